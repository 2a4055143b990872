//! The final gather interpolates between records only where they see the same surroundings.

use glam::Vec3;
use hemicube::base::progress::Unwatched;
use hemicube::form_factor::hemisphere::Hemispheres;
use hemicube::form_factor::{Viewpoint, map_rows};
use hemicube::patch::{MeshSettings, PatchMesh};
use hemicube::radiosity::Field;
use hemicube::radiosity::gather::{FinalGather, FinalGatherSettings};
use hemicube::scene::{Scene, SceneBuilder};
use hemicube::trace::Tracer;

use crate::support::scenes::{glowing, with_groups};

const WALL: f32 = 4.0;
const SHEET: f32 = 3.96;

/// Builds a room with a single-sided sheet, such as a mirror, close to its wall at x = 4.
fn room_with_a_sheet() -> Scene {
    let mut builder = SceneBuilder::default();
    let grey = builder.material(glowing(Vec3::splat(0.5), Vec3::ZERO));
    builder.room(Vec3::ZERO, Vec3::new(WALL, 3.0, 4.0), [grey; 6]);
    let corner = |y: f32, z: f32| Vec3::new(SHEET, y, z);
    builder.quad([corner(0.4, 0.8), corner(0.4, 3.2), corner(2.4, 3.2), corner(2.4, 0.8)], grey);
    with_groups(builder.build(), 1)
}

/// Returns viewpoints all over the wall; where the sheet hides the wall, they are on the sheet.
fn viewpoints() -> Vec<Viewpoint> {
    let positions = (1..60).flat_map(|i| (1..80).map(move |k| (0.05 * i as f32, 0.05 * k as f32)));
    let viewpoint = |(seed, (y, z))| {
        let is_hidden = (0.4..2.4).contains(&y) && (0.8..3.2).contains(&z);
        let x = if is_hidden { SHEET } else { WALL };
        Viewpoint { position: Vec3::new(x - 1e-4, y, z), normal: Vec3::NEG_X, seed }
    };
    (0..).zip(positions).map(viewpoint).collect()
}

/// All surfaces have radiosity 1 and the back of the sheet 0, so the exact irradiance is 1 minus the share of backs in
/// view.
#[test]
fn no_viewpoint_interpolates_records_behind_a_sheet() {
    let scene = room_with_a_sheet();
    let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.25, patch_size: 0.5 }).unwrap();
    let radiosity = Field::from_values(1, vec![Vec3::ONE; mesh.elements.len()]);
    let tracer = Tracer::new(&scene);
    let mut source = Hemispheres::new(&tracer, &mesh, 512);
    let settings = FinalGatherSettings { tolerance: 0.1, max_radius: 1.0, noise: f32::INFINITY, near_field_reach: 0.1 };
    let viewpoints = viewpoints();
    let gathered = FinalGather::new(&mesh, &radiosity, settings).at(&mut source, &viewpoints, &Unwatched).unwrap();
    let exact = map_rows(&mut source, &viewpoints, &|| true, |_, row| 1.0 - row.back()).unwrap();
    let errors = gathered.indirect.values().iter().zip(&exact).map(|(light, exact)| (light.x - exact).abs());
    let (on_sheet, on_wall): (Vec<_>, Vec<_>) =
        errors.zip(&viewpoints).partition(|(_, viewpoint)| viewpoint.position.x < SHEET);
    let worst = |errors: &[(f32, &Viewpoint)]| errors.iter().map(|(error, _)| *error).fold(0.0, f32::max);
    assert!(worst(&on_sheet) < 0.01, "{} on the sheet, which sees no backs", worst(&on_sheet));
    assert!(worst(&on_wall) < 0.1, "{} on the wall", worst(&on_wall));
}

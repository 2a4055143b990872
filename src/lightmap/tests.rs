//! Tests of lightmaps with light that is known everywhere.

use glam::{Quat, Vec2, Vec3};

use super::pieces::{Piece, pieces};
use super::*;
use crate::baked::GroupLight;
use crate::base::ids::TriangleId;
use crate::base::sampling::{r2, triangle_from_square};
use crate::base::triangle::interpolate;
use crate::patch::MeshSettings;
use crate::scene::builtin;

/// The Cornell box with a double-sided block, cut up.
fn room() -> (Scene, PatchMesh) {
    let mut scene = builtin::by_name("cornell").expect("it is built in");
    scene.materials.iter_mut().for_each(|material| material.double_sided = true);
    let turn = Quat::from_rotation_y(0.3) * Quat::from_rotation_x(0.2);
    scene.vertices.iter_mut().for_each(|vertex| {
        (vertex.position, vertex.normal) = (turn * vertex.position, turn * vertex.normal);
    });
    let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.2, patch_size: 0.5 }).expect("it can be cut");
    (scene, mesh)
}

/// Returns light that is a function of the vertex.
fn light(mesh: &PatchMesh, of: impl Fn(usize) -> Vec3) -> VertexLight {
    let direct = (0..mesh.vertices.len()).map(|v| of(v) * 0.25).collect();
    let indirect = (0..mesh.vertices.len()).map(|v| of(v) * 0.75).collect();
    VertexLight { groups: vec![GroupLight { direct, indirect }] }
}

const FINE: LightmapSettings = LightmapSettings { texel_size: 0.02, max_side: 2048 };

/// Places on a triangle, its edges and corners among them, as weights of its corners.
fn places() -> impl Iterator<Item = Vec3> {
    let along = (0..=8).map(|k| k as f32 / 8.0);
    let edges =
        along.flat_map(|x| [Vec3::new(x, 1.0 - x, 0.0), Vec3::new(0.0, x, 1.0 - x), Vec3::new(1.0 - x, 0.0, x)]);
    edges.chain((0..64).map(|i| triangle_from_square(r2(i, 7))))
}

fn between<T: std::ops::Mul<f32, Output = T> + std::ops::Add<Output = T> + Copy>(of: [T; 3], weights: Vec3) -> T {
    interpolate(of, weights)
}

/// Returns for each place of a lightmap its triangle, its position in the world, and the light that the texture shows
/// there.
fn shown(map: &Lightmap) -> impl Iterator<Item = (usize, Vec3, Vec3)> {
    (0..map.scene.triangles.len()).flat_map(move |t| {
        let positions = map.scene.corners(TriangleId::new(t));
        let coordinates = map.scene.triangles[t].vertices.map(|v| map.coordinates[v as usize]);
        places().map(move |weights| (t, between(positions, weights), map.texels.sample(between(coordinates, weights))))
    })
}

#[test]
fn light_that_is_linear_in_space_is_reproduced_within_one_texel() {
    let (scene, mesh) = room();
    let gradient = Vec3::new(3.0, 5.0, -2.0);
    let exact = |place: Vec3| Vec3::splat(40.0 + gradient.dot(place));
    let light = light(&mesh, |v| exact(mesh.vertices[v].position));
    let map = lightmap(&scene, &mesh, &light, &FINE).expect("it fits");
    assert!((map.texel_size / FINE.texel_size - 1.0).abs() < 1e-3, "{}", map.texel_size);
    let step = gradient.length() * map.texel_size;
    let deviations: Vec<f32> =
        shown(&map).map(|(_, place, light)| (light - exact(place)).abs().max_element() / step).collect();
    let worst = deviations.iter().copied().fold(0.0, f32::max);
    let exact = deviations.iter().filter(|&&deviation| deviation < 0.01).count();
    assert!(worst < 1.0, "{worst} texels");
    assert!(4 * exact > deviations.len(), "{exact} of {} within a hundredth of a texel", deviations.len());
    assert!(map.deviation < 2e-4, "{}", map.deviation);
}

#[test]
fn no_light_bleeds_between_surfaces() {
    // Every side of every wall has different light.
    let (scene, mesh) = room();
    let mut side_of = vec![(0, false); mesh.vertices.len()];
    for element in &mesh.elements {
        let instance = scene.triangles[element.triangle.index()].instance;
        element.vertices.iter().for_each(|&v| side_of[v as usize] = (instance.index(), element.is_back));
    }
    let own = |(instance, is_back): (usize, bool)| Vec3::splat((2 * instance + 1 + usize::from(is_back)) as f32);
    let light = light(&mesh, |v| own(side_of[v]));
    for texel_size in [0.02, 0.3] {
        let settings = LightmapSettings { texel_size, ..FINE };
        let map = lightmap(&scene, &mesh, &light, &settings).expect("it fits");
        for (t, place, light) in shown(&map) {
            let triangle = map.scene.triangles[t];
            let expected = own((triangle.instance.index(), map.scene.sides.is_back(TriangleId::new(t))));
            assert!((light - expected).abs().max_element() < 1e-3, "{light} and not {expected} at {place}");
        }
    }
}

#[test]
fn pieces_neither_overlap_nor_leave_the_texture() {
    let (scene, mesh) = room();
    let layout = layout::lay_flat(&scene, &FINE).expect("it fits");
    let dark = light(&mesh, |_| Vec3::ONE);
    let all: Vec<Piece> = pieces(&layout, &mesh, &dark).collect();
    assert_eq!(all.len(), mesh.elements.len());
    let size = Vec2::new(layout.size[0] as f32, layout.size[1] as f32);
    let within = |at: Vec2| at.cmpge(Vec2::splat(1.9)).all() && at.cmple(size - 1.9).all();
    assert!(all.iter().all(|piece| piece.corners.iter().all(|corner| within(corner.as_vec2()))));
    // The summed area of the pieces equals that of their surfaces.
    let flat: f64 = all.iter().map(|p| 0.5 * (p.corners[1] - p.corners[0]).perp_dot(p.corners[2] - p.corners[0])).sum();
    let surface: f64 = all.iter().map(|piece| piece.area).sum();
    let texels_a_metre = f64::from(layout.texel_size).recip();
    assert!((flat / (surface * texels_a_metre.powi(2)) - 1.0).abs() < 1e-3, "flat {flat}, surface {surface}");
    // No point of a fine grid lies in two of them.
    let mut taken = std::collections::HashSet::new();
    for piece in &all {
        let [a, b, c] = piece.corners.map(|corner| corner * 3.0);
        let (low, high) = (a.min(b).min(c).floor().as_i64vec2(), a.max(b).max(c).ceil().as_i64vec2());
        let points = (low.y..=high.y).flat_map(|y| (low.x..=high.x).map(move |x| (x, y)));
        for (x, y) in points {
            let at = glam::DVec2::new(x as f64 + 0.31, y as f64 + 0.43);
            let is_inside = [(a, b), (b, c), (c, a)].iter().all(|&(from, to)| (to - from).perp_dot(at - from) > 1e-3);
            assert!(!is_inside || taken.insert((x, y)), "{at} lies in two pieces");
        }
    }
    assert!(taken.len() as f64 > 0.9 * 9.0 * flat, "{} points on {flat} texels", taken.len());
}

#[test]
fn texels_grow_to_fit_the_largest_texture_and_too_small_a_texture_is_an_error() {
    let (scene, mesh) = room();
    let light = light(&mesh, |_| Vec3::ONE);
    let bounded = |max_side| lightmap(&scene, &mesh, &light, &LightmapSettings { max_side, ..FINE });
    let map = bounded(128).expect("it fits");
    assert!(map.texels.width.max(map.texels.height) <= 128 && map.texel_size > FINE.texel_size);
    assert_eq!(map.texels.irradiance.len(), (map.texels.width * map.texels.height) as usize);
    let error = bounded(12).expect_err("no room").to_string();
    assert!(error.contains("12 x 12"), "{error}");
}

#[test]
fn only_backs_and_seams_differ_from_the_scene() {
    let (scene, mesh) = room();
    let map = lightmap(&scene, &mesh, &light(&mesh, |_| Vec3::ONE), &FINE).expect("it fits");
    assert_eq!(map.scene.triangles.len(), 2 * scene.triangles.len());
    assert_eq!(map.scene.instances.len(), scene.instances.len());
    for (instance, laid) in scene.instances.iter().zip(&map.scene.instances) {
        assert_eq!((&instance.name, 2 * instance.triangles.len()), (&laid.name, laid.triangles.len()));
        let normal = |scene: &Scene, t: usize| crate::scene::normal_of(scene.corners(TriangleId::new(t)));
        let half = laid.triangles.len() / 2;
        for (k, t) in instance.triangles.clone().enumerate() {
            let [front, back] = [laid.triangles.start + k, laid.triangles.start + half + k];
            assert!((normal(&scene, t) - normal(&map.scene, front)).length() < 1e-6);
            assert!((normal(&scene, t) + normal(&map.scene, back)).length() < 1e-6);
            assert_eq!(map.scene.corners(TriangleId::new(front)), scene.corners(TriangleId::new(t)));
        }
    }
}

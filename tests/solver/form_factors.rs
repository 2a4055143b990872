//! Rows of form factors in random rooms: properties of every method, and agreement between methods.

use glam::Vec3;
use hemicube::form_factor::hemicube::{Hemicubes, size_for_patches};
use hemicube::form_factor::hemisphere::Hemispheres;
use hemicube::form_factor::polygon_pair::{Polygon, PolygonPair};
use hemicube::form_factor::{Entry, FormFactorSource, Row, Viewpoint, map_rows};
use hemicube::patch::{MeshSettings, PatchMesh};
use hemicube::radiosity::Viewpoints;
use hemicube::scene::{Scene, SceneBuilder, builtin};
use hemicube::trace::Tracer;

use crate::support::device::gpu;
use crate::support::scenes::{self, glowing, with_groups};

/// Returns a room, its mesh, and a viewpoint on each of its patches.
fn room(seed: u32) -> (Scene, PatchMesh, Vec<Viewpoint>) {
    let scene = scenes::cluttered_room(seed);
    let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.5, patch_size: 1.0 }).unwrap();
    let placement = Viewpoints::new(&scene);
    let viewpoints = mesh.patches.iter().flat_map(|patch| placement.on_patch(&mesh, patch, 1)).collect();
    (scene, mesh, viewpoints)
}

fn rows(source: &mut dyn FormFactorSource, viewpoints: &[Viewpoint]) -> Vec<Row> {
    map_rows(source, viewpoints, &|| true, |_, row| row.clone()).unwrap()
}

/// Sums up the share of the view that each input triangle fills.
fn by_triangle(entries: &[Entry], mesh: &PatchMesh) -> Vec<f32> {
    let mut shares = vec![0.0; mesh.roots.len()];
    for entry in entries {
        shares[mesh.elements[entry.element.index()].triangle.index()] += entry.factor;
    }
    shares
}

/// Asserts that rows in a closed room are complete: factors are positive and sum to 1 with those of backs, and no share
/// is sky.
fn assert_complete(rows: &[Row]) {
    for row in rows {
        let sum: f32 = row.entries.iter().map(|entry| entry.factor).sum();
        assert!(row.entries.iter().all(|entry| entry.factor > 0.0));
        assert!((sum + row.back() + row.sky - 1.0).abs() < 1e-4, "{sum} + {} + {}", row.back(), row.sky);
        assert!(row.sky == 0.0, "sky {}", row.sky);
    }
}

#[test]
fn rows_of_both_methods_sum_to_one_in_closed_rooms() {
    for seed in 0..4 {
        let (scene, mesh, viewpoints) = room(seed);
        let tracer = Tracer::new(&scene);
        assert_complete(&rows(&mut Hemispheres::new(&tracer, &mesh, 256), &viewpoints));
        if let Some(gpu) = gpu() {
            assert_complete(&rows(&mut Hemicubes::new(gpu, &scene, &mesh, 64), &viewpoints));
        }
    }
}

#[test]
fn hemispheres_and_hemicubes_agree() {
    let Some(gpu) = gpu() else { return };
    const NUM_RAYS: u32 = 4096;
    let (scene, mesh, viewpoints) = room(9);
    let tracer = Tracer::new(&scene);
    let by_rays = rows(&mut Hemispheres::new(&tracer, &mesh, NUM_RAYS), &viewpoints);
    let by_pixels = rows(&mut Hemicubes::new(gpu, &scene, &mesh, 128), &viewpoints);
    let assert_agree = |rays: &[Entry], pixels: &[Entry]| {
        for (a, b) in by_triangle(rays, &mesh).into_iter().zip(by_triangle(pixels, &mesh)) {
            let error = Hemispheres::standard_error(f64::from(b), f64::from(NUM_RAYS)) as f32;
            assert!((a - b).abs() < 4.0 * error + 1e-3, "{a} and {b}");
        }
    };
    for (rays, pixels) in by_rays.iter().zip(&by_pixels) {
        assert_agree(&rays.entries, &pixels.entries);
        assert_agree(&rays.backs, &pixels.backs);
    }
    assert!(by_rays.iter().any(|row| row.back() > 0.1), "some viewpoints see backs");
}

#[test]
fn culled_triangles_are_never_visible() {
    let Some(gpu) = gpu() else { return };
    for (scene, size_px) in
        [(scenes::cluttered_room(5), 16), (builtin::gallery(), 64), (scenes::cluttered_room(6), 256)]
    {
        let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.5, patch_size: 2.0 }).unwrap();
        let viewpoints = Viewpoints::new(&scene).at_light_vertices(&mesh);
        let mut culled = Hemicubes::new(gpu, &scene, &mesh, size_px);
        let mut whole = Hemicubes::new(gpu, &scene, &mesh, size_px).without_culling();
        for viewpoint in viewpoints.iter().step_by(viewpoints.len() / 12) {
            let (some, all) = (culled.elements_seen(viewpoint).unwrap(), whole.elements_seen(viewpoint).unwrap());
            assert!(some == all, "{size_px} px: {viewpoint:?}");
        }
    }
}

/// Computes the share of the view that two methods assign to different patches, as a mean over the viewpoints.
fn disagreement(one: &[Row], other: &[Row], mesh: &PatchMesh) -> f32 {
    let by_patch = |row: &Row| {
        let mut shares = vec![0.0; mesh.patches.len()];
        for entry in &row.entries {
            shares[mesh.elements[entry.element.index()].patch.index()] += entry.factor;
        }
        shares
    };
    let differing = |(a, b): (&Row, &Row)| -> f32 {
        by_patch(a).iter().zip(by_patch(b)).map(|(a, b)| (a - b).abs()).sum::<f32>() / 2.0
    };
    one.iter().zip(other).map(differing).sum::<f32>() / one.len() as f32
}

#[test]
fn the_chosen_hemicube_size_resolves_the_patches() {
    let Some(gpu) = gpu() else { return };
    for (seed, patch_size) in [(1, 0.5), (2, 1.0), (3, 2.0)] {
        let scene = scenes::cluttered_room(seed);
        let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: patch_size / 4.0, patch_size }).unwrap();
        let all = Viewpoints::new(&scene).at_light_vertices(&mesh);
        let viewpoints: Vec<Viewpoint> = all.iter().step_by(all.len() / 40).copied().collect();
        let rows_at = |size_px| rows(&mut Hemicubes::new(gpu, &scene, &mesh, size_px), &viewpoints);
        let (size_px, fine) = (size_for_patches(&scene, &mesh), rows_at(512));
        let error = disagreement(&rows_at(size_px), &fine, &mesh);
        assert!(error < 0.08, "{size_px} px, patches of {patch_size} m: {error}");
        if patch_size < 1.0 {
            let error = disagreement(&rows_at(size_px / 2), &fine, &mesh);
            assert!(error > 0.08, "{} px would be enough: {error}", size_px / 2);
        }
    }
}

/// Computes form factors `[i][j]` between patches, by `num_rays` rays from each of `num_points` points per patch.
fn between_patches(scene: &Scene, mesh: &PatchMesh, num_points: usize, num_rays: u32) -> Vec<Vec<f64>> {
    let placement = Viewpoints::new(scene);
    let of_patch = |patch| placement.on_patch(mesh, patch, num_points);
    let viewpoints: Vec<Viewpoint> = mesh.patches.iter().flat_map(of_patch).collect();
    let tracer = Tracer::new(scene);
    let mut factors = vec![vec![0.0; mesh.patches.len()]; mesh.patches.len()];
    for (at, row) in rows(&mut Hemispheres::new(&tracer, mesh, num_rays), &viewpoints).iter().enumerate() {
        for entry in &row.entries {
            let seen = mesh.elements[entry.element.index()].patch.index();
            factors[at / num_points][seen] += f64::from(entry.factor) / num_points as f64;
        }
    }
    factors
}

#[test]
fn form_factors_between_patches_are_reciprocal() {
    const NUM_POINTS: usize = 16;
    const NUM_RAYS: u32 = 256;
    let (scene, mesh, _) = room(3);
    let factors = between_patches(&scene, &mesh, NUM_POINTS, NUM_RAYS);
    let exchange = |i: usize, j: usize| {
        let area = f64::from(mesh.patches[i].area);
        let error = Hemispheres::standard_error(factors[i][j], f64::from(NUM_RAYS) * NUM_POINTS as f64);
        (area * factors[i][j], area * error)
    };
    // Differences from reciprocity, in units of their standard errors.
    let deviations = (0..factors.len()).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| {
        let ((one, one_error), (other, other_error)) = (exchange(i, j), exchange(j, i));
        (one - other) / one_error.hypot(other_error)
    });
    let (sum, count) = deviations.fold((0.0, 0), |(sum, count), z: f64| (sum + z * z, count + 1));
    let rms = (sum / f64::from(count)).sqrt();
    assert!(rms < 1.0, "{rms}");
}

#[test]
fn a_half_transparent_surface_fills_half_of_the_view() {
    let mut builder = SceneBuilder::default();
    let pane = builder.material(glowing(Vec3::splat(0.5), Vec3::ONE));
    let quad = |z: f32| [(-9.0, -9.0), (-9.0, 9.0), (9.0, 9.0), (9.0, -9.0)].map(|(x, y)| Vec3::new(x, y, z));
    builder.quad(quad(0.1), pane);
    let mut scene = with_groups(builder.build(), 1);
    scene.materials[0].base_colour.w = 0.5;
    scene.materials[0].alpha_mode = hemicube::scene::AlphaMode::Blend;
    let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 99.0, patch_size: 99.0 }).unwrap();
    let tracer = Tracer::new(&scene);
    let viewpoint = Viewpoint { position: Vec3::ZERO, normal: Vec3::Z, seed: 1 };
    let row = &rows(&mut Hemispheres::new(&tracer, &mesh, 4096), &[viewpoint])[0];
    let seen: f32 = row.entries.iter().map(|entry| entry.factor).sum();
    assert!((seen - 0.5).abs() < 0.03 && (row.sky - 0.5).abs() < 0.03, "{seen} and {}", row.sky);
}

fn polygon(corners: &[[f64; 3]]) -> Polygon {
    Polygon::new(corners.iter().map(|&corner| corner.into()).collect()).unwrap()
}

/// Returns pairs of a unit square that faces up and another polygon, with their published form factors.
fn published_pairs() -> Vec<(PolygonPair, f64)> {
    let floor = || polygon(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
    let ceiling = |z: f64| polygon(&[[0., 1., z], [1., 1., z], [1., 0., z], [0., 0., z]]);
    let wall = polygon(&[[0., 0., 0.], [0., 1., 0.], [0., 1., 1.], [0., 0., 1.]]);
    vec![
        (PolygonPair { a: floor(), b: ceiling(1.0), blocker: None }, 0.199_824_9),
        (PolygonPair { a: floor(), b: ceiling(0.01), blocker: None }, 0.980_416_6),
        (PolygonPair { a: floor(), b: wall, blocker: None }, 0.200_043_8),
    ]
}

/// Returns two large squares with a small one between them that blocks the view. No simple closed form is known, but
/// the methods share no step.
fn blocked_pair() -> PolygonPair {
    let square = |size: f64, z: f64| polygon(&[[-size, -size, z], [size, -size, z], [size, size, z], [-size, size, z]]);
    let ceiling = polygon(&[[-1., 1., 1.], [1., 1., 1.], [1., -1., 1.], [-1., -1., 1.]]);
    PolygonPair { a: square(1.0, 0.0), b: ceiling, blocker: Some(square(0.5, 0.7)) }
}

#[test]
fn three_methods_compute_the_published_form_factors() {
    for (pair, exact) in published_pairs() {
        let analytic = pair.analytic().factor;
        assert!((analytic - exact).abs() < 1e-6, "{analytic} {exact}");
        let rays = pair.by_hemispheres().unwrap();
        assert!((rays.factor - exact).abs() < (3.0 * rays.error).min(1e-3), "{rays:?} {exact}");
        if let Some(gpu) = gpu() {
            let cubes = pair.by_hemicubes(gpu, 128).unwrap();
            assert!((cubes.factor / exact - 1.0).abs() < 0.01, "{cubes:?} {exact}");
        }
    }
}

#[test]
fn three_methods_agree_behind_a_blocker() {
    let pair = blocked_pair();
    let open = PolygonPair { blocker: None, ..pair.clone() }.analytic().factor;
    let analytic = pair.analytic();
    assert!(analytic.factor < 0.8 * open && analytic.error < 1e-6, "{analytic:?} of {open}");
    let rays = pair.by_hemispheres().unwrap();
    assert!((rays.factor - analytic.factor).abs() < 3.0 * rays.error, "{rays:?} {analytic:?}");
    let Some(gpu) = gpu() else { return };
    let cubes = pair.by_hemicubes(gpu, 128).unwrap();
    assert!((cubes.factor / analytic.factor - 1.0).abs() < 0.02, "{cubes:?} {analytic:?}");
}

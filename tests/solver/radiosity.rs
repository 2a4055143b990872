//! Known answers of whole bakes: furnaces, linearity, energy balance, agreement of solvers.

use glam::Vec3;
use hemicube::bake::{BakeContext, BakeSettings, Method, Quality, Refinement, Solver, bake, bake_with};
use hemicube::base::colour::luminance;
use hemicube::base::ids::GroupId;
use hemicube::gpu::Gpu;
use hemicube::scene::{Light, SceneBuilder, builtin};

use crate::support::device::gpu;
use crate::support::scenes::{self, glowing, with_groups};

/// Returns the largest relative deviation from the exact answer over all vertices, and the imbalance of the energy
/// balance.
fn furnace_errors(gpu: Option<&Gpu>, method: Method) -> (f32, f64) {
    let (reflectance, exitance) = (Vec3::new(0.5, 0.7, 0.2), Vec3::new(1.0, 2.0, 3.0));
    let scene = scenes::furnace(reflectance, exitance);
    let settings = BakeSettings {
        element_size: Some(0.1),
        method: Some(method),
        threshold: 1e-4,
        ..BakeSettings::preset(Quality::Draft)
    };
    let bake = bake_with(&scene, &settings, &BakeContext { gpu, ..BakeContext::default() }).unwrap();
    let exact = exitance / (Vec3::ONE - reflectance);
    let group = &bake.baked.light.groups[0];
    let deviation = |(direct, indirect): (&Vec3, &Vec3)| {
        let radiosity = exitance + reflectance * (*direct + *indirect);
        ((radiosity - exact) / exact).abs().max_element()
    };
    let worst = group.direct.iter().zip(&group.indirect).map(deviation).fold(0.0, f32::max);
    (worst, bake.report.energy.imbalance)
}

#[test]
fn hemicubes_bake_a_furnace_to_its_closed_form() {
    let Some(gpu) = gpu() else { return };
    let (worst, imbalance) = furnace_errors(Some(gpu), Method::Hemicube);
    assert!(worst < 5e-3 && imbalance < 1e-3, "worst deviation {worst}, imbalance {imbalance}");
}

#[test]
fn hemispheres_bake_a_furnace_to_its_closed_form_without_a_device() {
    let (worst, imbalance) = furnace_errors(None, Method::Hemisphere);
    assert!(worst < 5e-3 && imbalance < 1e-3, "worst deviation {worst}, imbalance {imbalance}");
}

/// Returns the draft preset without adaptive subdivision.
fn without_refinement() -> BakeSettings {
    let draft = BakeSettings::preset(Quality::Draft);
    BakeSettings { refinement: Refinement { max_error: 0.0, ..draft.refinement }, ..draft }
}

/// Builds a room with two point lights of these intensities, in two groups.
fn lamp_room(intensities: [f32; 2]) -> hemicube::scene::Scene {
    let mut builder = SceneBuilder::default();
    let white = builder.material(glowing(Vec3::splat(0.7), Vec3::ZERO));
    let red = builder.material(glowing(Vec3::new(0.6, 0.1, 0.1), Vec3::ZERO));
    builder.room(Vec3::ZERO, Vec3::new(3.0, 2.0, 2.5), [white, white, red, white, white, white]);
    builder.light(Light::point(Vec3::new(1.0, 1.5, 1.0), Vec3::splat(intensities[0])));
    builder.light(Light { group: GroupId(1), ..Light::point(Vec3::new(2.2, 1.7, 1.8), Vec3::splat(intensities[1])) });
    with_groups(builder.build(), 2)
}

#[test]
fn light_is_linear_and_groups_are_independent() {
    let Some(gpu) = gpu() else { return };
    // Subdivision depends on the light. Without it both bakes have the same mesh.
    let settings = BakeSettings { element_size: Some(0.4), ..without_refinement() };
    let bake = |intensities| bake_with(&lamp_room(intensities), &settings, &BakeContext::on(gpu)).unwrap().baked.light;
    let (one, other) = (bake([100.0, 30.0]), bake([200.0, 30.0]));
    // The order of shooting depends on the powers, so the sums differ by the unshot power.
    for (group, factor) in [(0, 2.0), (1, 1.0)] {
        let sum = |light: &hemicube::baked::VertexLight| {
            let group = &light.groups[group];
            group.direct.iter().chain(&group.indirect).map(|e| f64::from(e.y)).sum::<f64>()
        };
        let ratio = sum(&other) / sum(&one);
        assert!((ratio / factor - 1.0).abs() < 2e-3, "group {group} grew by {ratio}");
    }
}

#[test]
fn in_a_closed_room_no_light_escapes() {
    let Some(gpu) = gpu() else { return };
    let settings = BakeSettings { element_size: Some(0.4), ..BakeSettings::preset(Quality::Draft) };
    let report = bake_with(&lamp_room([100.0, 30.0]), &settings, &BakeContext::on(gpu)).unwrap().report;
    assert!(report.energy.escaped < 1e-4 * report.energy.emitted, "{:?}", report.energy);
    assert!(report.energy.imbalance < 1e-3 && report.work.unshot_share < 0.01, "{report:?}");
    // Each lamp emits the flux 4 pi I. It is sampled at vertices, so a coarse mesh has an error of a few percent.
    let flux = 4.0 * std::f64::consts::PI * 130.0;
    assert!((report.energy.emitted / flux - 1.0).abs() < 0.05, "{} lm of {flux}", report.energy.emitted);
}

#[test]
fn a_wall_of_fine_holes_bakes_to_finite_light() {
    let Some(gpu) = gpu() else { return };
    let settings = BakeSettings { element_size: Some(0.25), ..BakeSettings::preset(Quality::Draft) };
    let mut scene = lamp_room([100.0, 30.0]);
    // One texel in a hundred is solid, so the samples of most elements hit none.
    let mut texels = vec![[255, 255, 255, 0]; 100];
    texels[42] = [255; 4];
    scene.textures.push(crate::support::quads::texture(10, &texels));
    scene.materials[1].base_colour_texture = Some(crate::support::quads::slot(0));
    scene.materials[1].alpha_mode = hemicube::scene::AlphaMode::Mask { cutoff: 0.5 };
    for (i, vertex) in scene.vertices.iter_mut().enumerate() {
        vertex.uv[0] = glam::Vec2::new((i % 4 / 2) as f32, (i % 2) as f32);
    }
    let light = bake_with(&scene, &settings, &BakeContext::on(gpu)).unwrap().baked.light;
    assert!(light.groups.iter().flat_map(|g| g.direct.iter().chain(&g.indirect)).all(|e| e.is_finite()));
}

/// Returns the luminance of all light at each vertex.
fn irradiance(bake: &hemicube::bake::Bake) -> Vec<f32> {
    let group = &bake.baked.light.groups[0];
    group.direct.iter().zip(&group.indirect).map(|(direct, indirect)| luminance(*direct + *indirect)).collect()
}

#[test]
fn three_solvers_agree_on_the_cornell_box() {
    let scene = builtin::cornell();
    let solved = |solver| {
        let settings = BakeSettings {
            solver,
            method: Some(Method::Hemisphere),
            threshold: 1e-3,
            ..BakeSettings::preset(Quality::Draft)
        };
        bake(&scene, &settings).unwrap()
    };
    let matrix = solved(Solver::Matrix);
    let exact = irradiance(&matrix);
    let mean = exact.iter().sum::<f32>() / exact.len() as f32;
    for solver in [Solver::Progressive, Solver::Gathering] {
        let other = solved(solver);
        let worst = irradiance(&other).iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(worst < 0.005 * mean, "{solver:?}: {worst} of {mean}");
        assert!(other.report.energy.imbalance < 1e-3, "{:?}", other.report.energy);
    }
}

#[test]
fn each_gathering_pass_adds_one_reflection() {
    // In a furnace the light of k reflections is a partial sum of E (1 + rho + rho^2 + ...).
    let (reflectance, exitance) = (Vec3::new(0.5, 0.7, 0.2), Vec3::new(1.0, 2.0, 3.0));
    let scene = scenes::furnace(reflectance, exitance);
    for passes in 1..=4 {
        let settings = BakeSettings {
            element_size: Some(0.3),
            method: Some(Method::Hemisphere),
            solver: Solver::Gathering,
            passes: Some(passes),
            ..BakeSettings::preset(Quality::Draft)
        };
        let bake = bake(&scene, &settings).unwrap();
        let expected = (0..passes as i32).map(|k| exitance * reflectance.powf(k as f32)).sum::<Vec3>();
        let group = &bake.baked.light.groups[0];
        for (direct, indirect) in group.direct.iter().zip(&group.indirect) {
            let found = *direct + *indirect;
            assert!(((found - expected) / expected).abs().max_element() < 5e-3, "pass {passes}: {found} {expected}");
        }
        assert_eq!(bake.report.work.passes, passes);
    }
}

//! How much light arrives: soft shadows, closed forms, and the share of the bake.

use glam::Vec3;
use hemicube::baked::VertexLight;
use hemicube::base::ids::GroupId;
use hemicube::render::shadow::shadow_difference;
use hemicube::render::{ShadowSettings, ShadowTechnique};
use hemicube::scene::{Material, builtin};

use super::stage::{SIZE, Shot, Stage, at, num_different, paint, settings};
use crate::support::device::gpu;

#[test]
fn soft_shadows_are_the_mean_of_the_rays_to_the_same_points() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.2, 0.0), 0);
    stage.scene.lights.clear();
    let emission = Vec3::splat(4.0);
    let lamp = stage.material(Material { emission, group: Some(GroupId(0)), ..paint() });
    stage.quad_of(Vec3::new(-0.5, 4.0, -0.5), Vec3::X, Vec3::Z, lamp);
    let shot = stage.shot(gpu);
    let with = |technique| ShadowSettings { light_samples: 64, ..settings(technique) };
    let truth = shot.decisions(gpu, &with(ShadowTechnique::Raytraced));
    let found = shot.decisions(gpu, &with(ShadowTechnique::VolumeDepthFail));
    assert_eq!((truth.samples.len(), num_different(&shadow_difference(&found, &truth))), (64, 0));
    let [soft, rays] =
        [ShadowTechnique::VolumeDepthFail, ShadowTechnique::Raytraced].map(|t| shot.picture(gpu, &with(t), 1));
    // Where no sample's edge passes, the sums agree; a sample's edge may move by a pixel and brings 1 / 64.
    let distance = |(a, b): (&u8, &u8)| a.abs_diff(*b);
    let differing = soft.display.iter().zip(&rays.display).map(distance).filter(|&d| d > 1).count();
    assert!(differing < soft.display.len() / 100, "{differing}");
}

#[test]
fn direct_light_of_many_samples_is_that_of_the_closed_form() {
    let scene = builtin::cornell();
    let (floor, normal) = (Vec3::new(4.5, 0.0, 1.0), Vec3::Y);
    let lamp = [[3.43, 2.27], [3.43, 3.32], [2.13, 3.32], [2.13, 2.27]].map(|[x, z]| Vec3::new(x, 5.488, z));
    let factor = hemicube::form_factor::analytic::point_to_polygon(floor, normal, &lamp);
    let samples = hemicube::render::shadow::light_samples(&scene, 64, 0.0);
    let sum: Vec3 = samples.iter().map(|sample| sample.irradiance(floor, normal)).sum();
    let expected = Vec3::new(17.0, 12.0, 4.0) * std::f32::consts::PI * factor.abs();
    assert!((sum / expected - 1.0).abs().max_element() < 0.01, "{sum}, not {expected}");
}

#[test]
fn live_direct_light_takes_the_place_of_the_stored_and_leaves_the_indirect() {
    let Some(gpu) = gpu() else { return };
    let stage = Stage::new();
    let mut light = VertexLight::dark(1, stage.scene.vertices.len());
    light.groups[0].direct.fill(Vec3::splat(1000.0));
    light.groups[0].indirect.fill(Vec3::splat(3.0));
    let shot = Shot { buffers: stage.lit(gpu, light), ..stage.shot(gpu) };
    let (x, y) = (SIZE[0] / 2, SIZE[1] / 2 + 20);
    for technique in [ShadowTechnique::VolumeDepthFail, ShadowTechnique::Map, ShadowTechnique::Raytraced] {
        let picture = shot.picture(gpu, &settings(technique), 4);
        let found = picture.radiance[(y * SIZE[0] + x) as usize][0];
        let point = stage.floor_under(x, y);
        let direct = stage.scene.lights[0].arrival(point);
        let received = 3.0 + direct.irradiance.x * direct.to_light.y;
        let expected = 0.5 * (0.1 + received / std::f32::consts::PI);
        assert!((found / expected - 1.0).abs() < 0.01, "{technique:?}: {found}, not {expected}");
    }
}

//! Amounts of light: soft shadows, closed forms, and the stored light of a bake.

use glam::Vec3;
use hemicube::baked::VertexLight;
use hemicube::base::ids::GroupId;
use hemicube::render::shadow::{Decisions, SampleBatch, shadow_difference};
use hemicube::render::{ShadowSettings, ShadowTechnique};
use hemicube::scene::{Light, LightKind, Material, builtin};

use super::stage::{SIZE, Shot, Stage, at, num_different, paint, settings};
use crate::support::device::gpu;

#[test]
fn soft_shadows_are_the_mean_of_rays_to_the_same_points() {
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
    // The sums agree except at the edges of the shadows of single samples.
    let is_at_edge = at_edges(&truth);
    let num_compared = is_at_edge.iter().filter(|is_at_edge| !**is_at_edge).count();
    assert!(num_compared > is_at_edge.len() / 2, "{num_compared} pixels compared");
    let pixels = soft.display.as_chunks::<4>().0.iter().zip(rays.display.as_chunks::<4>().0).zip(&is_at_edge);
    for (place, ((soft, rays), _)) in pixels.enumerate().filter(|(_, (_, is_at_edge))| !**is_at_edge) {
        assert!((0..3).all(|i| soft[i].abs_diff(rays[i]) <= 1), "pixel {place}: {soft:?}, by rays {rays:?}");
    }
}

/// Returns the pixels that have a neighbour whose decision about a sample differs. The edge there may shift by a pixel.
fn at_edges(truth: &Decisions) -> Vec<bool> {
    let [width, height] = truth.size.map(|side| side as usize);
    let around = |at: usize, limit: usize| at.saturating_sub(1)..=(at + 1).min(limit - 1);
    let differs = |place: usize| {
        let beside =
            || around(place / width, height).flat_map(|y| around(place % width, width).map(move |x| y * width + x));
        truth.samples.iter().any(|sample| beside().any(|other| sample.lit[other] != sample.lit[place]))
    };
    (0..width * height).map(differs).collect()
}

#[test]
fn direct_light_of_many_samples_is_that_of_the_closed_form() {
    let scene = builtin::cornell();
    let (floor, normal) = (Vec3::new(4.5, 0.0, 1.0), Vec3::Y);
    let lamp = [[3.43, 2.27], [3.43, 3.32], [2.13, 3.32], [2.13, 2.27]].map(|[x, z]| Vec3::new(x, 5.488, z));
    let factor = hemicube::form_factor::point_to_polygon(floor, normal, &lamp);
    let samples = hemicube::render::shadow::light_samples(&scene, 64, 0.0);
    let sum: Vec3 = samples.iter().map(|sample| sample.irradiance(floor, normal)).sum();
    let expected = Vec3::new(17.0, 12.0, 4.0) * std::f32::consts::PI * factor.abs();
    assert!((sum / expected - 1.0).abs().max_element() < 0.01, "{sum}, not {expected}");
}

#[test]
fn the_surface_pass_adds_the_same_light_as_the_direct_light_pass() {
    let Some(gpu) = gpu() else { return };
    let place = Vec3::new(-2.0, 3.0, 1.5);
    let spot = LightKind::Spot { position: place, direction: -place.normalize(), inner_angle: 0.3, outer_angle: 0.6 };
    let kinds = [
        LightKind::Point { position: Vec3::new(2.0, 3.5, 0.0) },
        LightKind::Directional { direction: Vec3::new(0.3, -1.0, -0.4).normalize() },
        spot,
    ];
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.0, 0.0), 0).sphere(Vec3::new(-1.6, 1.0, 0.3), 0.6);
    let lamps = kinds.map(|kind| Light { kind, ..stage.scene.lights[0].clone() });
    stage.scene.lights.extend(lamps);
    for num_lamps in [4, 1] {
        stage.scene.lights.truncate(num_lamps);
        let shot = stage.shot(gpu);
        for technique in [ShadowTechnique::Map, ShadowTechnique::None] {
            let mut at_once = settings(technique);
            at_once.maps.normal_offset = if num_lamps == 1 { 1.0 } else { 0.0 };
            let in_passes = ShadowSettings { batch: Some(SampleBatch::whole(0)), ..at_once.clone() };
            for samples in [1, 4] {
                let [few, passes] = [&at_once, &in_passes].map(|settings| shot.picture(gpu, settings, samples));
                let pairs = few.radiance.iter().zip(&passes.radiance);
                let differs = |a: &f32, b: &f32| (a - b).abs() > 0.01 * b.max(0.1);
                let differing = pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| differs(a, b))).count();
                // With several samples a pixel, half floats and centroids are rounded differently at edges.
                let allowed = if samples > 1 { few.radiance.len() / 4000 } else { 0 };
                assert!(
                    differing <= allowed,
                    "{num_lamps} lamps, {technique:?}, {samples} samples a pixel: {differing}"
                );
            }
        }
    }
}

#[test]
fn real_time_direct_light_replaces_the_stored_direct_light_and_keeps_the_indirect() {
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

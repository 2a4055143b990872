//! Shadows on a device without optional features.

use std::sync::Arc;

use hemicube::baked::{BakedScene, VertexLight};
use hemicube::gpu::Gpu;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::shadow::{ComparedScene, Decisions, ShadowComparison, shadow_difference};
use hemicube::render::{ShadowScene, ShadowTechnique, View};

use super::stage::{SIZE, Stage, at, num_different, places, raytraced, settings};
use crate::support::device::gpu;

/// A second device of the adapter, without optional features: depth has 24 bits, and light is added up in 16-bit
/// floats.
fn plain_device(gpu: &Gpu) -> Gpu {
    let descriptor = wgpu::DeviceDescriptor { required_limits: gpu.adapter.limits(), ..Default::default() };
    let (device, queue) = pollster::block_on(gpu.adapter.request_device(&descriptor)).expect("a plain device");
    Gpu::from_parts(gpu.instance.clone(), gpu.adapter.clone(), device, queue)
}

/// Shadows have a stencil of their own, in a format that every device has.
#[test]
fn case_24_without_optional_formats_shadows_are_as_exact() {
    let Some(gpu) = gpu() else { return };
    let gpu = &plain_device(gpu);
    assert!(!gpu.device.features().contains(wgpu::Features::DEPTH32FLOAT_STENCIL8));
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.0, 0.0), 0).sphere(glam::Vec3::new(-1.6, 1.0, 0.3), 0.6);
    let light = VertexLight::dark(1, stage.scene.vertices.len());
    let baked = BakedScene::new(stage.scene, light);
    let scene = &SceneBuffers::new(gpu, &baked);
    let shadows = &ShadowScene::new(gpu, Arc::new(baked.scene));
    let view = &View::from_camera(&stage.camera, SIZE[0] as f32 / SIZE[1] as f32);
    let mut comparison = ShadowComparison::new(gpu);
    let mut decide = |settings| -> Decisions {
        comparison.decisions(gpu, ComparedScene { scene, shadows, view, size: SIZE }, &settings).expect("decisions")
    };
    let truth = decide(raytraced());
    let dark = truth.samples[0].lit.iter().filter(|lit| !**lit).count();
    assert!(dark > 100 && dark < truth.samples[0].lit.len(), "{dark} dark pixels show nothing");
    for technique in [ShadowTechnique::VolumeDepthFail, ShadowTechnique::VolumeDepthPass, ShadowTechnique::Planar] {
        let difference = shadow_difference(&decide(settings(technique)), &truth);
        assert_eq!(num_different(&difference), 0, "{technique:?} at {:?}", places(&difference));
    }
    let map = shadow_difference(&decide(settings(ShadowTechnique::Map)), &truth);
    assert!(map.share <= 0.005, "{}", map.share);
}

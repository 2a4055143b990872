//! Direct light that looks into a shadow map: one pass for each kind of map and each softening.
//!
//! They are constants of the shader: drivers that draw on the CPU go through both sides of every branch.

use std::collections::HashMap;

use super::direct_light::{DirectLightPass, WHERE_UNSHADOWED};
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};

/// Direct light of one sample where its shadow map sees the point.
pub(in crate::render) const DIRECT_LIGHT_MAP: Shader = shader!(
    "direct light, map",
    "shared/frame.wgsl",
    "shared/facet.wgsl",
    "shared/light_sample.wgsl",
    "shared/one_light.wgsl",
    "shared/lit_point.wgsl",
    "shared/shadow_map.wgsl",
    "shared/map_lookup.wgsl",
    "shared/visibility_map.wgsl",
    "direct_light.wgsl"
);

/// What a map is like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MapKind {
    /// Six faces round a point; else one.
    pub is_cube: bool,
    /// Texels each way over which shadows are softened.
    pub pcf_radius: u32,
}

/// The passes that were asked for so far.
pub struct MapLight {
    layouts: [wgpu::BindGroupLayout; 3],
    samples: u32,
    passes: HashMap<MapKind, DirectLightPass>,
}

impl MapLight {
    /// Passes with these bind groups for targets with `samples` samples a pixel.
    pub fn new(layouts: [&wgpu::BindGroupLayout; 3], samples: u32) -> Self {
        Self { layouts: layouts.map(Clone::clone), samples, passes: HashMap::new() }
    }

    /// The pass that reads maps of a kind.
    pub fn pass(&mut self, gpu: &Gpu, kind: MapKind) -> &DirectLightPass {
        self.passes.entry(kind).or_insert_with(|| {
            let constants =
                [("IS_CUBE", f64::from(u8::from(kind.is_cube))), ("PCF_RADIUS", f64::from(kind.pcf_radius))];
            let layouts = self.layouts.each_ref().map(Some);
            let shader = (&DIRECT_LIGHT_MAP, constants.as_slice());
            DirectLightPass::new(gpu, &layouts, shader, self.samples, &WHERE_UNSHADOWED)
        })
    }
}

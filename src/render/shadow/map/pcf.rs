//! Percentage-closer filtering: direct light with its shadow looked up in a map.
//!
//! The share of a light that reaches a point is the mean of depth comparisons over the texels round it, not the
//! comparison with a mean depth (Reeves, Salesin and Cook 1987, "Rendering antialiased shadows with depth maps"). The
//! loop is in shaders/shadow/map/pcf.wgsl.

use std::collections::HashMap;

use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::shadow::light::direct_light::{DirectLightPass, LIGHT_UNSHADOWED};
use crate::render::shadow::light::pass_setup::PassSetup;

/// Direct light where the shadow map shows no caster before the point.
pub const DIRECT_LIGHT_PCF: Shader = shader!(
    "direct light, shadow map",
    "shared/frame.wgsl",
    "shadow/light/facet.wgsl",
    "shadow/light/light_sample.wgsl",
    "shadow/light/one_light.wgsl",
    "shadow/light/lit_point.wgsl",
    "shadow/map/projection.wgsl",
    "shadow/map/pcf.wgsl",
    "shadow/map/map_visibility.wgsl",
    "shadow/light/direct_light.wgsl"
);

/// What a map is like. These are constants of the shader, because software drivers execute both sides of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MapKind {
    /// Six faces round a point light; else one face.
    pub is_cube: bool,
    /// Texels in each direction over which shadows are filtered.
    pub pcf_radius: u32,
}

/// One direct light pass for each kind of map that has been drawn.
pub struct PcfPasses {
    setup: PassSetup,
    map_layout: wgpu::BindGroupLayout,
    passes: HashMap<MapKind, DirectLightPass>,
}

impl PcfPasses {
    /// No passes yet; they read maps bound with `map_layout` as bind group 2.
    pub fn new(setup: &PassSetup, map_layout: &wgpu::BindGroupLayout) -> Self {
        Self { setup: setup.clone(), map_layout: map_layout.clone(), passes: HashMap::new() }
    }

    /// Returns the pass that reads maps of a kind.
    pub fn pass(&mut self, gpu: &Gpu, kind: MapKind) -> &DirectLightPass {
        self.passes.entry(kind).or_insert_with(|| {
            let constants =
                [("IS_CUBE", f64::from(u8::from(kind.is_cube))), ("PCF_RADIUS", f64::from(kind.pcf_radius))];
            let [frame, sample] = self.setup.groups();
            let groups = [frame, sample, Some(&self.map_layout)];
            DirectLightPass::new(gpu, &groups, (&DIRECT_LIGHT_PCF, &constants), self.setup.samples, &LIGHT_UNSHADOWED)
        })
    }
}

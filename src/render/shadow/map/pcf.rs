//! Percentage-closer filtering: direct light with its shadow looked up in a map.
//!
//! The fraction of a light that reaches a point is the mean of depth comparisons with the texels round it, not the
//! comparison with a mean depth (Reeves, Salesin and Cook 1987, "Rendering antialiased shadows with depth maps"). The
//! loop is in shaders/shadow/map/pcf.wgsl.

use std::collections::HashMap;

use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::shadow::light::direct_light::{DirectLightPass, LIGHT_UNSHADOWED};
use crate::render::shadow::light::pass_setup::PassSetup;

/// Shader that adds direct light where the shadow map has no caster in front of the point.
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

/// Properties of a map. They are constants of the shader, because software drivers execute both sides of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MapKind {
    /// True if the map has six faces round a point light, false if it has one.
    pub is_cube: bool,
    /// Texels in each direction over which shadows are filtered.
    pub pcf_radius: u32,
}

/// Direct light passes, one for each kind of map that has been drawn.
pub struct PcfPasses {
    setup: PassSetup,
    map_layout: wgpu::BindGroupLayout,
    passes: HashMap<MapKind, DirectLightPass>,
}

impl PcfPasses {
    /// Creates an empty set. Its passes will read maps that are bound with `map_layout` as bind group 2.
    pub fn new(setup: &PassSetup, map_layout: &wgpu::BindGroupLayout) -> Self {
        Self { setup: setup.clone(), map_layout: map_layout.clone(), passes: HashMap::new() }
    }

    /// Returns the pass that reads maps of a kind; the first call creates it.
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

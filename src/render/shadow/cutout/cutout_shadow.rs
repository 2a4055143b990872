//! Cut-out shadow pass: marks visible points whose line to the light is blocked by an opaque part of a caster with
//! holes.

use super::cutouts::{SceneCutouts, cutouts_layout};
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::scene::materials::material_layout;
use crate::render::shadow::light::pass_setup::PassSetup;
use crate::render::shadow::shared::frame_context::FrameContext;
use crate::render::shadow::shared::pipeline::{PipelineRecipe, against_depth, culling, pipeline_layout};
use crate::render::shadow::shared::solid_surfaces::SolidPipelines;
use crate::render::shadow::shared::stencil::{SHADOW_BITS, both_faces, on_pass};

/// Shader of the cut-out shadow pass.
pub const CUTOUT_SHADOW: Shader = shader!(
    "cut-out shadow",
    "shared/frame.wgsl",
    "shared/material.wgsl",
    "shadow/shared/visible_point.wgsl",
    "shadow/light/light_sample.wgsl",
    "shadow/light/one_light.wgsl",
    "shadow/cutout/cutout_shadow.wgsl"
);
/// Stencil value of a point in shadow, within [`SHADOW_BITS`].
const SHADOWED: u32 = 1;

/// Cut-out shadow pass.
pub struct CutoutShadowPass {
    pipelines: SolidPipelines,
}

impl CutoutShadowPass {
    /// Creates pipelines.
    pub fn new(gpu: &Gpu, setup: &PassSetup) -> Self {
        let module = CUTOUT_SHADOW.module(gpu);
        let [frame, sample] = setup.groups();
        let groups = [frame, sample, Some(&material_layout(gpu)), Some(&cutouts_layout(gpu))];
        let layout = pipeline_layout(gpu, "cut-out shadow", &groups);
        let mark = on_pass(wgpu::CompareFunction::Always, wgpu::StencilOperation::Replace);
        let stencil = both_faces(mark, !0, SHADOW_BITS);
        let pipelines = SolidPipelines::new(|cull_mode| {
            let equal = wgpu::CompareFunction::Equal;
            PipelineRecipe {
                fragment: Some(("fragment", &[])),
                primitive: culling(cull_mode),
                depth_stencil: Some(against_depth(gpu, equal, stencil.clone(), Default::default())),
                samples: setup.samples,
                ..PipelineRecipe::new("cut-out shadow", &layout, &module)
            }
            .make(gpu)
        });
        Self { pipelines }
    }

    /// Marks the points in shadow, in a stencil pass with bind groups 0 and 1 set.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, frame: FrameContext<'_>) {
        let cutouts = frame.shadows.kept(|| SceneCutouts::new(frame.gpu, frame.shadows.scene()));
        pass.set_stencil_reference(SHADOWED);
        for cutouts in &cutouts.0 {
            pass.set_bind_group(2, &frame.scene.materials[cutouts.material.index()], &[]);
            pass.set_bind_group(3, &cutouts.triangles, &[]);
            self.pipelines.draw(pass, frame.scene, frame.render_settings);
        }
    }
}

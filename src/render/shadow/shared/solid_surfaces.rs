//! Draws the solid surfaces of a scene: all surfaces except those that blend, with or without their backs.

use crate::render::RenderSettings;
use crate::render::scene::SceneBuffers;
use crate::render::scene::draw_batch::DrawBatch;
use crate::scene::AlphaMode;

/// One pipeline for surfaces whose backs are culled, one for surfaces that are drawn from both sides.
pub struct SolidPipelines {
    culled: wgpu::RenderPipeline,
    two_sided: wgpu::RenderPipeline,
}

impl SolidPipelines {
    /// Calls `pipeline` for each of the two cull modes.
    pub fn new(pipeline: impl Fn(Option<wgpu::Face>) -> wgpu::RenderPipeline) -> Self {
        Self { culled: pipeline(Some(wgpu::Face::Back)), two_sided: pipeline(None) }
    }

    /// Returns the pipeline for a batch.
    pub fn of(&self, batch: &DrawBatch, settings: &RenderSettings) -> &wgpu::RenderPipeline {
        if batch.faces.are_culled(settings.cull_back) { &self.culled } else { &self.two_sided }
    }

    /// Draws all solid batches without materials, for passes after the depth prepass, which discards the holes of
    /// masks.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, scene: &SceneBuffers, settings: &RenderSettings) {
        bind_mesh(pass, scene);
        for batch in solid_batches(scene) {
            pass.set_pipeline(self.of(batch, settings));
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }
}

/// Binds the vertices and indices of a scene.
pub fn bind_mesh(pass: &mut wgpu::RenderPass<'_>, scene: &SceneBuffers) {
    if !scene.batches.is_empty() {
        pass.set_vertex_buffer(0, scene.vertices.slice(..));
        pass.set_index_buffer(scene.indices.slice(..), wgpu::IndexFormat::Uint32);
    }
}

/// Returns the batches that write depth.
pub fn solid_batches(scene: &SceneBuffers) -> impl Iterator<Item = &DrawBatch> {
    scene.batches.iter().filter(|batch| batch.alpha_mode != AlphaMode::Blend)
}

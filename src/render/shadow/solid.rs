//! Drawing the solid surfaces of a scene: all but those that blend, with the faces that a look shows.

use crate::render::RenderSettings;
use crate::render::scene::SceneBuffers;
use crate::render::scene::draw_batch::DrawBatch;
use crate::scene::AlphaMode;

/// One pipeline for surfaces whose backs are left out, one for those with two faces.
pub struct SolidPipelines {
    culled: wgpu::RenderPipeline,
    two_faced: wgpu::RenderPipeline,
}

impl SolidPipelines {
    /// Both pipelines, made for each way to cull.
    pub fn new(pipeline: impl Fn(Option<wgpu::Face>) -> wgpu::RenderPipeline) -> Self {
        Self { culled: pipeline(Some(wgpu::Face::Back)), two_faced: pipeline(None) }
    }

    /// The pipeline of a batch.
    pub fn of(&self, batch: &DrawBatch, settings: &RenderSettings) -> &wgpu::RenderPipeline {
        if batch.faces.are_culled(settings.cull_back) { &self.culled } else { &self.two_faced }
    }

    /// Draws all solid batches; for passes that need no material because the depth prepass has cut the holes.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, scene: &SceneBuffers, settings: &RenderSettings) {
        bind_mesh(pass, scene);
        for batch in solid_batches(scene) {
            pass.set_pipeline(self.of(batch, settings));
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }
}

/// Makes the scene's vertices and indices current.
pub fn bind_mesh(pass: &mut wgpu::RenderPass<'_>, scene: &SceneBuffers) {
    if !scene.batches.is_empty() {
        pass.set_vertex_buffer(0, scene.vertices.slice(..));
        pass.set_index_buffer(scene.indices.slice(..), wgpu::IndexFormat::Uint32);
    }
}

/// Batches that write depth.
pub fn solid_batches(scene: &SceneBuffers) -> impl Iterator<Item = &DrawBatch> {
    scene.batches.iter().filter(|batch| batch.alpha_mode != AlphaMode::Blend)
}

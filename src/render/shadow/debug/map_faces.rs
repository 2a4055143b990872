//! Debug view of the shadow map: the depth in its faces.

use super::overlay_pipeline::{begin, pipeline};
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::shadow::light::sample::LightSample;

const MAP_FACES: Shader = shader!(
    "map faces",
    "shared/colour.wgsl",
    "shadow/light/light_sample.wgsl",
    "shadow/light/one_light.wgsl",
    "shadow/map/projection.wgsl",
    "shadow/map/pcf.wgsl",
    "shadow/map/map_visibility.wgsl",
    "shadow/debug/map_faces.wgsl"
);

/// Shows the faces of a shadow map in place of the picture.
pub struct MapFaces {
    perspective: wgpu::RenderPipeline,
    orthographic: wgpu::RenderPipeline,
}

impl MapFaces {
    /// Creates pipelines for maps that are bound with `map_layout`.
    pub fn new(gpu: &Gpu, map_layout: &wgpu::BindGroupLayout, output_format: wgpu::TextureFormat) -> Self {
        let layouts = [None, None, Some(map_layout)];
        let shows =
            |is_perspective| pipeline(gpu, &MAP_FACES, &layouts, output_format, ("IS_PERSPECTIVE", is_perspective));
        Self { perspective: shows(1.0), orthographic: shows(0.0) }
    }

    /// Draws the `num_faces` faces of a map.
    pub fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        size: [u32; 2],
        (num_faces, map): (u32, &wgpu::BindGroup),
        sample: &LightSample,
    ) {
        let mut pass = begin(encoder, target, wgpu::LoadOp::Clear(wgpu::Color::BLACK));
        pass.set_pipeline(if sample.position().w == 0.0 { &self.orthographic } else { &self.perspective });
        pass.set_bind_group(2, map, &[]);
        // The faces are square; those of a cube are in two rows of three.
        let columns = if num_faces == 6 { 3 } else { 1 };
        let rows = num_faces / columns;
        let side = (size[0] / columns).min(size[1] / rows).max(1);
        let corner = [(size[0] - columns * side) / 2, (size[1] - rows * side) / 2];
        for face in 0..num_faces {
            let [x, y] = [corner[0] + face % columns * side, corner[1] + face / columns * side].map(|at| at as f32);
            pass.set_viewport(x, y, side as f32, side as f32, 0.0, 1.0);
            pass.draw(0..3, face..face + 1);
        }
    }
}

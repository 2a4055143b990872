//! Form factors from item buffers drawn by the GPU.
//!
//! Each viewpoint is the centre of a hemicube whose faces are drawn with element ids for colours; the delta form factors
//! of the pixels that show an element add up to its form factor. Many hemicubes share an atlas and several atlases are in
//! flight, so that drawing, reading back and summing overlap.
//!
//! Source: Cohen, Greenberg 1985, "The Hemi-Cube: a radiosity solution for complex environments".

mod atlas;
mod culling;
mod delta;
mod faces;
mod geometry;
mod indices;
mod resolution;
mod row;

use std::collections::VecDeque;

use rayon::prelude::*;

use self::atlas::{ATLAS_WIDTH, Atlas, Layout};
use self::geometry::{Geometry, VERTEX_LAYOUT};
use super::{FormFactorError, FormFactors, Row, Viewpoint};
use crate::gpu::shader::{Shader, shader};
use crate::gpu::{Gpu, GpuError};
use crate::patch::PatchMesh;
use crate::scene::Scene;

pub use delta::delta_form_factors;
pub use resolution::size_for_patches;

/// Item buffer: element ids seen from a hemicube.
const ITEM_BUFFER: Shader = shader!("item_buffer", "item_buffer.wgsl");

/// One atlas is summed while one is drawn and one waits for its turn.
const NUM_ATLASES: usize = 3;

/// Sizes a hemicube may have, pixels.
pub const SIZES: std::ops::RangeInclusive<u32> = 16..=512;

/// Finds form factors of one scene by hemicubes of one size.
pub struct Hemicubes<'a> {
    gpu: &'a Gpu,
    geometry: Geometry,
    pipeline: wgpu::RenderPipeline,
    atlases: Vec<Atlas>,
    layout: Layout,
    deltas: Vec<f32>,
    near: f32,
}

impl<'a> Hemicubes<'a> {
    /// Hemicubes `size_px` pixels wide: a power of two in [`SIZES`]; other sizes are rounded up to one.
    #[must_use]
    pub fn new(gpu: &'a Gpu, scene: &Scene, mesh: &PatchMesh, size_px: u32) -> Self {
        let n = size_px.clamp(*SIZES.start(), *SIZES.end()).next_power_of_two();
        let geometry = Geometry::new(gpu, scene, mesh);
        let bindings_layout = bindings_layout(gpu);
        let pipeline = pipeline(gpu, &bindings_layout, geometry.has_cutouts);
        let layout = Layout { n };
        let atlases = (0..NUM_ATLASES).map(|_| Atlas::new(gpu, &bindings_layout, &geometry, layout)).collect();
        // Reversed depth is as fine as floats are: the near plane may be close enough to miss no contact.
        let near = scene.bounds().extent() * 1e-6;
        Self { gpu, geometry, pipeline, atlases, layout, deltas: delta_form_factors(n), near }
    }

    /// Draws every triangle to every face: what culling is measured against.
    #[must_use]
    pub fn without_culling(mut self) -> Self {
        self.geometry.culling = None;
        self
    }

    /// Draws and reads back hemicubes without summing them: what a loop could reach if the sums were free.
    ///
    /// # Errors
    /// The device failed.
    pub fn draw_only(&mut self, viewpoints: &[Viewpoint]) -> Result<(), FormFactorError> {
        self.run(viewpoints, &|| true, |_, _, _| {}).map(|_| ())
    }

    /// Width of the hemicubes, pixels.
    #[must_use]
    pub fn size_px(&self) -> u32 {
        self.layout.n
    }

    /// The element that each pixel of one hemicube sees, if any: the faces one below the other, the top first, row by row.
    ///
    /// # Errors
    /// The device failed.
    pub fn elements_seen(&mut self, viewpoint: &Viewpoint) -> Result<Vec<Option<u32>>, FormFactorError> {
        let n = self.layout.n as usize;
        let seen = std::cell::RefCell::new(Vec::with_capacity(3 * n * n));
        self.run(std::slice::from_ref(viewpoint), &|| true, |items, _, _| {
            let lines = items.chunks(ATLAS_WIDTH as usize).take(3 * n);
            seen.borrow_mut().extend(lines.flat_map(|line| &line[..n]).map(|&item| row::element_seen(item)));
        })?;
        Ok(seen.into_inner())
    }

    /// Draws the viewpoints atlas by atlas and hands each finished atlas to `finish` with the index of its first
    /// viewpoint and their number.
    fn run(
        &mut self,
        viewpoints: &[Viewpoint],
        go_on: &dyn Fn() -> bool,
        finish: impl Fn(&[u32], usize, usize),
    ) -> Result<usize, FormFactorError> {
        let mut in_flight = VecDeque::new();
        let mut drawn: Option<(usize, usize)> = None;
        let mut done = 0;
        let mut batches = viewpoints.chunks(self.layout.capacity()).zip((0..NUM_ATLASES).cycle());
        loop {
            while in_flight.len() < NUM_ATLASES - 1 && go_on() {
                let Some((batch, slot)) = batches.next() else { break };
                let atlas = &mut self.atlases[slot];
                let submission = atlas.submit(self.gpu, &self.pipeline, &self.geometry, self.layout, batch, self.near);
                in_flight.push_back((submission, slot, batch.len()));
            }
            // Sums while the others are drawn.
            if let Some((slot, count)) = drawn.take() {
                let atlas = &self.atlases[slot];
                let items = atlas.items().map_err(|error| GpuError::Lost(error.to_string()))?;
                finish(bytemuck::cast_slice(&items), done, count);
                drop(items);
                atlas.release();
                done += count;
            }
            let Some((submission, slot, count)) = in_flight.pop_front() else {
                return Ok(done);
            };
            let wait = wgpu::PollType::Wait { submission_index: Some(submission), timeout: None };
            self.gpu.device.poll(wait).map_err(|error| GpuError::Lost(error.to_string()))?;
            drawn = Some((slot, count));
        }
    }
}

impl FormFactors for Hemicubes<'_> {
    fn rows(
        &mut self,
        viewpoints: &[Viewpoint],
        go_on: &dyn Fn() -> bool,
        take: &(dyn Fn(usize, &Row) + Sync),
    ) -> Result<usize, FormFactorError> {
        let (layout, deltas) = (self.layout, std::mem::take(&mut self.deltas));
        let n = layout.n as usize;
        let done = self.run(viewpoints, go_on, |items, first, count| {
            (0..count).into_par_iter().for_each_init(Row::default, |row, cell| {
                let (left, top) = layout.origin(cell);
                let lines = (top as usize..top as usize + 3 * n).map(|y| {
                    let start = y * ATLAS_WIDTH as usize + left as usize;
                    &items[start..start + n]
                });
                row::sum_items(lines, &deltas, n, row);
                take(first + cell, row);
            });
        });
        self.deltas = deltas;
        done
    }

    fn num_samples(&self) -> usize {
        // The top, and four halves of sides.
        3 * (self.layout.n * self.layout.n) as usize
    }
}

fn bindings_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    use wgpu::ShaderStages as Stage;
    let entry = |binding, visibility, ty, has_dynamic_offset| wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None },
        count: None,
    };
    let storage =
        |binding| entry(binding, Stage::FRAGMENT, wgpu::BufferBindingType::Storage { read_only: true }, false);
    let view = entry(0, Stage::VERTEX, wgpu::BufferBindingType::Uniform, true);
    let entries = [view, storage(1), storage(2), storage(3), storage(4)];
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("item buffer"), entries: &entries })
}

fn pipeline(gpu: &Gpu, bindings_layout: &wgpu::BindGroupLayout, has_cutouts: bool) -> wgpu::RenderPipeline {
    let module = ITEM_BUFFER.module(gpu);
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("item buffer"),
        bind_group_layouts: &[Some(bindings_layout)],
        ..Default::default()
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("item buffer"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(VERTEX_LAYOUT)],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &[("HAS_CUTOUTS", f64::from(u8::from(has_cutouts)))],
                ..Default::default()
            },
            targets: &[Some(wgpu::TextureFormat::R32Uint.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

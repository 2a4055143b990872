//! The source of form factors: hemicubes drawn atlas by atlas and summed into rows.

use std::cell::RefCell;
use std::collections::VecDeque;

use rayon::prelude::*;

use super::atlas::{Atlas, AtlasDraw};
use super::delta::delta_form_factors;
use super::geometry::Geometry;
use super::item_sums::{element_of, sum_items};
use super::layout::{ATLAS_WIDTH, Layout};
use super::pipeline::{bindings_layout, pipeline};
use crate::form_factor::{FormFactorError, FormFactorSource, Row, Viewpoint};
use crate::gpu::{Gpu, GpuError};
use crate::patch::PatchMesh;
use crate::scene::Scene;

/// Number of atlases in flight: one is summed while one is drawn and one is queued.
const NUM_ATLASES: usize = 3;

/// Sizes a hemicube may have, pixels.
pub const SIZES: std::ops::RangeInclusive<u32> = 16..=512;

/// Computes form factors of one scene by hemicubes of one size.
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
    /// Creates hemicubes `size_px` pixels wide. The size is a power of two in [`SIZES`]; others are rounded up to one.
    #[must_use]
    pub fn new(gpu: &'a Gpu, scene: &Scene, mesh: &PatchMesh, size_px: u32) -> Self {
        let n = size_px.clamp(*SIZES.start(), *SIZES.end()).next_power_of_two();
        let geometry = Geometry::new(gpu, scene, mesh);
        let bindings_layout = bindings_layout(gpu);
        let pipeline = pipeline(gpu, &bindings_layout, geometry.has_cutouts);
        let layout = Layout { n };
        let atlases = (0..NUM_ATLASES).map(|_| Atlas::new(gpu, &bindings_layout, &geometry, layout)).collect();
        // Reversed depth has the relative precision of a float, so the near plane can be close enough for surfaces in
        // contact.
        let near = scene.bounds().extent() * 1e-6;
        Self { gpu, geometry, pipeline, atlases, layout, deltas: delta_form_factors(n), near }
    }

    /// Draws every triangle to every face, as a baseline for culling.
    #[must_use]
    pub fn without_culling(mut self) -> Self {
        self.geometry.culling = None;
        self
    }

    /// Draws and reads back hemicubes without summing them, as a baseline for the full loop.
    ///
    /// # Errors
    /// Returns an error if the device fails.
    pub fn draw_only(&mut self, viewpoints: &[Viewpoint]) -> Result<(), FormFactorError> {
        self.draw(viewpoints, &|| true, |_, _, _| {}).map(|_| ())
    }

    /// Width of the hemicubes, pixels.
    #[must_use]
    pub fn size_px(&self) -> u32 {
        self.layout.n
    }

    /// Returns the element that is visible in each pixel of one hemicube, if any. The pixels are listed face by face,
    /// the top first, and row by row within a face.
    ///
    /// # Errors
    /// Returns an error if the device fails.
    pub fn elements_seen(&mut self, viewpoint: &Viewpoint) -> Result<Vec<Option<u32>>, FormFactorError> {
        let n = self.layout.n as usize;
        let seen = RefCell::new(Vec::with_capacity(3 * n * n));
        self.draw(std::slice::from_ref(viewpoint), &|| true, |items, _, _| {
            let lines = items.chunks(ATLAS_WIDTH as usize).take(3 * n);
            seen.borrow_mut().extend(lines.flat_map(|line| &line[..n]).map(|&item| element_of(item)));
        })?;
        Ok(seen.into_inner())
    }

    /// Draws the viewpoints atlas by atlas and passes each finished atlas to `finish` with the index of its first
    /// viewpoint and the number of viewpoints. Returns how many viewpoints were drawn.
    fn draw(
        &mut self,
        viewpoints: &[Viewpoint],
        may_continue: &dyn Fn() -> bool,
        finish: impl Fn(&[u32], usize, usize),
    ) -> Result<usize, FormFactorError> {
        let mut in_flight = VecDeque::new();
        let mut drawn: Option<(usize, usize)> = None;
        let mut done = 0;
        let mut batches = viewpoints.chunks(self.layout.capacity()).zip((0..NUM_ATLASES).cycle());
        loop {
            while in_flight.len() < NUM_ATLASES - 1 && may_continue() {
                let Some((batch, slot)) = batches.next() else { break };
                let draw = AtlasDraw {
                    gpu: self.gpu,
                    pipeline: &self.pipeline,
                    geometry: &self.geometry,
                    layout: self.layout,
                    near: self.near,
                };
                let submission = self.atlases[slot].submit(&draw, batch);
                in_flight.push_back((submission, slot, batch.len()));
            }
            // Sum the finished atlas while the others are drawn.
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

impl FormFactorSource for Hemicubes<'_> {
    fn rows(
        &mut self,
        viewpoints: &[Viewpoint],
        may_continue: &dyn Fn() -> bool,
        visit: &(dyn Fn(usize, &Row) + Sync),
    ) -> Result<usize, FormFactorError> {
        let (layout, deltas) = (self.layout, std::mem::take(&mut self.deltas));
        let n = layout.n as usize;
        let done = self.draw(viewpoints, may_continue, |items, first, count| {
            (0..count).into_par_iter().for_each_init(Row::default, |row, cell| {
                let (left, top) = layout.origin(cell);
                let lines = (top as usize..top as usize + 3 * n).map(|y| {
                    let start = y * ATLAS_WIDTH as usize + left as usize;
                    &items[start..start + n]
                });
                sum_items(lines, &deltas, n, row);
                visit(first + cell, row);
            });
        });
        self.deltas = deltas;
        done
    }

    fn num_samples(&self) -> usize {
        // The top face and four half sides.
        3 * (self.layout.n * self.layout.n) as usize
    }
}

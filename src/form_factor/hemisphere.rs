//! Form factors by the hemisphere method: Nusselt's analogue with rays, on the CPU alone.
//!
//! Rays leave the viewpoint with the density of the cosine, so that each is worth the same: 1/N. That is the projection of
//! the hemisphere on to its base circle, sampled. The directions are one table for all viewpoints; each turns it about its
//! normal and shifts it from the pole to the horizon. They stand along a space-filling curve, so that neighbouring rays meet
//! the same triangles.
//!
//! Source: Nusselt 1928, "Graphische Bestimmung des Winkelverhältnisses bei der Wärmestrahlung"; Malley 1988 (rays);
//! Cranley, Patterson 1976 (shifted points).

use std::f32::consts::TAU;

use glam::Vec2;
use rayon::prelude::*;

use super::{Entry, FormFactorError, FormFactors, Row, Viewpoint};
use crate::base::ids::TriangleId;
use crate::base::sampling::{hash, morton_2d, r2, tangent_frame, unit_float};
use crate::patch::PatchMesh;
use crate::trace::{Hit, Tracer};

/// Rays between two looks at whether to go on: a few milliseconds, for a window that wants to draw meanwhile.
const RAYS_A_BATCH: usize = 1 << 15;

/// Viewpoints that keep all cores busy.
const MIN_BATCH: usize = 16;

/// Finds form factors of one scene by rays.
pub struct Hemispheres<'a> {
    tracer: &'a Tracer<'a>,
    mesh: &'a PatchMesh,
    /// Evenly spread on the base circle: square of the radius, and unit vector of the angle.
    table: Vec<(f32, Vec2)>,
}

impl<'a> Hemispheres<'a> {
    /// Hemispheres of `num_rays` rays over the scene of `tracer`, cut as `mesh`.
    #[must_use]
    pub fn new(tracer: &'a Tracer<'a>, mesh: &'a PatchMesh, num_rays: u32) -> Self {
        let mut squares: Vec<Vec2> = (0..num_rays.max(1)).map(|i| r2(i, 0)).collect();
        squares.sort_by_key(|square| morton_2d(*square));
        let polar = |square: Vec2| (square.x, Vec2::from_angle(square.y * TAU));
        Self { tracer, mesh, table: squares.into_iter().map(polar).collect() }
    }

    /// Standard error of a form factor found as `factor`, if its rays were independent; evenly spread rays do better.
    #[must_use]
    pub fn standard_error(factor: f64, num_rays: f64) -> f64 {
        // One hit and one miss more: an object that no ray met need not be absent (Agresti, Coull 1998).
        let share = (factor * num_rays + 1.0) / (num_rays + 2.0);
        (share * (1.0 - share) / num_rays).sqrt()
    }

    fn see(&self, viewpoint: &Viewpoint, row: &mut Row) {
        row.clear();
        let share = 1.0 / self.table.len() as f32;
        let mut num_sky = 0;
        let (tangent, bitangent) = tangent_frame(viewpoint.normal);
        let (sin, cos) = (unit_float(hash(viewpoint.seed)) * TAU).sin_cos();
        let (x, y) = (tangent * cos + bitangent * sin, bitangent * cos - tangent * sin);
        let shift = unit_float(hash(viewpoint.seed ^ 0x9e37_79b9));
        for (i, (squared, angle)) in self.table.iter().enumerate() {
            let squared = (squared + shift).fract();
            let base = (x * angle.x + y * angle.y) * squared.sqrt();
            let direction = base + viewpoint.normal * (1.0 - squared).sqrt();
            let seed = viewpoint.seed ^ hash(i as u32);
            // A pane stops a ray with the probability of its opacity.
            let solid_from = |triangle: TriangleId| 1.0 - unit_float(hash(seed ^ hash(triangle.0)));
            match self.tracer.nearest_solid(viewpoint.position, direction, f32::INFINITY, solid_from) {
                None => num_sky += 1,
                Some(hit) => self.enter(row, &hit, share),
            }
        }
        row.sky = num_sky as f32 * share;
    }

    /// Adds the element that was hit, or the black back of one.
    fn enter(&self, row: &mut Row, hit: &Hit, factor: f32) {
        let root = self.mesh.roots[hit.triangle.index()];
        let mut element = self.mesh.element_at(hit.triangle, hit.barycentric);
        if !hit.is_front && !root.has_backs {
            return add(&mut row.backs, Entry { element, factor });
        }
        if !hit.is_front {
            element.0 += root.num_elements;
        }
        add(&mut row.entries, Entry { element, factor });
    }
}

/// Appends an entry, or adds it to the last where neighbouring rays met one element.
fn add(entries: &mut Vec<Entry>, entry: Entry) {
    match entries.last_mut() {
        Some(last) if last.element == entry.element => last.factor += entry.factor,
        _ => entries.push(entry),
    }
}

impl FormFactors for Hemispheres<'_> {
    fn rows(
        &mut self,
        viewpoints: &[Viewpoint],
        go_on: &dyn Fn() -> bool,
        take: &(dyn Fn(usize, &Row) + Sync),
    ) -> Result<usize, FormFactorError> {
        let mut done = 0;
        for batch in viewpoints.chunks((RAYS_A_BATCH / self.table.len()).max(MIN_BATCH)) {
            if !go_on() {
                break;
            }
            batch.par_iter().enumerate().for_each_init(Row::default, |row, (i, viewpoint)| {
                self.see(viewpoint, row);
                take(done + i, row);
            });
            done += batch.len();
        }
        Ok(done)
    }

    fn num_samples(&self) -> usize {
        self.table.len()
    }
}

//! Form factors by the hemisphere method: Nusselt's analogue with rays, on the CPU alone.
//!
//! Nusselt's analogue: project a surface on to the unit hemisphere around the viewpoint and from there orthogonally on
//! to the base circle; its form factor is the share of the circle that this projection covers. Points spread
//! evenly over the circle are therefore directions of equal weight 1/N (their density is cos theta / pi), and the form
//! factor of an element is the share of the N rays that hit it.
//!
//! All viewpoints share one table of points. Each viewpoint rotates it about its normal and shifts the radii modulo 1,
//! so the errors of neighbours are not correlated. The points are sorted along a space-filling curve, so consecutive
//! rays visit mostly the same triangles.
//!
//! Source: Nusselt 1928, "Graphische Bestimmung des Winkelverhältnisses bei der Wärmestrahlung"; Malley 1988 (rays);
//! Cranley, Patterson 1976 (shifted points).

use std::f32::consts::TAU;

use glam::Vec2;
use rayon::prelude::*;

use super::row::{Entry, Row, Viewpoint};
use super::source::{FormFactorError, FormFactorSource};
use crate::base::ids::TriangleId;
use crate::base::sampling::{hash, morton_2d, r2, tangent_frame, unit_float};
use crate::patch::PatchMesh;
use crate::trace::{Hit, Tracer};

/// Number of rays between two calls of `may_continue`. They take a few milliseconds, so a window can draw in between.
const RAYS_A_BATCH: usize = 1 << 15;

/// Smallest number of viewpoints of a batch: enough to use all cores.
const MIN_BATCH: usize = 16;

/// Computes form factors of one scene by rays.
pub struct Hemispheres<'a> {
    tracer: &'a Tracer<'a>,
    mesh: &'a PatchMesh,
    /// Points spread evenly over the base circle: square of the radius, and unit vector of the angle.
    circle: Vec<(f32, Vec2)>,
}

impl<'a> Hemispheres<'a> {
    /// Creates hemispheres of `num_rays` rays over the scene of `tracer`, whose elements are `mesh`.
    #[must_use]
    pub fn new(tracer: &'a Tracer<'a>, mesh: &'a PatchMesh, num_rays: u32) -> Self {
        let mut squares: Vec<Vec2> = (0..num_rays.max(1)).map(|i| r2(i, 0)).collect();
        squares.sort_by_key(|square| morton_2d(*square));
        let polar = |square: Vec2| (square.x, Vec2::from_angle(square.y * TAU));
        Self { tracer, mesh, circle: squares.into_iter().map(polar).collect() }
    }

    /// Standard error of the estimate `factor` for independent rays. The error of evenly spread rays is smaller.
    #[must_use]
    pub fn standard_error(factor: f64, num_rays: f64) -> f64 {
        // One hit and one miss are added, because an object that no ray hit may still be there (Agresti, Coull 1998).
        let share = (factor * num_rays + 1.0) / (num_rays + 2.0);
        (share * (1.0 - share) / num_rays).sqrt()
    }

    /// Traces all rays of a viewpoint and sums them in `row`.
    fn trace(&self, viewpoint: &Viewpoint, row: &mut Row) {
        row.clear();
        let share = 1.0 / self.circle.len() as f32;
        let mut num_sky = 0;
        let (tangent, bitangent) = tangent_frame(viewpoint.normal);
        let (sin, cos) = (unit_float(hash(viewpoint.seed)) * TAU).sin_cos();
        let (x, y) = (tangent * cos + bitangent * sin, bitangent * cos - tangent * sin);
        let shift = unit_float(hash(viewpoint.seed ^ 0x9e37_79b9));
        for (i, (squared, angle)) in self.circle.iter().enumerate() {
            let squared = (squared + shift).fract();
            let base = (x * angle.x + y * angle.y) * squared.sqrt();
            let direction = base + viewpoint.normal * (1.0 - squared).sqrt();
            let seed = viewpoint.seed ^ hash(i as u32);
            // The probability that a transparent surface stops a ray equals its opacity.
            let solid_from = |triangle: TriangleId| 1.0 - unit_float(hash(seed ^ hash(triangle.0)));
            match self.tracer.nearest_solid(viewpoint.position, direction, f32::INFINITY, solid_from) {
                None => num_sky += 1,
                Some(hit) => self.add_hit(row, &hit, share),
            }
        }
        row.sky = num_sky as f32 * share;
    }

    /// Adds the element that was hit, or the black back of one.
    fn add_hit(&self, row: &mut Row, hit: &Hit, factor: f32) {
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

/// Appends an entry, or adds its factor to the last entry if consecutive rays hit the same element.
fn add(entries: &mut Vec<Entry>, entry: Entry) {
    match entries.last_mut() {
        Some(last) if last.element == entry.element => last.factor += entry.factor,
        _ => entries.push(entry),
    }
}

impl FormFactorSource for Hemispheres<'_> {
    fn rows(
        &mut self,
        viewpoints: &[Viewpoint],
        may_continue: &dyn Fn() -> bool,
        visit: &(dyn Fn(usize, &Row) + Sync),
    ) -> Result<usize, FormFactorError> {
        let mut done = 0;
        for batch in viewpoints.chunks((RAYS_A_BATCH / self.circle.len()).max(MIN_BATCH)) {
            if !may_continue() {
                break;
            }
            batch.par_iter().enumerate().for_each_init(Row::default, |row, (i, viewpoint)| {
                self.trace(viewpoint, row);
                visit(done + i, row);
            });
            done += batch.len();
        }
        Ok(done)
    }

    fn num_samples(&self) -> usize {
        self.circle.len()
    }
}

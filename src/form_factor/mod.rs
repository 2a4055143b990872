//! Floor 3: form factors, asked for in batches of viewpoints and handed back as sparse rows.
//!
//! F(x, e) is the share of what leaves a small surface at x that arrives at element e; seen the other way round, it is the
//! weight of e's radiosity in the irradiance at x. One row serves shooting and gathering. Methods implement
//! [`FormFactors`] and check each other in the tests.

pub mod analytic;
pub mod contour;
pub mod hemicube;
pub mod hemisphere;
pub mod pair;
pub mod polygon;
pub mod row_cache;

mod quadrature;
mod row_file;

use std::sync::OnceLock;

use glam::Vec3;
use thiserror::Error;

use crate::base::ids::ElementId;
use crate::gpu::GpuError;

/// A small piece of surface that looks at the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// Metres; a hair above its surface.
    pub position: Vec3,
    /// Unit normal of the surface.
    pub normal: Vec3,
    /// Turns the sampling pattern about the normal, so that aliasing becomes noise and not bands.
    pub seed: u32,
}

/// A viewpoint that sees more back faces than this share lies inside something. One behind a single-sided sheet sees half.
pub const MAX_BACK_SHARE: f32 = 0.8;

/// Form factors from one viewpoint: all entries, `backs` and `sky` sum to 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// Elements seen; an element may occur more than once.
    pub entries: Vec<Entry>,
    /// Black backs of single-sided surfaces, each by the element on its front.
    pub backs: Vec<Entry>,
    /// Share that leaves the scene.
    pub sky: f32,
}

impl Row {
    /// Share that ends on black backs: a viewpoint inside a wall sees little else.
    #[must_use]
    pub fn back(&self) -> f32 {
        self.backs.iter().map(|entry| entry.factor).sum()
    }

    /// Takes all out, for another viewpoint.
    fn clear(&mut self) {
        self.entries.clear();
        self.backs.clear();
        self.sky = 0.0;
    }
}

/// One form factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Receiver.
    pub element: ElementId,
    /// F, 0..1.
    pub factor: f32,
}

/// Form factors could not be found.
#[derive(Debug, Error)]
pub enum FormFactorError {
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// A method that finds rows of form factors.
pub trait FormFactors {
    /// Finds the rows of `viewpoints` and gives each to `take` with its index, in batches and in parallel.
    ///
    /// Asks `go_on` before each batch and stops where it says no. Returns how many rows were given: always those of the
    /// first viewpoints.
    ///
    /// # Errors
    /// The device failed.
    fn rows(
        &mut self,
        viewpoints: &[Viewpoint],
        go_on: &dyn Fn() -> bool,
        take: &(dyn Fn(usize, &Row) + Sync),
    ) -> Result<usize, FormFactorError>;

    /// Rays or pixels of one row.
    fn num_samples(&self) -> usize;
}

/// What `reduce` makes of the rows of `viewpoints`; fewer than asked for where `go_on` said no.
///
/// # Errors
/// The device failed.
pub fn map_rows<T: Send + Sync>(
    method: &mut dyn FormFactors,
    viewpoints: &[Viewpoint],
    go_on: &dyn Fn() -> bool,
    reduce: impl Fn(usize, &Row) -> T + Sync,
) -> Result<Vec<T>, FormFactorError> {
    let results: Vec<OnceLock<T>> = viewpoints.iter().map(|_| OnceLock::new()).collect();
    let num_rows = method.rows(viewpoints, go_on, &|index, row| {
        // Each index is given once.
        let _ = results[index].set(reduce(index, row));
    })?;
    Ok(results.into_iter().take(num_rows).filter_map(OnceLock::into_inner).collect())
}

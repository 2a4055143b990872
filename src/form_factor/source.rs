//! The interface between geometry and light: a source computes rows of form factors, a solver uses them.

use std::error::Error;
use std::sync::OnceLock;

use thiserror::Error;

use super::row::{Row, Viewpoint};
use crate::gpu::GpuError;

/// Form factors could not be computed.
#[derive(Debug, Error)]
pub enum FormFactorError {
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A source outside this crate failed.
    #[error(transparent)]
    Custom(#[from] Box<dyn Error + Send + Sync>),
}

/// A method that computes rows of form factors over the elements of one mesh.
///
/// [`Hemicubes`](super::hemicube::Hemicubes) and [`Hemispheres`](super::hemisphere::Hemispheres) implement it. A method
/// of your own can drive every solver in the `radiosity` module: a row only has to hold, for each element in view, the
/// form factor F(viewpoint, element), and entries, backs and sky have to sum to 1.
///
/// ```
/// use hemicube::form_factor::{FormFactorError, FormFactorSource, Row, Viewpoint, map_rows};
/// use hemicube::glam::Vec3;
///
/// /// Every view ends in the sky.
/// struct EmptyScene;
///
/// impl FormFactorSource for EmptyScene {
///     fn rows(
///         &mut self,
///         viewpoints: &[Viewpoint],
///         may_continue: &dyn Fn() -> bool,
///         visit: &(dyn Fn(usize, &Row) + Sync),
///     ) -> Result<usize, FormFactorError> {
///         let num_rows = if may_continue() { viewpoints.len() } else { 0 };
///         (0..num_rows).for_each(|index| visit(index, &Row { sky: 1.0, ..Row::default() }));
///         Ok(num_rows)
///     }
///
///     fn num_samples(&self) -> usize {
///         1
///     }
/// }
///
/// let up = Viewpoint { position: Vec3::ZERO, normal: Vec3::Y, seed: 0 };
/// let sky = map_rows(&mut EmptyScene, &[up], &|| true, |_, row| row.sky)?;
/// assert_eq!(sky, [1.0]);
/// # Ok::<(), FormFactorError>(())
/// ```
pub trait FormFactorSource {
    /// Computes the rows of `viewpoints` in batches and passes each to `visit` with its index, possibly in parallel.
    ///
    /// Calls `may_continue` before each batch and stops if it returns false. Returns how many rows were passed on:
    /// always those of the first viewpoints.
    ///
    /// # Errors
    /// Returns an error if the device or the method fails.
    fn rows(
        &mut self,
        viewpoints: &[Viewpoint],
        may_continue: &dyn Fn() -> bool,
        visit: &(dyn Fn(usize, &Row) + Sync),
    ) -> Result<usize, FormFactorError>;

    /// Number of rays or pixels of one row, from which its noise follows.
    fn num_samples(&self) -> usize;
}

/// Maps the rows of `viewpoints`, in order. The result is shorter than `viewpoints` if `may_continue` returned false.
///
/// # Errors
/// Returns an error if the source fails.
pub fn map_rows<T: Send + Sync>(
    source: &mut dyn FormFactorSource,
    viewpoints: &[Viewpoint],
    may_continue: &dyn Fn() -> bool,
    reduce: impl Fn(usize, &Row) -> T + Sync,
) -> Result<Vec<T>, FormFactorError> {
    let results: Vec<OnceLock<T>> = viewpoints.iter().map(|_| OnceLock::new()).collect();
    let num_rows = source.rows(viewpoints, may_continue, &|index, row| {
        // Each index is visited once.
        let _ = results[index].set(reduce(index, row));
    })?;
    Ok(results.into_iter().take(num_rows).filter_map(OnceLock::into_inner).collect())
}

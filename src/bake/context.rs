//! Optional parts of a bake besides its settings: a device, stored rows, and an observer.

use crate::baked::{BakedScene, VertexLight};
use crate::base::progress::{Progress, Unwatched};
use crate::form_factor::row_cache::RowCache;
use crate::gpu::Gpu;

/// Observes a bake: its progress, its mesh and the light so far.
///
/// [`on_mesh`](Self::on_mesh) is called first, and again whenever the mesh is refined; [`on_light`](Self::on_light)
/// follows whenever [`is_light_due`](Self::is_light_due) returns true, always for the last mesh. All calls are made on
/// the thread that bakes. The bake ends early if [`Progress::is_cancelled`] returns true, and keeps what is solved.
pub trait BakeObserver: Progress {
    /// Called with the mesh that the light belongs to from now on, and the light known so far.
    fn on_mesh(&self, _mesh: &BakedScene) {}
    /// Returns true if [`on_light`](Self::on_light) may be called with a new estimate of the light.
    fn is_light_due(&self) -> bool {
        false
    }
    /// Called with the light so far, including the ambient estimate of the unshot power.
    fn on_light(&self, _estimate: &VertexLight) {}
}

impl BakeObserver for Unwatched {}

/// Optional parts of a bake besides its settings. The default is the CPU alone, without stored rows or an observer.
#[derive(Clone, Copy)]
pub struct BakeContext<'a> {
    /// Device that draws hemicubes; `None` computes form factors by rays.
    pub gpu: Option<&'a Gpu>,
    /// File of form-factor rows: rows in it are read, rows that are missing are added. A stopped bake continues from
    /// it, and a bake with other colours or lamps reuses most of it.
    pub row_cache: Option<&'a RowCache>,
    /// Observes the bake and may cancel it.
    pub observer: &'a dyn BakeObserver,
}

impl<'a> BakeContext<'a> {
    /// Creates a context with a device that draws hemicubes.
    #[must_use]
    pub fn on(gpu: &'a Gpu) -> Self {
        Self { gpu: Some(gpu), ..Self::default() }
    }
}

impl Default for BakeContext<'_> {
    fn default() -> Self {
        Self { gpu: None, row_cache: None, observer: &Unwatched }
    }
}

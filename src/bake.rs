//! Floor 5: the whole job as one recipe.

use crate::baked::{BakedScene, VertexLight};
use crate::base::progress::Progress;

/// Who watches a bake: progress, and the light so far.
///
/// `mesh` comes once, `light` as often as it is wanted; both are called on the thread that bakes.
pub trait Watch: Progress {
    /// The mesh that the light will be on, still dark.
    fn mesh(&self, _dark: &BakedScene) {}
    /// A new estimate of the light would be welcome now (the last one has been taken).
    fn wants_light(&self) -> bool {
        false
    }
    /// Light so far, with the ambient estimate of what is still unshot.
    fn light(&self, _estimate: &VertexLight) {}
}

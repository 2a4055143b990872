//! A row of form factors from one viewpoint, element by element.

use glam::Vec3;

use crate::base::ids::ElementId;

/// A point on a surface from which form factors are sampled: the differential area dA of the equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// Position slightly above the surface, metres.
    pub position: Vec3,
    /// Unit normal of the surface.
    pub normal: Vec3,
    /// Rotates the sampling pattern about the normal, which turns aliasing into noise instead of bands.
    pub seed: u32,
}

/// If the share of back faces in the view of a viewpoint is larger than this, the viewpoint lies inside a solid. Behind
/// a single-sided sheet the share is 0.5.
pub const MAX_BACK_SHARE: f32 = 0.8;

/// Form factors from one viewpoint: all entries, `backs` and `sky` sum to 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// Elements in view; an element may occur more than once.
    pub entries: Vec<Entry>,
    /// Black backs of single-sided surfaces in view, each under the element on its front.
    pub backs: Vec<Entry>,
    /// Share of the view without a surface.
    pub sky: f32,
}

impl Row {
    /// Share of the view that ends on black backs; close to 1 for a viewpoint inside a wall.
    #[must_use]
    pub fn back(&self) -> f32 {
        self.backs.iter().map(|entry| entry.factor).sum()
    }

    /// Empties the row but keeps its allocated memory.
    pub fn clear(&mut self) {
        self.entries.clear();
        self.backs.clear();
        self.sky = 0.0;
    }
}

/// One form factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The element in view.
    pub element: ElementId,
    /// Form factor, 0..1.
    pub factor: f32,
}

//! State of the picture behind the panels.

use std::time::Instant;

use crate::viewer::picture::marks_cache::MarksCache;

/// State of the picture behind the panels.
pub struct PictureState {
    /// Pixels across and down that the panels leave for it.
    pub size: [u32; 2],
    /// Marks over it.
    pub marks: MarksCache,
    /// How it improves at rest.
    pub refinement: Refinement,
    /// What is known about it.
    pub notes: PictureNotes,
}

/// How the picture improves while nothing changes.
pub struct Refinement {
    /// When a sketch is replaced by a finer picture.
    pub sketch_ends: Option<Instant>,
    /// When tracing of the view begins.
    pub tracing_begins: Option<Instant>,
    /// Tracing at rest was switched on in the last frame.
    pub was_tracing_on: bool,
    /// Light samples that each frame adds.
    pub samples_per_frame: usize,
}

/// What is known about the last picture.
#[derive(Default)]
pub struct PictureNotes {
    /// Rays a pixel; `None` unless it is traced.
    pub num_rays: Option<u32>,
    /// A known fault of its shadows.
    pub fault: Option<String>,
    /// Number of its light samples.
    pub num_light_samples: usize,
}

impl PictureState {
    /// A picture of `size` that has not been drawn yet.
    #[must_use]
    pub fn new(size: [u32; 2]) -> Self {
        let refinement =
            Refinement { sketch_ends: None, tracing_begins: None, was_tracing_on: false, samples_per_frame: 1 };
        Self { size, marks: MarksCache::default(), refinement, notes: PictureNotes::default() }
    }

    /// Width over height.
    #[must_use]
    pub fn aspect(&self) -> f32 {
        self.size[0] as f32 / self.size[1] as f32
    }
}

//! State of the picture behind the panels.

use std::time::Instant;

use crate::viewer::picture::marks_cache::MarksCache;

/// State of the picture behind the panels.
pub struct PictureState {
    /// Width and height of the area that the panels leave free, pixels.
    pub size: [u32; 2],
    /// Marks drawn over the picture.
    pub marks: MarksCache,
    /// Progressive refinement of the picture at rest.
    pub refinement: Refinement,
    /// Facts about the last picture.
    pub notes: PictureNotes,
}

/// Progressive refinement of the picture while nothing changes.
pub struct Refinement {
    /// Time at which a sketch is replaced by a finer picture.
    pub sketch_ends: Option<Instant>,
    /// Time at which tracing of the view begins.
    pub tracing_begins: Option<Instant>,
    /// True if tracing at rest was switched on in the last frame.
    pub was_tracing_on: bool,
    /// Light samples that each frame adds.
    pub samples_per_frame: usize,
}

/// Facts about the last picture.
#[derive(Default)]
pub struct PictureNotes {
    /// Rays per pixel; `None` if the picture is not traced.
    pub num_rays: Option<u32>,
    /// Known fault of the shadows of the picture.
    pub fault: Option<String>,
    /// Number of light samples of the picture.
    pub num_light_samples: usize,
}

impl PictureState {
    /// Creates the state of a picture of `size` that has not been drawn yet.
    #[must_use]
    pub fn new(size: [u32; 2]) -> Self {
        let refinement =
            Refinement { sketch_ends: None, tracing_begins: None, was_tracing_on: false, samples_per_frame: 1 };
        Self { size, marks: MarksCache::default(), refinement, notes: PictureNotes::default() }
    }

    /// Returns the aspect ratio, width / height.
    #[must_use]
    pub fn aspect(&self) -> f32 {
        self.size[0] as f32 / self.size[1] as f32
    }
}

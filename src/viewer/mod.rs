//! Floor 6: the window in which one walks through a scene while its light is solved.
//!
//! [`app`] is winit's side, [`walkthrough`] the open window: events become movement ([`input`], [`travel`], [`walk`]) and
//! [`panels::Action`]s ([`shortcuts`], `actions`); `frame` is the recipe of a frame. Loading and baking run in a
//! thread ([`worker`]); [`session`] holds what they bring, [`place`] the open scene, [`solved`] its light. What a click
//! asks ([`inquiry`]: a reading of the [`meter`], a [`patch_sight`], a [`replay`], a [`still`]) is an [`errand`].
//! Deliberately absent: any light of its own; everything that is drawn comes from [`crate::render`].

pub mod advice;
pub mod app;
pub mod camera;
pub mod canvas;
pub mod collider;
pub mod errand;
pub mod input;
pub mod inquiry;
pub mod kept_side;
pub mod marks;
pub mod memory;
pub mod meter;
mod motion;
pub mod output;
pub mod pacing;
pub mod panels;
pub mod patch_sight;
pub mod place;
pub mod replay;
pub mod screen;
pub mod session;
pub mod settings;
pub mod shortcuts;
pub mod sight;
pub mod solved;
pub mod still;
pub mod travel;
pub mod walk;
pub mod walkthrough;
pub mod worker;

mod accumulation;
mod actions;
mod background;
mod default_sky;
mod difference;
mod file_watch;
mod frame;
mod gui;
mod marks_cache;
mod painter;
mod picture;
mod quick;
mod shadow_notes;
mod warm_up;

use std::path::PathBuf;

use crate::bake::BakeSettings;

/// What the window opens with.
#[derive(Clone, Debug)]
pub struct ViewerOptions {
    /// A glTF file; none opens the built-in scene.
    pub scene: Option<PathBuf>,
    /// The material variant of the file that is worn; none for the materials worn without.
    pub variant: Option<String>,
    /// How it is baked, where the file brings no light.
    pub settings: BakeSettings,
    /// Where to log the time of each frame.
    pub frame_log: Option<PathBuf>,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// There is no display, or no graphics device that can draw into a window.
pub fn run(options: ViewerOptions) -> anyhow::Result<()> {
    background::share_work_in_background();
    app::run(options)
}

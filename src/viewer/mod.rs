//! Floor 6: the window that shows a scene, from a camera that walks or flies, while its light is solved.
//!
//! Rooms, the most basic first; each imports only rooms that come before it in this list:
//!
//! | room | what |
//! |---|---|
//! | [`camera`] | pose and movement of the camera, walking, collision |
//! | [`settings`], [`preferences`], `action` | what the user sets, what is stored between runs, what keys and panels request |
//! | `solution` | the solved light, and what is computed from it: lux meter, patch view, traced view, recording |
//! | `job` | threads for these computations |
//! | [`picture`] | the content of a picture of the scene |
//! | [`session`] | the open scene, and the worker that loads and bakes it |
//! | [`panels`] | the panels |
//! | [`software`] | parts for software drivers only |
//! | [`drawing`] | drawing of the picture |
//! | `window` | events, actions, frames |
//!
//! Deliberately absent: computation of light. Every picture is drawn by [`crate::render`].

pub mod camera;
pub mod drawing;
pub mod panels;
pub mod picture;
pub mod preferences;
pub mod session;
pub mod settings;
pub mod software;

mod action;
mod background;
mod job;
mod options;
mod solution;
mod window;

pub use options::ViewerOptions;

/// Opens the window and returns when it is closed.
///
/// # Errors
/// Returns an error if there is no display, or no graphics device that can draw into a window.
pub fn run(options: ViewerOptions) -> anyhow::Result<()> {
    background::lower_priority_of_rayon();
    window::app::run(options)
}

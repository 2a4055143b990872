//! The panels beside and over the picture: plain functions that turn [`Facts`] (what is shown) and [`Panels`] (what the
//! user has set) into widgets, and clicks into `Action`s.
//!
//! The panels have no access to the window, the device or the scene. Each section is a file with one `*_ui` function;
//! the sections of a page of the side panel share a folder: `picture`, `solution`, `measurement`, `scene`. `overlay` is
//! drawn over the picture, `chrome` is the rest of the window.

mod chrome;
mod facts;
mod layout;
mod measurement;
mod overlay;
mod picture;
mod scene;
pub mod shapes;
mod solution;

pub use chrome::message::{Notice, Trouble};
pub use chrome::theme;
pub use facts::{BakeFacts, CameraFacts, Facts, MeasurementFacts, PictureFacts, SceneFacts, ShadowFacts};
pub use layout::Panels;
pub use scene::open::OpenDialog;

#[cfg(test)]
mod tests;

//! The camera of the viewer: its pose, its movement, and the surfaces that a walker collides with.
//!
//! Deliberately absent: windows, clocks, keys and mouse buttons; `window::input` turns keys into a `MotionInput`.

pub mod pose;

pub(super) mod collider;
pub(super) mod controller;

mod glide;
mod walk;

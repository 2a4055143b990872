//! The window: events of keys and mouse, actions, and frames.
//!
//! From the bottom: `viewer` holds everything that is open; `actions` does what keys, panels and clicks request;
//! `next_picture` decides what a frame shows; `frame` draws it; `events` passes the events of the window to all of
//! them;
//! `app` is the application of winit.

pub(super) mod app;

mod accumulation;
mod actions;
mod events;
mod facts;
mod frame;
mod gui;
mod input;
mod next_picture;
mod pacing;
mod picture_state;
mod results;
mod shader_reload;
mod shadow_notes;
mod surface;
mod viewer;

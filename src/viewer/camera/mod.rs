//! The camera of the viewer: its pose, its movement, and the surfaces that a walker collides with.
//!
//! Deliberately absent: keys and mouse buttons ([`super::window`] turns them into a [`controller::MotionInput`]), windows
//! and clocks.

pub mod collider;
pub mod controller;
pub mod glide;
pub mod pose;
pub mod walk;

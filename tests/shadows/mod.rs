//! Shadows: every technique against rays, on scenes made to break them.

mod debug;
mod devices;
mod laboratory;
mod light;
mod map;
mod pictures;
mod planar;
mod stage;
mod stress;
mod truth;
mod volumes;

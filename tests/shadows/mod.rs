//! Shadows: each technique compared with rays, on scenes that are difficult for it.

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

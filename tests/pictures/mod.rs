//! Pictures that the GPU draws, compared with known answers.

mod at_once;
mod display;
mod files;
mod lost_device;
mod radiance;
mod relit;
mod sides;
mod stage;
mod textures;
mod tiles;

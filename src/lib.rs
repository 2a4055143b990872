//! Hemicube: true, view-independent diffuse light for glTF scenes.
//!
//! The crate is one route, told floor by floor; a floor only imports the floors below it
//! (`ARCHITECTURE.md` draws the house, `tests/floors.rs` enforces it):
//!
//! 0. [`base`]: ids, colour, sampling, progress.
//! 1. [`scene`]: a glTF file becomes a validated [`scene::Scene`].
//! 2. [`trace`], [`patch`], [`gpu`], [`baked`]: rays, patches and elements, the device, stored light.
//! 3. [`form_factor`], [`raytrace`], [`render`], [`lightmap`]: rows of form factors; traced and drawn pictures of a lit scene;
//!    its light as a texture.
//! 4. [`radiosity`]: direct light, progressive refinement, vertex light.
//! 5. [`bake`]: the whole job as one recipe.
//! 6. [`viewer`]: the window.
//! 7. [`cli`]: the command line.

pub mod base;
pub mod scene;

pub mod baked;
pub mod gpu;
pub mod patch;
pub mod trace;

pub mod form_factor;
pub mod lightmap;
pub mod raytrace;
pub mod render;

pub mod radiosity;

pub mod bake;

#[cfg(feature = "viewer")]
pub mod viewer;

#[cfg(feature = "cli")]
pub mod cli;

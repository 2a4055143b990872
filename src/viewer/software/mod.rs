//! Parts of the viewer that exist for software rendering only.
//!
//! A software driver, such as Mesa's lavapipe, draws on the cores of the processor that also trace rays and solve the
//! bake. [`Tier::Software`](crate::gpu::Tier) is decided once from the adapter. Everything that exists only for it lies
//! here or is named in the table, and does not run on hardware. The numbers were measured on two cores with Mesa 22.3
//! at 1280 x 720; another version may differ.
//!
//! | part | what it does | why, and what it gains |
//! |---|---|---|
//! | `software_renderer` | draws pictures of a movement with one sample per pixel instead of four | the CPU stores and resolves every sample; the gain was not measured separately |
//! | `sketch_size` | halves the width and height of moving pictures if a full one takes longer than 16 ms and half the size helps | the size follows the measured times, so scenes that gain nothing stay sharp |
//! | `software_renderer`, last exposure | shows a moving picture under the exposure metered for the one before | the surface pass then writes display colours directly, without a pass for tone mapping, which saves 5 ms per picture |
//! | `kept_side` | caches the side panel as a texture and repaints it if one of its shapes has changed | its hundreds of glyphs took longer than the picture |
//! | `warm_up` | draws a picture before the window shows one | lavapipe compiles a shader when it first draws, which delayed the first step of a walk |
//! | `window::surface` | waits for the frame before the bake resumes | otherwise the bake takes the cores that the frame is drawn on |
//! | `gpu::software` | stops the allocator from returning memory to the system after each submission | saves a third of the time of a hemicube (with glibc) |
//! | `bake::settings::method` | computes form factors by rays by default | a ray visits the triangles near it, an item buffer draws every triangle that may cover a pixel |
//!
//! Other parts were designed for this driver but also run on hardware, where their gain is not measured:
//!
//! * `baked::coarse`, `render::scene::tiled_mesh`, `render::stored_light::light_tiles`: a bake is drawn as a coarse
//!   mesh with its light in tiles of a texture. Medium bakes of cornell, gallery and zdm2 have 350, 10,000 and 73,000
//!   triangles instead of 20,000, 91,000 and 409,000.
//! * `render::surface::direct_source`: up to four light samples are added by the surface pass itself, without passes
//!   for depth and direct light.
//! * `render::shadow::map`: inside large triangles, a lookup reads one block plane of a shadow map instead of a window
//!   of texels. A frame of cornell with one map takes a third less time.
//! * `render::stored_light::weighted_light`: the sum over the light groups is computed when a lamp is dimmed, not for
//!   each vertex of each picture.
//!
//! Shaders follow three rules for lavapipe, which `shaders/shared/frame.wgsl` explains: no branch depends on a uniform
//! buffer, no derivative is taken of values that are read from storage, and what is linear in a triangle is computed at
//! its vertices.

pub mod kept_side;
mod sketch_size;
pub(super) mod software_renderer;
pub(super) mod warm_up;

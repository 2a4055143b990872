//! Floor 3: pictures of a lit scene, for the window and for files.
//!
//! A [`BakedScene`](crate::baked::BakedScene) is uploaded as [`SceneBuffers`](scene::SceneBuffers) and drawn by a
//! [`Renderer`]; its [`frame`] is the sequence of passes. Each pass is a file here, and its shader is the file of the
//! same stem in the same folder of `shaders/`.
//!
//! | room | holds |
//! |---|---|
//! | [`scene`] | the lit scene on the device |
//! | [`stored_light`] | the light of the vertices, summed over the light groups, and spread over tiles |
//! | [`shadow`] | direct light from the lights themselves, with the shadows of a technique |
//! | `surface` | radiance of every visible point |
//! | [`display`] | exposure and tone mapping, false colours |
//! | [`mod@compare`] | difference of two pictures |
//!
//! [`picture()`] draws a picture without a window. There is deliberately no render graph, no scene tree, and no
//! view-dependent light: light comes from the vertices.

pub mod compare;
pub mod display;
pub mod error;
pub mod frame;
pub mod headless;
pub mod overlay;
pub mod picture;
pub mod picture_request;
pub mod scene;
pub mod settings;
pub mod shadow;
pub mod stored_light;
pub mod targets;
pub mod view;

mod frame_uniform;
mod surface;

pub use compare::{Difference, Raster, compare, visible_difference};
pub use display::cpu_tone_map::tone_map_on_cpu;
pub use display::false_colour::{LuxScale, turbo};
pub use error::RenderError;
pub use frame::{Metering, Renderer};
pub use headless::{draw_picture, picture};
pub use overlay::{Mark, Overlay, OverlayPass};
pub use picture::{FileKind, Picture, save_display};
pub use picture_request::{MeteredExposure, PictureRequest};
pub use settings::{Exposure, RenderSettings, Shading, ToneMap};
pub use shadow::{ShadowScene, ShadowSettings, ShadowTechnique};
pub use view::View;

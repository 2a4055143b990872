//! Building blocks of all shadow techniques: the frame, the casters and lines of sight of a scene, and pipelines.
//!
//! Files here import no technique; the techniques import this folder.

pub mod casters;
pub mod depth_prepass;
pub mod exact_rays;
pub mod frame_context;
pub mod pipeline;
pub mod scene;
pub mod solid_surfaces;
pub mod stencil;

//! What all shadow techniques are built from: the frame, the casters and lines of sight of a scene, and pipelines.
//!
//! Files here import no technique: rooms stand on this folder, not the other way round.

pub mod casters;
pub mod depth_prepass;
pub mod exact_rays;
pub mod frame_context;
pub mod pipeline;
pub mod scene;
pub mod solid_surfaces;
pub mod stencil;

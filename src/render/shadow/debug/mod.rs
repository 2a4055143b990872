//! Debug views: the data of a shadow technique, drawn over the finished picture.

mod debug_pass;
mod map_faces;
mod marks;
mod overlay_pipeline;
mod stencil_counts;
mod view;

pub use debug_pass::DebugPass;
pub use stencil_counts::count_colour;
pub use view::{DebugView, DebugViewInfo, ShadowDebug};

//! Jobs that a click or a key starts: measurements, patch views, traced views, recordings and files. Each runs in a
//! thread of its own, pauses while a frame is drawn, and sends results to the window.

mod handle;
mod jobs;
mod result;

pub use jobs::{JobKind, Jobs};
pub use result::JobResult;

//! What keys, panels and clicks request, and how it is done. `perform` is the entry.

mod camera;
mod click;
mod files;
mod job_results;
mod output;
mod perform;

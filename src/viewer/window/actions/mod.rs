//! Carries out the actions that keys, panels and clicks request. `perform` is the entry.

mod camera;
mod click;
mod files;
mod job_results;
mod output;
mod perform;

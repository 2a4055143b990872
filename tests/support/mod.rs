//! What several test files need: a device, and small scenes built in code.

pub mod scenes;

use hemicube::gpu::Gpu;

/// A device, or none on a desk without a driver; with CI set there must be one.
pub fn gpu() -> Option<Gpu> {
    match Gpu::headless() {
        Ok(gpu) => Some(gpu),
        Err(error) if std::env::var_os("CI").is_some() => panic!("{error}"),
        Err(error) => {
            println!("skipped: {error}");
            None
        }
    }
}

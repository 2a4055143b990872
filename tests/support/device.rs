//! The device of the tests.

use std::sync::LazyLock;

use hemicube::gpu::Gpu;

static GPU: LazyLock<Option<Gpu>> = LazyLock::new(|| match Gpu::headless() {
    Ok(gpu) => Some(gpu),
    Err(error) if std::env::var_os("CI").is_some() => panic!("{error}"),
    Err(error) => {
        println!("skipped: {error}");
        None
    }
});

/// Returns the device that all tests share; `None` on a machine without an adapter, where the test then returns. Panics
/// instead if the environment variable CI is set.
pub fn gpu() -> Option<&'static Gpu> {
    GPU.as_ref()
}

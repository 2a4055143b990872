//! Errors of the device.

use thiserror::Error;

/// Error of the GPU device: there is none, or it cannot do the work.
#[derive(Clone, Debug, Error)]
pub enum GpuError {
    /// No driver offers an adapter.
    #[error(
        "no GPU adapter found ({0}). Install a Vulkan driver; without a graphics card the software one will do: \
         on Debian or Ubuntu `apt install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter(String),
    /// There is an adapter, but its driver creates no device.
    #[error("the GPU adapter {adapter} gives no device: {cause}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// The message of the driver.
        cause: String,
    },
    /// The picture is too large for a texture, or empty.
    #[error("cannot draw a picture of {width}x{height} pixels: each side must be 1 to {limit} on this GPU")]
    PictureSize {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Largest side of a texture, pixels.
        limit: u32,
    },
    /// The device was lost or refused a read-back.
    #[error("the GPU did not answer: {0}")]
    Lost(String),
}

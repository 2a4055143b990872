//! What can go wrong with the device.

use thiserror::Error;

/// There is no device, or it cannot do the work.
#[derive(Clone, Debug, Error)]
pub enum GpuError {
    /// No driver offers an adapter.
    #[error(
        "no GPU adapter found ({0}). Install a Vulkan driver; without a graphics card the software one will do: \
         on Debian or Ubuntu `apt install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter(String),
    /// There is an adapter, but it gives no device.
    #[error("the GPU adapter {adapter} gives no device: {cause}")]
    NoDevice {
        /// Its name.
        adapter: String,
        /// The message of the driver.
        cause: String,
    },
    /// A picture that no texture can hold.
    #[error("cannot draw a picture of {width}x{height} pixels: each side must be 1 to {limit} on this GPU")]
    PictureSize {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Largest side.
        limit: u32,
    },
    /// The device was lost or refused a read-back.
    #[error("the GPU did not answer: {0}")]
    Lost(String),
}

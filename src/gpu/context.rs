//! One adapter, one device, one queue.

use thiserror::Error;

/// The device and how it calls itself.
pub struct Gpu {
    /// The instance; the viewer makes its surface from it.
    pub instance: wgpu::Instance,
    /// The adapter the device belongs to.
    pub adapter: wgpu::Adapter,
    /// Makes resources.
    pub device: wgpu::Device,
    /// Takes work.
    pub queue: wgpu::Queue,
}

/// There is no device to work with.
#[derive(Debug, Error)]
pub enum GpuError {
    /// No driver answered.
    #[error(
        "no GPU adapter found ({0}). Install a Vulkan driver; without a graphics card the software one will do: \
         on Debian or Ubuntu `apt install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter(String),
    /// The driver answered but gave no device.
    #[error("the GPU adapter {adapter} gives no device: {cause}")]
    NoDevice {
        /// Its name.
        adapter: String,
        /// What it said.
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

impl Gpu {
    /// A device for work without a window.
    ///
    /// # Errors
    /// No adapter, or an adapter without the portable limits.
    pub fn headless() -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        Self::for_surface(instance, None)
    }

    /// A device that can draw to `surface` (a window), or to textures only.
    ///
    /// # Errors
    /// No adapter, or an adapter without the portable limits.
    pub fn for_surface(instance: wgpu::Instance, surface: Option<&wgpu::Surface<'_>>) -> Result<Self, GpuError> {
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: surface,
            ..Default::default()
        }))
        .map_err(|error| GpuError::NoAdapter(error.to_string()))?;
        let wanted = wgpu::Features::TIMESTAMP_QUERY
            | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS
            | wgpu::Features::DEPTH32FLOAT_STENCIL8
            // Sums of many light samples need more than half floats.
            | wgpu::Features::FLOAT32_BLENDABLE
            | wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("hemicube"),
            required_features: adapter.features() & wanted,
            // The adapter's own sizes: large scenes need more than the portable 128 MiB a storage buffer.
            required_limits: adapter.limits(),
            memory_hints: wgpu::MemoryHints::Manual { suballocated_device_memory_block_size: MEMORY_BLOCK },
            ..Default::default()
        }))
        .map_err(|error| GpuError::NoDevice { adapter: adapter.get_info().name, cause: error.to_string() })?;
        let gpu = Self { instance, adapter, device, queue };
        if gpu.is_software() {
            let_the_allocator_keep_memory();
        }
        Ok(gpu)
    }

    /// Name of the adapter, with its backend.
    #[must_use]
    pub fn name(&self) -> String {
        let info = self.adapter.get_info();
        format!("{} ({})", info.name, info.backend)
    }

    /// The adapter draws on the CPU (lavapipe): every pixel costs the cores that also trace rays.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.adapter.get_info().device_type == wgpu::DeviceType::Cpu
    }
}

/// Size of the blocks of device memory that resources share, bytes; of memory that the host sees, half of it. A block is
/// held as long as one resource lies in it: of wgpu's own, up to four times as large, a small buffer made at a busy moment
/// held hundreds of MiB.
const MEMORY_BLOCK: std::ops::Range<u64> = 64 << 20..64 << 20;

/// Keeps the allocator from giving a software driver's memory back to the system after every submission, only to ask for
/// it again: that took a third of the time of a hemicube.
///
/// The GNU allocator keeps twice the size of the largest block it has freed, of up to 32 MiB (mallopt(3),
/// `M_MMAP_THRESHOLD`); this one is never touched. Other allocators just free it.
fn let_the_allocator_keep_memory() {
    const LARGEST: usize = 31 << 20;
    drop(std::hint::black_box(Vec::<u8>::with_capacity(LARGEST)));
}

//! The GPU device with its adapter and its queue.

use std::sync::{Arc, OnceLock};

use super::GpuError;
use super::shader_library::ShaderLibrary;
use super::software::keep_allocated_memory;
use super::tier::Tier;

/// An adapter with its device and queue.
pub struct Gpu {
    /// The instance, from which the viewer creates its surface.
    pub instance: wgpu::Instance,
    /// The adapter of the device.
    pub adapter: wgpu::Adapter,
    /// The device, which creates resources.
    pub device: wgpu::Device,
    /// The queue, to which work is submitted.
    pub queue: wgpu::Queue,
    /// Kind of device: graphics card or processor.
    pub tier: Tier,
    /// The shaders in use.
    pub shaders: ShaderLibrary,
    /// Reason for the loss of the device; empty while it works.
    loss: Arc<OnceLock<String>>,
}

impl Gpu {
    /// Returns a device for work without a window.
    ///
    /// # Errors
    /// Returns an error if there is no adapter, or if its driver gives no device.
    pub fn headless() -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        Self::for_surface(instance, None)
    }

    /// Returns a device that can draw to `surface` (a window), or to textures only.
    ///
    /// # Errors
    /// Returns an error if there is no adapter, or if its driver gives no device.
    pub fn for_surface(instance: wgpu::Instance, surface: Option<&wgpu::Surface<'_>>) -> Result<Self, GpuError> {
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: surface,
            ..Default::default()
        }))
        .map_err(|error| GpuError::NoAdapter(error.to_string()))?;
        let optional = wgpu::Features::TIMESTAMP_QUERY
            | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS
            | wgpu::Features::DEPTH32FLOAT_STENCIL8
            // Sums of many light samples need more than half floats.
            | wgpu::Features::FLOAT32_BLENDABLE
            | wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("hemicube"),
            required_features: adapter.features() & optional,
            // The adapter's own limits: large scenes need more than the portable 128 MiB per storage buffer.
            required_limits: adapter.limits(),
            memory_hints: wgpu::MemoryHints::Manual { suballocated_device_memory_block_size: MEMORY_BLOCK },
            ..Default::default()
        }))
        .map_err(|error| GpuError::NoDevice { adapter: adapter.get_info().name, cause: error.to_string() })?;
        Ok(Self::from_parts(instance, adapter, device, queue))
    }

    /// Takes over a device that the caller has created, and sets its callback for the loss of the device.
    #[must_use]
    pub fn from_parts(
        instance: wgpu::Instance,
        adapter: wgpu::Adapter,
        device: wgpu::Device,
        queue: wgpu::Queue,
    ) -> Self {
        let loss = Arc::new(OnceLock::new());
        let lost = Arc::clone(&loss);
        // Only the first reason is stored: later ones are its consequences.
        device.set_device_lost_callback(move |reason, message| drop(lost.set(format!("{message} ({reason:?})"))));
        let lost = Arc::clone(&loss);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            // Errors after a loss are its consequences. Any other error is a bug of this program.
            assert!(lost.get().is_some(), "wgpu error: {error}");
        }));
        let tier = Tier::of(&adapter.get_info());
        if tier.is_software() {
            keep_allocated_memory();
        }
        Self { instance, adapter, device, queue, tier, shaders: ShaderLibrary::default(), loss }
    }

    /// Returns the name of the adapter, with its backend.
    #[must_use]
    pub fn name(&self) -> String {
        let info = self.adapter.get_info();
        format!("{} ({})", info.name, info.backend)
    }

    /// Checks that the device works, without waiting for it.
    ///
    /// wgpu accepts work for a lost device and drops it, so pictures would be black. It panics when it fills a new
    /// buffer of a lost device.
    ///
    /// # Errors
    /// Returns the reason if the device was lost.
    pub fn check(&self) -> Result<(), GpuError> {
        // The poll calls the callback. Its own error is ignored, because its cause is the loss of the device.
        let _ = self.device.poll(wgpu::PollType::Poll);
        self.loss.get().map_or(Ok(()), |reason| Err(GpuError::Lost(reason.clone())))
    }

    /// Waits until the device has done all work submitted so far.
    ///
    /// # Errors
    /// Returns the reason if the device was lost.
    pub fn wait(&self) -> Result<(), GpuError> {
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.check()?;
        waited.map(drop).map_err(|error| GpuError::Lost(error.to_string()))
    }
}

/// Size of the blocks of device memory that resources share, bytes. Blocks of memory that the host can access are half
/// as large.
///
/// A block stays allocated as long as one resource is in it. With wgpu's default size, up to four times as large, one
/// small buffer created at a busy moment held hundreds of MiB.
const MEMORY_BLOCK: std::ops::Range<u64> = 64 << 20..64 << 20;

//! The kind of device that draws, determined when the device is created.

/// The kind of device that draws.
///
/// It selects the method, not the result: the viewer draws moving views with fewer samples (`viewer::software`), and a
/// bake prefers rays to item buffers (`bake::Method`). No other code depends on the type of the adapter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tier {
    /// A graphics card, including integrated and virtual ones.
    Hardware,
    /// A driver that draws on the processor, such as Mesa's lavapipe. Drawing then competes with ray tracing for the
    /// cores.
    Software,
}

impl Tier {
    /// Returns the tier of an adapter.
    #[must_use]
    pub fn of(adapter: &wgpu::AdapterInfo) -> Self {
        match adapter.device_type {
            wgpu::DeviceType::Cpu => Tier::Software,
            _ => Tier::Hardware,
        }
    }

    /// Returns true if the processor draws.
    #[must_use]
    pub fn is_software(self) -> bool {
        self == Tier::Software
    }
}

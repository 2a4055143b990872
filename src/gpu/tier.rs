//! What kind of machine draws: decided once, when the device is made.

/// What kind of machine draws.
///
/// It chooses between ways to the same picture or the same bake: the viewer draws movement with fewer samples
/// (`viewer::software`), and a bake prefers rays to item buffers (`bake::method`). Nothing else asks for the adapter's type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tier {
    /// A graphics card, also an integrated or a virtual one.
    Hardware,
    /// A driver that draws on the processor, such as Mesa's lavapipe: each pixel costs time of the cores that also trace rays.
    Software,
}

impl Tier {
    /// The tier of an adapter.
    #[must_use]
    pub fn of(adapter: &wgpu::AdapterInfo) -> Self {
        match adapter.device_type {
            wgpu::DeviceType::Cpu => Tier::Software,
            _ => Tier::Hardware,
        }
    }

    /// The processor draws.
    #[must_use]
    pub fn is_software(self) -> bool {
        self == Tier::Software
    }
}

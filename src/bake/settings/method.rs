//! The methods by which a bake computes form factors.

use super::choice::choice_table;
use crate::gpu::Gpu;

/// How form factors are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Item buffers drawn by the GPU.
    Hemicube,
    /// Cosine-distributed rays on the CPU.
    Hemisphere,
}

choice_table! {
    Method {
        Hemicube: "hemicube", "Item buffers drawn by the GPU";
        Hemisphere: "hemisphere", "Rays on the CPU";
    }
}

impl Method {
    /// Returns the faster method. A graphics card draws hemicubes faster than the CPU traces rays. A software driver is
    /// slower, because a ray visits only the triangles near it, while an item buffer draws every triangle that may
    /// cover a pixel.
    #[must_use]
    pub fn fastest(gpu: Option<&Gpu>) -> Self {
        match gpu {
            Some(gpu) if !gpu.tier.is_software() => Self::Hemicube,
            _ => Self::Hemisphere,
        }
    }
}

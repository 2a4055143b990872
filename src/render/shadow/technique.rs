//! The shadow techniques, in one table that the command line, the panels and the benches use.

/// A technique that finds shadows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShadowTechnique {
    /// No shadows: light passes through everything.
    None,
    /// Shadow maps: depth seen from the light (Williams 1978), with percentage-closer filtering (Reeves et al. 1987).
    Map,
    /// Shadow volumes, counted in the stencil in front of the visible point: z-pass (Heidmann 1991).
    VolumeDepthPass,
    /// Shadow volumes, counted in the stencil behind the visible point: z-fail (Everitt and Kilgard 2002).
    VolumeDepthFail,
    /// Planar shadows: casters projected on to a few large planes (Blinn 1988).
    Planar,
    /// One ray for each pixel and light sample, on the CPU: the reference for the other techniques.
    Raytraced,
}

/// A row of [`ShadowTechnique::ALL`].
#[derive(Clone, Copy, Debug)]
pub struct TechniqueInfo {
    /// The technique.
    pub technique: ShadowTechnique,
    /// Name on the command line.
    pub name: &'static str,
    /// Name in the panels.
    pub title: &'static str,
    /// One line of explanation.
    pub hint: &'static str,
    /// Stencil bits that count shadows; `None` if the technique does not use the stencil.
    pub counted_bits: Option<u32>,
    /// True if the surface pass can add the light of up to four samples itself, without passes for depth and direct
    /// light.
    pub is_in_surface_pass: bool,
}

impl ShadowTechnique {
    /// All techniques, in the order in which they are listed.
    pub const ALL: [TechniqueInfo; 6] = [
        TechniqueInfo {
            technique: ShadowTechnique::None,
            name: "none",
            title: "None",
            hint: "Light passes through everything",
            counted_bits: None,
            is_in_surface_pass: true,
        },
        TechniqueInfo {
            technique: ShadowTechnique::Map,
            name: "map",
            title: "Map",
            hint: "Depth seen from the light",
            counted_bits: None,
            is_in_surface_pass: true,
        },
        TechniqueInfo {
            technique: ShadowTechnique::VolumeDepthPass,
            name: "volume-depth-pass",
            title: "Volumes, depth-pass",
            hint: "Stencil volumes counted in front of the visible point",
            counted_bits: Some(0xff),
            is_in_surface_pass: false,
        },
        TechniqueInfo {
            technique: ShadowTechnique::VolumeDepthFail,
            name: "volume-depth-fail",
            title: "Volumes, depth-fail",
            hint: "Stencil volumes counted behind the visible point",
            counted_bits: Some(0xff),
            is_in_surface_pass: false,
        },
        TechniqueInfo {
            technique: ShadowTechnique::Planar,
            name: "planar",
            title: "Planar",
            hint: "Casters projected on to the largest planes",
            counted_bits: Some(super::shared::stencil::SHADOW_BITS),
            is_in_surface_pass: false,
        },
        TechniqueInfo {
            technique: ShadowTechnique::Raytraced,
            name: "raytraced",
            title: "Ray-traced",
            hint: "One ray a pixel on the processor: the reference, and slow",
            counted_bits: None,
            is_in_surface_pass: false,
        },
    ];

    /// Returns the technique's row of the table.
    #[must_use]
    pub fn info(self) -> &'static TechniqueInfo {
        const ALL: &[TechniqueInfo] = &ShadowTechnique::ALL;
        ALL.iter().find(|info| info.technique == self).unwrap_or(&ALL[0])
    }

    /// Returns the technique with a name of the command line.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|info| info.name == name).map(|info| info.technique)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_one_row_for_each_technique() {
        for (index, info) in ShadowTechnique::ALL.iter().enumerate() {
            assert_eq!(info.technique as usize, index, "rows are in the order of the enum");
            assert_eq!(ShadowTechnique::from_name(info.name), Some(info.technique));
        }
        assert_eq!(ShadowTechnique::ALL.len(), ShadowTechnique::Raytraced as usize + 1);
    }
}

//! Settings of shadow maps.

/// Settings of shadow maps and their lookup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapSettings {
    /// Texels across and down a face of a map.
    pub resolution: u32,
    /// Texels in each direction over which the edge of a shadow is filtered (PCF).
    pub pcf_radius: u32,
    /// Shift of a point along its normal, texels. It avoids acne, but light leaks through thin walls. The lookup
    /// compares with the plane of the receiver and needs no shift.
    pub normal_offset: f32,
    /// Shift of a point towards the light, as a multiple of its surface's change of depth from texel to texel. Too
    /// small a shift shows acne, too large a shift detaches shadows from their casters.
    pub slope_bias: f32,
}

impl Default for MapSettings {
    fn default() -> Self {
        Self { resolution: 2048, pcf_radius: 1, normal_offset: 0.0, slope_bias: 0.3 }
    }
}

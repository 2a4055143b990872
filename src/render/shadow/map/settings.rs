//! Settings of shadow maps.

/// How shadow maps are drawn and looked up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapSettings {
    /// Texels across and down a face of a map.
    pub resolution: u32,
    /// Texels in each direction over which the edge of a shadow is filtered (PCF).
    pub pcf_radius: u32,
    /// Shift of a point along its normal, texels. It avoids acne and lets light leak through thin walls; depths that
    /// are compared with the plane of the receiver need none.
    pub normal_offset: f32,
    /// Shift of a point towards the light, in units of the depth that its surface falls from texel to texel. Too little
    /// shows acne, too much detaches shadows from their casters.
    pub slope_bias: f32,
}

impl Default for MapSettings {
    fn default() -> Self {
        Self { resolution: 2048, pcf_radius: 1, normal_offset: 0.0, slope_bias: 0.3 }
    }
}

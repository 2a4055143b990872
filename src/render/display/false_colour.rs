//! Illuminance as a colour: the scale, and the colours for legends.
//!
//! `shaders/display/false_colour.wgsl` colours the picture by the same formulas; a test compares the two.

use glam::Vec4;

/// The scale that assigns colours to illuminances.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct LuxScale {
    /// Illuminance of the first colour, lux; above 0 on a logarithmic scale.
    pub low: f32,
    /// Illuminance of the last colour, lux.
    pub high: f32,
    /// True if equal ratios take equal lengths of the scale, false if equal differences do.
    pub is_logarithmic: bool,
    /// Number of equal parts into which lines of equal illuminance divide the scale; 0 draws no lines.
    pub num_parts: u32,
}

impl Default for LuxScale {
    fn default() -> Self {
        Self { low: 10.0, high: 1000.0, is_logarithmic: true, num_parts: 8 }
    }
}

impl LuxScale {
    /// Smallest illuminance at which a logarithmic scale can begin, lux.
    const LEAST: f32 = 1e-3;

    /// Returns the scale with its ends in order and distinct.
    #[must_use]
    pub fn in_order(self) -> Self {
        let low = if self.is_logarithmic { self.low.max(Self::LEAST) } else { self.low.max(0.0) };
        Self { low, high: self.high.max(low * 1.01 + Self::LEAST), ..self }
    }

    /// Returns the illuminance at a place of the scale, 0..1.
    #[must_use]
    pub fn lux_at(&self, place: f32) -> f32 {
        let Self { low, high, .. } = self.in_order();
        if self.is_logarithmic { low * (high / low).powf(place) } else { low + (high - low) * place }
    }

    /// Returns `lux_scale` of shaders/shared/frame.wgsl.
    pub(in crate::render) fn uniform(&self) -> Vec4 {
        let Self { low, high, .. } = self.in_order();
        Vec4::new(low, high, f32::from(u8::from(self.is_logarithmic)), self.num_parts as f32)
    }
}

/// Returns the sRGB bytes of the Turbo colour map at `x` in 0..1.
///
/// Source: Mikhailov 2019, "Turbo, An Improved Rainbow Colormap for Visualization" (its polynomial).
#[must_use]
pub fn turbo(x: f32) -> [u8; 3] {
    const COEFFICIENTS: [[f32; 6]; 3] = [
        [0.135_721_38, 4.615_392_6, -42.660_32, 132.131_08, -152.942_4, 59.286_38],
        [0.091_402_61, 2.194_188_4, 4.842_966_6, -14.185_033, 4.277_298_6, 2.829_566],
        [0.106_673_3, 12.641_946, -60.582_05, 110.362_77, -89.903_11, 27.348_25],
    ];
    let x = x.clamp(0.0, 1.0);
    COEFFICIENTS.map(|c| {
        let value = c.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient);
        (255.0 * value.clamp(0.0, 1.0)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_goes_from_its_low_to_its_high_end() {
        for is_logarithmic in [true, false] {
            let scale = LuxScale { low: 20.0, high: 500.0, is_logarithmic, num_parts: 4 };
            assert!((scale.lux_at(0.0) - 20.0).abs() < 1e-3 && (scale.lux_at(1.0) - 500.0).abs() < 1e-2);
        }
        let logarithmic = LuxScale { low: 1.0, high: 100.0, is_logarithmic: true, num_parts: 4 };
        assert!((logarithmic.lux_at(0.5) - 10.0).abs() < 1e-4);
    }

    #[test]
    fn exchanged_ends_are_put_in_order() {
        for is_logarithmic in [true, false] {
            let scale = LuxScale { low: 100.0, high: 0.0, is_logarithmic, num_parts: 0 }.in_order();
            assert!(scale.low > 0.0 && scale.high > scale.low, "{scale:?}");
        }
    }

    #[test]
    fn turbo_goes_from_blue_over_green_to_red() {
        let [low, middle, high] = [0.1, 0.5, 0.95].map(turbo);
        assert!(low[2] > low[0] && middle[1] > middle[0] && middle[1] > middle[2] && high[0] > high[2], "{low:?}");
    }
}

//! Deviation of a lightmap from the light that it is made from.

use glam::Vec2;

use super::pieces::Piece;
use crate::baked::Texels;
use crate::base::colour::luminance;
use crate::base::sampling::{r2, triangle_from_square};

/// Number of sample points of an element.
const POINTS: u32 = 4;

/// Mean deviation in luminance over all surfaces, as a share of the mean luminance: sum A |shown - stored| / sum A
/// stored.
pub(super) fn deviation(texels: &Texels, pieces: impl Iterator<Item = Piece>) -> f32 {
    let size = Vec2::new(texels.width as f32, texels.height as f32);
    let (mut deviation, mut light) = (0.0, 0.0);
    for (p, piece) in pieces.enumerate() {
        let flat = piece.corners.map(|corner| corner.as_vec2());
        for point in 0..POINTS {
            let [a, b, c] = triangle_from_square(r2(POINTS * p as u32 + point, 0)).to_array();
            let stored = luminance(piece.light[0] * a + piece.light[1] * b + piece.light[2] * c);
            let shown = luminance(texels.sample((flat[0] * a + flat[1] * b + flat[2] * c) / size));
            deviation += piece.area * f64::from((shown - stored).abs());
            light += piece.area * f64::from(stored);
        }
    }
    if light > 0.0 { (deviation / light) as f32 } else { 0.0 }
}

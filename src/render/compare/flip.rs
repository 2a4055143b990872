//! FLIP: estimates the difference that an observer sees who alternates between two pictures.
//!
//! Both pictures are converted to an opponent colour space and filtered by the contrast sensitivity of the eye at a
//! viewing distance. They are compared in CIELAB with the HyAB metric, which yields a colour difference dC in 0..1.
//! Edge and point detectors yield a feature difference dF. The error of a pixel is
//!
//! ```text
//! dE = dC^(1 - dF)
//! ```
//!
//! So a colour difference counts more where one picture has a feature that the other lacks.
//!
//! Source: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A Difference Evaluator for
//! Alternating Images" (sections and constants are those of the paper).

use std::f32::consts::PI;

use glam::{Mat3, Vec2, Vec3};
use rayon::prelude::*;

use crate::base::colour::linear_from_srgb;

/// Pixels per degree of a screen 0.7 m wide with 3840 pixels, seen from 0.7 m.
const PIXELS_PER_DEGREE: f32 = 67.02;

/// Exponents of the colour and of the feature difference (sections 4.1.3 and 4.3).
const COLOUR_EXPONENT: f32 = 0.7;
const FEATURE_EXPONENT: f32 = 0.5;

/// A colour difference that is this share of the largest one is mapped to [`FULL_VALUE`]. Larger differences are mapped
/// to the rest of the range (section 4.1.3).
const FULL_SHARE: f32 = 0.4;
const FULL_VALUE: f32 = 0.95;

/// Width of the detected features, degrees (section 4.2).
const FEATURE_WIDTH: f32 = 0.082;

/// XYZ of white (D65), as computed by the linear Rec. 709 matrix.
const WHITE: Vec3 = Vec3::new(0.950_428_55, 1.0, 1.088_900_3);

/// Computes the FLIP error of each pixel, from 0 (equal) to 1. Both pictures have `width` pixels a row. Their colours
/// are linear display colours with white at 1.
///
/// Shapes: `picture` and `reference` `[pixel]`, row by row.
#[must_use]
pub fn flip(picture: &[Vec3], reference: &[Vec3], width: usize) -> Vec<f32> {
    let [a, b] = [picture, reference].map(|pixels| Seen::of(pixels, width));
    let largest = hyab(hunt(lab(Vec3::Y)), hunt(lab(Vec3::Z))).powf(COLOUR_EXPONENT);
    let pixel = |i: usize| {
        let colour = spread(hyab(a.colours[i], b.colours[i]).powf(COLOUR_EXPONENT), largest);
        let [edges, points] = [0, 1].map(|k| (a.features[i][k] - b.features[i][k]).abs());
        let feature = (edges.max(points) * std::f32::consts::FRAC_1_SQRT_2).powf(FEATURE_EXPONENT);
        colour.powf(1.0 - feature)
    };
    (0..reference.len()).map(pixel).collect()
}

/// A picture as the eye perceives it: blurred colours and strengths of features.
struct Seen {
    /// Blurred colours, in CIELAB with Hunt's adjustment.
    colours: Vec<Vec3>,
    /// Strength of edges and of points.
    features: Vec<[f32; 2]>,
}

impl Seen {
    fn of(pixels: &[Vec3], width: usize) -> Self {
        let opponent: Vec<Vec3> = pixels.iter().map(|&pixel| opponent(pixel.clamp(Vec3::ZERO, Vec3::ONE))).collect();
        let colours = blurred(&opponent, width).into_iter().map(|seen| {
            let linear = linear_from_opponent(seen).clamp(Vec3::ZERO, Vec3::ONE);
            hunt(lab(linear))
        });
        let lightness: Vec<f32> = opponent.iter().map(|colour| (colour.x + 16.0) / 116.0).collect();
        Self { colours: colours.collect(), features: features(&lightness, width) }
    }
}

/// Returns the matrix from linear Rec. 709 to XYZ.
fn xyz_from_linear() -> Mat3 {
    Mat3::from_cols(
        Vec3::new(0.412_390_8, 0.212_639, 0.019_330_82),
        Vec3::new(0.357_584_33, 0.715_168_65, 0.119_194_78),
        Vec3::new(0.180_480_8, 0.072_192_32, 0.950_532_14),
    )
}

/// Returns YCxCz: lightness, red against green, blue against yellow.
fn opponent(linear: Vec3) -> Vec3 {
    let [x, y, z] = (xyz_from_linear() * linear / WHITE).to_array();
    Vec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

fn linear_from_opponent(colour: Vec3) -> Vec3 {
    let y = (colour.x + 16.0) / 116.0;
    let xyz = Vec3::new(y + colour.y / 500.0, y, y - colour.z / 200.0);
    xyz_from_linear().inverse() * (xyz * WHITE)
}

/// Returns the CIELAB values of a linear colour.
fn lab(linear: Vec3) -> Vec3 {
    const DELTA: f32 = 6.0 / 29.0;
    let bent = |t: f32| if t > DELTA.powi(3) { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 };
    let [x, y, z] = (xyz_from_linear() * linear / WHITE).to_array().map(bent);
    Vec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

/// Applies the Hunt effect: dark colours appear less saturated.
fn hunt(lab: Vec3) -> Vec3 {
    let paleness = 0.01 * lab.x;
    Vec3::new(lab.x, paleness * lab.y, paleness * lab.z)
}

/// Returns the HyAB distance, for colours that may be far apart (Abasi et al. 2020): |dL| + length(da, db).
fn hyab(a: Vec3, b: Vec3) -> f32 {
    let apart = a - b;
    apart.x.abs() + Vec2::new(apart.y, apart.z).length()
}

/// Maps a colour difference to 0..1; usual differences take most of the range.
fn spread(difference: f32, largest: f32) -> f32 {
    let full = FULL_SHARE * largest;
    if difference < full {
        difference * FULL_VALUE / full
    } else {
        FULL_VALUE + (difference - full) / (largest - full) * (1.0 - FULL_VALUE)
    }
}

/// Filters a picture by the contrast sensitivity of the eye, channel by channel (section 4.1.1, table 1).
fn blurred(opponent: &[Vec3], width: usize) -> Vec<Vec3> {
    /// Amplitudes and widths of the Gaussians that make up the contrast sensitivity of a channel.
    const SENSITIVITY: [&[[f32; 2]]; 3] = [&[[1.0, 0.0047]], &[[1.0, 0.0053]], &[[34.1, 0.04], [13.5, 0.025]]];
    /// Radius in pixels beyond which the widest Gaussian is negligible.
    const RADIUS: i32 = 10;
    let channel = |k: usize| -> Vec<f32> {
        let values: Vec<f32> = opponent.iter().map(|colour| colour[k]).collect();
        let mut sum = vec![0.0; values.len()];
        let mut whole = 0.0;
        for &[amplitude, spread] in SENSITIVITY[k] {
            let gaussian = kernel(RADIUS, |x| (-(PI * x / PIXELS_PER_DEGREE).powi(2) / spread).exp());
            let height = amplitude * (PI / spread).sqrt();
            whole += height * gaussian.iter().sum::<f32>().powi(2);
            for (sum, blurred) in sum.iter_mut().zip(convolved(&values, width, &gaussian, &gaussian)) {
                *sum += height * blurred;
            }
        }
        sum.into_iter().map(|sum| sum / whole).collect()
    };
    let [y, cx, cz] = [0, 1, 2].map(channel);
    y.into_iter().zip(cx.into_iter().zip(cz)).map(|(y, (cx, cz))| Vec3::new(y, cx, cz)).collect()
}

/// Computes the strength of edges and of points in a greyscale picture (section 4.2).
fn features(lightness: &[f32], width: usize) -> Vec<[f32; 2]> {
    let deviation = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
    let radius = (3.0 * deviation).ceil() as i32;
    let gaussian = |x: f32| (-0.5 * (x / deviation).powi(2)).exp();
    let smooth = balanced(kernel(radius, gaussian));
    let edge = balanced(kernel(radius, |x| -x * gaussian(x)));
    let point = balanced(kernel(radius, |x| ((x / deviation).powi(2) - 1.0) * gaussian(x)));
    let strength = |across: &[f32]| -> Vec<f32> {
        let along_x = convolved(lightness, width, across, &smooth);
        let along_y = convolved(lightness, width, &smooth, across);
        along_x.into_iter().zip(along_y).map(|(x, y)| x.hypot(y)).collect()
    };
    strength(&edge).into_iter().zip(strength(&point)).map(|(edge, point)| [edge, point]).collect()
}

/// Returns the values of a function at whole pixels.
fn kernel(radius: i32, value: impl Fn(f32) -> f32) -> Vec<f32> {
    (-radius..=radius).map(|x| value(x as f32)).collect()
}

/// Scales the positive values so that they sum to 1, and the negative values so that they sum to -1.
fn balanced(kernel: Vec<f32>) -> Vec<f32> {
    let sum = |sign: f32| kernel.iter().map(|x| (sign * x).max(0.0)).sum::<f32>();
    let (above, below) = (sum(1.0), sum(-1.0));
    kernel
        .into_iter()
        .map(|x| {
            if x > 0.0 {
                x / above
            } else if x < 0.0 {
                x / below
            } else {
                0.0
            }
        })
        .collect()
}

/// Convolves with one kernel along rows and another along columns. The border pixels are repeated outwards.
fn convolved(values: &[f32], width: usize, along_row: &[f32], along_column: &[f32]) -> Vec<f32> {
    let height = values.len() / width;
    let weighted = |kernel: &[f32], at: usize, size: usize, value: &dyn Fn(usize) -> f32| -> f32 {
        let radius = kernel.len() / 2;
        let near = |k: usize| (at + k).saturating_sub(radius).min(size - 1);
        kernel.iter().enumerate().map(|(k, weight)| weight * value(near(k))).sum()
    };
    let pixels = 0..values.len();
    let rows: Vec<f32> = pixels
        .clone()
        .into_par_iter()
        .map(|i| weighted(along_row, i % width, width, &|x| values[i / width * width + x]))
        .collect();
    pixels
        .into_par_iter()
        .map(|i| weighted(along_column, i / width, height, &|y| rows[y * width + i % width]))
        .collect()
}

/// Returns the linear colour of a difference from 0 to 1: matplotlib's magma map, by the polynomials of Zucker.
#[must_use]
pub fn magma(difference: f32) -> Vec3 {
    const FACTORS: [[f32; 3]; 7] = [
        [-0.002_136_485, -0.000_749_655, -0.005_386_128],
        [0.251_660_54, 0.677_523_24, 2.494_026_6],
        [8.353_717, -3.577_719_5, 0.314_467_9],
        [-27.668_733, 14.264_731, -13.649_213],
        [52.176_14, -27.943_606, 12.944_169],
        [-50.768_525, 29.046_583, 4.234_153],
        [18.655_705, -11.489_774, -5.601_961_5],
    ];
    let t = difference.clamp(0.0, 1.0);
    let encoded = FACTORS.iter().rev().fold(Vec3::ZERO, |sum, &factors| sum * t + Vec3::from(factors));
    encoded.clamp(Vec3::ZERO, Vec3::ONE).map(linear_from_srgb)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp of coloured blocks, 64 x 64.
    fn blocks() -> Vec<Vec3> {
        let colour = |x: u32, y: u32| {
            let block =
                if (x / 8 + y / 8).is_multiple_of(2) { Vec3::new(1.0, 0.4, 0.2) } else { Vec3::new(0.3, 0.5, 1.0) };
            block * (0.1 + 0.8 * x as f32 / 63.0)
        };
        (0..64 * 64).map(|i| colour(i % 64, i / 64)).collect()
    }

    #[test]
    fn differences_are_those_of_the_program_of_the_authors() {
        // Mean, largest value, and two pixels as flip-evaluator 1.7 prints them for the same pictures.
        type Change = fn(&[Vec3], usize) -> Vec3;
        let changes: [(Change, [f32; 4]); 4] = [
            (|p, i| p[if i % 64 == 0 { i } else { i - 1 }], [0.109_614_26, 0.280_622_27, 0.056_917_76, 0.090_495_93]),
            (|p, i| 0.7 * p[i], [0.327_790_77, 0.450_051_7, 0.239_170_5, 0.306_545_85]),
            (
                |p, i| if i % 64 < 8 && i < 8 * 64 { Vec3::ZERO } else { p[i] },
                [0.013_447_749, 0.780_697_35, 0.710_192_3, 0.0],
            ),
            (
                |p, i| (p[i] * Vec3::new(1.1, 1.0, 0.9)).min(Vec3::ONE),
                [0.147_735_3, 0.237_356_99, 0.084_794_45, 0.124_518_82],
            ),
        ];
        let reference = blocks();
        for (change, expected) in changes {
            let changed: Vec<Vec3> = (0..reference.len()).map(|i| change(&reference, i)).collect();
            let seen = flip(&changed, &reference, 64);
            let mean = seen.iter().sum::<f32>() / seen.len() as f32;
            let found = [mean, seen.iter().copied().fold(0.0, f32::max), seen[0], seen[40 * 64 + 23]];
            let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(off < 2e-3, "{found:?} for {expected:?}");
        }
    }

    #[test]
    fn equal_pictures_have_no_difference() {
        assert!(flip(&blocks(), &blocks(), 64).iter().all(|&difference| difference == 0.0));
    }

    #[test]
    fn the_colour_map_goes_from_black_to_pale_yellow() {
        assert!(magma(0.0).max_element() < 0.01 && magma(1.0).min_element() > 0.4, "{} {}", magma(0.0), magma(1.0));
    }
}

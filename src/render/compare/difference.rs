//! Difference of two pictures as numbers that a test can bound.
//!
//! Each of the three numbers detects a different fault: the relative error finds a large error anywhere, the mean
//! difference finds a picture that is slightly too bright everywhere, and the perceptible share finds a small region
//! that is plainly wrong. FLIP estimates for each pixel the difference that an observer sees.

use std::path::Path;

use glam::Vec3;

use super::flip::flip;

use crate::base::colour::{linear_from_srgb, luminance};
use crate::render::{FileKind, Picture, RenderError};

/// Smallest CIELAB difference that an eye notices between two colours side by side (Mahy et al. 1994).
const PERCEPTIBLE_STEP: f32 = 2.3;

/// Linear pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Linear colours.
    pub pixels: Vec<Vec3>,
    /// Kind of the colours: display colours, whose white is 1, or radiance.
    pub kind: FileKind,
}

/// Difference of a picture from a reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Root mean square of the difference divided by that of the reference, in linear light over all channels.
    pub relative_rmse: f32,
    /// Mean luminance of the picture divided by that of the reference, minus one.
    pub mean_difference: f32,
    /// Share of pixels whose colour differs by more than the smallest difference that an eye notices.
    pub perceptible_share: f32,
}

impl Raster {
    /// Returns the colours of a picture as a file of `kind` would store them.
    #[must_use]
    pub fn of(picture: &Picture, kind: FileKind) -> Self {
        match kind {
            FileKind::Display => Self::displayed(picture),
            FileKind::Radiance => Self::radiance(picture),
        }
    }

    /// Returns the display colours of a picture; white is 1.
    #[must_use]
    pub fn displayed(picture: &Picture) -> Self {
        let channel = |byte: u8| linear_from_srgb(f32::from(byte) / 255.0);
        let (pixels, _) = picture.display.as_chunks::<4>();
        let pixels = pixels.iter().map(|&[r, g, b, _]| Vec3::new(channel(r), channel(g), channel(b))).collect();
        Self { size: [picture.width, picture.height], pixels, kind: FileKind::Display }
    }

    /// Returns the radiance of a picture, before exposure.
    #[must_use]
    pub fn radiance(picture: &Picture) -> Self {
        let pixels = picture.radiance.iter().map(|&[r, g, b, _]| Vec3::new(r, g, b)).collect();
        Self { size: [picture.width, picture.height], pixels, kind: FileKind::Radiance }
    }

    /// Reads a picture file.
    ///
    /// # Errors
    /// Returns an error if the file is missing, is no picture, or ends in neither `.png` nor `.exr`.
    pub fn load(path: &Path) -> Result<Self, RenderError> {
        let kind = FileKind::of(path)?;
        let image = image::open(path).map_err(|cause| RenderError::Read { path: path.to_owned(), cause })?;
        let size = [image.width(), image.height()];
        let stored = image.into_rgb32f().pixels().map(|pixel| Vec3::from(pixel.0)).collect();
        let pixels = match kind {
            FileKind::Radiance => stored,
            FileKind::Display => decoded(stored),
        };
        Ok(Self { size, pixels, kind })
    }

    /// Returns the value of white: 1 for display colours, five times the mean luminance for radiance (a usual
    /// exposure).
    fn white(&self) -> f32 {
        match self.kind {
            FileKind::Display => 1.0,
            FileKind::Radiance => {
                let mean = self.pixels.iter().map(|&pixel| luminance(pixel)).sum::<f32>() / self.pixels.len() as f32;
                (5.0 * mean).max(f32::MIN_POSITIVE)
            }
        }
    }
}

/// Decodes sRGB-encoded colours to linear ones.
fn decoded(pixels: Vec<Vec3>) -> Vec<Vec3> {
    pixels.into_iter().map(|pixel| Vec3::from(pixel.to_array().map(linear_from_srgb))).collect()
}

/// Computes the difference of `picture` from `reference`.
///
/// # Errors
/// Returns an error if the sizes differ.
pub fn compare(picture: &Raster, reference: &Raster) -> Result<Difference, RenderError> {
    check_sizes(picture, reference)?;
    let white = reference.white();
    let (mut error, mut power, mut light, mut reference_light, mut perceptible) = (0.0, 0.0, 0.0, 0.0, 0usize);
    for (&a, &b) in picture.pixels.iter().zip(&reference.pixels) {
        error += f64::from((a - b).length_squared());
        power += f64::from(b.length_squared());
        light += f64::from(luminance(a));
        reference_light += f64::from(luminance(b));
        perceptible += usize::from(is_perceptible(a, b, white));
    }
    Ok(Difference {
        relative_rmse: ratio(error, power).sqrt() as f32,
        mean_difference: ratio(light - reference_light, reference_light) as f32,
        perceptible_share: perceptible as f32 / reference.pixels.len().max(1) as f32,
    })
}

/// Computes the FLIP error of each pixel, from 0 (equal) to 1. Radiance is exposed so that five times the mean of the
/// reference is white.
///
/// # Errors
/// Returns an error if the sizes differ.
pub fn visible_difference(picture: &Raster, reference: &Raster) -> Result<Vec<f32>, RenderError> {
    check_sizes(picture, reference)?;
    let white = reference.white();
    let [shown, expected] =
        [picture, reference].map(|raster| raster.pixels.iter().map(|&pixel| pixel / white).collect::<Vec<_>>());
    Ok(flip(&shown, &expected, reference.size[0] as usize))
}

fn check_sizes(picture: &Raster, reference: &Raster) -> Result<(), RenderError> {
    if picture.size == reference.size {
        return Ok(());
    }
    Err(RenderError::SizesDiffer { a: picture.size, b: reference.size })
}

/// Returns `part / whole`; 0 / 0 is 0.
fn ratio(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

/// Returns true if the colours differ by more than the smallest difference that an eye notices, or one of them is not a
/// number.
pub fn is_perceptible(a: Vec3, b: Vec3, white: f32) -> bool {
    let distance = (lab(a / white) - lab(b / white)).length();
    distance.is_nan() || distance > PERCEPTIBLE_STEP
}

/// Returns the CIELAB values of a linear Rec. 709 colour relative to white (CIE 15).
fn lab(colour: Vec3) -> Vec3 {
    let x = colour.dot(Vec3::new(0.4124, 0.3576, 0.1805)) / 0.9505;
    let y = luminance(colour);
    let z = colour.dot(Vec3::new(0.0193, 0.1192, 0.9505)) / 1.089;
    let f = |t: f32| if t > 0.008_856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
    Vec3::new(116.0 * f(y) - 16.0, 500.0 * (f(x) - f(y)), 200.0 * (f(y) - f(z)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A smooth ramp with coloured blocks, 64 x 64.
    fn sample() -> Raster {
        let colour = |x: u32, y: u32| {
            let block =
                if (x / 8 + y / 8).is_multiple_of(2) { Vec3::new(1.0, 0.4, 0.2) } else { Vec3::new(0.3, 0.5, 1.0) };
            block * (0.1 + 0.8 * x as f32 / 63.0)
        };
        let pixels = (0..64 * 64).map(|i| colour(i % 64, i / 64)).collect();
        Raster { size: [64, 64], pixels, kind: FileKind::Display }
    }

    fn changed(change: impl Fn(usize, Vec3) -> Vec3) -> Difference {
        let reference = sample();
        let mut picture = reference.clone();
        picture.pixels = reference.pixels.iter().enumerate().map(|(i, &pixel)| change(i, pixel)).collect();
        compare(&picture, &reference).expect("same size")
    }

    #[test]
    fn a_picture_does_not_differ_from_itself() {
        let none = Difference { relative_rmse: 0.0, mean_difference: 0.0, perceptible_share: 0.0 };
        assert_eq!(changed(|_, pixel| pixel), none);
    }

    #[test]
    fn brightening_shows_in_the_mean() {
        let difference = changed(|_, pixel| pixel * 1.05);
        assert!((difference.mean_difference - 0.05).abs() < 1e-4, "{difference:?}");
        assert!((difference.relative_rmse - 0.05).abs() < 1e-4, "{difference:?}");
    }

    #[test]
    fn a_tint_is_perceived_though_the_mean_stays() {
        let difference = changed(|_, pixel| {
            let tinted = pixel * Vec3::new(1.1, 1.0, 0.9);
            tinted * (luminance(pixel) / luminance(tinted))
        });
        assert!(difference.mean_difference.abs() < 1e-4, "{difference:?}");
        assert!(difference.perceptible_share > 0.8, "{difference:?}");
    }

    #[test]
    fn a_shift_by_one_pixel_is_perceived_at_the_edges() {
        let reference = sample();
        let difference = changed(|i, _| reference.pixels[if i % 64 == 0 { i } else { i - 1 }]);
        assert!(difference.perceptible_share > 0.1 && difference.relative_rmse > 0.1, "{difference:?}");
    }

    #[test]
    fn each_pixel_of_a_wrong_region_is_counted() {
        let difference = changed(|i, pixel| if i % 64 < 8 && i / 64 < 8 { Vec3::ZERO } else { pixel });
        assert_eq!(difference.perceptible_share, 64.0 / 4096.0);
        assert!(difference.relative_rmse < 0.1, "{difference:?}");
    }

    #[test]
    fn invisible_noise_is_not_perceived() {
        let difference = changed(|i, pixel| pixel + Vec3::splat(if i % 2 == 0 { 5e-4 } else { -5e-4 }));
        assert_eq!(difference.perceptible_share, 0.0);
    }

    #[test]
    fn a_value_that_is_not_a_number_is_always_a_difference() {
        let difference = changed(|i, pixel| if i == 7 { Vec3::NAN } else { pixel });
        assert!(difference.perceptible_share > 0.0 && difference.relative_rmse.is_nan());
    }

    #[test]
    fn pictures_of_different_sizes_are_refused() {
        let small = Raster { size: [32, 128], ..sample() };
        assert!(matches!(compare(&small, &sample()), Err(RenderError::SizesDiffer { .. })));
    }
}

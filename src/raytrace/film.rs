//! A picture that samples are added to, tile by tile on all cores, pass by pass.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{Vec2, Vec3, Vec4};
use rayon::prelude::*;

use crate::base::colour::luminance;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::hash;
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::scene::{Camera, Projection};

/// Width and height of a tile, in pixels.
const TILE: u32 = 16;

/// A traced picture, row by row from the top, to which samples can be added.
///
/// Passes add up: one pass of 16 samples gives the same picture as four passes of 4.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    size: [u32; 2],
    samples: u32,
    /// Sums of radiance and coverage `[pixel][half]`. Samples with even and with odd numbers are independent, so the
    /// difference of their means gives the error of the whole.
    sums: Vec<[Vec4; 2]>,
}

/// Sums that a pass adds to pixels, with the numbers of the pixels.
type Tile = Vec<(u32, [Vec4; 2])>;

/// Standard errors of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmNoise {
    /// Root mean square of the pixels' standard errors over that of the picture.
    pub pixel: f32,
    /// Standard error of the mean luminance over the mean luminance.
    pub mean: f32,
}

impl Film {
    /// Returns a picture of `size` pixels without samples.
    #[must_use]
    pub fn new(size: [u32; 2]) -> Self {
        Self { size, samples: 0, sums: vec![[Vec4::ZERO; 2]; size[0] as usize * size[1] as usize] }
    }

    /// Width and height, pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Number of rays a pixel so far.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Linear radiance before exposure, premultiplied by the fourth channel, which is the share of the pixel that is
    /// covered. All values are 0 without samples.
    #[must_use]
    pub fn radiance(&self) -> Vec<[f32; 4]> {
        let count = self.samples.max(1) as f32;
        self.sums.iter().map(|[even, odd]| ((*even + *odd) / count).to_array()).collect()
    }

    /// Adds `samples` rays a pixel through a box filter. If it is cancelled, the picture stays unchanged and the result
    /// is false.
    ///
    /// `radiance` returns the radiance along a camera ray, or `None` if the ray leaves the scene.
    pub(crate) fn refine(
        &mut self,
        camera: &Camera,
        samples: u32,
        seed: u32,
        progress: &dyn Progress,
        radiance: impl Fn(Ray, &mut Sampler) -> Option<Vec3> + Sync,
    ) -> bool {
        let view = RaySetup::new(camera, self.size);
        let numbers = self.samples..self.samples + samples;
        let tiles = [self.size[0].div_ceil(TILE), self.size[1].div_ceil(TILE)];
        let num_tiles = tiles[0] * tiles[1];
        let num_done = AtomicUsize::new(0);
        let traced: Option<Vec<Tile>> = (0..num_tiles)
            .into_par_iter()
            .map(|tile| {
                progress.rest();
                let [left, top] = [TILE * (tile % tiles[0]), TILE * (tile / tiles[0])];
                let columns = left..(left + TILE).min(self.size[0]);
                let pixels = (top..(top + TILE).min(self.size[1])).flat_map(|y| columns.clone().map(move |x| [x, y]));
                let pixel = |[x, y]: [u32; 2]| {
                    let number = y * self.size[0] + x;
                    let seen = || sums(&view, [x, y], numbers.clone(), hash(seed) ^ number, &radiance);
                    (!progress.is_cancelled()).then(|| (number, seen()))
                };
                let pixels = pixels.map(pixel).collect();
                let num_done = num_done.fetch_add(1, Ordering::Relaxed) + 1;
                progress.report(Stage::Trace, num_done as f32 / num_tiles as f32);
                pixels
            })
            .collect();
        let Some(traced) = traced else { return false };
        for (number, [even, odd]) in traced.into_iter().flatten() {
            let sums = &mut self.sums[number as usize];
            *sums = [sums[0] + even, sums[1] + odd];
        }
        self.samples += samples;
        true
    }

    /// Squared standard error of a pixel's luminance; 0 with a single sample.
    ///
    /// Equation: the mean of two independent halves a and b has the variance (a - b)^2 / 4.
    fn variance(&self, [even, odd]: &[Vec4; 2]) -> f32 {
        if self.samples < 2 {
            return 0.0;
        }
        let counts = [self.samples.div_ceil(2), self.samples / 2].map(|count| count as f32);
        let apart = *even / counts[0] - *odd / counts[1];
        0.25 * luminance(apart.truncate()).powi(2)
    }

    /// Standard errors of the picture, relative to its luminance; 0 if it is dark.
    #[must_use]
    pub fn noise(&self) -> FilmNoise {
        let luminances = self.radiance().into_iter().map(|[r, g, b, _]| f64::from(luminance(Vec3::new(r, g, b))));
        let (sum, power) = luminances.fold((0.0, 0.0), |(sum, power), y| (sum + y, power + y * y));
        let variance: f64 = self.sums.iter().map(|sums| f64::from(self.variance(sums))).sum();
        let ratio = |error: f64, whole: f64| if whole > 0.0 { (error / whole) as f32 } else { 0.0 };
        FilmNoise { pixel: ratio(variance.sqrt(), power.sqrt()), mean: ratio(variance.sqrt(), sum) }
    }
}

/// Sums over the even and over the odd samples of one pixel.
fn sums(
    view: &RaySetup<'_>,
    pixel: [u32; 2],
    samples: std::ops::Range<u32>,
    seed: u32,
    radiance: &impl Fn(Ray, &mut Sampler) -> Option<Vec3>,
) -> [Vec4; 2] {
    let mut sums = [Vec4::ZERO; 2];
    for sample in samples {
        let half = sample % 2;
        let mut sampler = Sampler::new(seed ^ (half << 31), sample / 2);
        let ray = view.ray(pixel, sampler.square());
        if let Some(found) = radiance(ray, &mut sampler) {
            sums[half as usize] += found.extend(1.0);
        }
    }
    sums
}

/// The camera rays of a picture.
struct RaySetup<'a> {
    camera: &'a Camera,
    size: Vec2,
}

impl<'a> RaySetup<'a> {
    fn new(camera: &'a Camera, size: [u32; 2]) -> Self {
        Self { camera, size: Vec2::new(size[0] as f32, size[1] as f32) }
    }

    /// Returns the ray through a point of a pixel, given as a point of the unit square.
    fn ray(&self, pixel: [u32; 2], square: Vec2) -> Ray {
        let at = (Vec2::new(pixel[0] as f32, pixel[1] as f32) + square) / self.size;
        let on_screen = Vec2::new((2.0 * at.x - 1.0) * self.size.x / self.size.y, 1.0 - 2.0 * at.y);
        let camera = self.camera;
        let (origin, direction) = match camera.projection {
            Projection::Perspective { fov_y } => {
                let on_plane = on_screen * (0.5 * fov_y).tan();
                (camera.position, (camera.world_from_view * on_plane.extend(-1.0)).normalize())
            }
            Projection::Orthographic { half_height } => {
                let aside = camera.world_from_view * (on_screen * half_height).extend(0.0);
                (camera.position + aside, camera.forward())
            }
        };
        Ray { origin, direction, source: RaySource::Camera }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::progress::{Cancel, Unwatched};

    fn camera() -> Camera {
        Camera::looking_at("test", Vec3::ZERO, Vec3::NEG_Z, std::f32::consts::FRAC_PI_2)
    }

    fn film(
        size: [u32; 2],
        passes: &[u32],
        seed: u32,
        radiance: impl Fn(Ray, &mut Sampler) -> Option<Vec3> + Sync,
    ) -> Film {
        let mut film = Film::new(size);
        for &samples in passes {
            assert!(film.refine(&camera(), samples, seed, &Unwatched, &radiance));
        }
        film
    }

    #[test]
    fn rays_go_through_their_pixels() {
        let camera = camera();
        let view = RaySetup::new(&camera, [4, 2]);
        let corner = view.ray([0, 0], Vec2::ZERO).direction;
        assert!((corner / -corner.z - Vec3::new(-2.0, 1.0, -1.0)).length() < 1e-5, "{corner}");
        let other = view.ray([3, 1], Vec2::ONE).direction;
        assert!((other / -other.z - Vec3::new(2.0, -1.0, -1.0)).length() < 1e-5, "{other}");
    }

    #[test]
    fn the_stated_error_is_the_true_one() {
        // Two equally likely values have a standard deviation of half their distance.
        let samples = 64;
        let coin = |_, sampler: &mut Sampler| Some(Vec3::splat(2.0 * (sampler.bits() % 2) as f32));
        let film = film([64, 64], &[samples], 1, coin);
        let expected = 1.0 / samples as f32;
        let variance = film.sums.iter().map(|sums| film.variance(sums)).sum::<f32>() / film.sums.len() as f32;
        assert!((variance / expected - 1.0).abs() < 0.1, "{variance} for {expected}");
        let noise = film.noise();
        assert!((noise.mean * 64.0 / expected.sqrt() - 1.0).abs() < 0.1, "{noise:?}");
    }

    #[test]
    fn equal_seeds_give_equal_pictures_and_different_seeds_different_ones() {
        let random = |_, sampler: &mut Sampler| Some(Vec3::splat(sampler.number()));
        let film = |seed| film([40, 20], &[3], seed, random);
        assert_eq!(film(1), film(1));
        assert_ne!(film(1), film(2));
    }

    #[test]
    fn several_passes_equal_one_pass_of_all_samples() {
        // Sums of whole numbers are exact in any order.
        let random = |_, sampler: &mut Sampler| Some(Vec3::splat((sampler.bits() % 64) as f32));
        assert_eq!(film([20, 10], &[1, 3, 2], 5, random), film([20, 10], &[6], 5, random));
    }

    #[test]
    fn rays_that_leave_the_scene_cover_nothing() {
        let film = film([4, 2], &[8], 0, |ray, _| (ray.direction.x > 0.0).then_some(Vec3::ONE));
        assert_eq!((film.radiance()[0], film.radiance()[3]), ([0.0; 4], [1.0; 4]));
    }

    #[test]
    fn a_cancelled_pass_leaves_the_picture_as_it_was() {
        struct Stopped(Cancel);
        impl Progress for Stopped {
            fn report(&self, _: Stage, _: f32) {}
            fn is_cancelled(&self) -> bool {
                self.0.is_cancelled()
            }
        }
        let (stopped, mut picture) = (Stopped(Cancel::default()), film([4, 2], &[2], 0, |_, _| Some(Vec3::ONE)));
        let before = picture.clone();
        stopped.0.cancel();
        assert!(!picture.refine(&camera(), 2, 0, &stopped, |_, _| Some(Vec3::ONE)));
        assert_eq!(picture, before);
    }
}

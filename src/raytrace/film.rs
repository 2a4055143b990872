//! The picture that rays add up to, tile by tile on all cores.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::path::{Chance, Ray};
use super::sampler::Sampler;
use crate::base::colour::luminance;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::hash;
use crate::scene::{Camera, Projection};

/// Pixels that one core takes at a time, across and down.
const TILE: u32 = 16;

/// A traced picture, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Linear radiance before exposure, premultiplied by the fourth channel, the share of the pixel that is covered.
    pub radiance: Vec<[f32; 4]>,
    /// Squared standard error of each pixel's luminance; 0 with a single sample.
    pub variance: Vec<f32>,
}

/// How well a picture is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmNoise {
    /// Root mean square of the pixels' standard errors over that of the picture.
    pub pixel: f32,
    /// Standard error of the mean luminance over the mean luminance.
    pub mean: f32,
}

impl Film {
    /// Traces `samples` rays a pixel through a box filter. What `radiance` finds along a ray from the eye is averaged; none
    /// is the open. Pixels that were not reached when the work was cancelled are empty.
    pub(super) fn trace(
        camera: &Camera,
        size: [u32; 2],
        samples: u32,
        seed: u32,
        progress: &dyn Progress,
        radiance: impl Fn(Ray, &mut Sampler) -> Option<Vec3> + Sync,
    ) -> Self {
        let eye = Eye::new(camera, size);
        let tiles = [size[0].div_ceil(TILE), size[1].div_ceil(TILE)];
        let num_tiles = tiles[0] * tiles[1];
        let num_done = AtomicUsize::new(0);
        let traced: Vec<Vec<(u32, Pixel)>> = (0..num_tiles)
            .into_par_iter()
            .map(|tile| {
                progress.rest();
                let [left, top] = [TILE * (tile % tiles[0]), TILE * (tile / tiles[0])];
                let columns = left..(left + TILE).min(size[0]);
                let pixels = (top..(top + TILE).min(size[1])).flat_map(|y| columns.clone().map(move |x| [x, y]));
                let pixels = pixels.take_while(|_| !progress.is_cancelled());
                let pixel = |[x, y]: [u32; 2]| {
                    let number = y * size[0] + x;
                    (number, Pixel::trace(&eye, [x, y], samples, hash(seed) ^ number, &radiance))
                };
                let pixels = pixels.map(pixel).collect();
                let num_done = num_done.fetch_add(1, Ordering::Relaxed) + 1;
                progress.report(Stage::Trace, num_done as f32 / num_tiles as f32);
                pixels
            })
            .collect();
        let mut film = Self::empty(size);
        for (number, pixel) in traced.into_iter().flatten() {
            film.radiance[number as usize] = pixel.radiance;
            film.variance[number as usize] = pixel.variance;
        }
        film
    }

    fn empty(size: [u32; 2]) -> Self {
        let num_pixels = size[0] as usize * size[1] as usize;
        Self { size, radiance: vec![[0.0; 4]; num_pixels], variance: vec![0.0; num_pixels] }
    }

    /// How well the picture is known; 0 where it is dark.
    #[must_use]
    pub fn noise(&self) -> FilmNoise {
        let luminances = self.radiance.iter().map(|&[r, g, b, _]| f64::from(luminance(Vec3::new(r, g, b))));
        let (sum, power) = luminances.fold((0.0, 0.0), |(sum, power), y| (sum + y, power + y * y));
        let variance: f64 = self.variance.iter().map(|&variance| f64::from(variance)).sum();
        let ratio = |error: f64, whole: f64| if whole > 0.0 { (error / whole) as f32 } else { 0.0 };
        FilmNoise { pixel: ratio(variance.sqrt(), power.sqrt()), mean: ratio(variance.sqrt(), sum) }
    }
}

/// One pixel of a [`Film`].
struct Pixel {
    radiance: [f32; 4],
    variance: f32,
}

impl Pixel {
    /// Two halves with independent samples: how far they are apart tells the error of their mean.
    fn trace(
        eye: &Eye<'_>,
        pixel: [u32; 2],
        samples: u32,
        seed: u32,
        radiance: &impl Fn(Ray, &mut Sampler) -> Option<Vec3>,
    ) -> Self {
        let half = |number: u32, count: u32| {
            let (mut sum, mut covered) = (Vec3::ZERO, 0.0);
            for index in 0..count {
                let mut sampler = Sampler::new(seed ^ (number << 31), index);
                let ray = eye.ray(pixel, sampler.square());
                if let Some(found) = radiance(ray, &mut sampler) {
                    sum += found;
                    covered += 1.0;
                }
            }
            sum.extend(covered)
        };
        let counts = [samples.div_ceil(2), samples / 2];
        let [first, second] = [half(0, counts[0]), half(1, counts[1])];
        let mean = (first + second) / samples as f32;
        let variance = if counts[1] == 0 {
            0.0
        } else {
            let apart = first / counts[0] as f32 - second / counts[1] as f32;
            0.25 * luminance(apart.truncate()).powi(2)
        };
        Self { radiance: mean.to_array(), variance }
    }
}

/// Where rays through pixels come from.
struct Eye<'a> {
    camera: &'a Camera,
    size: Vec2,
}

impl<'a> Eye<'a> {
    fn new(camera: &'a Camera, size: [u32; 2]) -> Self {
        Self { camera, size: Vec2::new(size[0] as f32, size[1] as f32) }
    }

    /// The ray through a point of a pixel, given as a point of the unit square.
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
        Ray { origin, direction, chance: Chance::Eye }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::progress::{Cancel, Unwatched};

    fn camera() -> Camera {
        Camera::looking_at("test", Vec3::ZERO, Vec3::NEG_Z, std::f32::consts::FRAC_PI_2)
    }

    #[test]
    fn rays_go_through_their_pixels() {
        let camera = camera();
        let eye = Eye::new(&camera, [4, 2]);
        let corner = eye.ray([0, 0], Vec2::ZERO).direction;
        assert!((corner / -corner.z - Vec3::new(-2.0, 1.0, -1.0)).length() < 1e-5, "{corner}");
        let other = eye.ray([3, 1], Vec2::ONE).direction;
        assert!((other / -other.z - Vec3::new(2.0, -1.0, -1.0)).length() < 1e-5, "{other}");
    }

    #[test]
    fn the_stated_error_is_the_true_one() {
        // Two values as likely as each other scatter by half their distance.
        let samples = 64;
        let coin = |_, sampler: &mut Sampler| Some(Vec3::splat(2.0 * (sampler.bits() % 2) as f32));
        let film = Film::trace(&camera(), [64, 64], samples, 1, &Unwatched, coin);
        let expected = 1.0 / samples as f32;
        let variance = film.variance.iter().sum::<f32>() / film.variance.len() as f32;
        assert!((variance / expected - 1.0).abs() < 0.1, "{variance} for {expected}");
        let noise = film.noise();
        assert!((noise.mean * 64.0 / expected.sqrt() - 1.0).abs() < 0.1, "{noise:?}");
    }

    #[test]
    fn a_seed_gives_the_same_picture_each_time_and_another_one_another() {
        let random = |_, sampler: &mut Sampler| Some(Vec3::splat(sampler.number()));
        let film = |seed| Film::trace(&camera(), [40, 20], 3, seed, &Unwatched, random);
        assert_eq!(film(1), film(1));
        assert_ne!(film(1), film(2));
    }

    #[test]
    fn what_is_open_is_not_covered_and_a_cancelled_picture_is_empty() {
        let film =
            Film::trace(&camera(), [4, 2], 8, 0, &Unwatched, |ray, _| (ray.direction.x > 0.0).then_some(Vec3::ONE));
        assert_eq!((film.radiance[0], film.radiance[3]), ([0.0; 4], [1.0; 4]));
        struct Stopped(Cancel);
        impl Progress for Stopped {
            fn report(&self, _: Stage, _: f32) {}
            fn is_cancelled(&self) -> bool {
                self.0.is_cancelled()
            }
        }
        let stopped = Stopped(Cancel::default());
        stopped.0.cancel();
        assert_eq!(Film::trace(&camera(), [4, 2], 8, 0, &stopped, |_, _| Some(Vec3::ONE)), Film::empty([4, 2]));
    }
}

//! The lights of a scene as rays see them: emissive triangles to aim at, and punctual lights.

use std::f32::consts::PI;

use glam::Vec3;

use super::light_bounds::LightBounds;
use super::light_tree::LightTree;
use super::sampler::Sampler;
use crate::base::colour::luminance;
use crate::base::ids::TriangleId;
use crate::base::sampling::{cosine_hemisphere, r2, triangle_from_square};
use crate::base::triangle::interpolate;
use crate::scene::{Arrival, Scene, area_of, normal_of};

/// Places of a triangle at which the texture of its glow is looked up to guess its power.
const NUM_POWER_SAMPLES: u32 = 32;

/// All lights of a scene.
pub(super) struct Lights<'a> {
    scene: &'a Scene,
    emitters: Vec<Emitter>,
    tree: LightTree,
    /// Luminous powers over pi `[e]`, each with those before it.
    power_until: Vec<f32>,
    /// Emitter `[t]` that a triangle is, or [`NO_EMITTER`].
    emitter_of: Vec<u32>,
}

const NO_EMITTER: u32 = u32::MAX;

struct Emitter {
    triangle: TriangleId,
    corners: [Vec3; 3],
    normal: Vec3,
    area: f32,
    is_two_sided: bool,
}

/// Light that leaves an emissive triangle.
pub(super) struct Emission {
    pub point: Vec3,
    /// Unit normal of the side that it leaves.
    pub normal: Vec3,
    /// Unit vector.
    pub direction: Vec3,
    /// Luminous flux per channel, if this were all the light there is.
    pub flux: Vec3,
}

/// A point on an emissive triangle, as seen from a place.
pub(super) struct EmitterSample {
    /// The point.
    pub point: Vec3,
    /// Unit normal of the side that is seen.
    pub normal: Vec3,
    /// Unit vector from the place to the point.
    pub direction: Vec3,
    /// Emitted radiance towards the place, as far as it is opaque.
    pub radiance: Vec3,
    /// Probability density of the direction, per steradian.
    pub density: f32,
}

impl<'a> Lights<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        let candidates = (0..scene.triangles.len()).map(TriangleId::new);
        let shining = candidates.filter(|&t| !scene.triangles[t.index()].is_back_side);
        let (mut emitters, mut bounds, mut power_until) = (Vec::new(), Vec::new(), Vec::new());
        let mut whole = 0.0;
        let mut emitter_of = vec![NO_EMITTER; scene.triangles.len()];
        for triangle in shining.filter(|&t| scene.material_of(t).is_emissive()) {
            let radiance = mean_radiance(scene, triangle);
            if radiance <= 0.0 {
                continue;
            }
            let corners = scene.corners(triangle);
            let (area, normal) = (area_of(corners), normal_of(corners));
            let is_two_sided = scene.material_of(triangle).double_sided;
            emitter_of[triangle.index()] = emitters.len() as u32;
            whole += radiance * area * if is_two_sided { 2.0 } else { 1.0 };
            power_until.push(whole);
            bounds.push(LightBounds::of_triangle(corners, normal, radiance * area, is_two_sided));
            emitters.push(Emitter { triangle, corners, normal, area, is_two_sided });
        }
        Self { scene, tree: LightTree::new(&bounds), power_until, emitters, emitter_of }
    }

    /// A point on one of the emissive triangles, those that bring most light being the likeliest; none where it does not
    /// face the place.
    pub(super) fn sample_emitter(&self, place: Vec3, normal: Vec3, sampler: &mut Sampler) -> Option<EmitterSample> {
        let (number, square) = (sampler.number(), sampler.square());
        let (chosen, probability) = self.tree.choose(place, normal, number)?;
        let emitter = &self.emitters[chosen];
        let weights = triangle_from_square(square);
        let [a, b, c] = emitter.corners;
        let point = interpolate([a, b, c], weights);
        let offset = point - place;
        let direction = offset.normalize_or_zero();
        let cosine = emitter.cosine(-direction);
        if cosine <= 0.0 || normal.dot(direction) <= 0.0 {
            return None;
        }
        let surface = self.scene.surface_at(emitter.triangle, weights);
        Some(EmitterSample {
            point,
            normal: if emitter.normal.dot(direction) < 0.0 { emitter.normal } else { -emitter.normal },
            direction,
            radiance: surface.emission * surface.opacity,
            density: probability * offset.length_squared() / (emitter.area * cosine),
        })
    }

    /// Light that leaves one of the emissive triangles, the mightiest being the likeliest; none where nothing emits.
    pub(super) fn emit(&self, sampler: &mut Sampler) -> Option<Emission> {
        let whole = *self.power_until.last()?;
        let number = sampler.number() * whole;
        let chosen = self.power_until.partition_point(|&power| power <= number).min(self.emitters.len() - 1);
        let emitter = &self.emitters[chosen];
        let power = self.power_until[chosen] - chosen.checked_sub(1).map_or(0.0, |before| self.power_until[before]);
        let weights = triangle_from_square(sampler.square());
        let [a, b, c] = emitter.corners;
        let num_sides = if emitter.is_two_sided { 2.0 } else { 1.0 };
        let is_back = emitter.is_two_sided && sampler.number() < 0.5;
        let normal = if is_back { -emitter.normal } else { emitter.normal };
        let surface = self.scene.surface_at(emitter.triangle, weights);
        Some(Emission {
            point: interpolate([a, b, c], weights),
            normal,
            direction: cosine_hemisphere(normal, sampler.square()),
            flux: surface.emission * (surface.opacity * PI * emitter.area * num_sides * whole / power),
        })
    }

    /// Density per steradian with which [`Self::sample_emitter`] would have taken a direction from `place` that meets
    /// `triangle` at `distance`.
    pub(super) fn density(
        &self,
        place: Vec3,
        normal: Vec3,
        direction: Vec3,
        triangle: TriangleId,
        distance: f32,
    ) -> f32 {
        let Some(emitter) = self.emitters.get(self.emitter_of[triangle.index()] as usize) else {
            return 0.0;
        };
        let number = self.emitter_of[triangle.index()] as usize;
        let cosine = emitter.cosine(-direction);
        if cosine <= 0.0 {
            return 0.0;
        }
        self.tree.probability(number, place, normal) * distance * distance / (emitter.area * cosine)
    }

    /// One of the punctual lights (its number and what it would bring if nothing stood between), chosen by what it brings,
    /// and the probability of the choice.
    pub(super) fn choose_punctual(
        &self,
        place: Vec3,
        normal: Vec3,
        sampler: &mut Sampler,
    ) -> Option<(usize, Arrival, f32)> {
        let mut number = sampler.number();
        let mut chosen = None;
        let mut whole = 0.0;
        // Weighted reservoir of one; the number is stretched again after each decision.
        for (light, arrival) in self.punctual(place).enumerate() {
            let weight = weight(&arrival, normal);
            if weight <= 0.0 {
                continue;
            }
            whole += weight;
            let share = weight / whole;
            if number < share {
                (chosen, number) = (Some((light, arrival, weight)), number / share);
            } else {
                number = (number - share) / (1.0 - share);
            }
        }
        chosen.map(|(light, arrival, weight)| (light, arrival, weight / whole))
    }

    /// The probability with which [`Self::choose_punctual`] would choose `light`.
    pub(super) fn punctual_probability(&self, light: usize, place: Vec3, normal: Vec3) -> f32 {
        let weights = || self.punctual(place).map(|arrival| weight(&arrival, normal));
        weights().nth(light).map_or(0.0, |weight| weight / weights().sum::<f32>().max(f32::MIN_POSITIVE))
    }

    /// What all punctual lights would bring if nothing stood between.
    pub(super) fn punctual(&self, place: Vec3) -> impl Iterator<Item = Arrival> {
        self.scene.lights.iter().map(move |light| light.arrival(place))
    }

    /// Something emits.
    pub(super) fn has_emitters(&self) -> bool {
        !self.emitters.is_empty()
    }

    /// There is a punctual light.
    pub(super) fn has_punctual(&self) -> bool {
        !self.scene.lights.is_empty()
    }
}

impl Emitter {
    /// Cosine to the emitting side's normal of a unit vector away from the triangle; 0 where nothing is emitted.
    fn cosine(&self, away: Vec3) -> f32 {
        let cosine = self.normal.dot(away);
        if self.is_two_sided { cosine.abs() } else { cosine.max(0.0) }
    }
}

/// Luminance that arrives on a surface.
fn weight(arrival: &Arrival, normal: Vec3) -> f32 {
    luminance(arrival.irradiance) * normal.dot(arrival.to_light).max(0.0)
}

/// Mean luminance that a triangle emits.
fn mean_radiance(scene: &Scene, triangle: TriangleId) -> f32 {
    let count = if scene.material_of(triangle).emissive_texture.is_some() { NUM_POWER_SAMPLES } else { 1 };
    let at = |i| luminance(scene.surface_at(triangle, triangle_from_square(r2(i, triangle.0))).emission);
    (0..count).map(at).sum::<f32>() / count as f32
}

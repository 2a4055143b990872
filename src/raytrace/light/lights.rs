//! The lights of a scene: emissive triangles, sampled by points on them, and punctual lights.

use std::f32::consts::PI;

use glam::Vec3;

use crate::base::colour::luminance;
use crate::base::ids::TriangleId;
use crate::base::sampling::{cosine_hemisphere, r2, triangle_from_square};
use crate::base::triangle::interpolate;
use crate::raytrace::light::light_bounds::LightBounds;
use crate::raytrace::light::light_tree::LightTree;
use crate::raytrace::sampler::Sampler;
use crate::scene::{Arrival, Scene, area_of, normal_of};

/// Points of a triangle at which the emissive texture is sampled to estimate its power.
const NUM_POWER_SAMPLES: u32 = 32;

/// All lights of a scene.
pub(crate) struct Lights<'a> {
    scene: &'a Scene,
    emitters: Vec<Emitter>,
    tree: LightTree,
    /// Running sum of luminous power / pi `[e]`.
    power_until: Vec<f32>,
    /// Number of the emitter of each triangle `[t]`, or [`NO_EMITTER`].
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
pub(crate) struct Emission {
    pub point: Vec3,
    /// Unit normal of the side that it leaves.
    pub normal: Vec3,
    /// Unit vector in which the light leaves.
    pub direction: Vec3,
    /// Flux per channel of all emitters, estimated by this sample.
    pub flux: Vec3,
}

/// A point on an emissive triangle, as seen from another point.
pub(crate) struct EmitterSample {
    /// Point on the triangle.
    pub point: Vec3,
    /// Unit normal of the visible side.
    pub normal: Vec3,
    /// Unit vector towards the triangle.
    pub direction: Vec3,
    /// Emitted radiance x opacity.
    pub radiance: Vec3,
    /// Probability density of the direction, per steradian.
    pub density: f32,
}

impl<'a> Lights<'a> {
    pub(crate) fn new(scene: &'a Scene) -> Self {
        let (mut emitters, mut bounds, mut power_until) = (Vec::new(), Vec::new(), Vec::new());
        let mut whole = 0.0;
        let mut emitter_of = vec![NO_EMITTER; scene.triangles.len()];
        for triangle in scene.fronts().filter(|&t| scene.material_of(t).is_emissive()) {
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

    /// Samples a point on an emissive triangle, chosen by the light that it may send to `place`. Returns `None` if the
    /// point does not face the place.
    ///
    /// The density per steradian is p = P d^2 / (A cos), with the probability P of the triangle, its area A, the
    /// distance d and the cosine at the triangle.
    pub(crate) fn sample_emitter(&self, place: Vec3, normal: Vec3, sampler: &mut Sampler) -> Option<EmitterSample> {
        let (number, square) = (sampler.number(), sampler.square());
        let (chosen, probability) = self.tree.choose(place, normal, number)?;
        let emitter = &self.emitters[chosen];
        let weights = triangle_from_square(square);
        let point = interpolate(emitter.corners, weights);
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

    /// Samples light that leaves an emissive triangle, chosen by power. Returns `None` if nothing emits.
    pub(crate) fn emit(&self, sampler: &mut Sampler) -> Option<Emission> {
        let whole = *self.power_until.last()?;
        let number = sampler.number() * whole;
        let chosen = self.power_until.partition_point(|&power| power <= number).min(self.emitters.len() - 1);
        let emitter = &self.emitters[chosen];
        let power = self.power_until[chosen] - chosen.checked_sub(1).map_or(0.0, |before| self.power_until[before]);
        let weights = triangle_from_square(sampler.square());
        let num_sides = if emitter.is_two_sided { 2.0 } else { 1.0 };
        let is_back = emitter.is_two_sided && sampler.number() < 0.5;
        let normal = if is_back { -emitter.normal } else { emitter.normal };
        let surface = self.scene.surface_at(emitter.triangle, weights);
        Some(Emission {
            point: interpolate(emitter.corners, weights),
            normal,
            direction: cosine_hemisphere(normal, sampler.square()),
            flux: surface.emission * (surface.opacity * PI * emitter.area * num_sides * whole / power),
        })
    }

    /// Returns the density per steradian with which [`Self::sample_emitter`] chooses a direction from `place` that hits
    /// `triangle` at `distance`.
    pub(crate) fn density(
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

    /// Chooses a punctual light by its unoccluded irradiance, and returns its number, its light at `place` and the
    /// probability of the choice.
    pub(crate) fn choose_punctual(
        &self,
        place: Vec3,
        normal: Vec3,
        sampler: &mut Sampler,
    ) -> Option<(usize, Arrival, f32)> {
        let mut number = sampler.number();
        let mut chosen = None;
        let mut whole = 0.0;
        // Weighted reservoir sampling of one light; the random number is rescaled to 0..1 after each decision.
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

    /// Returns the probability with which [`Self::choose_punctual`] chooses `light`.
    pub(crate) fn punctual_probability(&self, light: usize, place: Vec3, normal: Vec3) -> f32 {
        let weights = || self.punctual(place).map(|arrival| weight(&arrival, normal));
        weights().nth(light).map_or(0.0, |weight| weight / weights().sum::<f32>().max(f32::MIN_POSITIVE))
    }

    /// Returns the unoccluded light of all punctual lights at a point.
    pub(crate) fn punctual(&self, place: Vec3) -> impl Iterator<Item = Arrival> {
        self.scene.lights.iter().map(move |light| light.arrival(place))
    }

    /// Returns true if there is an emissive triangle.
    pub(crate) fn has_emitters(&self) -> bool {
        !self.emitters.is_empty()
    }

    /// Returns true if there is a punctual light.
    pub(crate) fn has_punctual(&self) -> bool {
        !self.scene.lights.is_empty()
    }
}

impl Emitter {
    /// Returns the cosine between a unit vector away from the triangle and the normal of the emitting side, or 0 on a
    /// side that does not emit.
    fn cosine(&self, away: Vec3) -> f32 {
        let cosine = self.normal.dot(away);
        if self.is_two_sided { cosine.abs() } else { cosine.max(0.0) }
    }
}

/// Illuminance on a surface.
fn weight(arrival: &Arrival, normal: Vec3) -> f32 {
    luminance(arrival.irradiance) * normal.dot(arrival.to_light).max(0.0)
}

/// Mean emitted luminance of a triangle.
fn mean_radiance(scene: &Scene, triangle: TriangleId) -> f32 {
    let count = if scene.material_of(triangle).emissive_texture.is_some() { NUM_POWER_SAMPLES } else { 1 };
    let at = |i| luminance(scene.surface_at(triangle, triangle_from_square(r2(i, triangle.0))).emission);
    (0..count).map(at).sum::<f32>() / count as f32
}

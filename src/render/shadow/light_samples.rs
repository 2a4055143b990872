//! The lights of a scene as points and directions, each with one hard shadow.
//!
//! A punctual light is one sample, or many on a small ball round its place. An emissive surface is many: stratified over its area, each shines as the cosine to
//! its normal with the surface's exitance times its share of the area, so that their sum tends to the irradiance that
//! the bake finds in closed form.

use std::collections::{BTreeMap, HashMap};

use glam::{Vec2, Vec3, Vec4};

use crate::base::ids::{GroupId, TriangleId};
use crate::base::sampling::triangle_from_square;
use crate::base::triangle::interpolate;
use crate::scene::{Light, LightKind, Scene, area_of, normal_of};

/// Pieces of one surface closer than this share of the scene's extent shine as one lamp, as in the bake.
const PLACE_SHARE: f32 = 0.1;
/// Height of a sample above its surface, as a share of the scene's extent: the surface must not shade itself.
const HEIGHT: f32 = 2e-5;
/// Step of the second coordinate from sample to sample: the golden ratio spreads any number of them evenly.
const GOLDEN: f32 = 0.618_034;
/// `GRAZING_COSINE` of shaders/shared/light_sample.wgsl.
pub const GRAZING_COSINE: f32 = 1e-4;

/// One point or direction from which light comes.
#[derive(Clone, Debug, PartialEq)]
pub struct LightSample {
    /// Where it is and how strong; for a sample of a surface a point light along the normal.
    pub light: Light,
    /// Normal of the emissive surface it stands for: it shines on that side as the cosine.
    pub surface_normal: Option<Vec3>,
    /// Which lamp of the scene it belongs to: punctual lights first, then emissive surfaces.
    pub lamp: usize,
}

impl LightSample {
    /// Homogeneous place: a position with w = 1, or the direction towards the light with w = 0.
    #[must_use]
    pub fn place(&self) -> Vec4 {
        match self.light.kind {
            LightKind::Point { position } | LightKind::Spot { position, .. } => position.extend(1.0),
            LightKind::Directional { direction } => (-direction).extend(0.0),
        }
    }

    /// Irradiance on a surface at `point` with unit normal `normal` where nothing stands between, lux per channel.
    #[must_use]
    pub fn irradiance(&self, point: Vec3, normal: Vec3) -> Vec3 {
        let arrival = self.light.arrival(point);
        let cosine = normal.dot(arrival.to_light);
        let emitted = self.surface_normal.map_or(1.0, |axis| axis.dot(-arrival.to_light));
        if cosine <= GRAZING_COSINE || emitted <= GRAZING_COSINE {
            return Vec3::ZERO;
        }
        arrival.irradiance * (cosine * emitted)
    }
}

/// All light samples of a scene: `per_lamp` for each emissive surface, and for each punctual light where it has a
/// `radius` in metres, else one. Directional lights are infinitely far and stay one.
#[must_use]
pub fn light_samples(scene: &Scene, per_lamp: u32, radius: f32) -> Vec<LightSample> {
    let mut samples = Vec::new();
    for (lamp, light) in scene.lights.iter().enumerate() {
        add_punctual(light, lamp, if radius > 0.0 { per_lamp } else { 1 }, radius, &mut samples);
    }
    let height = HEIGHT * scene.bounds().extent();
    for (number, surface) in surfaces(scene).iter().enumerate() {
        surface.add_samples(scene, per_lamp, height, scene.lights.len() + number, &mut samples);
    }
    samples.retain(|sample| sample.light.intensity.max_element() > 0.0);
    samples
}

/// A punctual light as `count` equal points, spread evenly on a ball (a Fibonacci lattice); one point is its middle.
fn add_punctual(light: &Light, lamp: usize, count: u32, radius: f32, samples: &mut Vec<LightSample>) {
    let (LightKind::Point { position } | LightKind::Spot { position, .. }) = light.kind else {
        samples.push(LightSample { light: light.clone(), surface_normal: None, lamp });
        return;
    };
    for index in 0..count {
        let height = 1.0 - (2 * index + 1) as f32 / count as f32;
        let (sin, cos) = (index as f32 * GOLDEN * std::f32::consts::TAU).sin_cos();
        let ring = if count > 1 { (1.0 - height * height).sqrt() } else { 0.0 };
        let mut part = light.clone();
        part.intensity /= count as f32;
        if let LightKind::Point { position: place } | LightKind::Spot { position: place, .. } = &mut part.kind {
            *place = position + radius * Vec3::new(ring * cos, height, ring * sin);
        }
        samples.push(LightSample { light: part, surface_normal: None, lamp });
    }
}

/// Emissive triangles of one instance, material, side and place.
struct Surface {
    group: GroupId,
    is_back: bool,
    triangles: Vec<TriangleId>,
    /// Running sum of their areas.
    cumulative_area: Vec<f32>,
}

fn surfaces(scene: &Scene) -> Vec<Surface> {
    let place_size = PLACE_SHARE * scene.bounds().extent().max(f32::MIN_POSITIVE);
    let has_backs = scene.sides.has_backs();
    let mut by_place: BTreeMap<_, Surface> = BTreeMap::new();
    for piece in pieces(scene) {
        let triangle = &scene.triangles[piece[0].index()];
        let material = &scene.materials[triangle.material.index()];
        let Some(group) = material.group else { continue };
        let middle = piece.iter().flat_map(|&id| scene.corners(id)).sum::<Vec3>() / (3 * piece.len()) as f32;
        let place = (middle / place_size).floor().as_ivec3().to_array();
        // A bake has written the backs of double-sided triangles out.
        let num_sides = if material.double_sided && !has_backs { 2 } else { 1 };
        for side in 0..num_sides {
            let key = (triangle.instance, triangle.material, scene.sides.is_back(piece[0]), side, place);
            let surface = by_place.entry(key).or_insert_with(|| Surface::new(group, side == 1));
            piece.iter().for_each(|&id| surface.add(id, area_of(scene.corners(id))));
        }
    }
    by_place.into_values().collect()
}

/// Emissive triangles of one instance, material and side that hang together by their corners.
fn pieces(scene: &Scene) -> Vec<Vec<TriangleId>> {
    let mut piece_of_corner = HashMap::new();
    let mut pieces: Vec<Vec<TriangleId>> = Vec::new();
    for (t, triangle) in scene.triangles.iter().enumerate() {
        if !scene.materials[triangle.material.index()].is_emissive() {
            continue;
        }
        let id = TriangleId::new(t);
        let surface = (triangle.instance, triangle.material, scene.sides.is_back(id));
        let corners = scene.corners(id).map(|corner| (surface, corner.to_array().map(f32::to_bits)));
        let mut touched: Vec<usize> =
            corners.iter().filter_map(|corner| piece_of_corner.get(corner).copied()).collect();
        touched.sort_unstable();
        touched.dedup();
        // The triangle joins all pieces that it touches into the first of them.
        let home = touched.first().copied().unwrap_or_else(|| {
            pieces.push(Vec::new());
            pieces.len() - 1
        });
        for &other in touched.iter().skip(1) {
            let moved = std::mem::take(&mut pieces[other]);
            pieces[home].extend(moved);
            piece_of_corner.values_mut().filter(|piece| **piece == other).for_each(|piece| *piece = home);
        }
        pieces[home].push(id);
        piece_of_corner.extend(corners.map(|corner| (corner, home)));
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

impl Surface {
    fn new(group: GroupId, is_back: bool) -> Self {
        Self { group, is_back, triangles: Vec::new(), cumulative_area: Vec::new() }
    }

    fn add(&mut self, id: TriangleId, area: f32) {
        let before = self.cumulative_area.last().copied().unwrap_or(0.0);
        self.triangles.push(id);
        self.cumulative_area.push(before + area);
    }

    /// Adds `count` samples, one in each of as many parts of equal area.
    fn add_samples(&self, scene: &Scene, count: u32, height: f32, lamp: usize, samples: &mut Vec<LightSample>) {
        let area = self.cumulative_area.last().copied().unwrap_or(0.0);
        for index in 0..count {
            let square = Vec2::new((index as f32 + 0.5) / count as f32, (0.5 + index as f32 * GOLDEN).fract());
            let (id, weights) = self.at(square, area);
            let corners = scene.corners(id);
            let [a, b, c] = corners;
            let normal = if self.is_back { -normal_of(corners) } else { normal_of(corners) };
            let position = interpolate([a, b, c], weights) + height * normal;
            let radiance = emission(scene, id, weights);
            samples.push(LightSample {
                light: Light {
                    name: scene.instances[scene.triangles[id.index()].instance.index()].name.clone(),
                    group: self.group,
                    // A Lambertian of radiance L and area A has the intensity L A cos.
                    ..Light::point(position, radiance * (area / count as f32))
                },
                surface_normal: Some(normal),
                lamp,
            });
        }
    }

    /// Triangle and barycentric weights of a point of the unit square, by area.
    fn at(&self, square: Vec2, area: f32) -> (TriangleId, Vec3) {
        let target = square.x * area;
        let at = self.cumulative_area.partition_point(|&sum| sum <= target).min(self.triangles.len() - 1);
        let before = if at == 0 { 0.0 } else { self.cumulative_area[at - 1] };
        // What is left of the first coordinate is uniform within the triangle.
        let within = ((target - before) / (self.cumulative_area[at] - before)).clamp(0.0, 1.0);
        (self.triangles[at], triangle_from_square(Vec2::new(within, square.y)))
    }
}

/// Radiance that a triangle sends from a point, holes left out.
fn emission(scene: &Scene, id: TriangleId, weights: Vec3) -> Vec3 {
    let point = scene.surface_at(id, weights);
    point.emission * point.opacity
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    use crate::scene::{Material, SceneBuilder};

    /// A square of side 2 at height 1 that shines down with exitance pi.
    fn panel(double_sided: bool) -> Scene {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let mut builder = SceneBuilder::default();
        let group = Some(builder.group("lamps"));
        let lamp = builder.material(Material { emission: Vec3::ONE, group, double_sided, ..Material::default() });
        builder.quad(corners.map(|(x, z)| Vec3::new(x, 1.0, z)), lamp);
        builder.build()
    }

    #[test]
    fn samples_of_a_surface_sum_to_its_irradiance() {
        // Four times the factor from a point to a parallel square of side a at distance c over its corner,
        // F = 2 / (2 pi) x a / sqrt(a^2 + c^2) x atan(a / sqrt(a^2 + c^2)), with a = c = 1.
        let half: f32 = 0.5f32.sqrt();
        let expected = PI * 4.0 * half * half.atan() / PI;
        // Evenly spread points err by about one of them, 1 / N; as many at random by 0.53 / sqrt(N), which is 3.3 % at 256.
        for count in [64, 256, 1024] {
            let samples = light_samples(&panel(false), count, 0.0);
            assert_eq!(samples.len(), count as usize);
            let sum: Vec3 = samples.iter().map(|sample| sample.irradiance(Vec3::ZERO, Vec3::Y)).sum();
            assert!((sum.x / expected - 1.0).abs() < 1.0 / count as f32, "{count} points: {sum}, not {expected}");
        }
    }

    #[test]
    fn a_light_with_a_radius_is_a_ball_of_points_as_strong_together() {
        let position = Vec3::new(1.0, 2.0, 3.0);
        let lights = vec![Light::point(position, Vec3::ONE), Light::directional(Vec3::NEG_Y, Vec3::ONE)];
        let scene = Scene { lights, ..Scene::default() };
        assert_eq!(light_samples(&scene, 64, 0.0).len(), 2);
        assert_eq!(light_samples(&scene, 1, 0.3)[0].place(), position.extend(1.0));
        let samples = light_samples(&scene, 64, 0.3);
        let ball: Vec<_> = samples.iter().filter(|sample| sample.lamp == 0).collect();
        assert_eq!((ball.len(), samples.len()), (64, 65));
        assert!(ball.iter().all(|s| (s.place().truncate().distance(position) - 0.3).abs() < 1e-5));
        let total: f32 = ball.iter().map(|sample| sample.light.intensity.x).sum();
        let mean = ball.iter().map(|sample| sample.place().truncate()).sum::<Vec3>() / 64.0;
        assert!((total - 1.0).abs() < 1e-5 && mean.distance(position) < 0.01, "{total}, {mean}");
    }

    #[test]
    fn a_panel_shines_on_its_front_and_a_double_sided_one_on_both() {
        let above = |scene: &Scene| -> Vec3 {
            light_samples(scene, 4, 0.0).iter().map(|sample| sample.irradiance(2.0 * Vec3::Y, Vec3::NEG_Y)).sum()
        };
        assert_eq!(above(&panel(false)), Vec3::ZERO);
        assert!(above(&panel(true)).x > 0.1);
    }
}

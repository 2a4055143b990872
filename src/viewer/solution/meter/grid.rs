//! A grid of measurements over a flat surface: minimum, mean, maximum and uniformity.

use glam::{Vec2, Vec3};

use crate::bake::Measured;
use crate::base::colour::luminance;
use crate::base::ids::TriangleId;
use crate::base::progress::Progress;
use crate::raytrace::MeasuringPoint;
use crate::scene::{Scene, normal_of};
use crate::viewer::camera::collider::Pick;
use crate::viewer::solution::solved::SolvedScene;

/// Largest number of points of a grid.
const MAX_POINTS: usize = 400;
/// Smallest cosine between the normals of triangles in the same plane.
const SAME_NORMAL: f32 = 0.999;
/// Largest distance of triangles in the same plane, as a fraction of the largest extent of the scene.
const SAME_PLANE: f32 = 1e-3;

/// The points of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct GridPlan {
    /// The points, row by row.
    pub points: Vec<MeasuringPoint>,
    /// Distance between neighbours, metres.
    pub spacing: f32,
}

/// A measured grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The points.
    pub plan: GridPlan,
    /// Irradiance at each point, lux per channel.
    pub measured: Vec<Measured>,
}

impl GridPlan {
    /// Lays a grid over the flat part of the picked instance, `height` metres above it. Points are about `spacing`
    /// metres apart, or farther if that gives more than 400 points.
    #[must_use]
    pub fn over(scene: &Scene, pick: &Pick, spacing: f32, height: f32) -> Self {
        let flat = flat_part(scene, pick);
        let (right, up) = pick.normal.any_orthonormal_pair();
        let (right, up) = level(pick.normal, right, up);
        let place = |p: Vec3| Vec2::new((p - pick.point).dot(right), (p - pick.point).dot(up));
        let triangles: Vec<[Vec2; 3]> = flat.iter().map(|&t| scene.corners(t).map(place)).collect();
        let corners = || triangles.iter().flatten();
        let low = corners().copied().reduce(Vec2::min).unwrap_or_default();
        let high = corners().copied().reduce(Vec2::max).unwrap_or_default();
        let size = high - low;
        let widest = (size.x * size.y / MAX_POINTS as f32).max(0.0).sqrt();
        let spacing = spacing.max(widest).max(1e-4 * size.max_element()).max(f32::MIN_POSITIVE);
        let count = (size / spacing).round().clamp(Vec2::ONE, Vec2::splat(MAX_POINTS as f32));
        let mut points = Vec::new();
        for row in 0..count.y as u32 {
            for column in 0..count.x as u32 {
                let at = low + size * (Vec2::new(column as f32, row as f32) + 0.5) / count;
                if triangles.iter().any(|triangle| contains(*triangle, at)) && points.len() < MAX_POINTS {
                    let position = pick.point + right * at.x + up * at.y + pick.normal * height;
                    points.push(MeasuringPoint { position, normal: pick.normal });
                }
            }
        }
        Self { points, spacing }
    }

    /// Measures all points; `None` if it was cancelled.
    #[must_use]
    pub fn measure(self, solved: &SolvedScene, progress: &dyn Progress) -> Option<Grid> {
        let measured = solved.measure(&self.points, progress)?;
        Some(Grid { plan: self, measured })
    }
}

impl Grid {
    /// Returns the illuminance at each point, lux.
    pub fn lux(&self) -> impl Iterator<Item = f32> {
        self.measured.iter().map(|measured| luminance(measured.total))
    }

    /// Returns the smallest illuminance, lux.
    #[must_use]
    pub fn min(&self) -> f32 {
        self.lux().fold(f32::INFINITY, f32::min)
    }

    /// Returns the greatest illuminance, lux.
    #[must_use]
    pub fn max(&self) -> f32 {
        self.lux().fold(0.0, f32::max)
    }

    /// Returns the mean illuminance, lux.
    #[must_use]
    pub fn mean(&self) -> f32 {
        self.lux().sum::<f32>() / self.measured.len().max(1) as f32
    }

    /// Computes the uniformity U0 = smallest illuminance / mean illuminance (EN 12464-1); 0 without light.
    #[must_use]
    pub fn uniformity(&self) -> f32 {
        if self.mean() > 0.0 { self.min() / self.mean() } else { 0.0 }
    }
}

/// Returns the triangles of the picked instance that lie in the plane of the pick and have the same normal.
fn flat_part(scene: &Scene, pick: &Pick) -> Vec<TriangleId> {
    let tolerance = SAME_PLANE * scene.bounds().extent();
    let front = normal_of(scene.corners(pick.triangle));
    let instance = scene.triangles[pick.triangle.index()].instance;
    let lies_there = |&t: &TriangleId| {
        let corners = scene.corners(t);
        let triangle = &scene.triangles[t.index()];
        triangle.instance == instance
            && normal_of(corners).dot(front) > SAME_NORMAL
            && corners.iter().all(|&corner| (corner - pick.point).dot(front).abs() < tolerance)
    };
    scene.fronts().filter(lies_there).collect()
}

/// Returns the axes of a plane; the first is horizontal.
fn level(normal: Vec3, right: Vec3, up: Vec3) -> (Vec3, Vec3) {
    let flat = if normal.y.abs() > 0.9 { Vec3::X.reject_from(normal) } else { Vec3::Y.cross(normal) };
    flat.try_normalize().map_or((right, up), |right| (right, normal.cross(right)))
}

/// Returns true if the point lies in the triangle, of either orientation.
fn contains([a, b, c]: [Vec2; 3], p: Vec2) -> bool {
    let side = |from: Vec2, to: Vec2| (to - from).perp_dot(p - from);
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0)
}

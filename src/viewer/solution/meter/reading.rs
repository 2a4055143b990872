//! A reading of the lux meter at a point.

use glam::Vec3;

use crate::bake::Measured;
use crate::base::colour::luminance;
use crate::base::ids::TriangleId;
use crate::base::progress::Progress;
use crate::raytrace::MeasuringPoint;
use crate::trace::Tracer;
use crate::viewer::camera::collider::Pick;
use crate::viewer::settings::light::GroupDial;
use crate::viewer::solution::solved::SolvedScene;

/// A reading of the meter at a point, with all lights as baked.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Position and normal of the meter.
    pub point: MeasuringPoint,
    /// Irradiance, lux per channel.
    pub measured: Measured,
    /// Stored light of each group `[g]`.
    pub groups: Vec<GroupReading>,
    /// The surface; `None` if the point lies on no element.
    pub surface: Option<SurfaceReading>,
}

/// Light of one group at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupReading {
    /// Name of the group.
    pub name: String,
    /// Direct irradiance, lux per channel.
    pub direct: Vec3,
    /// Irradiance after at least one reflection, lux per channel.
    pub indirect: Vec3,
}

/// The surface under the meter.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceReading {
    /// Name of the instance.
    pub instance: String,
    /// Name of the material.
    pub material: String,
    /// Index of the patch.
    pub patch: usize,
    /// Index of the element.
    pub element: usize,
    /// Mean diffuse reflectance of the element.
    pub reflectance: Vec3,
    /// Emitted light, lm/m².
    pub exitance: Vec3,
}

impl Reading {
    /// Returns the illuminance, lux.
    #[must_use]
    pub fn lux(&self) -> f32 {
        luminance(self.measured.total)
    }

    /// Returns the share of the direct light in the illuminance.
    #[must_use]
    pub fn direct_share(&self) -> f32 {
        luminance(self.measured.direct) / self.lux().max(f32::MIN_POSITIVE)
    }

    /// Returns the radiosity, lm/m²: emitted plus reflected light, B = M + rho E.
    #[must_use]
    pub fn radiosity(&self) -> Option<Vec3> {
        self.surface.as_ref().map(|surface| surface.exitance + surface.reflectance * self.measured.total)
    }

    /// Returns the share of each group in the stored light `[g]`; all are 0 if there is no light.
    #[must_use]
    pub fn group_shares(&self) -> Vec<f32> {
        let lux: Vec<f32> = self.groups.iter().map(|group| luminance(group.direct + group.indirect)).collect();
        let total: f32 = lux.iter().sum::<f32>().max(f32::MIN_POSITIVE);
        lux.iter().map(|lux| lux / total).collect()
    }

    /// Computes the illuminance with dimmed groups, lux: the measured illuminance times dimmed / full stored light.
    #[must_use]
    pub fn dimmed_lux(&self, dials: &[GroupDial]) -> f32 {
        let stored = |weight: &dyn Fn(usize) -> Vec3| -> f32 {
            let groups = self.groups.iter().enumerate();
            groups.map(|(g, group)| luminance(weight(g) * (group.direct + group.indirect))).sum()
        };
        let all = stored(&|_| Vec3::ONE);
        let dimmed = stored(&|g| dials.get(g).map_or(Vec3::ONE, GroupDial::weight));
        if all > 0.0 { self.lux() * dimmed / all } else { self.lux() }
    }
}

/// Measures at a point; `None` if it was cancelled.
#[must_use]
pub fn read(solved: &SolvedScene, point: MeasuringPoint, progress: &dyn Progress) -> Option<Reading> {
    let measured = *solved.measure(&[point], progress)?.first()?;
    let element = element_at(solved, &point);
    let groups = group_light(solved, &point, element);
    let surface = element.map(|element| surface_of(solved, element));
    Some(Reading { point, measured, groups, surface })
}

/// Returns the measuring point on a picked surface.
#[must_use]
pub fn point_of(pick: &Pick) -> MeasuringPoint {
    MeasuringPoint { position: pick.point, normal: pick.normal }
}

/// Returns the element of the bake at a point, on the side of its normal.
fn element_at(solved: &SolvedScene, point: &MeasuringPoint) -> Option<usize> {
    let reach = 1e-3 * solved.baked.scene.bounds().extent();
    let tracer = Tracer::new(&solved.baked.scene);
    let hit = tracer.nearest(point.position + reach * point.normal, -point.normal, 2.0 * reach)?;
    let front = hit.triangle.index();
    if hit.is_front {
        return Some(front);
    }
    let root = solved.mesh.roots.get(solved.mesh.elements.get(front)?.triangle.index())?;
    Some(if root.has_backs { front + root.num_elements as usize } else { front })
}

/// Interpolates the stored light of each group between the corners of an element.
fn group_light(solved: &SolvedScene, point: &MeasuringPoint, element: Option<usize>) -> Vec<GroupReading> {
    let scene = &solved.baked.scene;
    let corners = element.and_then(|e| scene.triangles.get(e)).map(|triangle| triangle.vertices);
    let weights = element.map(|e| barycentric(scene.corners(TriangleId::new(e)), point.position));
    let between = |values: &[Vec3]| match (corners, weights) {
        (Some(corners), Some(weights)) => {
            corners.iter().zip(weights.to_array()).map(|(&v, weight)| values[v as usize] * weight).sum::<Vec3>()
        }
        _ => Vec3::ZERO,
    };
    let groups = scene.light_groups.iter().zip(&solved.baked.light.groups);
    groups
        .map(|(name, light)| GroupReading {
            name: name.clone(),
            direct: between(&light.direct).max(Vec3::ZERO),
            indirect: between(&light.indirect).max(Vec3::ZERO),
        })
        .collect()
}

/// Computes the barycentric coordinates of a point in the plane of a triangle.
fn barycentric([a, b, c]: [Vec3; 3], p: Vec3) -> Vec3 {
    let normal = (b - a).cross(c - a);
    let whole = normal.length_squared().max(f32::MIN_POSITIVE);
    let part = |from: Vec3, to: Vec3| (to - from).cross(p - from).dot(normal) / whole;
    Vec3::new(part(b, c), part(c, a), part(a, b))
}

fn surface_of(solved: &SolvedScene, element: usize) -> SurfaceReading {
    let scene = &solved.baked.scene;
    let triangle = &scene.triangles[element];
    let optics = &solved.mesh.elements[element.min(solved.mesh.elements.len() - 1)];
    SurfaceReading {
        instance: scene.instances.get(triangle.instance.index()).map(|i| i.name.clone()).unwrap_or_default(),
        material: scene.materials[triangle.material.index()].name.clone(),
        patch: optics.patch.index(),
        element,
        reflectance: optics.reflectance,
        exitance: optics.exitance,
    }
}

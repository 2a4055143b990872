//! Irradiance at points, as a lux meter would show it.
//!
//! Direct light is computed at the point itself. Indirect light is gathered by rays over the stored solution, which is
//! sharper than interpolation between the vertices around the point.

use glam::Vec3;

use super::settings::Quality;
use crate::baked::BakedScene;
use crate::base::progress::{Progress, Unwatched};
use crate::form_factor::Viewpoint;
use crate::patch::{MeshError, MeshSettings, PatchMesh};
use crate::radiosity::Viewpoints;
use crate::radiosity::direct::DirectLight;
use crate::raytrace::{GatherPrecision, MeasuringPoint, gathered_irradiance, stored_irradiance};
use crate::scene::Scene;
use crate::trace::Tracer;

/// Irradiance at a point, lux per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Direct and indirect light.
    pub total: Vec3,
    /// The part that arrives straight from the lights.
    pub direct: Vec3,
}

/// The precision of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasureSettings {
    /// Precision of the rays that gather indirect light.
    pub gather: GatherPrecision,
    /// Largest number of rays per point and emitter in penumbrae.
    pub num_penumbra_rays: u32,
}

impl Default for MeasureSettings {
    /// Returns the medium preset.
    fn default() -> Self {
        Self::preset(Quality::default())
    }
}

impl MeasureSettings {
    /// Returns the values of a preset.
    #[must_use]
    pub fn preset(quality: Quality) -> Self {
        let (num_penumbra_rays, max_rays, error) = match quality {
            Quality::Draft => (256, 1 << 13, 0.02),
            Quality::Medium => (1024, 1 << 16, 6e-3),
            Quality::High => (4096, 1 << 18, 3e-3),
        };
        Self { gather: GatherPrecision { min_rays: 1024, max_rays, error }, num_penumbra_rays }
    }
}

/// A scene with its light, and an observer of the measurement.
#[derive(Clone, Copy)]
pub struct MeasureContext<'a> {
    /// The scene in which direct light is computed: the original scene, or the scene of elements that the bake made.
    pub scene: &'a Scene,
    /// The mesh of `scene`.
    pub mesh: &'a PatchMesh,
    /// The elements with their light.
    pub baked: &'a BakedScene,
    /// Observes the measurement and may cancel it.
    pub progress: &'a dyn Progress,
}

/// Measures at points of a baked scene, in order.
///
/// ```
/// use hemicube::glam::Vec3;
/// use hemicube::bake::{BakeSettings, MeasureSettings, Method, Quality, bake, measure};
/// use hemicube::raytrace::MeasuringPoint;
/// use hemicube::scene::builtin;
///
/// let settings = BakeSettings {
///     element_size: Some(0.5),
///     method: Some(Method::Hemisphere),
///     hemisphere_rays: 64,
///     ..BakeSettings::preset(Quality::Draft)
/// };
/// let baked = bake(&builtin::cornell(), &settings)?.baked;
/// let middle_of_the_floor = MeasuringPoint { position: baked.scene.bounds().centre().with_y(0.0), normal: Vec3::Y };
/// let measured = measure(&baked, &[middle_of_the_floor], &MeasureSettings::preset(Quality::Draft))?;
/// assert!(measured[0].total.min_element() >= measured[0].direct.min_element());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns an error if the bake has no elements.
pub fn measure(
    baked: &BakedScene,
    points: &[MeasuringPoint],
    settings: &MeasureSettings,
) -> Result<Vec<Measured>, MeshError> {
    let mesh = PatchMesh::new(&baked.scene, &MeshSettings::uncut())?;
    let context = MeasureContext { scene: &baked.scene, mesh: &mesh, baked, progress: &Unwatched };
    Ok(measure_with(&context, points, settings).unwrap_or_default())
}

/// Measures at points, in order; `None` after a cancel.
#[must_use]
pub fn measure_with(
    context: &MeasureContext<'_>,
    points: &[MeasuringPoint],
    settings: &MeasureSettings,
) -> Option<Vec<Measured>> {
    let &MeasureContext { scene, mesh, baked, progress } = context;
    let placement = Viewpoints::new(scene);
    let viewpoint = |(seed, point): (usize, &MeasuringPoint)| -> Viewpoint {
        placement.above(point.position, point.normal.normalize_or_zero(), seed as u32)
    };
    let viewpoints: Vec<Viewpoint> = points.iter().enumerate().map(viewpoint).collect();
    let tracer = Tracer::new(scene);
    let direct = DirectLight::new(scene, mesh, &tracer, settings.num_penumbra_rays).irradiance(&viewpoints, progress);
    let total_at = |at| if direct.num_groups() > 0 { direct.total(at) } else { Vec3::ZERO };
    let direct: Vec<Vec3> = (0..points.len()).map(total_at).collect();
    let elements = Tracer::new(&baked.scene);
    let indirect = gathered_irradiance(&elements, baked, points, &direct, &settings.gather, progress)?;
    let measured = |(indirect, direct)| Measured { total: direct + indirect, direct };
    Some(indirect.into_iter().zip(direct).map(measured).collect())
}

/// Interpolates the light stored at the vertices around each point. A value is `None` if the point lies on no surface.
#[must_use]
pub fn look_up(baked: &BakedScene, points: &[MeasuringPoint]) -> Vec<Option<Measured>> {
    let tracer = Tracer::new(&baked.scene);
    let measured = |(direct, indirect)| Measured { total: direct + indirect, direct };
    stored_irradiance(&tracer, baked, points).into_iter().map(|found| found.map(measured)).collect()
}

//! Irradiance at points: what a lux meter would show.
//!
//! Direct light is asked for at the point itself; indirect light is gathered over the stored solution, which is sharper than
//! the vertices round the point.

use glam::Vec3;

use super::settings::Quality;
use crate::baked::BakedScene;
use crate::base::progress::Progress;
use crate::form_factor::Viewpoint;
use crate::patch::PatchMesh;
use crate::radiosity::Viewpoints;
use crate::radiosity::direct::DirectLight;
use crate::raytrace::{GatherPrecision, MeasuringPoint, gathered_irradiance, stored_irradiance};
use crate::scene::Scene;
use crate::trace::Tracer;

/// Irradiance at a point, lux per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// All of it.
    pub total: Vec3,
    /// The part that comes straight from lights.
    pub direct: Vec3,
}

/// How closely is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasureSettings {
    /// Rays that gather indirect light.
    pub gather: GatherPrecision,
    /// Most rays a point and emitter in penumbrae.
    pub num_penumbra_rays: u32,
}

impl MeasureSettings {
    /// The values of a preset.
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

/// Measures at `points` in a scene whose light is `baked`. None where it was cancelled.
///
/// `scene` and its `mesh` are those that were baked, or the bake's own elements: direct light is asked of them.
#[must_use]
pub fn measure(
    scene: &Scene,
    mesh: &PatchMesh,
    baked: &BakedScene,
    points: &[MeasuringPoint],
    settings: &MeasureSettings,
    progress: &dyn Progress,
) -> Option<Vec<Measured>> {
    let sites = Viewpoints::new(scene);
    let viewpoint = |(seed, point): (usize, &MeasuringPoint)| -> Viewpoint {
        sites.above(point.position, point.normal.normalize_or_zero(), seed as u32)
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

/// The light that is stored at the vertices round each point; none where a point lies on no surface.
#[must_use]
pub fn look_up(baked: &BakedScene, points: &[MeasuringPoint]) -> Vec<Option<Measured>> {
    let tracer = Tracer::new(&baked.scene);
    let measured = |(direct, indirect)| Measured { total: direct + indirect, direct };
    stored_irradiance(&tracer, baked, points).into_iter().map(|found| found.map(measured)).collect()
}

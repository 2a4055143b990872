//! Which way of finding form factors suits a scene and a device.

use super::BakeError;
use super::settings::{BakeSettings, Method, SHOOTING_RAYS};
use crate::form_factor::FormFactorSource;
use crate::form_factor::hemicube::{Hemicubes, size_for_patches};
use crate::form_factor::hemisphere::Hemispheres;
use crate::form_factor::row_cache::{CachedFormFactors, RowCache};
use crate::gpu::Gpu;
use crate::patch::PatchMesh;
use crate::trace::Tracer;

/// What form factors are asked of: a device that draws hemicubes, else rays.
#[derive(Clone, Copy)]
pub(super) struct Seer<'a> {
    gpu: Option<&'a Gpu>,
    mesh: &'a PatchMesh,
    tracer: &'a Tracer<'a>,
    rows: Option<&'a RowCache>,
}

impl<'a> Seer<'a> {
    /// Sees by `method`, and keeps what it sees in `rows` where there is such a cache.
    ///
    /// # Errors
    /// Hemicubes are wanted and there is no device.
    pub(super) fn new(
        method: Method,
        gpu: Option<&'a Gpu>,
        mesh: &'a PatchMesh,
        tracer: &'a Tracer<'a>,
        rows: Option<&'a RowCache>,
    ) -> Result<Self, BakeError> {
        let gpu = match method {
            Method::Hemicube => Some(gpu.ok_or(BakeError::NoDevice)?),
            Method::Hemisphere => None,
        };
        Ok(Self { gpu, mesh, tracer, rows })
    }

    /// Coarse form factors: shooters see patches, not detail.
    pub(super) fn shooting(self) -> Box<dyn FormFactorSource + 'a> {
        self.with(size_for_patches(self.tracer.scene(), self.mesh), SHOOTING_RAYS)
    }

    /// Form factors for the light that is shown.
    pub(super) fn gathering(self, settings: &BakeSettings) -> Box<dyn FormFactorSource + 'a> {
        self.with(settings.hemicube_px, settings.hemisphere_rays)
    }

    /// Hemicubes `size_px` pixels wide on a device, else hemispheres of `num_rays` rays.
    fn with(self, size_px: u32, num_rays: u32) -> Box<dyn FormFactorSource + 'a> {
        let (method, label): (Box<dyn FormFactorSource + 'a>, _) = match self.gpu {
            Some(gpu) => (
                Box::new(Hemicubes::new(gpu, self.tracer.scene(), self.mesh, size_px)),
                format!("hemicubes of {size_px} px by {}", gpu.name()),
            ),
            None => (
                Box::new(Hemispheres::new(self.tracer, self.mesh, num_rays)),
                format!("hemispheres of {num_rays} rays"),
            ),
        };
        match self.rows {
            Some(rows) => Box::new(CachedFormFactors::new(method, &label, self.mesh, rows)),
            None => method,
        }
    }
}

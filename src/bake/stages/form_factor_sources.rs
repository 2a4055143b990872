//! The sources of form factors of a bake: hemicubes or hemispheres, coarse ones for the solver and fine ones for the
//! gather.

use crate::bake::context::BakeContext;
use crate::bake::error::BakeError;
use crate::bake::settings::{BakeSettings, Method, SHOOTING_RAYS};
use crate::form_factor::FormFactorSource;
use crate::form_factor::hemicube::{Hemicubes, size_for_patches};
use crate::form_factor::hemisphere::Hemispheres;
use crate::form_factor::row_cache::{CachedFormFactors, RowCache};
use crate::gpu::Gpu;
use crate::patch::PatchMesh;
use crate::trace::Tracer;

/// Makes sources of form factors by one method over one mesh.
#[derive(Clone, Copy)]
pub(in crate::bake) struct FormFactorSources<'a> {
    /// The device that draws hemicubes; `None` if rays are traced.
    gpu: Option<&'a Gpu>,
    mesh: &'a PatchMesh,
    tracer: &'a Tracer<'a>,
    row_cache: Option<&'a RowCache>,
}

impl<'a> FormFactorSources<'a> {
    /// Creates sources by `method`. Their rows are stored in the row cache of `context` if it has one.
    ///
    /// # Errors
    /// Returns an error if hemicubes are requested without a device.
    pub fn new(
        method: Method,
        context: &BakeContext<'a>,
        mesh: &'a PatchMesh,
        tracer: &'a Tracer<'a>,
    ) -> Result<Self, BakeError> {
        let gpu = match method {
            Method::Hemicube => Some(context.gpu.ok_or(BakeError::NoDevice)?),
            Method::Hemisphere => None,
        };
        Ok(Self { gpu, mesh, tracer, row_cache: context.row_cache })
    }

    /// Returns coarse form factors for the solver, which resolve patches but no detail.
    pub fn for_patches(self) -> Box<dyn FormFactorSource + 'a> {
        self.source(size_for_patches(self.tracer.scene(), self.mesh), SHOOTING_RAYS)
    }

    /// Returns the form factors of the final gather, whose light is displayed.
    pub fn for_vertices(self, settings: &BakeSettings) -> Box<dyn FormFactorSource + 'a> {
        self.source(settings.hemicube_px, settings.hemisphere_rays)
    }

    /// Returns hemicubes `size_px` pixels wide if there is a device, else hemispheres of `num_rays` rays.
    fn source(self, size_px: u32, num_rays: u32) -> Box<dyn FormFactorSource + 'a> {
        let (source, label): (Box<dyn FormFactorSource + 'a>, _) = match self.gpu {
            Some(gpu) => (
                Box::new(Hemicubes::new(gpu, self.tracer.scene(), self.mesh, size_px)),
                format!("hemicubes of {size_px} px by {}", gpu.name()),
            ),
            None => (
                Box::new(Hemispheres::new(self.tracer, self.mesh, num_rays)),
                format!("hemispheres of {num_rays} rays"),
            ),
        };
        match self.row_cache {
            Some(rows) => Box::new(CachedFormFactors::new(source, &label, self.mesh, rows)),
            None => source,
        }
    }
}

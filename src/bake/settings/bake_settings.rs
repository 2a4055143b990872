//! All settings of a bake, and the sizes that follow from them for a given scene.

use super::{Method, Quality, Solver};
use crate::patch::MeshSettings;
use crate::radiosity::adaptive_subdivision::SubdivisionSettings;
use crate::radiosity::gather::FinalGatherSettings;
use crate::radiosity::solver::progressive::ProgressiveSettings;
use crate::scene::Scene;

/// How a scene is baked: the choices of a user, and the numbers of a preset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BakeSettings {
    /// The preset that the other values are based on.
    pub quality: Quality,
    /// Longest element edge, metres; `None` derives it from the area of the scene.
    pub element_size: Option<f32>,
    /// Method of computing form factors; `None` chooses the faster one.
    pub method: Option<Method>,
    /// Solver of the system of patches.
    pub solver: Solver,
    /// Progressive refinement: average number of shots per patch after which shooting ends (`None`: 64). Gathering:
    /// number of passes (`None`: until the light converges).
    pub passes: Option<usize>,
    /// Shooting ends when the unshot power is this share of its initial value.
    pub threshold: f32,
    /// Width of the hemicubes of the final gather, pixels.
    pub hemicube_px: u32,
    /// Number of rays of the hemispheres of the final gather.
    pub hemisphere_rays: u32,
    /// Approximate numbers of elements and patches from which sizes are derived.
    pub budget: MeshBudget,
    /// How elements follow the light.
    pub refinement: Refinement,
    /// How densely light is sampled.
    pub sampling: Sampling,
}

/// Approximate numbers of elements and patches of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshBudget {
    /// Number of elements before subdivision by light.
    pub elements: f64,
    /// Number of patches.
    pub patches: f64,
}

/// How elements are subdivided where light is not linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinement {
    /// An edge is halved if the light at its midpoint deviates from the mean of its ends by more than this, relative
    /// to the light there. 0 halves no edge.
    pub max_error: f32,
    /// Shortest edges made before light is reflected, in element sizes.
    pub min_edge: f32,
    /// Shortest edges of hard shadows in the result, in element sizes.
    pub sharp_edge: f32,
    /// Approximate limit of the number of elements, as a multiple of this sum: the budget plus half the number of input
    /// triangles.
    pub max_growth: f32,
}

/// How densely light is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Number of viewpoints per patch.
    pub points_a_patch: usize,
    /// Number of points per element at which direct light is sampled.
    pub points_an_element: usize,
    /// Largest number of rays per viewpoint and emitter in penumbrae.
    pub num_penumbra_rays: u32,
    /// Largest error of the irradiance cache.
    pub cache_tolerance: f32,
    /// Accepted noise of one record of the irradiance cache: standard deviation relative to its irradiance.
    pub noise: f32,
}

/// Largest number of rays per point and emitter in penumbrae if only the mean over a patch matters.
pub(in crate::bake) const PENUMBRA_RAYS_ON_ELEMENTS: u32 = 64;

/// Number of rays of the hemispheres of patches.
pub(in crate::bake) const SHOOTING_RAYS: u32 = 512;

/// Largest radius of a record of the irradiance cache, in element sizes.
const MAX_RADIUS: f32 = 4.0;

/// Average number of shots per patch after which shooting ends.
const MAX_SHOTS_A_PATCH: usize = 64;

/// Memory for rows stored between shots, bytes.
pub(in crate::bake) const ROW_BYTES: usize = 1 << 30;

/// Mean area of an element in squares of the element size (bisection ends between 1/8 and 1/4).
const AREA_OF_ELEMENT: f64 = 0.18;

/// Elements per input triangle added to the budget: finely modelled surfaces have edges that cast shadows.
const ELEMENTS_A_TRIANGLE: f64 = 0.5;

impl Default for BakeSettings {
    /// Returns the medium preset.
    fn default() -> Self {
        Self::preset(Quality::default())
    }
}

impl BakeSettings {
    /// Returns the values of a preset.
    #[must_use]
    pub fn preset(quality: Quality) -> Self {
        let medium = Self {
            quality,
            element_size: None,
            method: None,
            solver: Solver::Progressive,
            passes: None,
            threshold: 1e-3,
            hemicube_px: 64,
            hemisphere_rays: 1024,
            budget: MeshBudget { elements: 12_000.0, patches: 1_500.0 },
            refinement: Refinement { max_error: 0.04, min_edge: 1.0 / 8.0, sharp_edge: 1.0 / 64.0, max_growth: 10.0 },
            sampling: Sampling {
                points_a_patch: 2,
                points_an_element: 2,
                num_penumbra_rays: 256,
                cache_tolerance: 0.1,
                noise: 0.05,
            },
        };
        match quality {
            Quality::Draft => Self {
                threshold: 1e-2,
                hemicube_px: 32,
                hemisphere_rays: 256,
                budget: MeshBudget { elements: 6_000.0, patches: 500.0 },
                refinement: Refinement { max_error: 0.1, min_edge: 1.0 / 4.0, sharp_edge: 1.0 / 8.0, max_growth: 3.0 },
                sampling: Sampling {
                    points_a_patch: 1,
                    points_an_element: 1,
                    num_penumbra_rays: 64,
                    cache_tolerance: 0.2,
                    noise: 0.1,
                },
                ..medium
            },
            Quality::Medium => medium,
            Quality::High => Self {
                threshold: 3e-4,
                hemicube_px: 128,
                hemisphere_rays: 4096,
                budget: MeshBudget { elements: 40_000.0, patches: 4_000.0 },
                refinement: Refinement { max_error: 0.02, min_edge: 1.0 / 16.0, max_growth: 8.0, ..medium.refinement },
                sampling: Sampling {
                    points_a_patch: 4,
                    points_an_element: 4,
                    num_penumbra_rays: 1024,
                    cache_tolerance: 0.06,
                    noise: 0.025,
                },
                ..medium
            },
        }
    }

    /// The sizes of elements and patches for a scene, metres.
    #[must_use]
    pub fn mesh_settings(&self, scene: &Scene) -> MeshSettings {
        let area = scene.area();
        let chosen = (area / (AREA_OF_ELEMENT * self.budget.elements)).sqrt() as f32;
        let element_size = self.element_size.unwrap_or(chosen);
        let patch_size = ((area / self.budget.patches).sqrt() as f32).max(element_size);
        MeshSettings { element_size, patch_size }
    }

    /// Approximate limit of the number of elements after subdivision.
    pub(in crate::bake) fn max_elements(&self, scene: &Scene) -> usize {
        let aim = self.budget.elements + ELEMENTS_A_TRIANGLE * scene.triangles.len() as f64;
        (f64::from(self.refinement.max_growth) * aim) as usize
    }

    /// Returns the settings of subdivision by direct light, before it is reflected.
    pub(in crate::bake) fn subdivision_by_direct(&self, scene: &Scene, sizes: &MeshSettings) -> SubdivisionSettings {
        let min_edge = self.refinement.min_edge * sizes.element_size;
        SubdivisionSettings {
            max_error: self.refinement.max_error,
            short_edge: 2.0 * min_edge,
            min_edge,
            max_elements: self.max_elements(scene),
        }
    }

    /// Returns the settings of the last subdivision, which follows all light. `by_direct` are those of subdivision by
    /// direct light.
    pub(in crate::bake) fn subdivision_by_all(
        &self,
        by_direct: SubdivisionSettings,
        sizes: &MeshSettings,
    ) -> SubdivisionSettings {
        SubdivisionSettings { min_edge: self.refinement.sharp_edge * sizes.element_size, ..by_direct }
    }

    /// Returns the settings of the final gather at vertices.
    pub(in crate::bake) fn final_gather(&self, sizes: &MeshSettings) -> FinalGatherSettings {
        FinalGatherSettings {
            tolerance: self.sampling.cache_tolerance,
            noise: self.sampling.noise,
            max_radius: MAX_RADIUS * sizes.element_size,
            near_field_reach: sizes.patch_size,
        }
    }

    /// Returns the settings of progressive refinement.
    pub(in crate::bake) fn progressive(&self) -> ProgressiveSettings {
        ProgressiveSettings {
            threshold: self.threshold,
            max_shots_a_patch: self.passes.unwrap_or(MAX_SHOTS_A_PATCH),
            points_a_patch: self.sampling.points_a_patch,
            patches_a_batch: 64,
            row_bytes: ROW_BYTES,
        }
    }
}

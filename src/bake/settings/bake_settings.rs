//! All numbers of a bake, and the sizes that they mean on a given scene.

use super::{Method, Quality, Solver};
use crate::patch::MeshSettings;
use crate::radiosity::adaptive_subdivision::SubdivisionSettings;
use crate::radiosity::gather::FinalGatherSettings;
use crate::radiosity::solver::progressive::ProgressiveSettings;
use crate::scene::Scene;

/// How a scene is baked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BakeSettings {
    /// The preset that the other values began as.
    pub quality: Quality,
    /// Longest element edge, metres; none: chosen from the scene's area.
    pub element_size: Option<f32>,
    /// How form factors are found; none: whatever is faster.
    pub method: Option<Method>,
    /// Width of the hemicubes that gather, pixels.
    pub hemicube_px: u32,
    /// Rays of the hemispheres that gather.
    pub hemisphere_rays: u32,
    /// Share of the first unshot power at which shooting ends.
    pub threshold: f32,
    /// How the system is solved.
    pub solver: Solver,
    /// Shots a patch, on average, after which shooting ends (none: 64), or passes of gathering (none: until nothing changes).
    pub passes: Option<usize>,
    /// Elements that a chosen element size aims at.
    pub target_elements: f64,
    /// Deviation from the mean of its ends at which an edge is halved, relative to the light there; 0 halves none.
    pub refine_error: f32,
    /// Shortest edges that halving makes before light is reflected, in element sizes.
    pub min_edge: f32,
    /// Shortest edges of hard shadows in the result, in element sizes.
    pub sharp_edge: f32,
    /// About the most elements, as a multiple of those aimed at and half of the input triangles.
    pub max_growth: f32,
    /// Patches that the patch size aims at.
    pub target_patches: f64,
    /// Hemicubes a patch.
    pub points_a_patch: usize,
    /// Error that vertices may make by borrowing gathered light from their neighbourhood.
    pub cache_tolerance: f32,
    /// Noise that gathering may leave at a vertex that others borrow from: standard deviation relative to the irradiance.
    pub noise: f32,
    /// Points of an element at which its direct light is found.
    pub points_an_element: usize,
    /// Rays a place and emitter in penumbrae.
    pub num_penumbra_rays: u32,
}

/// Rays a point and emitter in penumbrae where only the mean over a patch counts.
pub(in crate::bake) const PENUMBRA_RAYS_ON_ELEMENTS: u32 = 64;

/// Rays of the hemispheres that shoot.
pub(in crate::bake) const SHOOTING_RAYS: u32 = 512;

/// Farthest that gathered light is borrowed from, in element sizes.
const BORROW_REACH: f32 = 4.0;

/// Shots a patch, on average, after which shooting ends.
const MAX_SHOTS_A_PATCH: usize = 64;

/// Rows kept between shots.
pub(in crate::bake) const ROW_BYTES: usize = 1 << 30;

/// Mean area of an element in squares of the element size (bisection ends between 1/8 and 1/4).
const AREA_OF_ELEMENT: f64 = 0.18;

/// Elements that an input triangle is worth beyond those aimed at: what is modelled finely has edges that throw shadows.
const ELEMENTS_A_TRIANGLE: f64 = 0.5;

impl BakeSettings {
    /// The values of a preset.
    #[must_use]
    pub fn preset(quality: Quality) -> Self {
        let base = Self {
            quality,
            element_size: None,
            method: None,
            hemicube_px: 64,
            hemisphere_rays: 1024,
            threshold: 1e-3,
            solver: Solver::Progressive,
            passes: None,
            target_elements: 12_000.0,
            refine_error: 0.04,
            min_edge: 1.0 / 8.0,
            sharp_edge: 1.0 / 64.0,
            max_growth: 10.0,
            target_patches: 1_500.0,
            points_a_patch: 2,
            cache_tolerance: 0.1,
            noise: 0.05,
            points_an_element: 2,
            num_penumbra_rays: 256,
        };
        match quality {
            Quality::Draft => Self {
                hemicube_px: 32,
                hemisphere_rays: 256,
                threshold: 1e-2,
                target_elements: 6_000.0,
                refine_error: 0.1,
                min_edge: 1.0 / 4.0,
                sharp_edge: 1.0 / 8.0,
                max_growth: 3.0,
                target_patches: 500.0,
                points_a_patch: 1,
                cache_tolerance: 0.2,
                noise: 0.1,
                points_an_element: 1,
                num_penumbra_rays: 64,
                ..base
            },
            Quality::Medium => base,
            Quality::High => Self {
                hemicube_px: 128,
                hemisphere_rays: 4096,
                threshold: 3e-4,
                target_elements: 40_000.0,
                refine_error: 0.02,
                min_edge: 1.0 / 16.0,
                max_growth: 8.0,
                target_patches: 4_000.0,
                points_a_patch: 4,
                cache_tolerance: 0.06,
                noise: 0.025,
                points_an_element: 4,
                num_penumbra_rays: 1024,
                ..base
            },
        }
    }

    /// Sizes in metres on this scene.
    #[must_use]
    pub fn mesh_settings(&self, scene: &Scene) -> MeshSettings {
        let area = scene.area();
        let chosen = (area / (AREA_OF_ELEMENT * self.target_elements)).sqrt() as f32;
        let element_size = self.element_size.unwrap_or(chosen);
        let patch_size = ((area / self.target_patches).sqrt() as f32).max(element_size);
        MeshSettings { element_size, patch_size }
    }

    /// About the most elements that light may cut the scene into.
    pub(in crate::bake) fn max_elements(&self, scene: &Scene) -> usize {
        let aim = self.target_elements + ELEMENTS_A_TRIANGLE * scene.triangles.len() as f64;
        (f64::from(self.max_growth) * aim) as usize
    }

    /// How elements follow direct light before it is reflected.
    pub(in crate::bake) fn refine(&self, scene: &Scene, sizes: &MeshSettings) -> SubdivisionSettings {
        let min_edge = self.min_edge * sizes.element_size;
        SubdivisionSettings {
            max_error: self.refine_error,
            short_edge: 2.0 * min_edge,
            min_edge,
            max_elements: self.max_elements(scene),
        }
    }

    /// How they follow all light in the end, given how they followed direct light.
    pub(in crate::bake) fn sharpen(&self, refine: SubdivisionSettings, sizes: &MeshSettings) -> SubdivisionSettings {
        SubdivisionSettings { min_edge: self.sharp_edge * sizes.element_size, ..refine }
    }

    pub(in crate::bake) fn gather(&self, sizes: &MeshSettings) -> FinalGatherSettings {
        FinalGatherSettings {
            tolerance: self.cache_tolerance,
            noise: self.noise,
            max_radius: BORROW_REACH * sizes.element_size,
            near_field_reach: sizes.patch_size,
        }
    }

    pub(in crate::bake) fn progressive(&self) -> ProgressiveSettings {
        ProgressiveSettings {
            threshold: self.threshold,
            max_shots_a_patch: self.passes.unwrap_or(MAX_SHOTS_A_PATCH),
            points_a_patch: self.points_a_patch,
            patches_a_batch: 64,
            row_bytes: ROW_BYTES,
        }
    }
}

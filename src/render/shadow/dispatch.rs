//! Chooses the passes of each technique. No other file chooses by technique.

use super::light::pass_setup::PassSetup;
use super::light::shadow_pass::ShadowPass;
use super::light::unshadowed::UnshadowedLight;
use super::map::MapShadows;
use super::planar::PlanarShadows;
use super::raytraced::RaytracedLight;
use super::settings::ShadowSettings;
use super::shared::scene::ShadowScene;
use super::technique::ShadowTechnique;
use super::volume::{Counting, KnownFault, VolumeShadows, fault_of_counting};
use crate::gpu::Gpu;
use crate::render::View;

/// The passes of one technique.
pub enum TechniquePasses {
    /// Draws one light sample after the other.
    BySample(Box<dyn ShadowPass>),
    /// Traces rays to all light samples at once.
    ByRays(Box<RaytracedLight>),
}

/// Creates the passes of a technique.
pub fn passes_of(gpu: &Gpu, setup: &PassSetup, technique: ShadowTechnique) -> TechniquePasses {
    TechniquePasses::BySample(match technique {
        ShadowTechnique::None => Box::new(UnshadowedLight::new(gpu, setup)),
        ShadowTechnique::Map => Box::new(MapShadows::new(gpu, setup)),
        ShadowTechnique::VolumeDepthPass => Box::new(VolumeShadows::new(gpu, setup, Counting::DepthPass)),
        ShadowTechnique::VolumeDepthFail => Box::new(VolumeShadows::new(gpu, setup, Counting::DepthFail)),
        ShadowTechnique::Planar => Box::new(PlanarShadows::new(gpu, setup)),
        ShadowTechnique::Raytraced => {
            return TechniquePasses::ByRays(Box::new(RaytracedLight::new(gpu, &setup.frame_layout)));
        }
    })
}

/// Returns the known fault of the shadows with these settings from this view; `None` if none is known.
#[must_use]
pub fn known_fault(shadows: &ShadowScene, view: &View, settings: &ShadowSettings) -> Option<KnownFault> {
    let counting = match settings.technique {
        ShadowTechnique::VolumeDepthPass => Counting::DepthPass,
        ShadowTechnique::VolumeDepthFail => Counting::DepthFail,
        _ => return None,
    };
    fault_of_counting(shadows, view, counting, &settings.volumes, &settings.samples(shadows))
}

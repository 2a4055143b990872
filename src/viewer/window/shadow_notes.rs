//! Messages about known faults of the shadows in the current view.

use crate::render::shadow::KnownFault;
use crate::scene::Scene;

/// Returns the message about a fault.
#[must_use]
pub fn message_about(fault: KnownFault, scene: &Scene) -> String {
    let name = |lamp: usize| match scene.lights.get(lamp).map(|light| light.name.as_str()) {
        Some(name) if !name.is_empty() => name.to_owned(),
        _ => "a lamp".to_owned(),
    };
    match fault {
        KnownFault::EyeInVolume { lamp } => {
            format!("Depth-pass is wrong from here: the eye is in the shadow of {}", name(lamp))
        }
        KnownFault::NearPlaneCutsVolume { lamp } => {
            format!("Depth-pass is wrong from here: the near plane cuts the shadow of {}", name(lamp))
        }
        KnownFault::FarPlaneCutsVolumes => "Depth-fail is wrong: the far plane cuts shadow volumes".to_owned(),
    }
}

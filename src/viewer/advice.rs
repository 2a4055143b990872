//! What the loader and the mesh doctor say of a scene, and where it is.

use crate::base::bounds::Bounds;
use crate::scene::Scene;
use crate::scene::doctor::{self, Location};

/// Less than this much is never framed, metres: one wants to see what is around.
const SURROUNDINGS: f32 = 0.5;

/// Something that a user should know of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Advice {
    /// What was found; after a semicolon what to do.
    pub text: String,
    /// Where it is; empty where it has no place.
    pub places: Vec<Location>,
}

impl Advice {
    /// Advice without a place.
    #[must_use]
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into(), places: Vec::new() }
    }

    /// All that is to be said of a scene.
    #[must_use]
    pub fn of_scene(scene: &Scene) -> Vec<Self> {
        let notes = scene.notes.iter().map(Self::new);
        let findings = doctor::examine(scene).findings.into_iter();
        notes.chain(findings.map(|found| Self { text: found.line(), places: found.locations })).collect()
    }

    /// A box round one of the places, with some of its surroundings.
    #[must_use]
    pub fn bounds(&self, place: usize) -> Option<Bounds> {
        let Bounds { low, high } = Bounds::around(self.places.get(place)?.lines.iter().flatten().copied())?;
        Some(Bounds { low: low - SURROUNDINGS, high: high + SURROUNDINGS })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    #[test]
    fn what_is_wrong_has_a_place_to_go_to() {
        let mut scene = builtin::cornell();
        // A hole in the room.
        scene.triangles.remove(0);
        let advice = Advice::of_scene(&scene);
        let open = advice.iter().find(|advice| advice.text.contains("open edge")).expect("the hole is found");
        let bounds = open.bounds(0).expect("it has a place");
        assert!(bounds.size().min_element() >= 2.0 * SURROUNDINGS && bounds.low.is_finite(), "{bounds:?}");
        assert_eq!(Advice::new("no lights").bounds(0), None);
    }
}

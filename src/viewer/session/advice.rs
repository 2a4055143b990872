//! Advice about a scene from the loader and the mesh doctor, with its locations.

use crate::base::bounds::Bounds;
use crate::scene::Scene;
use crate::scene::doctor::{self, Location};

/// Margin round a framed location, metres.
const SURROUNDINGS: f32 = 0.5;

/// A piece of advice about a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Advice {
    /// The finding, a semicolon, and the remedy.
    pub text: String,
    /// Its locations, if it has any.
    pub locations: Vec<Location>,
}

impl Advice {
    /// Creates advice without a location.
    #[must_use]
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into(), locations: Vec::new() }
    }

    /// Returns all advice about a scene.
    #[must_use]
    pub fn of_scene(scene: &Scene) -> Vec<Self> {
        let notes = scene.notes.iter().map(Self::new);
        let findings = doctor::examine(scene).findings.into_iter();
        notes.chain(findings.map(|found| Self { text: found.line(), locations: found.locations })).collect()
    }

    /// Returns the bounding box of a location with a margin; `None` if there is no such location.
    #[must_use]
    pub fn bounds(&self, location: usize) -> Option<Bounds> {
        let Bounds { low, high } = Bounds::around(self.locations.get(location)?.lines.iter().flatten().copied())?;
        Some(Bounds { low: low - SURROUNDINGS, high: high + SURROUNDINGS })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    #[test]
    fn findings_have_locations() {
        let mut scene = builtin::cornell();
        // Removing a triangle makes a hole in the room.
        scene.triangles.remove(0);
        let advice = Advice::of_scene(&scene);
        let open = advice.iter().find(|advice| advice.text.contains("open edge")).expect("the hole is found");
        let bounds = open.bounds(0).expect("it has a location");
        assert!(bounds.size().min_element() >= 2.0 * SURROUNDINGS && bounds.low.is_finite(), "{bounds:?}");
        assert_eq!(Advice::new("no lights").bounds(0), None);
    }
}

//! Keeps the marks on the device until something about them changes.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::marks::{Marks, Wire};
use super::patch_sight::{PatchSight, heat};
use super::place::Place;
use crate::base::ids::{InstanceId, PatchId};
use crate::gpu::Gpu;
use crate::render::Overlay;

/// What is to be marked.
pub struct Wanted<'a> {
    /// Lines.
    pub wire: Wire,
    /// Chosen instances.
    pub chosen: BTreeSet<InstanceId>,
    /// Which advice is shown.
    pub found: Option<usize>,
    /// Whose form factors are shown.
    pub sight: Option<&'a Arc<PatchSight>>,
    /// Who shoots.
    pub shooter: Option<PatchId>,
}

/// What marks were made from: addresses stand for what they point to.
type Key = (usize, usize, Wire, BTreeSet<InstanceId>, Option<usize>, usize, Option<PatchId>);

/// The last marks.
#[derive(Default)]
pub struct MarksCache {
    last: Option<(Key, Option<Arc<Overlay>>)>,
}

impl MarksCache {
    /// The marks on the device; none where nothing is marked.
    pub fn overlay(&mut self, gpu: &Gpu, place: &Place, wanted: &Wanted<'_>) -> Option<Arc<Overlay>> {
        let scene = &place.mesh.scene;
        let address = |solved: &Arc<_>| Arc::as_ptr(solved) as usize;
        let key = (
            Arc::as_ptr(scene) as usize,
            place.solved.as_ref().map_or(0, address),
            wanted.wire,
            wanted.chosen.clone(),
            wanted.found,
            wanted.sight.map_or(0, |sight| Arc::as_ptr(sight) as usize),
            wanted.shooter,
        );
        if let Some((last, overlay)) = &self.last
            && *last == key
        {
            return overlay.clone();
        }
        let marks = marks(place, wanted);
        let overlay = (!marks.is_empty()).then(|| Arc::new(Overlay::new(gpu, &marks.lines, &marks.triangles)));
        self.last = Some((key, overlay.clone()));
        overlay
    }
}

fn marks(place: &Place, wanted: &Wanted<'_>) -> Marks {
    let (scene, solved) = (&place.mesh.scene, place.solved.as_deref());
    let mut marks = Marks::default();
    if let (Some(solved), Some(sight)) = (solved, wanted.sight) {
        marks.heat(&solved.baked.scene, &heat(solved, &sight.factors));
    }
    if let (Some(solved), Some(shooter)) = (solved, wanted.shooter) {
        marks.shooter(solved, shooter);
    }
    wanted.chosen.iter().for_each(|&chosen| marks.chosen(scene, chosen));
    marks.wire(wanted.wire, scene, solved);
    if let Some(advice) = wanted.found.and_then(|number| place.advice.get(number)) {
        marks.found(&advice.places);
    }
    marks
}

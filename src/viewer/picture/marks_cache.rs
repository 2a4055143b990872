//! Caches the marks on the device until they change.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::base::ids::{InstanceId, PatchId};
use crate::gpu::Gpu;
use crate::render::Overlay;
use crate::scene::Scene;
use crate::scene::doctor::Location;
use crate::viewer::picture::marks::Marks;
use crate::viewer::settings::view::Wire;
use crate::viewer::solution::patch_view::{ChosenPatchView, heat};
use crate::viewer::solution::solved::SolvedScene;

/// Selection of what is marked in the picture.
pub struct MarkSelection<'a> {
    /// The triangles that are drawn.
    pub scene: &'a Arc<Scene>,
    /// The solved light of the scene, if there is any.
    pub solved: Option<&'a Arc<SolvedScene>>,
    /// The wireframe.
    pub wire: Wire,
    /// Tinted instances.
    pub instances: BTreeSet<InstanceId>,
    /// Index and locations of the advice that is shown.
    pub advice: Option<(usize, &'a [Location])>,
    /// The view whose form factors are shown as a heat map.
    pub patch_view: Option<&'a Arc<ChosenPatchView>>,
    /// The shooting patch.
    pub shooter: Option<PatchId>,
}

/// Key of a [`MarkSelection`] in the cache. References are compared by their address.
type Key = (usize, usize, Wire, BTreeSet<InstanceId>, Option<usize>, usize, Option<PatchId>);

/// The last marks.
#[derive(Default)]
pub struct MarksCache {
    last: Option<(Key, Option<Arc<Overlay>>)>,
}

impl MarksCache {
    /// Returns the marks on the device; `None` if nothing is marked.
    pub fn overlay(&mut self, gpu: &Gpu, selection: &MarkSelection<'_>) -> Option<Arc<Overlay>> {
        let key = selection.key();
        if let Some((last, overlay)) = &self.last
            && *last == key
        {
            return overlay.clone();
        }
        let marks = selection.marks();
        let overlay = (!marks.is_empty()).then(|| Arc::new(Overlay::new(gpu, &marks.lines, &marks.triangles)));
        self.last = Some((key, overlay.clone()));
        overlay
    }
}

impl MarkSelection<'_> {
    fn key(&self) -> Key {
        (
            Arc::as_ptr(self.scene) as usize,
            self.solved.map_or(0, |solved| Arc::as_ptr(solved) as usize),
            self.wire,
            self.instances.clone(),
            self.advice.map(|(index, _)| index),
            self.patch_view.map_or(0, |view| Arc::as_ptr(view) as usize),
            self.shooter,
        )
    }

    fn marks(&self) -> Marks {
        let solved = self.solved.map(Arc::as_ref);
        let mut marks = Marks::default();
        if let (Some(solved), Some(view)) = (solved, self.patch_view) {
            marks.heat(&solved.baked.scene, &heat(solved, &view.factors));
        }
        if let (Some(solved), Some(shooter)) = (solved, self.shooter) {
            marks.shooter(solved, shooter);
        }
        self.instances.iter().for_each(|&instance| marks.chosen(self.scene, instance));
        marks.wire(self.wire, self.scene, solved);
        if let Some((_, locations)) = self.advice {
            marks.locations(locations);
        }
        marks
    }
}

//! Settings of planar shadows: what receives and throws them, and the cures for their faults.

use std::collections::BTreeSet;

use glam::Vec4;

use super::planes::{is_same_plane, plane_of};
use crate::base::ids::{InstanceId, TriangleId};
use crate::scene::Scene;

/// How planar shadows are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarSettings {
    /// How many of the largest planes receive shadows, if none are chosen.
    pub num_receivers: usize,
    /// Planes that are chosen to receive shadows, as `plane_of` returns them.
    pub receivers: Vec<Vec4>,
    /// Instances that are chosen to throw shadows; all do if this is empty.
    pub casters: BTreeSet<InstanceId>,
    /// Shadows end at the edge of their receiver (a stencil mark). If off, they stick out into the air.
    pub stays_on_receiver: bool,
    /// The stencil mark replaces the depth test. If off, shadows fight with their receivers for depth.
    pub is_free_of_depth: bool,
    /// Points under several casters are darkened once. If off, they are darkened twice.
    pub darkens_once: bool,
    /// Casters are clipped at the plane and at the height of the light. If off, those below the plane or above the
    /// light throw anti-shadows.
    pub clips_casters: bool,
}

impl Default for PlanarSettings {
    fn default() -> Self {
        Self {
            num_receivers: 8,
            receivers: Vec::new(),
            casters: BTreeSet::new(),
            stays_on_receiver: true,
            is_free_of_depth: true,
            darkens_once: true,
            clips_casters: true,
        }
    }
}

impl PlanarSettings {
    /// Adds the plane of a triangle to the chosen receivers, or removes it.
    pub fn toggle_receiver(&mut self, scene: &Scene, triangle: TriangleId) {
        let Some(plane) = plane_of(scene, triangle) else { return };
        let extent = scene.bounds().extent();
        let before = self.receivers.len();
        self.receivers.retain(|&chosen| !is_same_plane(chosen, plane, extent));
        if self.receivers.len() == before {
            self.receivers.push(plane);
        }
    }

    /// Adds an instance to the chosen casters, or removes it.
    pub fn toggle_caster(&mut self, instance: InstanceId) {
        if !self.casters.remove(&instance) {
            self.casters.insert(instance);
        }
    }
}

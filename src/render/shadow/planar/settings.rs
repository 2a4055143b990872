//! Settings of planar shadows: what receives and casts them, and the cures for their faults.

use std::collections::BTreeSet;

use glam::Vec4;

use super::planes::{is_same_plane, plane_of};
use crate::base::ids::{InstanceId, TriangleId};
use crate::scene::Scene;

/// Settings of planar shadows.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarSettings {
    /// Number of planes that receive shadows if none is chosen; the largest are taken.
    pub num_receivers: usize,
    /// Planes that are chosen to receive shadows, as `plane_of` returns them.
    pub receivers: Vec<Vec4>,
    /// Instances that are chosen to cast shadows. If this is empty, all instances do.
    pub casters: BTreeSet<InstanceId>,
    /// True if shadows end at the edge of their receiver (by a stencil mark). If false, they extend into the air.
    pub stays_on_receiver: bool,
    /// True if the stencil mark replaces the depth test. If false, shadows and their receivers fight for depth.
    pub is_free_of_depth: bool,
    /// True if points under several casters are darkened once. If false, they are darkened twice.
    pub darkens_once: bool,
    /// True if casters are clipped at the plane and at the height of the light. If false, casters below the plane or
    /// above the light cast anti-shadows.
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

//! An open scene: what is drawn of it, what the walker touches, and the light that is solved for it.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::Vec3;

use super::advice::Advice;
use super::camera::Eye;
use super::collider::Collider;
use super::panels::ReplaySettings;
use super::replay::Recording;
use super::solved::Solved;
use super::travel::Traveller;
use super::worker::{Loaded, Mesh};
use crate::bake::BakeSettings;
use crate::base::colour::luminance;
use crate::base::ids::InstanceId;
use crate::gpu::Gpu;
use crate::patch::MeshSettings;
use crate::render::LuxScale;
use crate::render::scene::SceneBuffers;
use crate::scene::Scene;

/// Shares of the vertices that a fitted scale leaves out below and above.
const FITTED: [f32; 2] = [0.05, 0.98];

/// An opened scene.
pub struct Place {
    /// As the file has it.
    pub scene: Arc<Scene>,
    /// What the walker touches.
    pub collider: Collider,
    /// The eye.
    pub traveller: Traveller,
    /// What is drawn.
    pub mesh: Mesh,
    /// Counts how often its light was renewed.
    pub light_version: u32,
    /// There is light to see by.
    pub is_lit: bool,
    /// Camera of the file that was visited last.
    pub camera: usize,
    /// The light, once it is solved.
    pub solved: Option<Arc<Solved>>,
    /// What the user should know, with what to do.
    pub advice: Vec<Advice>,
    /// What is left of the mesh when these are hidden.
    part: Option<(BTreeSet<InstanceId>, Arc<SceneBuffers>)>,
    /// The moment of a recorded bake that is on the device.
    replay: ReplaySettings,
}

impl Place {
    /// A scene that has been read, seen with `eye` or from where it is seen best.
    #[must_use]
    pub fn new(loaded: Loaded, eye: Option<Eye>) -> Self {
        let Loaded { scene, collider, mesh, solved, advice } = loaded;
        let traveller = eye.map_or_else(|| first_view(&scene, &collider), |eye| Traveller::new(eye, &collider));
        Self {
            is_lit: solved.as_ref().is_some_and(|solved| shines(solved)),
            scene,
            collider,
            traveller,
            mesh,
            light_version: 0,
            camera: 0,
            solved,
            advice,
            part: None,
            replay: ReplaySettings::default(),
        }
    }

    /// What bake settings mean on this scene.
    #[must_use]
    pub fn mesh_sizes(&self, settings: &BakeSettings) -> MeshSettings {
        settings.mesh_settings(&self.scene)
    }

    /// Nothing stands between the eye and a point.
    #[must_use]
    pub fn sees(&self, point: Vec3) -> bool {
        let eye = self.traveller.eye.position;
        let way = point - eye;
        let stops = |t| self.scene.material_of(t).double_sided;
        let met = self.collider.pick(eye, way, stops);
        met.is_none_or(|pick| (pick.point - eye).length() > 0.995 * way.length())
    }

    /// New light is on the device, and another mesh with it where there is one.
    pub fn light_up(&mut self, mesh: Option<Mesh>) {
        self.light_version += 1;
        if let Some(mesh) = mesh {
            (self.mesh, self.part, self.is_lit) = (mesh, None, true);
            // What was solved before is of another mesh.
            self.solved = None;
        }
    }

    /// The light is solved.
    pub fn settle(&mut self, solved: Arc<Solved>) {
        self.is_lit = shines(&solved);
        self.solved = Some(solved);
        self.replay = ReplaySettings::default();
    }

    /// What is drawn when these instances are hidden.
    #[must_use]
    pub fn shown(&mut self, gpu: &Gpu, hidden: &BTreeSet<InstanceId>) -> Arc<SceneBuffers> {
        if hidden.is_empty() {
            self.part = None;
            return Arc::clone(&self.mesh.buffers);
        }
        if let Some((last, buffers)) = &self.part
            && last == hidden
        {
            return Arc::clone(buffers);
        }
        let is_shown = |triangle: &crate::scene::Triangle| !hidden.contains(&triangle.instance);
        let buffers = Arc::new(self.mesh.buffers.part(gpu, &self.mesh.scene, is_shown));
        self.part = Some((hidden.clone(), Arc::clone(&buffers)));
        buffers
    }

    /// Brings the light of a moment of the recorded bake to the device, or the finished light back.
    pub fn show_moment(&mut self, gpu: &Gpu, wanted: ReplaySettings, recording: Option<&Recording>) {
        let Some(solved) = &self.solved else { return };
        let wanted = if wanted.is_on && recording.is_some() { wanted } else { ReplaySettings::default() };
        if wanted == self.replay {
            return;
        }
        match recording.and_then(|recording| recording.moments.get(wanted.moment)).filter(|_| wanted.is_on) {
            Some(moment) => self.mesh.buffers.set_light(gpu, &moment.light(solved, wanted.with_ambient)),
            None => self.mesh.buffers.set_light(gpu, &solved.baked.light),
        }
        self.replay = wanted;
        self.light_version += 1;
    }

    /// The scale that spans most of the light of the scene.
    #[must_use]
    pub fn fitted_scale(&self, scale: LuxScale) -> LuxScale {
        let Some(solved) = &self.solved else { return scale };
        let groups = &solved.baked.light.groups;
        let at = |v: usize| -> Vec3 { groups.iter().map(|group| group.direct[v] + group.indirect[v]).sum() };
        let mut lux: Vec<f32> = (0..solved.baked.scene.vertices.len()).map(|v| luminance(at(v))).collect();
        lux.retain(|lux| lux.is_finite() && *lux > 0.0);
        lux.sort_by(f32::total_cmp);
        let Some(last) = lux.len().checked_sub(1) else { return scale };
        let [low, high] = FITTED.map(|share| two_figures(lux[(share * last as f32) as usize]));
        LuxScale { low, high, ..scale }.in_order()
    }
}

/// A number rounded to two figures.
fn two_figures(value: f32) -> f32 {
    let unit = 10f32.powf(value.max(f32::MIN_POSITIVE).log10().floor() - 1.0);
    (value / unit).round() * unit
}

/// Some light arrives somewhere.
fn shines(solved: &Solved) -> bool {
    let groups = &solved.baked.light.groups;
    groups.iter().any(|group| group.direct.iter().chain(&group.indirect).any(|value| *value != Vec3::ZERO))
}

/// The first camera of the file, else a place from which all is in view.
fn first_view(scene: &Scene, collider: &Collider) -> Traveller {
    if let Some(camera) = scene.cameras.first() {
        return Traveller::new(Eye::from_camera(camera), collider);
    }
    const ASPECT: f32 = 16.0 / 9.0;
    let mut eye = Eye::looking_along(Vec3::ZERO, Vec3::new(-0.6, -0.45, -1.0));
    eye.frame(scene.bounds(), ASPECT);
    Traveller::new(eye, collider)
}

#[cfg(test)]
mod tests {
    use super::two_figures;

    #[test]
    fn two_figures_are_kept() {
        for (value, rounded) in [(1234.0, 1200.0), (0.0567, 0.057), (98.6, 99.0), (10.0, 10.0)] {
            assert!((two_figures(value) / rounded - 1.0).abs() < 1e-4, "{value}");
        }
    }
}

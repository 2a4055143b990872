//! An open scene: its triangles, the camera in it, and its light.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::Vec3;

use crate::bake::BakeSettings;
use crate::base::colour::luminance;
use crate::base::ids::InstanceId;
use crate::gpu::Gpu;
use crate::patch::MeshSettings;
use crate::render::LuxScale;
use crate::render::scene::SceneBuffers;
use crate::scene::Scene;
use crate::viewer::camera::collider::Collider;
use crate::viewer::camera::controller::CameraController;
use crate::viewer::camera::pose::CameraPose;
use crate::viewer::picture::uploaded_scene::UploadedScene;
use crate::viewer::session::advice::Advice;
use crate::viewer::session::user_event::LoadedScene;
use crate::viewer::settings::view::ReplaySettings;
use crate::viewer::solution::recording::Recording;
use crate::viewer::solution::solved::SolvedScene;

/// Quantiles of the illuminance at the ends of a fitted scale.
const FITTED: [f32; 2] = [0.05, 0.98];

/// An open scene.
pub struct OpenScene {
    /// The scene of the file.
    pub scene: Arc<Scene>,
    /// Its triangles for collision and picking.
    pub collider: Collider,
    /// The camera.
    pub controller: CameraController,
    /// What is drawn: the triangles of the file, or the elements of the bake.
    pub uploaded: UploadedScene,
    /// Version of the light on the device: it rises by one with each upload.
    pub light_version: u32,
    /// True if the scene has any light.
    pub is_lit: bool,
    /// Index of the camera of the file that was visited last.
    pub camera_index: usize,
    /// The solved light; `None` before the end of the bake.
    pub solved: Option<Arc<SolvedScene>>,
    /// Advice for the user.
    pub advice: Vec<Advice>,
    /// Cached buffers without the hidden instances.
    part: Option<(BTreeSet<InstanceId>, Arc<SceneBuffers>)>,
    /// The moment of the recording that is on the device.
    replay: ReplaySettings,
}

impl OpenScene {
    /// Opens a loaded scene. The camera starts at `pose` if given, else at the first camera of the file, else outside
    /// the scene.
    #[must_use]
    pub fn new(loaded: LoadedScene, pose: Option<CameraPose>) -> Self {
        let LoadedScene { scene, collider, uploaded, solved, advice } = loaded;
        let controller =
            pose.map_or_else(|| first_view(&scene, &collider), |pose| CameraController::new(pose, &collider));
        Self {
            is_lit: solved.as_ref().is_some_and(|solved| has_light(solved)),
            scene,
            collider,
            controller,
            uploaded,
            light_version: 0,
            camera_index: 0,
            solved,
            advice,
            part: None,
            replay: ReplaySettings::default(),
        }
    }

    /// Returns the mesh settings that follow from bake settings in this scene.
    #[must_use]
    pub fn mesh_sizes(&self, settings: &BakeSettings) -> MeshSettings {
        settings.mesh_settings(&self.scene)
    }

    /// Returns true if no surface hides `point` from the camera.
    #[must_use]
    pub fn sees(&self, point: Vec3) -> bool {
        let eye = self.controller.pose.position;
        let way = point - eye;
        let stops = |t| self.scene.material_of(t).double_sided;
        let met = self.collider.pick(eye, way, stops);
        met.is_none_or(|pick| (pick.point - eye).length() > 0.995 * way.length())
    }

    /// Shows new light that is on the device. Replaces the mesh if one is given.
    pub fn show_light(&mut self, mesh: Option<UploadedScene>) {
        self.light_version += 1;
        if let Some(mesh) = mesh {
            (self.uploaded, self.part, self.is_lit) = (mesh, None, true);
            // The solved light belongs to the previous mesh.
            self.solved = None;
        }
    }

    /// Sets the solved light.
    pub fn set_solved(&mut self, solved: Arc<SolvedScene>) {
        self.is_lit = has_light(&solved);
        self.solved = Some(solved);
        self.replay = ReplaySettings::default();
    }

    /// Returns the buffers to draw if these instances are hidden.
    #[must_use]
    pub fn visible_buffers(&mut self, gpu: &Gpu, hidden: &BTreeSet<InstanceId>) -> Arc<SceneBuffers> {
        if hidden.is_empty() {
            self.part = None;
            return Arc::clone(&self.uploaded.buffers);
        }
        if let Some((last, buffers)) = &self.part
            && last == hidden
        {
            return Arc::clone(buffers);
        }
        let is_shown = |triangle: &crate::scene::Triangle| !hidden.contains(&triangle.instance);
        let buffers = Arc::new(self.uploaded.buffers.part(gpu, &self.uploaded.scene, is_shown));
        self.part = Some((hidden.clone(), Arc::clone(&buffers)));
        buffers
    }

    /// Uploads the light of a moment of the recording, or the finished light if the recording is not shown.
    pub fn show_moment(&mut self, gpu: &Gpu, wanted: ReplaySettings, recording: Option<&Recording>) {
        let Some(solved) = &self.solved else { return };
        let wanted = if wanted.is_on && recording.is_some() { wanted } else { ReplaySettings::default() };
        if wanted == self.replay {
            return;
        }
        match recording.and_then(|recording| recording.moments.get(wanted.moment)).filter(|_| wanted.is_on) {
            Some(moment) => self.uploaded.buffers.set_light(gpu, &moment.light(solved, wanted.with_ambient)),
            None => self.uploaded.buffers.set_light(gpu, &solved.baked.light),
        }
        self.replay = wanted;
        self.light_version += 1;
    }

    /// Returns `scale` with limits that span most of the illuminance of the scene.
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

/// Rounds `value` to two significant figures.
fn two_figures(value: f32) -> f32 {
    let unit = 10f32.powf(value.max(f32::MIN_POSITIVE).log10().floor() - 1.0);
    (value / unit).round() * unit
}

/// Returns true if any vertex receives light.
fn has_light(solved: &SolvedScene) -> bool {
    let groups = &solved.baked.light.groups;
    groups.iter().any(|group| group.direct.iter().chain(&group.indirect).any(|value| *value != Vec3::ZERO))
}

/// Creates a camera at the first camera of the file; if there is none, outside, with the whole scene in view.
fn first_view(scene: &Scene, collider: &Collider) -> CameraController {
    if let Some(camera) = scene.cameras.first() {
        return CameraController::new(CameraPose::from_camera(camera), collider);
    }
    const ASPECT: f32 = 16.0 / 9.0;
    let mut pose = CameraPose::looking_along(Vec3::ZERO, Vec3::new(-0.6, -0.45, -1.0));
    pose.frame(scene.bounds(), ASPECT);
    CameraController::new(pose, collider)
}

#[cfg(test)]
mod tests {
    use super::two_figures;

    #[test]
    fn numbers_are_rounded_to_two_figures() {
        for (value, rounded) in [(1234.0, 1200.0), (0.0567, 0.057), (98.6, 99.0), (10.0, 10.0)] {
            assert!((two_figures(value) / rounded - 1.0).abs() < 1e-4, "{value}");
        }
    }
}

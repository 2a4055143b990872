//! Collects the facts that the panels show from the parts of the viewer.

use glam::Vec3;

use crate::bake::BakeSettings;
use crate::patch::MeshSettings;
use crate::viewer::drawing::canvas::Canvas;
use crate::viewer::job::{JobKind, Jobs};
use crate::viewer::panels::{BakeFacts, CameraFacts, MeasurementFacts, PictureFacts, SceneFacts, ShadowFacts};
use crate::viewer::session::Session;
use crate::viewer::session::open_scene::OpenScene;
use crate::viewer::window::pacing::Pacer;
use crate::viewer::window::picture_state::PictureState;
use crate::viewer::window::results::Results;

/// Returns the facts about the open scene.
pub fn of_scene(session: &Session) -> SceneFacts<'_> {
    let open_scene = session.open_scene.as_ref();
    SceneFacts {
        open: open_scene.map(|open_scene| &*open_scene.scene),
        variant: session.variant(),
        num_elements: session.num_elements(),
        advice: open_scene.map_or(&[], |open_scene| &open_scene.advice),
    }
}

/// Returns the facts about the light. `next` describes the next bake, `curve` the convergence of the last one.
pub fn of_bake<'a>(
    session: &'a Session,
    results: &'a Results,
    jobs: &Jobs,
    next: Option<(BakeSettings, MeshSettings)>,
    curve: &'a [[f32; 2]],
) -> BakeFacts<'a> {
    let solved = session.open_scene.as_ref().and_then(|open_scene| open_scene.solved.as_deref());
    BakeFacts {
        light: session.light_state(),
        is_solved: solved.is_some(),
        next,
        curve,
        report: solved.and_then(|solved| solved.report.as_ref()),
        recording: results.recording.as_deref(),
        is_recording: jobs.is_running(JobKind::Record),
    }
}

/// Returns the facts about the camera.
pub fn of_camera<'a>(
    open_scene: Option<&OpenScene>,
    is_captured: bool,
    bookmarks: Vec<u8>,
    is_visible: &'a dyn Fn(Vec3) -> bool,
) -> CameraFacts<'a> {
    let controller = open_scene.map(|open_scene| &open_scene.controller);
    CameraFacts {
        pose: controller.map(|controller| controller.pose),
        is_walking: controller.is_some_and(|controller| controller.is_walking()),
        speed: controller.map_or(0.0, |controller| controller.speed()),
        is_captured,
        bookmarks,
        is_visible,
    }
}

/// Returns the facts about the picture and the frames.
pub fn of_picture<'a>(picture: &PictureState, jobs: &Jobs, pacer: &Pacer, adapter: &'a str) -> PictureFacts<'a> {
    PictureFacts {
        size: picture.size,
        num_rays: picture.notes.num_rays,
        is_writing: jobs.is_running(JobKind::Write),
        frame_rate: pacer.frame_rate(),
        frame_seconds: pacer.frame_seconds(),
        adapter,
    }
}

/// Returns the facts about the shadows. `num_points`: samples per lamp that have been added up, and their final number.
pub fn of_shadows<'a>(picture: &'a PictureState, canvas: &'a Canvas, num_points: Option<[u32; 2]>) -> ShadowFacts<'a> {
    ShadowFacts {
        num_light_samples: picture.notes.num_light_samples,
        num_points,
        difference: canvas.difference(),
        fault: picture.notes.fault.as_deref(),
        laps: &canvas.laps().passes,
        has_device_clock: canvas.laps().is_of_device,
    }
}

/// Returns the facts about measurements.
pub fn of_measurement<'a>(results: &'a Results, jobs: &Jobs) -> MeasurementFacts<'a> {
    let measurements = &results.measurements;
    MeasurementFacts {
        last: measurements.last.as_ref(),
        pins: &measurements.pins,
        grid: measurements.grid.as_ref(),
        patch_view: results.patch_view.as_ref(),
        is_busy: jobs.is_running(JobKind::Measure),
    }
}

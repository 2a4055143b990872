//! Events that threads send to the window.

use std::sync::Arc;

use crate::scene::Scene;
use crate::viewer::camera::collider::Collider;
use crate::viewer::job::JobResult;
use crate::viewer::picture::uploaded_scene::UploadedScene;
use crate::viewer::session::advice::Advice;
use crate::viewer::solution::solved::SolvedScene;

/// An event that a thread sends to the window (the user event of winit).
pub enum UserEvent {
    /// Event of the worker of a run. Events of earlier runs are ignored.
    Worker {
        /// Number of the run.
        run: u32,
        /// The event.
        event: WorkerEvent,
    },
    /// A job has a result.
    Job {
        /// Number of the job.
        number: u32,
        /// The result.
        result: JobResult,
    },
    /// Another program has written the open file.
    FileChanged,
    /// Another program has written a shader.
    ShadersChanged,
}

/// An event of a worker.
pub enum WorkerEvent {
    /// The scene is loaded and on the device. It is dark unless the file is a bake.
    Loaded(Box<LoadedScene>),
    /// The elements of the bake are on the device, still dark.
    MeshUploaded(UploadedScene),
    /// Newer light of the bake is on the device.
    LightUpdated,
    /// The progress or the convergence curve has changed.
    Progress,
    /// The bake has ended; its light is on the device.
    Finished(Arc<SolvedScene>),
    /// Loading or baking has failed, with a message for the user.
    Failed(String),
}

/// A scene that has been loaded.
pub struct LoadedScene {
    /// The scene of the file.
    pub scene: Arc<Scene>,
    /// Triangles of the scene for collision and picking.
    pub collider: Collider,
    /// Triangles of the scene on the device.
    pub uploaded: UploadedScene,
    /// The light, if the file is a bake.
    pub solved: Option<Arc<SolvedScene>>,
    /// Advice for the user.
    pub advice: Vec<Advice>,
}

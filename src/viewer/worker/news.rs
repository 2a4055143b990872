//! What a worker is asked to do, and what it tells the window.

use std::sync::Arc;

use super::Source;
use crate::bake::BakeSettings;
use crate::render::ShadowScene;
use crate::render::scene::SceneBuffers;
use crate::scene::Scene;
use crate::viewer::advice::Advice;
use crate::viewer::collider::Collider;
use crate::viewer::errand::Finding;
use crate::viewer::solved::Solved;

/// What a worker is asked to do.
pub enum Job {
    /// Loads a scene in a material variant, and bakes it where it brings no light of its own.
    Open(Source, Option<String>, BakeSettings),
    /// Bakes a scene that is open (again).
    Bake(Arc<Scene>, BakeSettings),
}

/// A message of a thread to the window.
pub struct News {
    /// Number of the job, as it was given: news of an abandoned job are dropped.
    pub job: u32,
    /// What is new.
    pub event: Event,
}

/// What is new.
pub enum Event {
    /// The file is read; the mesh is on the device, still dark unless the file is a bake.
    Loaded(Box<Loaded>),
    /// The mesh that the light will be on is on the device, still dark.
    Mesh(Mesh),
    /// Brighter light is on the device.
    Light,
    /// The numbers of [`Worker::progress`](super::Worker::progress) have changed.
    Progress,
    /// The bake has ended; its light is on the device.
    Finished(Arc<Solved>),
    /// The job has failed, in words for the user.
    Failed(String),
    /// An errand, by its number, has brought something.
    Found(u32, Finding),
    /// The open file has been written by another program.
    FileChanged,
}

/// A mesh on the device.
#[derive(Clone)]
pub struct Mesh {
    /// Its triangles.
    pub scene: Arc<Scene>,
    /// On the device.
    pub buffers: Arc<SceneBuffers>,
    /// Its casters and lights.
    pub shadows: Arc<ShadowScene>,
}

/// A scene that has been read.
pub struct Loaded {
    /// As the file has it.
    pub scene: Arc<Scene>,
    /// What the walker touches.
    pub collider: Collider,
    /// The same, on the device.
    pub mesh: Mesh,
    /// The file is a bake, with this light: nothing is left to do.
    pub solved: Option<Arc<Solved>>,
    /// What a user should know of the scene, with what to do.
    pub advice: Vec<Advice>,
}

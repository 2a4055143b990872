//! Loads and bakes in a thread of its own, and tells the window what is new.
//!
//! The thread uploads meshes and light to the window's device itself, so that no frame has to wait for that. While the
//! window draws, it holds the work ([`Worker::hold`]); the work rests between two of its small steps.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use anyhow::Context;
use winit::event_loop::EventLoopProxy;

use super::collider::Collider;
use crate::bake::{Bake, BakeSettings, Watch, bake};
use crate::baked::{self, BakedScene, VertexLight};
use crate::base::progress::{Cancel, Gate, Progress, Stage};
use crate::gpu::{Gpu, SceneBuffers};
use crate::render::ShadowScene;
use crate::scene::{Scene, builtin, gltf};

/// The window hears of progress at most this often.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(250);

/// Where a scene comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A scene that the program makes, by name.
    BuiltIn(String),
    /// A glTF file.
    File(PathBuf),
}

impl Default for Source {
    /// The scene for a first look.
    fn default() -> Self {
        Self::BuiltIn(builtin::NAMES[0].to_owned())
    }
}

impl Source {
    /// A file, or `builtin:NAME`.
    #[must_use]
    pub fn of(path: PathBuf) -> Self {
        match path.to_str().and_then(|text| text.strip_prefix(builtin::PREFIX)) {
            Some(name) => Self::BuiltIn(name.to_owned()),
            None => Self::File(path),
        }
    }

    fn load(&self) -> anyhow::Result<Scene> {
        match self {
            Self::BuiltIn(name) => builtin::by_name(name).with_context(|| format!("there is no built-in scene {name}")),
            Self::File(path) => Ok(gltf::load(path)?),
        }
    }
}

/// What a worker is asked to do.
pub enum Job {
    /// Loads a scene, and bakes it where it brings no light of its own.
    Open(Source, BakeSettings),
    /// Bakes a scene that is open (again).
    Bake(Arc<Scene>, BakeSettings),
}

/// A message of a worker to the window.
pub struct News {
    /// Number of the job, as [`Worker::start`] was given it: news of an abandoned job are dropped.
    pub job: u32,
    /// What is new.
    pub event: Event,
}

/// What is new.
pub enum Event {
    /// The file is read; the mesh is on the device, still dark unless the file is a bake.
    Loaded(Box<Loaded>),
    /// The mesh that the light will be on is on the device, still dark.
    Mesh {
        /// On the device.
        buffers: Arc<SceneBuffers>,
        /// Its casters and lights.
        shadows: Arc<ShadowScene>,
        /// Triangles that receive light.
        num_elements: usize,
    },
    /// Brighter light is on the device.
    Light,
    /// The numbers of [`Worker::progress`] have changed.
    Progress,
    /// The bake has ended; its light is on the device.
    Finished(Box<Bake>),
    /// The job has failed, in words for the user.
    Failed(String),
}

/// A scene that has been read.
pub struct Loaded {
    /// As the file has it.
    pub scene: Arc<Scene>,
    /// What the walker touches.
    pub collider: Collider,
    /// On the device.
    pub buffers: Arc<SceneBuffers>,
    /// Its casters and lights.
    pub shadows: Arc<ShadowScene>,
    /// The file is a bake: nothing is left to do.
    pub is_baked: bool,
}

/// A job that runs.
pub struct Worker {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

/// What the window and the thread both touch.
struct Shared {
    gate: Gate,
    cancel: Cancel,
    /// Stage and its done share.
    progress: Mutex<(Stage, f32)>,
    /// From when on new light is welcome; none while the last is not on the screen.
    light_wanted: Mutex<Option<Instant>>,
}

/// Holds the work until it is dropped.
pub struct Held(Arc<Shared>);

impl Drop for Held {
    fn drop(&mut self) {
        self.0.gate.open();
    }
}

impl Worker {
    /// Starts a thread for `job`; `gpu` is the window's device.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn start(number: u32, job: Job, gpu: Arc<Gpu>, window: EventLoopProxy<News>) -> anyhow::Result<Self> {
        let shared = Arc::new(Shared {
            gate: Gate::default(),
            cancel: Cancel::default(),
            progress: Mutex::new((Stage::Load, 0.0)),
            light_wanted: Mutex::new(Some(Instant::now())),
        });
        let runner =
            Runner { number, gpu, window, shared: Arc::clone(&shared), mesh: OnceLock::new(), told: Mutex::new(None) };
        let thread = std::thread::Builder::new().name("bake".to_owned()).spawn(move || runner.run(job));
        Ok(Self { shared, thread: Some(thread.context("cannot start the bake")?) })
    }

    /// Stage and its done share, 0..1.
    #[must_use]
    pub fn progress(&self) -> (Stage, f32) {
        *lock(&self.shared.progress)
    }

    /// Asks the work to end soon and to keep what is solved.
    pub fn cancel(&self) {
        self.shared.cancel.cancel();
    }

    /// The end has been asked for.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.shared.cancel.is_cancelled()
    }

    /// The thread has ended.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// The last light is on the screen; the next one is welcome after `pause`.
    pub fn ask_for_light(&self, pause: Duration) {
        lock(&self.shared.light_wanted).get_or_insert_with(|| Instant::now() + pause);
    }

    /// The work rests until the result is dropped.
    #[must_use]
    pub fn hold(&self) -> Held {
        self.shared.gate.close();
        Held(Arc::clone(&self.shared))
    }
}

impl Drop for Worker {
    /// Waits for the thread: a device must not be torn down while it works.
    fn drop(&mut self) {
        self.cancel();
        self.shared.gate.open();
        if let Some(thread) = self.thread.take() {
            // A panic of the thread has been printed already.
            let _ = thread.join();
        }
    }
}

/// The thread's side.
struct Runner {
    number: u32,
    gpu: Arc<Gpu>,
    window: EventLoopProxy<News>,
    shared: Arc<Shared>,
    mesh: OnceLock<Arc<SceneBuffers>>,
    /// When the window last heard of progress.
    told: Mutex<Option<Instant>>,
}

impl Runner {
    fn run(&self, job: Job) {
        let outcome = match job {
            Job::Open(source, settings) => self.open(&source, &settings),
            Job::Bake(scene, settings) => self.bake(&scene, &settings),
        };
        if let Err(error) = outcome {
            self.tell(Event::Failed(format!("{error:#}")));
        }
    }

    fn open(&self, source: &Source, settings: &BakeSettings) -> anyhow::Result<()> {
        let (baked, is_baked) = match baked::gltf::from_scene(source.load()?) {
            Ok(baked) => (baked, true),
            Err(scene) => (dark(scene), false),
        };
        let collider = Collider::new(&baked.scene);
        let buffers = Arc::new(SceneBuffers::new(&self.gpu, &baked));
        let scene = Arc::new(baked.scene);
        let shadows = Arc::new(ShadowScene::new(&self.gpu, Arc::clone(&scene)));
        let loaded = Loaded { scene: Arc::clone(&scene), collider, buffers, shadows, is_baked };
        self.tell(Event::Loaded(Box::new(loaded)));
        if is_baked { Ok(()) } else { self.bake(&scene, settings) }
    }

    fn bake(&self, scene: &Scene, settings: &BakeSettings) -> anyhow::Result<()> {
        let gpu = Gpu::headless()?;
        let done = bake(Some(&gpu), scene, settings, self)?;
        log::info!("the bake has ended");
        if let Some(mesh) = self.mesh.get() {
            mesh.set_light(&self.gpu, &done.baked.light);
        }
        self.tell(Event::Finished(Box::new(done)));
        Ok(())
    }

    fn tell(&self, event: Event) {
        // Nobody listens once the window is closed.
        let _ = self.window.send_event(News { job: self.number, event });
    }
}

/// The values behind a lock are whole at any time: a thread that panicked leaves nothing half done.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A scene as the file has it, without any light.
fn dark(scene: Scene) -> BakedScene {
    let light = VertexLight::dark(scene.light_groups.len(), scene.vertices.len());
    BakedScene { scene, light }
}

impl Progress for Runner {
    fn report(&self, stage: Stage, done: f32) {
        *lock(&self.shared.progress) = (stage, done);
        let mut told = lock(&self.told);
        if told.is_none_or(|at| at.elapsed() >= PROGRESS_INTERVAL) {
            *told = Some(Instant::now());
            self.tell(Event::Progress);
        }
    }

    fn is_cancelled(&self) -> bool {
        self.shared.cancel.is_cancelled()
    }

    fn rest(&self) {
        self.shared.gate.pass();
    }
}

impl Watch for Runner {
    fn mesh(&self, dark: &BakedScene) {
        let buffers = Arc::new(SceneBuffers::new(&self.gpu, dark));
        let shadows = Arc::new(ShadowScene::new(&self.gpu, Arc::new(dark.scene.clone())));
        let num_elements = dark.scene.triangles.len();
        self.tell(Event::Mesh { buffers: Arc::clone(&buffers), shadows, num_elements });
        // The recipe hands out one mesh only; a second would find the first in place.
        let _ = self.mesh.set(buffers);
    }

    fn wants_light(&self) -> bool {
        lock(&self.shared.light_wanted).is_some_and(|from| from <= Instant::now())
    }

    fn light(&self, estimate: &VertexLight) {
        if let Some(mesh) = self.mesh.get() {
            *lock(&self.shared.light_wanted) = None;
            mesh.set_light(&self.gpu, estimate);
            self.tell(Event::Light);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shared() -> Arc<Shared> {
        Arc::new(Shared {
            gate: Gate::default(),
            cancel: Cancel::default(),
            progress: Mutex::new((Stage::Load, 0.0)),
            light_wanted: Mutex::new(None),
        })
    }

    #[test]
    fn work_rests_while_it_is_held_and_goes_on_afterwards() {
        let shared = shared();
        let worker = Worker { shared: Arc::clone(&shared), thread: None };
        let held = worker.hold();
        let (told, done) = std::sync::mpsc::channel();
        let work = std::thread::spawn(move || {
            shared.gate.pass();
            told.send(()).expect("somebody listens");
        });
        assert!(done.recv_timeout(Duration::from_millis(50)).is_err(), "the gate let it pass");
        drop(held);
        assert!(done.recv_timeout(Duration::from_secs(5)).is_ok());
        work.join().expect("no panic");
    }

    #[test]
    fn a_worker_that_is_dropped_ends_its_thread_even_while_it_is_held() {
        let shared = shared();
        let for_thread = Arc::clone(&shared);
        let thread = std::thread::spawn(move || {
            while !for_thread.cancel.is_cancelled() {
                for_thread.gate.pass();
                std::thread::yield_now();
            }
        });
        let worker = Worker { shared, thread: Some(thread) };
        std::mem::forget(worker.hold());
        drop(worker);
    }

    #[test]
    fn a_name_after_builtin_is_no_file() {
        assert_eq!(Source::of("builtin:cornell".into()), Source::BuiltIn("cornell".into()));
        assert_eq!(Source::of("rooms/hall.glb".into()), Source::File("rooms/hall.glb".into()));
        let message = Source::BuiltIn("castle".into()).load().map(|scene| scene.name).unwrap_err().to_string();
        assert!(message.contains("castle"), "{message}");
    }
}

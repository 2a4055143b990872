//! The worker's thread: loads a scene, uploads it, bakes it.

use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use winit::event_loop::EventLoopProxy;

use super::shared::{Shared, lock};
use crate::bake::{BakeContext, BakeObserver, BakeSettings, Method, bake_with};
use crate::baked::{self, BakedScene, VertexLight};
use crate::base::progress::{Progress, Stage};
use crate::gpu::Gpu;
use crate::render::ShadowScene;
use crate::render::scene::SceneBuffers;
use crate::scene::Scene;
use crate::viewer::camera::collider::Collider;
use crate::viewer::picture::uploaded_scene::UploadedScene;
use crate::viewer::session::advice::Advice;
use crate::viewer::session::default_sky;
use crate::viewer::session::source::Source;
use crate::viewer::session::user_event::{LoadedScene, UserEvent, WorkerEvent};
use crate::viewer::solution::solved::SolvedScene;

/// Shortest time between two events about progress.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(250);

/// The task of a worker.
pub enum Task {
    /// Loads a scene in a material variant, and bakes it if it has no light.
    Open(Source, Option<String>, BakeSettings),
    /// Bakes the open scene.
    Bake(Arc<Scene>, BakeSettings),
}

/// The worker as seen from its own thread.
pub(super) struct Runner {
    run: u32,
    /// The window's device.
    gpu: Arc<Gpu>,
    window: EventLoopProxy<UserEvent>,
    shared: Arc<Shared>,
    /// The elements of the bake on the device.
    elements: Mutex<Option<Arc<SceneBuffers>>>,
    /// When the last event about progress was sent.
    last_progress: Mutex<Option<Instant>>,
}

impl Runner {
    pub fn new(run: u32, gpu: Arc<Gpu>, window: EventLoopProxy<UserEvent>, shared: Arc<Shared>) -> Self {
        Self { run, gpu, window, shared, elements: Mutex::default(), last_progress: Mutex::default() }
    }

    pub fn run(&self, task: Task) {
        let outcome = match task {
            Task::Open(source, variant, settings) => self.open(&source, variant, &settings),
            Task::Bake(scene, settings) => self.bake(&scene, &settings),
        };
        if let Err(error) = outcome {
            self.send(WorkerEvent::Failed(format!("{error:#}")));
        }
    }

    fn open(&self, source: &Source, variant: Option<String>, settings: &BakeSettings) -> anyhow::Result<()> {
        let mut scene = source.load(variant)?;
        let mut advice = Advice::of_scene(&scene);
        if default_sky::is_needed(&scene) {
            default_sky::add(&mut scene);
            advice.insert(0, Advice::new(default_sky::NOTE));
        }
        let (baked, is_baked) = match baked::gltf::from_scene(scene) {
            Ok(baked) => (baked, true),
            Err(scene) => (BakedScene::dark(scene), false),
        };
        let collider = Collider::new(&baked.scene);
        let uploaded = self.uploaded(&baked, || {});
        let solved = is_baked.then(|| SolvedScene::of_file(baked).map(Arc::new)).transpose()?;
        let scene = Arc::clone(&uploaded.scene);
        let loaded = LoadedScene { scene: Arc::clone(&scene), collider, uploaded, solved, advice };
        self.send(WorkerEvent::Loaded(Box::new(loaded)));
        if is_baked { Ok(()) } else { self.bake(&scene, settings) }
    }

    fn bake(&self, scene: &Arc<Scene>, settings: &BakeSettings) -> anyhow::Result<()> {
        self.shared.set_threshold(settings.threshold);
        // Hemicubes are drawn on a second device, so that frames do not wait for them. The default method on a software
        // driver is the hemisphere, which needs no device.
        let needs_device = !self.gpu.tier.is_software() || settings.method == Some(Method::Hemicube);
        let gpu = needs_device.then(Gpu::headless).transpose()?;
        let done = bake_with(scene, settings, &BakeContext { gpu: gpu.as_ref(), row_cache: None, observer: self })?;
        log::info!("the bake has ended");
        if let Some(elements) = &*lock(&self.elements) {
            elements.set_light_in_parts(&self.gpu, &done.baked.light, || self.rest());
        }
        self.send(WorkerEvent::Finished(Arc::new(SolvedScene::of_bake(Arc::clone(scene), done, settings))));
        Ok(())
    }

    /// Uploads a scene in two steps, with `pause` between them.
    fn uploaded(&self, baked: &BakedScene, pause: impl FnOnce()) -> UploadedScene {
        let buffers = Arc::new(SceneBuffers::new(&self.gpu, baked));
        let scene = Arc::new(baked.scene.clone());
        pause();
        let shadows = Arc::new(ShadowScene::new(&self.gpu, Arc::clone(&scene)));
        UploadedScene { scene, buffers, shadows }
    }

    fn send(&self, event: WorkerEvent) {
        // The event loop is gone once the window is closed.
        let _ = self.window.send_event(UserEvent::Worker { run: self.run, event });
    }
}

impl Progress for Runner {
    fn report(&self, stage: Stage, done: f32) {
        self.shared.report(stage, done);
        let mut last = lock(&self.last_progress);
        if last.is_none_or(|at| at.elapsed() >= PROGRESS_INTERVAL) {
            *last = Some(Instant::now());
            self.send(WorkerEvent::Progress);
        }
    }

    fn is_cancelled(&self) -> bool {
        self.shared.cancel.is_cancelled()
    }

    fn rest(&self) {
        self.shared.gate.pass();
    }
}

impl BakeObserver for Runner {
    fn on_mesh(&self, dark: &BakedScene) {
        self.rest();
        let uploaded = self.uploaded(dark, || self.rest());
        // Starts the upload now instead of with the next frame.
        self.gpu.queue.submit([]);
        let elements = Arc::clone(&uploaded.buffers);
        self.send(WorkerEvent::MeshUploaded(uploaded));
        *lock(&self.elements) = Some(elements);
    }

    fn is_light_due(&self) -> bool {
        self.shared.is_light_due()
    }

    fn on_light(&self, estimate: &VertexLight) {
        if let Some(elements) = &*lock(&self.elements) {
            self.shared.wait_for_window();
            elements.set_light_in_parts(&self.gpu, estimate, || self.rest());
            self.send(WorkerEvent::LightUpdated);
        }
    }
}

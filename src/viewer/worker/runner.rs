//! The thread that loads and bakes.

use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use winit::event_loop::EventLoopProxy;

use super::news::{Event, Job, Loaded, Mesh, News};
use super::{Shared, Source, lock};
use crate::bake::{BakeSettings, Method, Watch, bake};
use crate::baked::{self, BakedScene, VertexLight};
use crate::base::progress::{Progress, Stage};
use crate::gpu::Gpu;
use crate::render::ShadowScene;
use crate::render::scene::SceneBuffers;
use crate::scene::Scene;
use crate::viewer::advice::Advice;
use crate::viewer::collider::Collider;
use crate::viewer::default_sky;
use crate::viewer::solved::Solved;

/// The window hears of progress at most this often.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(250);

/// The thread's side of a worker.
pub struct Runner {
    pub number: u32,
    /// The window's device.
    pub gpu: Arc<Gpu>,
    pub window: EventLoopProxy<News>,
    pub shared: Arc<Shared>,
    pub mesh: Mutex<Option<Arc<SceneBuffers>>>,
    /// When the window last heard of progress.
    pub told: Mutex<Option<Instant>>,
}

impl Runner {
    pub fn run(&self, job: Job) {
        let outcome = match job {
            Job::Open(source, variant, settings) => self.open(&source, variant, &settings),
            Job::Bake(scene, settings) => self.bake(&scene, &settings),
        };
        if let Err(error) = outcome {
            self.tell(Event::Failed(format!("{error:#}")));
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
        let buffers = Arc::new(SceneBuffers::new(&self.gpu, &baked));
        let scene = Arc::new(baked.scene.clone());
        let shadows = Arc::new(ShadowScene::new(&self.gpu, Arc::clone(&scene)));
        let mesh = Mesh { scene: Arc::clone(&scene), buffers, shadows };
        let solved = is_baked.then(|| Solved::of_file(baked).map(Arc::new)).transpose()?;
        self.tell(Event::Loaded(Box::new(Loaded { scene: Arc::clone(&scene), collider, mesh, solved, advice })));
        if is_baked { Ok(()) } else { self.bake(&scene, settings) }
    }

    fn bake(&self, scene: &Arc<Scene>, settings: &BakeSettings) -> anyhow::Result<()> {
        *lock(&self.shared.threshold) = settings.threshold;
        // A device of its own, so that frames do not wait; rays, which a software driver is too slow for, need none.
        let is_drawn = !self.gpu.is_software() || settings.method == Some(Method::Hemicube);
        let gpu = is_drawn.then(Gpu::headless).transpose()?;
        let done = bake(gpu.as_ref(), scene, settings, self)?;
        log::info!("the bake has ended");
        if let Some(mesh) = &*lock(&self.mesh) {
            mesh.set_light_in_parts(&self.gpu, &done.baked.light, || self.rest());
        }
        self.tell(Event::Finished(Arc::new(Solved::of_bake(Arc::clone(scene), done, settings))));
        Ok(())
    }

    fn tell(&self, event: Event) {
        // Nobody listens once the window is closed.
        let _ = self.window.send_event(News { job: self.number, event });
    }
}

impl Progress for Runner {
    fn report(&self, stage: Stage, done: f32) {
        self.shared.report(stage, done);
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
        self.rest();
        let buffers = Arc::new(SceneBuffers::new(&self.gpu, dark));
        let scene = Arc::new(dark.scene.clone());
        self.rest();
        let shadows = Arc::new(ShadowScene::new(&self.gpu, Arc::clone(&scene)));
        // On its way now, and not with the next frame.
        self.gpu.queue.submit([]);
        self.tell(Event::Mesh(Mesh { scene, buffers: Arc::clone(&buffers), shadows }));
        *lock(&self.mesh) = Some(buffers);
    }

    fn wants_light(&self) -> bool {
        lock(&self.shared.light_wanted).is_some_and(|from| from <= Instant::now())
    }

    fn light(&self, estimate: &VertexLight) {
        if let Some(mesh) = &*lock(&self.mesh) {
            *lock(&self.shared.light_wanted) = None;
            mesh.set_light_in_parts(&self.gpu, estimate, || self.rest());
            self.tell(Event::Light);
        }
    }
}

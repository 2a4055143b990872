//! What is open: a scene, its light on the device, the traveller in it, and the worker that loads and bakes it.

use std::sync::Arc;
use std::time::Instant;

use glam::Vec3;
use winit::event_loop::EventLoopProxy;

use super::bake_worker::{Event, Job, Loaded, News, Source, Worker};
use super::camera::Eye;
use super::collider::Collider;
use super::panels::LightState;
use super::travel::Traveller;
use crate::bake::{Bake, BakeSettings};
use crate::base::progress::Stage;
use crate::gpu::{Gpu, SceneBuffers};
use crate::render::ShadowScene;
use crate::scene::Scene;

/// An opened scene.
pub struct Place {
    /// As the file has it.
    pub scene: Arc<Scene>,
    /// What the walker touches.
    pub collider: Collider,
    /// The eye.
    pub traveller: Traveller,
    /// On the device.
    pub buffers: Arc<SceneBuffers>,
    /// Its casters and lights.
    pub shadows: Arc<ShadowScene>,
    /// Counts how often their light was renewed.
    pub light_version: u32,
    /// There is light to see by.
    pub is_lit: bool,
    /// Camera of the file that was visited last.
    pub camera: usize,
}

/// What is open, and what is being done about it.
pub struct Session {
    gpu: Arc<Gpu>,
    window: EventLoopProxy<News>,
    /// None until the first scene is read.
    pub place: Option<Place>,
    worker: Option<Worker>,
    /// Ended or asked to end; dropped when they have.
    retired: Vec<Worker>,
    job: u32,
    began: Instant,
    /// A mesh that waits for its first light before it is shown.
    coming: Option<(Arc<SceneBuffers>, Arc<ShadowScene>)>,
    num_elements: Option<usize>,
    outcome: LightState,
}

/// What the user should hear about.
pub enum Outcome {
    /// Nothing to say; the picture has changed.
    Changed,
    /// A scene has been opened.
    Opened,
    /// A line that goes away.
    Note(String),
    /// Something did not work: what, and why.
    Trouble(String, String),
}

impl Session {
    /// Nothing is open; `gpu` is the window's device.
    #[must_use]
    pub fn new(gpu: Arc<Gpu>, window: EventLoopProxy<News>) -> Self {
        Self {
            gpu,
            window,
            place: None,
            worker: None,
            retired: Vec::new(),
            job: 0,
            began: Instant::now(),
            coming: None,
            num_elements: None,
            outcome: LightState::Nothing,
        }
    }

    /// Reads a scene and bakes it; the one that is open stays until the new one is read.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn open(&mut self, source: Source, settings: BakeSettings) -> anyhow::Result<()> {
        self.start(Job::Open(source, settings))
    }

    /// Bakes the open scene anew; a file that is a bake stays as it is.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn bake(&mut self, settings: BakeSettings) -> anyhow::Result<()> {
        match &self.place {
            Some(place) if self.outcome != LightState::Stored => {
                self.start(Job::Bake(Arc::clone(&place.scene), settings))
            }
            _ => Ok(()),
        }
    }

    fn start(&mut self, job: Job) -> anyhow::Result<()> {
        self.retire();
        self.job += 1;
        self.began = Instant::now();
        self.coming = None;
        self.worker = Some(Worker::start(self.job, job, Arc::clone(&self.gpu), self.window.clone())?);
        Ok(())
    }

    fn retire(&mut self) {
        self.retired.retain(|worker| !worker.is_finished());
        if let Some(worker) = self.worker.take() {
            worker.cancel();
            self.retired.push(worker);
        }
    }

    /// The worker, while it loads or bakes.
    #[must_use]
    pub fn worker(&self) -> Option<&Worker> {
        self.worker.as_ref()
    }

    /// Where the light stands.
    #[must_use]
    pub fn light_state(&self) -> LightState {
        match &self.worker {
            Some(worker) => {
                let (stage, done) = worker.progress();
                let is_cancelled = worker.is_cancelled();
                LightState::Working { stage, done, elapsed: self.began.elapsed(), is_cancelled }
            }
            None => self.outcome.clone(),
        }
    }

    /// Triangles that carry light; none before they are known.
    #[must_use]
    pub fn num_elements(&self) -> Option<usize> {
        self.num_elements
    }

    /// Takes in what the worker tells.
    pub fn hear(&mut self, news: News) -> Outcome {
        if news.job != self.job {
            return Outcome::Changed;
        }
        match news.event {
            Event::Loaded(loaded) => self.enter(*loaded),
            Event::Mesh { buffers, shadows, num_elements } => {
                self.coming = Some((buffers, shadows));
                self.num_elements = Some(num_elements);
                Outcome::Changed
            }
            Event::Light => {
                self.light_up();
                Outcome::Changed
            }
            Event::Progress => Outcome::Changed,
            Event::Finished(bake) => self.finish(&bake),
            Event::Failed(message) => self.fail(message),
        }
    }

    fn enter(&mut self, loaded: Loaded) -> Outcome {
        let Loaded { scene, collider, buffers, shadows, is_baked } = loaded;
        let traveller = first_view(&scene, &collider);
        self.num_elements = is_baked.then_some(scene.triangles.len());
        self.outcome = if is_baked { LightState::Stored } else { LightState::Dark };
        let (light_version, camera) = (0, 0);
        let is_lit = is_baked;
        self.place = Some(Place { scene, collider, traveller, buffers, shadows, light_version, is_lit, camera });
        if is_baked {
            self.retire();
        }
        Outcome::Opened
    }

    /// Shows the light that has just come, the first time with the mesh that it is on.
    fn light_up(&mut self) {
        let Some(place) = &mut self.place else { return };
        place.light_version += 1;
        if let Some((buffers, shadows)) = self.coming.take() {
            (place.buffers, place.shadows, place.is_lit) = (buffers, shadows, true);
        }
    }

    fn finish(&mut self, bake: &Bake) -> Outcome {
        self.light_up();
        let elapsed = self.began.elapsed();
        let was_cancelled = self.worker.as_ref().is_some_and(Worker::is_cancelled);
        self.outcome = LightState::Baked {
            elapsed,
            unshot_share: bake.report.unshot_share,
            num_hemicubes: bake.report.hemicubes,
            num_patches: bake.report.patches,
        };
        self.retire();
        let unshot = 100.0 * bake.report.unshot_share;
        Outcome::Note(if was_cancelled {
            format!("Bake ended early: {unshot:.1} % of the light is not shot")
        } else {
            format!("Light solved in {:.1} s", elapsed.as_secs_f32())
        })
    }

    fn fail(&mut self, message: String) -> Outcome {
        let was_loading = matches!(self.light_state(), LightState::Working { stage: Stage::Load, .. });
        self.retire();
        self.coming = None;
        let title = if was_loading { "This file cannot be opened" } else { "The bake has failed" };
        Outcome::Trouble(title.to_owned(), message)
    }
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

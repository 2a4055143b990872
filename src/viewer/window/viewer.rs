//! Everything that lives as long as the window.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::event_loop::EventLoopProxy;
use winit::window::Window;

use crate::bake::BakeSettings;
use crate::viewer::camera::pose::CameraPose;
use crate::viewer::job::Jobs;
use crate::viewer::options::ViewerOptions;
use crate::viewer::panels::{Notice, Panels, Trouble};
use crate::viewer::preferences::Preferences;
use crate::viewer::session::Session;
use crate::viewer::session::file_watch::FileWatch;
use crate::viewer::session::open_scene::OpenScene;
use crate::viewer::session::source::Source;
use crate::viewer::session::user_event::UserEvent;
use crate::viewer::solution::solved::SolvedScene;
use crate::viewer::window::gui::Gui;
use crate::viewer::window::input::Controls;
use crate::viewer::window::pacing::Pacer;
use crate::viewer::window::picture_state::{PictureNotes, PictureState};
use crate::viewer::window::results::Results;
use crate::viewer::window::surface::WindowSurface;

/// Shortest time between two writes of the preferences.
const SAVE_INTERVAL: Duration = Duration::from_secs(2);

/// Everything that lives as long as the window.
pub struct Viewer {
    pub window: Arc<Window>,
    pub surface: WindowSurface,
    pub gui: Gui,
    pub panels: Panels,
    pub session: Session,
    pub controls: Controls,
    pub pacer: Pacer,
    pub picture: PictureState,
    pub jobs: Jobs,
    pub results: Results,
    /// Name of the graphics adapter.
    pub adapter: String,
    /// Bake settings from the command line.
    given_settings: BakeSettings,
    saved: SavedPreferences,
    /// Watches the files of the shaders.
    pub shader_watch: Option<FileWatch>,
    /// Error after which the window cannot draw.
    pub failure: Option<anyhow::Error>,
}

/// The preferences that were written last.
struct SavedPreferences {
    preferences: Preferences,
    at: Instant,
}

impl Viewer {
    /// Opens the device and begins to load the scene.
    ///
    /// # Errors
    /// Returns an error if no graphics device can draw into the window, no thread can be started, or the frame log
    /// cannot be written.
    pub fn new(window: Arc<Window>, options: &ViewerOptions, proxy: EventLoopProxy<UserEvent>) -> anyhow::Result<Self> {
        let surface = WindowSurface::new(&window)?;
        let gui = Gui::new(&window, surface.gpu.device.limits().max_texture_dimension_2d);
        let refresh_rate = window.current_monitor().and_then(|monitor| monitor.refresh_rate_millihertz());
        let pacer = Pacer::new(refresh_rate.map_or(60.0, |rate| rate as f32 / 1e3), options.frame_log.as_deref())?;
        let job_events = proxy.clone();
        let jobs = Jobs::new(move |number, result| {
            // The event loop is gone once the window is closed.
            let _ = job_events.send_event(UserEvent::Job { number, result });
        });
        let mut session = Session::new(Arc::clone(&surface.gpu), proxy);
        let source = options.scene.clone().map_or_else(Source::default, Source::of);
        session.open(source, options.variant.clone(), options.settings)?;
        let preferences = Preferences::path().map_or_else(Preferences::default, |path| Preferences::read(&path));
        Ok(Self {
            adapter: surface.gpu.name(),
            picture: PictureState::new(surface.size()),
            saved: SavedPreferences { preferences: preferences.clone(), at: Instant::now() },
            panels: Panels::new(options.settings.quality, preferences),
            given_settings: options.settings,
            window,
            surface,
            gui,
            session,
            controls: Controls::default(),
            pacer,
            jobs,
            results: Results::default(),
            shader_watch: None,
            failure: None,
        })
    }

    /// Returns what is needed to open the same scene again: the window, the options, and the pose of the camera.
    pub fn reopening(&self, options: &ViewerOptions) -> (Arc<Window>, ViewerOptions, Option<CameraPose>) {
        let scene = Some(self.session.name());
        let variant = self.session.variant().map(str::to_owned);
        let options = ViewerOptions { scene, variant, settings: self.next_settings(), ..options.clone() };
        let pose = self.session.open_scene.as_ref().map(|open_scene| open_scene.controller.pose);
        (Arc::clone(&self.window), options, pose)
    }

    /// Restores the pose of the camera after the loss of a device, and shows a message with the reason.
    pub fn after_loss(mut self, error: &anyhow::Error, pose: Option<CameraPose>) -> Self {
        self.session.keep_pose(pose);
        self.notify(format!("The graphics device was lost and has been replaced: {error:#}"));
        self
    }

    /// Returns the settings of the next bake: those of the command line, or another preset if the user has chosen one.
    pub fn next_settings(&self) -> BakeSettings {
        let is_as_given = self.panels.quality == self.given_settings.quality;
        if is_as_given { self.given_settings } else { BakeSettings::preset(self.panels.quality) }
    }

    /// Returns the solved light of the open scene.
    pub fn solved(&self) -> Option<Arc<SolvedScene>> {
        self.session.open_scene.as_ref()?.solved.clone()
    }

    /// Returns the exposure that was metered for the last picture, stops.
    pub fn metered_ev(&self) -> Option<f32> {
        self.surface.canvas.metered_ev(&self.surface.gpu)
    }

    /// Shows a notice that disappears after a while.
    pub fn notify(&mut self, text: impl Into<String>) {
        self.panels.notice = Some(Notice::new(text));
    }

    /// Shows a message about a failure until the user closes it.
    pub fn show_trouble(&mut self, title: impl Into<String>, text: impl Into<String>) {
        self.panels.trouble = Some(Trouble::new(title, text));
    }

    /// Shows a message if `outcome` is an error.
    pub fn report(&mut self, outcome: anyhow::Result<()>) {
        if let Err(error) = outcome {
            self.show_trouble("This did not work", format!("{error:#}"));
        }
    }

    /// Shows the path of a file that has been written, or a message about the failure.
    pub fn report_written(&mut self, written: anyhow::Result<PathBuf>) {
        match written {
            Ok(path) => self.notify(format!("Written: {}", path.display())),
            Err(error) => self.report(Err(error)),
        }
    }

    /// Ends all jobs and drops their results. Called when the light that they were computed from is replaced.
    pub fn discard_results(&mut self) {
        self.jobs.end_all();
        self.panels.replay = Default::default();
        self.results = Results::default();
        self.picture.notes = PictureNotes::default();
    }

    /// Updates title, panels and preferences for a scene that has been opened.
    pub fn on_scene_opened(&mut self) {
        self.discard_results();
        let Some(OpenScene { scene, advice, .. }) = &self.session.open_scene else { return };
        self.window.set_title(&format!("{} - Hemicube", scene.name));
        self.panels.light.reset_groups(scene);
        self.panels.selection = Default::default();
        self.panels.shown_advice = None;
        self.panels.trouble = None;
        let sky = advice.first().filter(|advice| advice.text == crate::viewer::session::DEFAULT_SKY_NOTE);
        if let Some(note) = sky.map(|advice| advice.text.clone()) {
            self.notify(note);
        }
        let name = self.session.name();
        if matches!(Source::of(name.clone()), Source::File(_)) {
            self.panels.preferences.add_recent(&name);
        }
        self.save_preferences();
    }

    /// Writes the preferences if they have changed, at most every two seconds.
    pub fn save_changed_preferences(&mut self) {
        if self.saved.at.elapsed() > SAVE_INTERVAL && self.saved.preferences != self.panels.preferences {
            self.save_preferences();
        }
    }

    fn save_preferences(&mut self) {
        if let Some(path) = Preferences::path() {
            self.panels.preferences.write(&path);
        }
        self.saved = SavedPreferences { preferences: self.panels.preferences.clone(), at: Instant::now() };
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        self.save_preferences();
    }
}

//! Hot reload of shaders. A change of their files shows in the next frame. If a shader is invalid, its error is shown
//! and the old shaders stay in use.

use std::path::PathBuf;

use winit::event_loop::EventLoopProxy;

use crate::viewer::panels::Trouble;
use crate::viewer::session::file_watch::FileWatch;
use crate::viewer::session::user_event::UserEvent;
use crate::viewer::window::viewer::Viewer;

/// Title of the message about an error.
const TITLE: &str = "A shader has an error: the last valid shaders stay in use";

impl Viewer {
    /// Reads shaders from `folder` from now on, and again whenever a file there changes.
    pub fn watch_shaders(&mut self, folder: PathBuf, proxy: EventLoopProxy<UserEvent>) {
        self.surface.gpu.shaders.read_from(folder.clone());
        self.shader_watch = FileWatch::start(folder, proxy, || UserEvent::ShadersChanged);
        self.reload_shaders();
    }

    /// Reads the shader files again. If all are valid and one has changed, rebuilds everything that draws.
    pub fn reload_shaders(&mut self) {
        match self.surface.gpu.shaders.reload() {
            Ok(has_changed) => {
                if self.panels.trouble.as_ref().is_some_and(|trouble| trouble.title == TITLE) {
                    self.panels.trouble = None;
                }
                if has_changed {
                    self.surface.renew_canvas();
                    if let Some(open_scene) = &mut self.session.open_scene {
                        open_scene.uploaded.forget_drawn(&self.surface.gpu);
                    }
                    self.notify("Shaders reloaded");
                }
            }
            Err(message) => self.panels.trouble = Some(Trouble::of_code(TITLE, message)),
        }
        self.pacer.request();
    }
}

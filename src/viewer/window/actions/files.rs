//! Opens scenes.

use std::path::PathBuf;

use crate::viewer::panels::OpenDialog;
use crate::viewer::session::source::Source;
use crate::viewer::window::viewer::Viewer;

impl Viewer {
    /// Opens a file.
    pub fn open_file(&mut self, path: PathBuf) {
        self.notify(format!("Opening {}", path.display()));
        self.open_source(Source::of(path));
    }

    pub(super) fn open_source(&mut self, source: Source) {
        let outcome = self.session.open(source, None, self.next_settings());
        self.report(outcome);
    }

    /// Loads the open file again and shows `why`.
    pub fn reload(&mut self, why: &str) {
        self.notify(why);
        let outcome = self.session.reload(self.next_settings());
        self.report(outcome);
    }

    /// Opens the dialog that chooses a file, in the folder of the last file.
    pub(super) fn choose_file(&mut self) {
        let last = self.panels.preferences.recent.first().and_then(|path| path.parent().map(PathBuf::from));
        let folder = last.filter(|folder| folder.is_dir()).unwrap_or_else(|| PathBuf::from("."));
        self.controls.mouse.set_free(&self.window);
        self.panels.dialog = Some(OpenDialog::new(&folder));
    }
}

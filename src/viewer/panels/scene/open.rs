//! The dialog that opens a file, and the list of recent files.

use std::path::{Path, PathBuf};

use egui::{Align2, Id, Role, ScrollArea, TextEdit, Ui};

use super::super::chrome::widgets::{hint, named, wide_button};
use crate::scene::builtin;
use crate::viewer::action::Action;

/// Largest number of listed entries of a folder.
const MAX_ENTRIES: usize = 2000;

/// The open dialog: a folder and its scene files.
pub struct OpenDialog {
    /// Text of the input line: a folder, or a file.
    path: String,
    folder: PathBuf,
    entries: Vec<Entry>,
}

struct Entry {
    name: String,
    is_folder: bool,
}

impl OpenDialog {
    /// Creates a dialog that shows this folder.
    #[must_use]
    pub fn new(folder: &Path) -> Self {
        let folder = std::fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        Self { path: folder.display().to_string(), entries: entries(&folder), folder }
    }

    fn enter(&mut self, folder: &Path) {
        *self = Self::new(folder);
    }
}

/// Lists the folders, then the scene files, each sorted by name.
fn entries(folder: &Path) -> Vec<Entry> {
    let found = std::fs::read_dir(folder).into_iter().flatten().flatten().take(MAX_ENTRIES);
    let mut entries: Vec<Entry> = found
        .filter_map(|entry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            let is_folder = entry.path().is_dir();
            let is_scene = Path::new(&name)
                .extension()
                .is_some_and(|e| e.eq_ignore_ascii_case("glb") || e.eq_ignore_ascii_case("gltf"));
            (!name.starts_with('.') && (is_folder || is_scene)).then_some(Entry { name, is_folder })
        })
        .collect();
    entries.sort_by_key(|entry| (!entry.is_folder, entry.name.to_lowercase()));
    entries
}

pub fn open_ui(ctx: &egui::Context, dialog: &mut Option<OpenDialog>, actions: &mut Vec<Action>) {
    let Some(open) = dialog else { return };
    let mut is_open = true;
    let mut chosen = None;
    let window = egui::Window::new("Open a scene").id(Id::unique("open")).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).default_width(460.0).open(&mut is_open).show(ctx, |ui| {
        chosen = dialog_ui(ui, open);
    });
    if let Some(path) = chosen {
        actions.push(Action::Open(path));
        is_open = false;
    }
    if !is_open {
        *dialog = None;
    }
}

/// Lays out the contents of the dialog. Returns the chosen file.
fn dialog_ui(ui: &mut Ui, open: &mut OpenDialog) -> Option<PathBuf> {
    let line = ui.add(TextEdit::singleline(&mut open.path).desired_width(f32::INFINITY));
    named(&line, Role::TextInput, "Path");
    let is_entered = line.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
    if is_entered {
        let typed = PathBuf::from(open.path.trim());
        if typed.is_dir() {
            open.enter(&typed);
        } else {
            return Some(typed);
        }
    }
    let mut chosen = list_ui(ui, open);
    hint(ui, "FILE#NAME opens one of several scenes in a file.");
    ui.horizontal(|ui| {
        for name in builtin::NAMES {
            if ui.button(format!("Built-in {name}")).clicked() {
                chosen = Some(PathBuf::from(format!("{}{name}", builtin::PREFIX)));
            }
        }
    });
    chosen
}

fn list_ui(ui: &mut Ui, open: &mut OpenDialog) -> Option<PathBuf> {
    let mut next = None;
    ScrollArea::vertical().max_height(260.0).min_scrolled_height(260.0).auto_shrink([false, true]).show(ui, |ui| {
        if let Some(parent) = open.folder.parent()
            && ui.selectable_label(false, "..  (one folder up)").clicked()
        {
            next = Some(parent.to_owned());
        }
        for entry in &open.entries {
            let name = if entry.is_folder { format!("{}/", entry.name) } else { entry.name.clone() };
            if ui.selectable_label(false, name).clicked() {
                next = Some(open.folder.join(&entry.name));
            }
        }
        if open.entries.is_empty() {
            hint(ui, "No folders and no .glb or .gltf files here.");
        }
    });
    let next = next?;
    if next.is_dir() {
        open.enter(&next);
        return None;
    }
    Some(next)
}

pub fn recent_ui(ui: &mut Ui, recent: &[PathBuf], actions: &mut Vec<Action>) {
    if wide_button(
        ui,
        "Read the file again",
        true,
        "Keeps the camera (F5); happens automatically when the file changes",
    ) {
        actions.push(Action::Reload);
    }
    for path in recent {
        let name = path.file_name().map_or(path.to_string_lossy(), |name| name.to_string_lossy());
        let button = egui::Button::new(name.as_ref()).truncate();
        let response = ui.vertical_centered_justified(|ui| ui.add(button)).inner;
        if response.on_hover_text(path.display().to_string()).clicked() {
            actions.push(Action::Open(path.clone()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_come_first_and_other_files_are_not_listed() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::create_dir(folder.path().join("rooms")).expect("made");
        for name in ["b.glb", "A.GLTF", "notes.txt", ".hidden.glb"] {
            std::fs::write(folder.path().join(name), "").expect("written");
        }
        let names: Vec<_> = entries(folder.path()).into_iter().map(|entry| entry.name).collect();
        assert_eq!(names, ["rooms", "A.GLTF", "b.glb"]);
        assert!(entries(Path::new("/no/such/folder")).is_empty());
    }
}

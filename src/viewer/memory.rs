//! What the window remembers between runs: one small file in the user's configuration folder.
//!
//! A file that cannot be read is as good as none, and one that cannot be written is no reason to bother anybody.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::camera::Eye;
use super::marks::Wire;
use super::output::PictureSettings;
use super::panels::Tab;
use crate::base::output::write_whole;
use crate::render::LuxScale;

/// Files that are remembered.
const MAX_RECENT: usize = 8;
/// Scenes whose bookmarks are remembered.
const MAX_PLACES: usize = 64;

/// What is remembered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Memory {
    /// Files opened last, the newest first.
    pub recent: Vec<PathBuf>,
    /// The first start has explained itself.
    pub has_seen_tour: bool,
    /// The side panel is shown.
    pub is_open: bool,
    /// The page that it shows.
    pub tab: Tab,
    /// Sections of the side panel that are unfolded or not, by title.
    pub sections: BTreeMap<String, bool>,
    /// Scale of false colours.
    pub lux_scale: LuxScale,
    /// Wire over the picture.
    pub wire: Wire,
    /// A still camera traces rays.
    pub traces_stills: bool,
    /// Large pictures.
    pub picture: PictureSettings,
    /// Bookmarks of each scene, by its file.
    pub bookmarks: BTreeMap<PathBuf, Bookmarks>,
}

/// Views that number keys come back to.
pub type Bookmarks = BTreeMap<u8, Bookmark>;

/// A view.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bookmark {
    position: [f32; 3],
    yaw: f32,
    pitch: f32,
    fov_y: f32,
}

impl Default for Memory {
    fn default() -> Self {
        Self {
            recent: Vec::new(),
            has_seen_tour: false,
            is_open: true,
            tab: Tab::Picture,
            sections: BTreeMap::new(),
            lux_scale: LuxScale::default(),
            wire: Wire::None,
            traces_stills: false,
            picture: PictureSettings::default(),
            bookmarks: BTreeMap::new(),
        }
    }
}

impl From<&Eye> for Bookmark {
    fn from(eye: &Eye) -> Self {
        Self { position: eye.position.to_array(), yaw: eye.yaw, pitch: eye.pitch, fov_y: eye.fov_y }
    }
}

impl Bookmark {
    /// The eye that was marked.
    #[must_use]
    pub fn eye(&self) -> Eye {
        Eye { position: Vec3::from_array(self.position), yaw: self.yaw, pitch: self.pitch, fov_y: self.fov_y }
    }

    fn is_sound(&self) -> bool {
        self.eye().position.is_finite()
            && self.yaw.is_finite()
            && self.pitch.abs() < 1.57
            && (0.01..3.1).contains(&self.fov_y)
    }
}

impl Memory {
    /// Where it is kept; none where the system has no such place.
    #[must_use]
    pub fn place() -> Option<PathBuf> {
        Some(dirs::config_dir()?.join("hemicube").join("viewer.json"))
    }

    /// What is remembered in a file; nothing where there is none or it makes no sense.
    #[must_use]
    pub fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let mut memory: Self = serde_json::from_str(&text).unwrap_or_default();
        memory.lux_scale = memory.lux_scale.in_order();
        memory.picture.size = memory.picture.size.map(|side| side.clamp(1, 16_384));
        for bookmarks in memory.bookmarks.values_mut() {
            bookmarks.retain(|_, bookmark| bookmark.is_sound());
        }
        memory
    }

    /// Writes it down.
    pub fn write(&self, path: &Path) {
        let written = path.parent().map_or(Ok(()), std::fs::create_dir_all).and_then(|()| {
            let text = serde_json::to_vec_pretty(self).map_err(std::io::Error::other)?;
            write_whole(path, &text)
        });
        if let Err(error) = written {
            log::info!("{}: {error}", path.display());
        }
    }

    /// A file has been opened.
    pub fn opened(&mut self, path: &Path) {
        self.recent.retain(|other| other != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(MAX_RECENT);
    }

    /// Marks a view of a scene under a number.
    pub fn mark(&mut self, scene: &Path, number: u8, eye: &Eye) {
        if !self.bookmarks.contains_key(scene) && self.bookmarks.len() >= MAX_PLACES {
            self.bookmarks.pop_first();
        }
        self.bookmarks.entry(scene.to_owned()).or_default().insert(number, eye.into());
    }

    /// Numbers of the views of a scene that are marked.
    #[must_use]
    pub fn bookmarks_of(&self, scene: &Path) -> Vec<u8> {
        self.bookmarks.get(scene).map(|bookmarks| bookmarks.keys().copied().collect()).unwrap_or_default()
    }

    /// The view of a scene under a number.
    #[must_use]
    pub fn marked(&self, scene: &Path, number: u8) -> Option<Eye> {
        Some(self.bookmarks.get(scene)?.get(&number)?.eye())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_remembered() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("deep").join("viewer.json");
        assert_eq!(Memory::read(&path), Memory::default());
        let mut memory = Memory { has_seen_tour: true, wire: Wire::Patches, ..Memory::default() };
        memory.opened(Path::new("hall.glb"));
        let eye = Eye::looking_along(Vec3::new(1.0, 2.0, 3.0), Vec3::X);
        memory.mark(Path::new("hall.glb"), 3, &eye);
        memory.write(&path);
        let read = Memory::read(&path);
        assert_eq!(read, memory);
        assert_eq!(read.marked(Path::new("hall.glb"), 3), Some(eye));
        assert_eq!(read.marked(Path::new("hall.glb"), 4), None);
    }

    #[test]
    fn nonsense_is_forgotten() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("viewer.json");
        for text in ["", "{", "[1]", r#"{"recent": 7}"#] {
            std::fs::write(&path, text).expect("written");
            assert_eq!(Memory::read(&path), Memory::default(), "{text}");
        }
        let wild = r#"{"lux_scale": {"low": 9.0, "high": -1.0, "is_logarithmic": true, "num_parts": 3},
            "bookmarks": {"a.glb": {"1": {"position": [0, 0, 0], "yaw": 0, "pitch": 9, "fov_y": 1}}}}"#;
        std::fs::write(&path, wild).expect("written");
        let memory = Memory::read(&path);
        assert!(memory.lux_scale.high > memory.lux_scale.low);
        assert_eq!(memory.marked(Path::new("a.glb"), 1), None);
    }

    #[test]
    fn the_newest_file_comes_first_and_old_ones_go() {
        let mut memory = Memory::default();
        for name in ["a", "b", "a"] {
            memory.opened(Path::new(name));
        }
        assert_eq!(memory.recent, [PathBuf::from("a"), PathBuf::from("b")]);
        (0..20).for_each(|i| memory.opened(&PathBuf::from(i.to_string())));
        assert_eq!(memory.recent.len(), MAX_RECENT);
    }
}

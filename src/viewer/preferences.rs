//! Preferences, which are stored between runs in a JSON file in the user's configuration folder.
//!
//! A file that cannot be read counts as empty. A failure to write is only logged.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::base::output::write_whole;
use crate::render::LuxScale;
use crate::viewer::camera::pose::CameraPose;
use crate::viewer::settings::picture_file::PictureSettings;
use crate::viewer::settings::view::{Tab, Wire};

/// Largest number of recent files.
const MAX_RECENT: usize = 8;
/// Largest number of scenes with bookmarks.
const MAX_SCENES: usize = 64;

/// Preferences and recent files of the user. The names of the fields are those of the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Recent files, the newest first.
    pub recent: Vec<PathBuf>,
    /// True if the tour of the first start has been closed.
    pub has_seen_tour: bool,
    /// True if the side panel is shown.
    pub is_open: bool,
    /// The page of the side panel.
    pub tab: Tab,
    /// True for each section of the side panel that is unfolded, by title.
    pub sections: BTreeMap<String, bool>,
    /// Scale of the false colours.
    pub lux_scale: LuxScale,
    /// The wireframe over the picture.
    pub wire: Wire,
    /// True if the view is traced while the camera rests.
    pub traces_stills: bool,
    /// Settings of large pictures.
    pub picture: PictureSettings,
    /// Bookmarks of each scene, by its name.
    pub bookmarks: BTreeMap<PathBuf, Bookmarks>,
}

/// The views of a scene by number key.
pub type Bookmarks = BTreeMap<u8, Bookmark>;

/// A stored view.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bookmark {
    position: [f32; 3],
    yaw: f32,
    pitch: f32,
    fov_y: f32,
}

impl Default for Preferences {
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

impl From<&CameraPose> for Bookmark {
    fn from(pose: &CameraPose) -> Self {
        Self { position: pose.position.to_array(), yaw: pose.yaw, pitch: pose.pitch, fov_y: pose.fov_y }
    }
}

impl Bookmark {
    /// Returns the pose of the camera.
    #[must_use]
    pub fn pose(&self) -> CameraPose {
        CameraPose { position: Vec3::from_array(self.position), yaw: self.yaw, pitch: self.pitch, fov_y: self.fov_y }
    }

    fn is_valid(&self) -> bool {
        self.pose().position.is_finite()
            && self.yaw.is_finite()
            && self.pitch.abs() < 1.57
            && (0.01..3.1).contains(&self.fov_y)
    }
}

impl Preferences {
    /// Returns the path of the file; `None` if the system has no configuration folder.
    #[must_use]
    pub fn path() -> Option<PathBuf> {
        Some(dirs::config_dir()?.join("hemicube").join("viewer.json"))
    }

    /// Reads a file. Returns the defaults if there is none or it is not valid. Values out of range are corrected.
    #[must_use]
    pub fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let mut preferences: Self = serde_json::from_str(&text).unwrap_or_default();
        preferences.lux_scale = preferences.lux_scale.in_order();
        preferences.picture.size = preferences.picture.size.map(|side| side.clamp(1, 16_384));
        for bookmarks in preferences.bookmarks.values_mut() {
            bookmarks.retain(|_, bookmark| bookmark.is_valid());
        }
        preferences
    }

    /// Writes the file. Failures are logged.
    pub fn write(&self, path: &Path) {
        let written = path.parent().map_or(Ok(()), std::fs::create_dir_all).and_then(|()| {
            let text = serde_json::to_vec_pretty(self).map_err(std::io::Error::other)?;
            write_whole(path, &text)
        });
        if let Err(error) = written {
            log::info!("{}: {error}", path.display());
        }
    }

    /// Puts a file at the head of the recent files.
    pub fn add_recent(&mut self, path: &Path) {
        self.recent.retain(|other| other != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(MAX_RECENT);
    }

    /// Sets the bookmark `number` of a scene.
    pub fn set_bookmark(&mut self, scene: &Path, number: u8, pose: &CameraPose) {
        if !self.bookmarks.contains_key(scene) && self.bookmarks.len() >= MAX_SCENES {
            self.bookmarks.pop_first();
        }
        self.bookmarks.entry(scene.to_owned()).or_default().insert(number, pose.into());
    }

    /// Returns the numbers of the bookmarks of a scene.
    #[must_use]
    pub fn bookmarks_of(&self, scene: &Path) -> Vec<u8> {
        self.bookmarks.get(scene).map(|bookmarks| bookmarks.keys().copied().collect()).unwrap_or_default()
    }

    /// Returns the pose of the bookmark `number` of a scene.
    #[must_use]
    pub fn bookmark(&self, scene: &Path, number: u8) -> Option<CameraPose> {
        Some(self.bookmarks.get(scene)?.get(&number)?.pose())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("deep").join("viewer.json");
        assert_eq!(Preferences::read(&path), Preferences::default());
        let mut preferences = Preferences { has_seen_tour: true, wire: Wire::Patches, ..Preferences::default() };
        preferences.add_recent(Path::new("hall.glb"));
        let pose = CameraPose::looking_along(Vec3::new(1.0, 2.0, 3.0), Vec3::X);
        preferences.set_bookmark(Path::new("hall.glb"), 3, &pose);
        preferences.write(&path);
        let read = Preferences::read(&path);
        assert_eq!(read, preferences);
        assert_eq!(read.bookmark(Path::new("hall.glb"), 3), Some(pose));
        assert_eq!(read.bookmark(Path::new("hall.glb"), 4), None);
    }

    #[test]
    fn invalid_files_and_values_are_ignored() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("viewer.json");
        for text in ["", "{", "[1]", r#"{"recent": 7}"#] {
            std::fs::write(&path, text).expect("written");
            assert_eq!(Preferences::read(&path), Preferences::default(), "{text}");
        }
        let wild = r#"{"lux_scale": {"low": 9.0, "high": -1.0, "is_logarithmic": true, "num_parts": 3},
            "bookmarks": {"a.glb": {"1": {"position": [0, 0, 0], "yaw": 0, "pitch": 9, "fov_y": 1}}}}"#;
        std::fs::write(&path, wild).expect("written");
        let preferences = Preferences::read(&path);
        assert!(preferences.lux_scale.high > preferences.lux_scale.low);
        assert_eq!(preferences.bookmark(Path::new("a.glb"), 1), None);
    }

    #[test]
    fn the_newest_file_is_first_and_old_ones_are_dropped() {
        let mut preferences = Preferences::default();
        for name in ["a", "b", "a"] {
            preferences.add_recent(Path::new(name));
        }
        assert_eq!(preferences.recent, [PathBuf::from("a"), PathBuf::from("b")]);
        (0..20).for_each(|i| preferences.add_recent(&PathBuf::from(i.to_string())));
        assert_eq!(preferences.recent.len(), MAX_RECENT);
    }
}

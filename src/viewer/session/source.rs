//! Source of a scene: a file, or a built-in one.

use std::path::PathBuf;

use anyhow::Context;

use crate::scene::gltf::LoadOptions;
use crate::scene::{Scene, builtin, gltf};

/// Source of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A built-in scene, by its name.
    BuiltIn(String),
    /// A glTF file.
    File(PathBuf),
}

impl Default for Source {
    /// Returns the first built-in scene.
    fn default() -> Self {
        Self::BuiltIn(builtin::NAMES[0].to_owned())
    }
}

impl Source {
    /// Parses the path of a file, or `builtin:NAME`.
    #[must_use]
    pub fn of(path: PathBuf) -> Self {
        match path.to_str().and_then(|text| text.strip_prefix(builtin::PREFIX)) {
            Some(name) => Self::BuiltIn(name.to_owned()),
            None => Self::File(path),
        }
    }

    /// Returns the file on disk, without the name of a scene in it; `None` for a built-in scene.
    #[must_use]
    pub fn file(&self) -> Option<PathBuf> {
        let Self::File(path) = self else { return None };
        if path.exists() {
            return Some(path.clone());
        }
        let text = path.to_str()?;
        Some(text.rsplit_once('#').map_or_else(|| path.clone(), |(file, _)| PathBuf::from(file)))
    }

    /// Returns the name that [`Source::of`] parses.
    #[must_use]
    pub fn name(&self) -> PathBuf {
        match self {
            Self::BuiltIn(name) => PathBuf::from(format!("{}{name}", builtin::PREFIX)),
            Self::File(path) => path.clone(),
        }
    }

    /// Loads the scene. A file is loaded in the material variant of that name.
    ///
    /// # Errors
    /// Returns an error if the scene or the variant does not exist, or if the file is not valid.
    pub fn load(&self, variant: Option<String>) -> anyhow::Result<Scene> {
        match self {
            Self::BuiltIn(name) => builtin::by_name(name).with_context(|| format!("there is no built-in scene {name}")),
            Self::File(path) => Ok(gltf::load_with(path, &LoadOptions { variant })?),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_builtin_scenes_are_not_files() {
        assert_eq!(Source::of("builtin:cornell".into()), Source::BuiltIn("cornell".into()));
        assert_eq!(Source::of("rooms/hall.glb".into()), Source::File("rooms/hall.glb".into()));
        let message = Source::BuiltIn("castle".into()).load(None).map(|scene| scene.name).unwrap_err().to_string();
        assert!(message.contains("castle"), "{message}");
    }

    #[test]
    fn the_name_of_a_scene_in_a_file_is_not_part_of_the_path() {
        let file = |name: &str| Source::of(name.into()).file();
        assert_eq!(file("rooms/hall.glb#Cellar"), Some("rooms/hall.glb".into()));
        assert_eq!(file("rooms/hall.glb"), Some("rooms/hall.glb".into()));
        assert_eq!(file("builtin:gallery"), None);
        assert_eq!(Source::default().name(), PathBuf::from("builtin:gallery"));
    }
}

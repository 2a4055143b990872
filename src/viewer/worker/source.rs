//! Where a scene comes from.

use std::path::PathBuf;

use anyhow::Context;

use crate::scene::gltf::LoadOptions;
use crate::scene::{Scene, builtin, gltf};

/// Where a scene comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A scene that the program makes, by name.
    BuiltIn(String),
    /// A glTF file.
    File(PathBuf),
}

impl Default for Source {
    /// The scene for a first look.
    fn default() -> Self {
        Self::BuiltIn(builtin::NAMES[0].to_owned())
    }
}

impl Source {
    /// A file, or `builtin:NAME`.
    #[must_use]
    pub fn of(path: PathBuf) -> Self {
        match path.to_str().and_then(|text| text.strip_prefix(builtin::PREFIX)) {
            Some(name) => Self::BuiltIn(name.to_owned()),
            None => Self::File(path),
        }
    }

    /// The file on disk, without the name of a scene in it; none for a built-in scene.
    #[must_use]
    pub fn file(&self) -> Option<PathBuf> {
        let Self::File(path) = self else { return None };
        if path.exists() {
            return Some(path.clone());
        }
        let text = path.to_str()?;
        Some(text.rsplit_once('#').map_or_else(|| path.clone(), |(file, _)| PathBuf::from(file)))
    }

    /// As [`Source::of`] takes it.
    #[must_use]
    pub fn name(&self) -> PathBuf {
        match self {
            Self::BuiltIn(name) => PathBuf::from(format!("{}{name}", builtin::PREFIX)),
            Self::File(path) => path.clone(),
        }
    }

    /// Reads or makes the scene; a file in the material variant of that name.
    ///
    /// # Errors
    /// There is no such scene or variant, or the file is not right.
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
    fn a_name_after_builtin_is_no_file() {
        assert_eq!(Source::of("builtin:cornell".into()), Source::BuiltIn("cornell".into()));
        assert_eq!(Source::of("rooms/hall.glb".into()), Source::File("rooms/hall.glb".into()));
        let message = Source::BuiltIn("castle".into()).load(None).map(|scene| scene.name).unwrap_err().to_string();
        assert!(message.contains("castle"), "{message}");
    }

    #[test]
    fn a_scene_of_a_file_lies_in_that_file() {
        let file = |name: &str| Source::of(name.into()).file();
        assert_eq!(file("rooms/hall.glb#Cellar"), Some("rooms/hall.glb".into()));
        assert_eq!(file("rooms/hall.glb"), Some("rooms/hall.glb".into()));
        assert_eq!(file("builtin:gallery"), None);
        assert_eq!(Source::default().name(), PathBuf::from("builtin:gallery"));
    }
}

//! Scenes made by the program itself: no file is needed to see light.
//!
//! `assets/` holds the same scenes as .glb, written from here; a test keeps the two equal.

mod builder;
mod carving;
mod cornell;
mod gallery;
mod images;
mod mirrors;
mod round;
mod shape;

pub use cornell::cornell;
pub use gallery::gallery;
pub use mirrors::mirrors;

use super::Scene;

/// What comes before the name of a built-in scene where a file name could stand.
pub const PREFIX: &str = "builtin:";

/// Names of the built-in scenes.
pub const NAMES: [&str; 3] = ["gallery", "cornell", "mirrors"];

/// The built-in scene of this name.
#[must_use]
pub fn by_name(name: &str) -> Option<Scene> {
    match name {
        "gallery" => Some(gallery()),
        "cornell" => Some(cornell()),
        "mirrors" => Some(mirrors()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_makes_the_scene_it_names() {
        for name in NAMES {
            assert_eq!(by_name(name).map(|scene| scene.name).as_deref(), Some(name));
        }
        assert!(by_name("nowhere").is_none());
    }
}

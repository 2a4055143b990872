//! Input by keys and mouse.

pub mod keys;
pub mod mouse;
pub mod shortcuts;

use glam::Vec3;

use keys::Keys;
use mouse::Mouse;

/// State of keys and mouse.
#[derive(Default)]
pub struct Controls {
    /// The keys that are held down.
    pub keys: Keys,
    /// The mouse.
    pub mouse: Mouse,
    /// The point that the camera orbits while a button is held.
    pub orbit_pivot: Option<Vec3>,
}

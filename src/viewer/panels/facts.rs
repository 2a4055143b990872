//! What the panels show and do not set.

use std::time::Duration;

use glam::Vec3;

use super::super::advice::Advice;
use super::super::camera::Eye;
use super::super::meter::{Grid, Reading};
use super::super::patch_sight::PatchSight;
use super::super::replay::Recording;
use crate::bake::{BakeSettings, Report};
use crate::base::progress::Stage;
use crate::patch::MeshSettings;
use crate::scene::Scene;

use std::sync::Arc;

/// What the panels show.
#[derive(Clone)]
pub struct Facts<'a> {
    /// The open scene.
    pub scene: Option<&'a Scene>,
    /// The material variant of the file that is worn.
    pub variant: Option<&'a str>,
    /// State of its light.
    pub light: LightState,
    /// Triangles that carry light; none before they are known.
    pub num_elements: Option<usize>,
    /// The eye; none before a scene is open.
    pub eye: Option<Eye>,
    /// Pixels across and down of the picture.
    pub picture_size: [u32; 2],
    /// Feet on the floor.
    pub is_walking: bool,
    /// Speed without running, metres a second.
    pub pace: f32,
    /// The mouse looks around until Escape.
    pub is_captured: bool,
    /// Frames a second while something moves.
    pub frame_rate: f32,
    /// Time that a frame takes, seconds.
    pub frame_seconds: f32,
    /// Name of the graphics device.
    pub adapter: &'a str,
    /// The next bake's settings, and what they mean on this scene.
    pub next_bake: Option<(BakeSettings, MeshSettings)>,
    /// Seconds since the bake began, and share of the light that was unshot.
    pub curve: &'a [[f32; 2]],
    /// The certificate of the last bake.
    pub report: Option<&'a Report>,
    /// What the user should know of the scene, with what to do.
    pub advice: &'a [Advice],
    /// The light is solved: it can be measured and saved.
    pub is_solved: bool,
    /// The meter.
    pub meter: MeterFacts<'a>,
    /// What the chosen patch sees.
    pub sight: Option<&'a Arc<PatchSight>>,
    /// The recorded bake.
    pub recording: Option<&'a Recording>,
    /// A bake is being recorded.
    pub is_recording: bool,
    /// A picture is being written.
    pub is_writing: bool,
    /// Rays a pixel of the traced view; none where it is drawn.
    pub num_rays: Option<u32>,
    /// Points a lamp that have been added up so far while the camera rests, and how many there will be.
    pub num_points: Option<[u32; 2]>,
    /// Share of pixels in which the compared shadows differ, where that is shown.
    pub difference: Option<f32>,
    /// What is known to be wrong with the shadows from here.
    pub fault: Option<&'a str>,
    /// What the passes of the last picture have taken, milliseconds, where they are timed.
    pub laps: &'a [(&'static str, f32)],
    /// They are timed by the device itself.
    pub has_device_clock: bool,
    /// Points and directions from which direct light comes.
    pub num_light_samples: usize,
    /// Numbers of the views that are marked.
    pub bookmarks: Vec<u8>,
    /// Nothing stands before a point.
    pub sees: &'a dyn Fn(Vec3) -> bool,
}

/// What the meter has to show.
#[derive(Clone, Copy, Default)]
pub struct MeterFacts<'a> {
    /// The last reading.
    pub last: Option<&'a Reading>,
    /// Readings that are kept.
    pub pins: &'a [Reading],
    /// The last grid.
    pub grid: Option<&'a Grid>,
    /// Something is being measured.
    pub is_busy: bool,
}

impl Facts<'_> {
    /// Eye point, metres.
    #[must_use]
    pub fn position(&self) -> Vec3 {
        self.eye.map_or(Vec3::ZERO, |eye| eye.position)
    }
}

/// Where the light of the open scene stands.
#[derive(Clone, Debug, PartialEq)]
pub enum LightState {
    /// Nothing is open.
    Nothing,
    /// A scene is read or baked.
    Working {
        /// What is being done.
        stage: Stage,
        /// Its done share.
        done: f32,
        /// Time since it began.
        elapsed: Duration,
        /// Its end has been asked for.
        is_cancelled: bool,
    },
    /// The file brought its light.
    Stored,
    /// A bake has ended.
    Baked {
        /// What it took.
        elapsed: Duration,
    },
    /// The last bake failed or never was.
    Dark,
}

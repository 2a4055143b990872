//! Materials of the gallery.

use glam::{Vec2, Vec3};

use super::super::builder::{Builder, paint};
use super::super::images;
use super::super::shape::Shape;
use crate::base::ids::MaterialId;

/// Radiance of the overcast sky in the windows, nit.
const SKY: Vec3 = Vec3::new(2400.0, 2900.0, 3500.0);
/// Radiance of the luminous ceiling, nit.
const CEILING_PANEL: Vec3 = Vec3::new(1000.0, 960.0, 880.0);
/// Radiance of an opal globe, nit: 40 cd from a disc of 9 cm radius.
const GLOBE: Vec3 = Vec3::new(1900.0, 1500.0, 1170.0);

/// Side of the square that the plank texture covers, metres.
const PLANKS_SIZE: f32 = 1.2;

/// The materials of the gallery.
pub(super) struct Finishes {
    pub(super) white: MaterialId,
    pub(super) ceiling: MaterialId,
    pub(super) red: MaterialId,
    pub(super) blue_green: MaterialId,
    pub(super) oak: MaterialId,
    pub(super) walnut: MaterialId,
    pub(super) stone: MaterialId,
    pub(super) plaster: MaterialId,
    pub(super) bronze: MaterialId,
    pub(super) clay: MaterialId,
    pub(super) black: MaterialId,
    pub(super) shade: MaterialId,
    pub(super) sky: MaterialId,
    pub(super) ceiling_panel: MaterialId,
    pub(super) globe: MaterialId,
}

impl Finishes {
    pub(super) fn new(builder: &mut Builder) -> Self {
        let planks = builder.texture(images::planks());
        Self {
            white: builder.material(paint("warm white", [0.82, 0.80, 0.75])),
            ceiling: builder.material(paint("ceiling white", [0.85, 0.85, 0.83])),
            red: builder.material(paint("deep red", [0.52, 0.045, 0.035])),
            blue_green: builder.material(paint("blue-green", [0.05, 0.33, 0.34])),
            oak: builder.textured(paint("oak", [1.0; 3]), planks),
            walnut: builder.textured(paint("walnut", [0.62, 0.50, 0.42]), planks),
            stone: builder.material(paint("limestone", [0.66, 0.62, 0.54])),
            plaster: builder.material(paint("plaster", [0.84, 0.83, 0.80])),
            bronze: builder.material(paint("bronze", [0.42, 0.27, 0.13])),
            clay: builder.material(paint("clay", [0.58, 0.30, 0.17])),
            black: builder.material(paint("black metal", [0.04, 0.04, 0.04])),
            shade: builder.material(paint("lamp shade", [0.72, 0.66, 0.55])),
            sky: builder.glowing(paint("sky", [0.2; 3]), SKY, "daylight"),
            ceiling_panel: builder.glowing(paint("ceiling panel", [0.8; 3]), CEILING_PANEL, "ceiling panel"),
            globe: builder.glowing(paint("opal globe", [0.8; 3]), GLOBE, "lamps"),
        }
    }
}

/// Returns the shape with texture coordinates of planks along X.
pub(super) fn with_planks(shape: Shape) -> Shape {
    shape.with_uv(|at| Vec2::new(at.z, at.x) / PLANKS_SIZE)
}

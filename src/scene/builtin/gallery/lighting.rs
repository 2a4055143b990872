//! Lights of the gallery: daylight, sun, lamps and the spot.

use glam::{Quat, Vec2, Vec3};

use super::super::builder::Builder;
use super::super::round::{lathe, sphere};
use super::super::shape::{Shape, Side, cuboid, polygon};
use super::finishes::Finishes;
use super::rooms::{RED_ROOM_HEIGHT, WINDOW_WALL_Z, WINDOWS_X, WINDOWS_Y};
use crate::scene::LightKind;

/// Direction of the sunlight, not normalised: 38 degrees downward, slightly to the east.
const SUN: Vec3 = Vec3::new(0.30, -0.80, -0.975);
/// Illuminance of a low sun behind haze on a perpendicular surface, lux.
const SUN_LUX: Vec3 = Vec3::new(4300.0, 4000.0, 3500.0);
/// Warm white of the lamps, of luminance 1.
const WARM: Vec3 = Vec3::new(1.22, 0.96, 0.75);
/// Position (x, z) of each pendant lamp, metres.
const PENDANTS: [[f32; 2]; 2] = [[-4.6, 3.0], [-1.8, 1.5]];
const GLOBE_RADIUS: f32 = 0.09;
const GLOBE_HEIGHT: f32 = 2.2;

/// Adds the sun, and the window shafts through which sunlight and skylight enter.
///
/// A shaft is parallel to the sunlight, so it casts no shadow of its own. Its lower side emits skylight and hides the
/// void outside.
pub(super) fn windows(builder: &mut Builder, finishes: &Finishes) {
    let [sill, head] = WINDOWS_Y;
    // The shaft extends two metres outward, against the sunlight. It is widened so that no ray grazes a side.
    let out = -SUN * (2.0 / -SUN.z);
    for ([west, east], number) in WINDOWS_X.into_iter().zip(1..) {
        let inner =
            [(west, sill), (east, sill), (east, head), (west, head)].map(|(x, y)| Vec3::new(x, y, WINDOW_WALL_Z));
        let middle = inner.iter().sum::<Vec3>() / 4.0;
        let outer = inner.map(|corner| corner + out + (corner - middle) * 0.06);
        let side = |i: usize| polygon(&[inner[i], outer[i], outer[(i + 1) % 4], inner[(i + 1) % 4]]);
        builder.place(&format!("sky in window {number}"), finishes.sky, side(0));
        builder.place(&format!("shaft of window {number}"), finishes.white, (1..4).map(side).collect());
    }
    builder.light("sun", LightKind::Directional { direction: SUN.normalize() }, SUN_LUX, "sun");
}

/// Adds two pendant lamps: an opal globe under a shade, and a point light below it for the light that it emits
/// downward.
pub(super) fn lamps(builder: &mut Builder, finishes: &Finishes) {
    for ([x, z], number) in PENDANTS.into_iter().zip(1..) {
        let centre = Vec3::new(x, GLOBE_HEIGHT, z);
        builder.place(&format!("globe {number}"), finishes.globe, sphere(GLOBE_RADIUS, 12, 6).moved(centre));
        builder.place(&format!("shade {number}"), finishes.shade, shade().moved(centre));
        let cord = Vec3::new(0.006, 0.0, 0.006);
        let top = Vec3::new(x, RED_ROOM_HEIGHT, z);
        let cord = cuboid(centre + Vec3::Y * 0.20 - cord, top + cord, &[Side::Above, Side::Below]);
        builder.place(&format!("cord {number}"), finishes.black, cord);
        let position = centre - Vec3::Y * (GLOBE_RADIUS + 0.05);
        builder.light(&format!("lamp {number}"), LightKind::Point { position }, WARM * 40.0, "lamps");
    }
}

/// Returns a thin, closed bell around a globe at the origin.
fn shade() -> Shape {
    let outside = [(0.30, -0.02), (0.16, 0.14), (0.0, 0.20)].map(Vec2::from);
    let inside = [(0.0, 0.19), (0.155, 0.13), (0.29, -0.02), (0.30, -0.02)].map(Vec2::from);
    lathe(&outside, 16).join(lathe(&inside, 16))
}

/// Adds the spot that lights the sphere before the red wall, in its housing under the ceiling.
pub(super) fn spot(builder: &mut Builder, finishes: &Finishes) {
    let position = Vec3::new(-3.9, 2.85, 2.6);
    let direction = (Vec3::new(-5.8, 1.3, 1.2) - position).normalize();
    let kind = LightKind::Spot { position, direction, inner_angle: 0.15, outer_angle: 0.32 };
    builder.light("spot", kind, WARM * 600.0, "spot");
    // The light is in the open end of the tube, whose axis is -Y before it is rotated.
    let tube = [(0.045, 0.0), (0.06, 0.0), (0.06, 0.16), (0.0, 0.16)].map(Vec2::from);
    let bore = [(0.0, 0.02), (0.045, 0.02), (0.045, 0.0)].map(Vec2::from);
    let housing = lathe(&tube, 12).join(lathe(&bore, 12));
    let housing = housing.turned(Quat::from_rotation_arc(Vec3::NEG_Y, direction)).moved(position);
    builder.place("spot housing", finishes.black, housing);
    let top = position - direction * 0.10;
    let stem =
        cuboid(top - Vec3::splat(0.008), top.with_y(RED_ROOM_HEIGHT) + Vec3::new(0.008, 0.0, 0.008), &[Side::Above]);
    builder.place("spot stem", finishes.black, stem);
}

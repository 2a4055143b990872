//! Bounds of one lamp or of several: an estimate of the light that they may send to a point.
//!
//! Equation: importance = power cos_emitter cos_receiver / distance^2, where each cosine is the largest that any lamp
//! within the bounds may have. The angle of cos_emitter is the angle to the axis, minus the spread of the normals,
//! minus the angle that the box subtends.
//!
//! Source: Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", section 12.6.3.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

/// Lamps that face the same way count as alike beyond this distance, in radii of their bounds.
const FAR: f32 = 4.0;

/// Cosine of the angle within which lamps face the same way.
const SAME_WAY: f32 = 0.999;

/// Bounds in space, direction and power of one lamp or of several.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightBounds {
    low: Vec3,
    high: Vec3,
    /// Luminous power / pi.
    pub(crate) power: f32,
    /// The emitting normals lie in a cone round this axis.
    pub(crate) axis: Vec3,
    /// Cosine of the half angle of that cone.
    cos_spread: f32,
    pub(crate) is_two_sided: bool,
}

impl LightBounds {
    /// Bounds of an emissive triangle.
    pub(crate) fn of_triangle(corners: [Vec3; 3], normal: Vec3, power: f32, is_two_sided: bool) -> Self {
        let [a, b, c] = corners;
        Self { low: a.min(b).min(c), high: a.max(b).max(c), power, axis: normal, cos_spread: 1.0, is_two_sided }
    }

    pub(crate) fn centre(&self) -> Vec3 {
        0.5 * (self.low + self.high)
    }

    pub(crate) fn union(self, other: Self) -> Self {
        let (axis, cos_spread) = cone_round((self.axis, self.cos_spread), (other.axis, other.cos_spread));
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            power: self.power + other.power,
            axis,
            cos_spread,
            is_two_sided: self.is_two_sided || other.is_two_sided,
        }
    }

    /// Estimated light at a point of a surface with this normal; 0 only if none can arrive.
    pub(crate) fn importance(&self, point: Vec3, normal: Vec3) -> f32 {
        let offset = point - self.centre();
        let radius_squared = 0.25 * (self.high - self.low).length_squared();
        let distance_squared = offset.length_squared();
        let direction = offset / distance_squared.sqrt().max(f32::MIN_POSITIVE);
        // Half angle that the box subtends at the point.
        let bound = Angle::from_cos(if distance_squared <= radius_squared {
            -1.0
        } else {
            (1.0 - radius_squared / distance_squared).sqrt()
        });
        let cos_out = self.axis.dot(direction);
        let out = Angle::from_cos(if self.is_two_sided { cos_out.abs() } else { cos_out });
        let cos_emitter = out.less(Angle::from_cos(self.cos_spread)).less(bound).cos;
        let cos_receiver = Angle::from_cos(-normal.dot(direction)).less(bound).cos;
        if cos_emitter <= 0.0 || cos_receiver <= 0.0 {
            return 0.0;
        }
        // Inside the box, the distance to the centre may be far smaller than that to the lamp.
        self.power * cos_emitter * cos_receiver / distance_squared.max(radius_squared).max(f32::MIN_POSITIVE)
    }

    /// Returns true if the lamps, as seen from this point, differ almost only in their power.
    pub(crate) fn are_alike(&self, point: Vec3) -> bool {
        let radius_squared = 0.25 * (self.high - self.low).length_squared();
        self.cos_spread >= SAME_WAY && point.distance_squared(self.centre()) > FAR * FAR * radius_squared
    }

    /// Cost of a node: power x directions x area (Conty Estevez and Kulla 2018, section 4.4).
    pub(crate) fn cost(&self) -> f32 {
        let spread = self.cos_spread.clamp(-1.0, 1.0).acos();
        let end = (spread + 0.5 * PI).min(PI);
        let (sin, cos) = spread.sin_cos();
        let directions =
            TAU * (1.0 - cos) + 0.5 * PI * (2.0 * end * sin - (spread - 2.0 * end).cos() - 2.0 * spread * sin + cos);
        let size = self.high - self.low;
        let area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
        // The cost of a flat or thin box must not be 0.
        self.power * directions * (area + 1e-3 * size.length_squared())
    }
}

/// An angle in 0..pi.
#[derive(Clone, Copy)]
struct Angle {
    cos: f32,
    sin: f32,
}

impl Angle {
    fn from_cos(cos: f32) -> Self {
        let cos = cos.clamp(-1.0, 1.0);
        Self { cos, sin: (1.0 - cos * cos).sqrt() }
    }

    /// Returns the angle minus `other`, at least 0.
    fn less(self, other: Self) -> Self {
        if self.cos > other.cos {
            return Self { cos: 1.0, sin: 0.0 };
        }
        Self { cos: self.cos * other.cos + self.sin * other.sin, sin: self.sin * other.cos - self.cos * other.sin }
    }
}

/// The smallest cone (axis, cosine of the half angle) round two cones.
fn cone_round(a: (Vec3, f32), b: (Vec3, f32)) -> (Vec3, f32) {
    let (spread_a, spread_b) = (a.1.clamp(-1.0, 1.0).acos(), b.1.clamp(-1.0, 1.0).acos());
    let between = a.0.dot(b.0).clamp(-1.0, 1.0).acos();
    if between + spread_b <= spread_a {
        return a;
    }
    if between + spread_a <= spread_b {
        return b;
    }
    let spread = 0.5 * (spread_a + between + spread_b);
    let turn_axis = a.0.cross(b.0);
    if spread >= PI || turn_axis.length_squared() < 1e-12 {
        return (a.0, if between < 0.1 { spread.cos() } else { -1.0 });
    }
    let turned = glam::Quat::from_axis_angle(turn_axis.normalize(), spread - spread_a) * a.0;
    (turned.normalize(), spread.min(PI).cos())
}

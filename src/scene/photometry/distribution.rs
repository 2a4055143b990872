//! Luminous intensity by direction, interpolated in the table of a photometric file, and its flux.

use std::f32::consts::{PI, TAU};
use std::sync::Arc;

use glam::{Quat, Vec3};

/// Luminous intensity by direction, candela.
#[derive(Clone, Debug, PartialEq)]
pub struct Photometry {
    /// Vertical angles, from the axis `[v]`, degrees, ascending.
    pub(super) vertical: Vec<f32>,
    /// Horizontal angles, round the axis `[h]`, degrees, ascending.
    pub(super) horizontal: Vec<f32>,
    /// Intensities `[h][v]`.
    pub(super) candela: Vec<f32>,
    /// The largest intensity.
    pub(super) peak: f32,
    /// Bytes of the file, which a bake copies unchanged.
    pub(super) file: Vec<u8>,
}

/// Intensity distribution of a light: a table and its orientation.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The table, which several lights may share.
    pub photometry: Arc<Photometry>,
    /// Rotation from the luminaire's space, whose axis is -Z, to world space.
    pub world_from_light: Quat,
}

impl Profile {
    /// Returns the intensity along the unit vector `direction`, away from the light, relative to the largest intensity.
    #[must_use]
    pub fn share(&self, direction: Vec3) -> f32 {
        let local = self.world_from_light.inverse() * direction;
        self.photometry.intensity(local) / self.photometry.peak
    }
}

impl Photometry {
    /// Returns the luminous intensity along a unit vector in the luminaire's space, candela, interpolated linearly
    /// between the table's angles. Vertical angles start at -Z, horizontal ones at +X and increase towards +Y
    /// (EXT_lights_ies). The intensity outside the vertical angles of the table is zero.
    #[must_use]
    pub fn intensity(&self, direction: Vec3) -> f32 {
        let vertical = (-direction.z).clamp(-1.0, 1.0).acos().to_degrees();
        let round = direction.y.atan2(direction.x).to_degrees();
        let Some((low, share)) = bracket(&self.vertical, vertical) else { return 0.0 };
        let (plane, turn) = bracket(&self.horizontal, self.folded(round)).unwrap_or((0, 0.0));
        let next = (plane + 1).min(self.horizontal.len() - 1);
        let along = |plane: usize| {
            let row = &self.candela[plane * self.vertical.len()..][..self.vertical.len()];
            row[low] + share * (row[(low + 1).min(row.len() - 1)] - row[low])
        };
        along(plane) + turn * (along(next) - along(plane))
    }

    /// Maps a horizontal angle into the part of the circle that the table covers. The other parts are mirror images.
    fn folded(&self, degrees: f32) -> f32 {
        let degrees = degrees.rem_euclid(360.0);
        let half = if degrees > 180.0 { 360.0 - degrees } else { degrees };
        let (first, last) = (self.horizontal[0], self.horizontal[self.horizontal.len() - 1]);
        match (first, last) {
            _ if first == last => first,
            // A table from 90 to 270 degrees covers the half towards -X.
            (90.0, 270.0) if !(90.0..=270.0).contains(&degrees) => (180.0 - degrees).rem_euclid(360.0),
            (0.0, 90.0) if half > 90.0 => 180.0 - half,
            (0.0, 90.0 | 180.0) => half,
            _ => degrees,
        }
    }

    /// Returns the largest intensity, candela.
    #[must_use]
    pub fn peak(&self) -> f32 {
        self.peak
    }

    /// Returns the bytes of the photometric file.
    #[must_use]
    pub fn file(&self) -> &[u8] {
        &self.file
    }

    /// Returns the luminous flux, lumen: the integral of the intensity over the sphere by the midpoint rule, in steps
    /// of 2 and 4 degrees.
    #[must_use]
    pub fn flux(&self) -> f32 {
        const STEPS: usize = 90;
        let ring = |v: usize| {
            let polar = (v as f32 + 0.5) * PI / STEPS as f32;
            let towards = |h: usize| {
                let (sin, cos) = ((h as f32 + 0.5) * TAU / STEPS as f32).sin_cos();
                self.intensity(Vec3::new(polar.sin() * cos, polar.sin() * sin, -polar.cos()))
            };
            (0..STEPS).map(towards).sum::<f32>() * polar.sin()
        };
        (0..STEPS).map(ring).sum::<f32>() * (PI / STEPS as f32) * (TAU / STEPS as f32)
    }
}

/// Returns the index of the last of the ascending `angles` at or below `angle`, and the position between it and the
/// next one, 0..1; `None` outside their range.
fn bracket(angles: &[f32], angle: f32) -> Option<(usize, f32)> {
    /// Tolerance for rounding at the ends of the table, degrees.
    const SLACK: f32 = 1e-3;
    if angle < angles[0] - SLACK || angle > angles[angles.len() - 1] + SLACK {
        return None;
    }
    let low = angles.partition_point(|&known| known <= angle).saturating_sub(1).min(angles.len().saturating_sub(2));
    let next = (low + 1).min(angles.len() - 1);
    let width = angles[next] - angles[low];
    Some((low, if width > 0.0 { ((angle - angles[low]) / width).clamp(0.0, 1.0) } else { 0.0 }))
}

#[cfg(test)]
mod tests {
    use super::super::parse;
    use super::*;

    /// Returns a file with these angles and candelas.
    fn file(vertical: &str, horizontal: &str, candela: &str) -> Photometry {
        let count = |list: &str| list.split_whitespace().count();
        let counts = format!("{} {}", count(vertical), count(horizontal));
        let text = format!(
            "IES:LM-63-2019\nTILT=NONE\n1 -1 1.0 {counts} 1 2 0 0 0\n1 1 10\n{vertical}\n{horizontal}\n{candela}\n"
        );
        parse(text.as_bytes()).expect("LM-63")
    }

    fn towards(vertical: f32, horizontal: f32) -> Vec3 {
        let ((sin, cos), (y, x)) = (vertical.to_radians().sin_cos(), horizontal.to_radians().sin_cos());
        Vec3::new(sin * x, sin * y, -cos)
    }

    #[test]
    fn the_flux_of_a_lambertian_luminaire_is_pi_times_its_peak() {
        let angles: Vec<String> = (0..=90).map(|degree| degree.to_string()).collect();
        let cosines: Vec<String> =
            (0..=90).map(|degree| format!("{}", 100.0 * f64::from(degree).to_radians().cos())).collect();
        let lambert = file(&angles.join(" "), "0", &cosines.join(" "));
        assert!((lambert.flux() / (PI * 100.0) - 1.0).abs() < 1e-3, "{}", lambert.flux());
        assert_eq!((lambert.peak(), lambert.intensity(towards(120.0, 0.0))), (100.0, 0.0));
        assert!((lambert.intensity(towards(60.0, 77.0)) - 50.0).abs() < 0.01);
    }

    #[test]
    fn a_table_of_a_part_of_the_circle_is_mirrored_to_the_rest() {
        // At 90 degrees from the axis, the candelas equal the horizontal angle.
        let quarter = file("0 90", "0 90", "0 0 0 90");
        let half = file("0 90", "0 90 180", "0 0 0 90 0 180");
        let side = file("0 90", "90 180 270", "0 90 0 180 0 270");
        let whole = file("0 90", "0 90 180 270 360", "0 0 0 90 0 180 0 270 0 360");
        let round = [
            (45.0, [45.0, 45.0, 135.0, 45.0]),
            (135.0, [45.0, 135.0, 135.0, 135.0]),
            (300.0, [60.0, 60.0, 240.0, 300.0]),
        ];
        for (at, expected) in round {
            let found = [&quarter, &half, &side, &whole].map(|table| table.intensity(towards(90.0, at)));
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.01), "{at}: {found:?}");
        }
    }

    #[test]
    fn the_distribution_rotates_with_the_light() {
        let photometry = Arc::new(file("0 90 180", "0", "10 5 0"));
        let upwards = Quat::from_rotation_arc(Vec3::NEG_Z, Vec3::Y);
        let profile = Profile { photometry, world_from_light: upwards };
        assert!((profile.share(Vec3::Y) - 1.0).abs() < 1e-3 && profile.share(Vec3::NEG_Y) < 1e-3);
        assert!((profile.share(Vec3::X) - 0.5).abs() < 1e-3);
    }
}

//! Deterministic sample points: every pseudo-random number in the program is a pure function of an index.

use glam::{Vec2, Vec3};

/// Returns a well-mixed 32-bit hash of `x` (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", PCG).
#[must_use]
pub fn hash(x: u32) -> u32 {
    let state = x.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// Uniform number in [0, 1) from the upper 24 bits of a hash value.
#[must_use]
pub fn unit_float(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// Returns the `index`-th point of the R2 low-discrepancy sequence, shifted by `seed`, in [0, 1)^2.
///
/// Source: Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences".
#[must_use]
pub fn r2(index: u32, seed: u32) -> Vec2 {
    // 2^32 / g and 2^32 / g^2, where g is the plastic number: integer arithmetic is exact for any index.
    const STEP_X: u32 = 3_242_174_889;
    const STEP_Y: u32 = 2_447_445_414;
    let x = hash(seed).wrapping_add(index.wrapping_mul(STEP_X));
    let y = hash(seed ^ 0x9e37_79b9).wrapping_add(index.wrapping_mul(STEP_Y));
    Vec2::new(unit_float(x), unit_float(y))
}

/// Returns the barycentric coordinates of a uniformly distributed point of a triangle, given a uniformly distributed
/// point of the unit square.
///
/// Source: Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
#[must_use]
pub fn triangle_from_square(square: Vec2) -> Vec3 {
    let (mut x, mut y) = (square.x, square.y);
    if y > x {
        x *= 0.5;
        y -= x;
    } else {
        y *= 0.5;
        x -= y;
    }
    Vec3::new(1.0 - x - y, x, y)
}

/// Returns the position of a point of the unit square along the Z-order curve: the interleaved bits of its coordinates,
/// 16 each.
///
/// Source: Morton 1966, "A Computer Oriented Geodetic Data Base and a New Technique in File Sequencing".
#[must_use]
pub fn morton_2d(square: Vec2) -> u32 {
    let spread = |x: f32| {
        let x = (x * 65_536.0) as u32;
        let x = (x | x << 8) & 0x00ff_00ff;
        let x = (x | x << 4) & 0x0f0f_0f0f;
        let x = (x | x << 2) & 0x3333_3333;
        (x | x << 1) & 0x5555_5555
    };
    spread(square.x) | spread(square.y) << 1
}

/// Returns the unit direction in the hemisphere round `normal`, given a uniformly distributed point of the unit square;
/// its probability density is cos(theta) / pi per steradian.
#[must_use]
pub fn cosine_hemisphere(normal: Vec3, square: Vec2) -> Vec3 {
    let (tangent, bitangent) = tangent_frame(normal);
    let (sin, cos) = (std::f32::consts::TAU * square.y).sin_cos();
    let radius = square.x.sqrt();
    tangent * (radius * cos) + bitangent * (radius * sin) + normal * (1.0 - square.x).sqrt()
}

/// Returns the unit vectors `(tangent, bitangent)` that form a right-handed orthonormal frame with the unit vector
/// `normal`.
///
/// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
#[must_use]
pub fn tangent_frame(normal: Vec3) -> (Vec3, Vec3) {
    let sign = 1f32.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    (
        Vec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
        Vec3::new(b, sign + normal.y * normal.y * a, -normal.y),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tangent_frame_is_right_handed_and_orthonormal() {
        for i in 0..200 {
            let p = r2(i, 7);
            let z = 2.0 * p.x - 1.0;
            let phi = std::f32::consts::TAU * p.y;
            let r = (1.0 - z * z).sqrt();
            let n = Vec3::new(r * phi.cos(), r * phi.sin(), z);
            let (t, b) = tangent_frame(n);
            assert!((t.cross(b) - n).length() < 1e-5);
            assert!(t.dot(b).abs() < 1e-5 && (t.length() - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn triangle_samples_have_the_centroid_as_mean() {
        let mean: Vec3 = (0..4096).map(|i| triangle_from_square(r2(i, 1))).sum::<Vec3>() / 4096.0;
        assert!((mean - Vec3::splat(1.0 / 3.0)).abs().max_element() < 2e-3, "{mean}");
    }
}

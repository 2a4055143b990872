//! Adaptive quadrature along a line and over a triangle.

use glam::DVec3;

/// Largest number of times that an interval is halved.
const MAX_DEPTH: u32 = 48;

/// Positive nodes of the 15-point Kronrod rule, the largest first; every second one is a node of the 7-point Gauss
/// rule.
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_55,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_83,
];
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

/// Integral of `f` from `low` to `high`, to about `tolerance`.
///
/// Source: Kronrod 1965; Piessens et al. 1983 (QUADPACK), rule of 7 and 15 points.
pub(super) fn integrate(f: &dyn Fn(f64) -> f64, low: f64, high: f64, tolerance: f64) -> f64 {
    if high <= low {
        return 0.0;
    }
    halve_until_exact(f, low, high, tolerance, 0)
}

fn halve_until_exact(f: &dyn Fn(f64) -> f64, low: f64, high: f64, tolerance: f64, depth: u32) -> f64 {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let at_middle = f(middle);
    let (mut kronrod, mut gauss) = (KRONROD[7] * at_middle, GAUSS[3] * at_middle);
    for i in 0..7 {
        let pair = f(middle - half * NODES[i]) + f(middle + half * NODES[i]);
        kronrod += KRONROD[i] * pair;
        if i % 2 == 1 {
            gauss += GAUSS[i / 2] * pair;
        }
    }
    let is_exact = (kronrod - gauss).abs() * half <= tolerance.max(1e-15 * kronrod.abs() * half);
    if is_exact || depth == MAX_DEPTH {
        return kronrod * half;
    }
    let share = 0.5 * tolerance;
    halve_until_exact(f, low, middle, share, depth + 1) + halve_until_exact(f, middle, high, share, depth + 1)
}

/// Largest number of times that a triangle is quartered.
const MAX_QUARTERINGS: u32 = 9;

/// Integral of `f` over a triangle, and its error bound.
///
/// Source: Radon 1948 (the seven-point rule of degree five).
pub(super) fn integrate_triangle(f: &dyn Fn(DVec3) -> f64, corners: [DVec3; 3], tolerance: f64) -> (f64, f64) {
    let whole = radon(f, corners);
    quarter_until_exact(f, corners, whole, tolerance, 0)
}

fn quarter_until_exact(
    f: &dyn Fn(DVec3) -> f64,
    [a, b, c]: [DVec3; 3],
    whole: f64,
    tolerance: f64,
    depth: u32,
) -> (f64, f64) {
    let (ab, bc, ca) = (0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a));
    let quarters = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    let parts = quarters.map(|quarter| radon(f, quarter));
    let sum: f64 = parts.iter().sum();
    let error = (sum - whole).abs();
    // The first levels may miss small features.
    if (error <= tolerance && depth >= 3) || depth == MAX_QUARTERINGS {
        return (sum, error);
    }
    let refined = |(quarter, part)| quarter_until_exact(f, quarter, part, 0.25 * tolerance, depth + 1);
    let add = |(sum, error), (part, part_error)| (sum + part, error + part_error);
    quarters.into_iter().zip(parts).map(refined).fold((0.0, 0.0), add)
}

fn radon(f: &dyn Fn(DVec3) -> f64, [a, b, c]: [DVec3; 3]) -> f64 {
    let root = 15f64.sqrt();
    let area = 0.5 * (b - a).cross(c - a).length();
    let mut sum = 0.225 * f((a + b + c) / 3.0);
    for (near, weight) in
        [((6.0 - root) / 21.0, (155.0 - root) / 1200.0), ((6.0 + root) / 21.0, (155.0 + root) / 1200.0)]
    {
        for [p, q, r] in [[a, b, c], [b, c, a], [c, a, b]] {
            sum += weight * f(p * (1.0 - 2.0 * near) + (q + r) * near);
        }
    }
    sum * area
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_logarithm_is_integrated_up_to_its_singularity() {
        let exact = -1.0;
        assert!((integrate(&f64::ln, 1e-300, 1.0, 1e-12) - exact).abs() < 1e-10);
    }

    #[test]
    fn a_polynomial_of_degree_five_is_integrated_exactly() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        // Integral of x^3 y^2 = 3! 2! / 7!.
        let found = radon(&|p| p.x.powi(3) * p.y.powi(2), corners);
        assert!((found - 12.0 / 5040.0).abs() < 1e-15, "{found}");
        // A kink needs more subdivisions.
        let (kinked, error) = integrate_triangle(&|p| (p.x - 0.3).max(0.0), corners, 1e-8);
        assert!((kinked - 0.7f64.powi(3) / 6.0).abs() < 1e-7 && error < 1e-6, "{kinked} {error}");
    }
}

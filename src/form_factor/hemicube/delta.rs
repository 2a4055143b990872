//! Delta form factors: the share of the view that each pixel of a hemicube covers.
//!
//! Source: Cohen, Greenberg 1985, "The Hemi-Cube"; here integrated over the pixel in closed form instead of evaluated
//! at its centre.

use std::f64::consts::PI;

/// Delta form factors of a hemicube `n` pixels wide, in the layout of its atlas cell: `n` columns and `3 n` rows, first
/// the top face, then the four half sides with the horizon at their bottom row. They sum to 1.
#[must_use]
pub fn delta_form_factors(n: u32) -> Vec<f32> {
    let step = 2.0 / f64::from(n);
    let edge = |i: u32| f64::from(i) * step - 1.0;
    let mut deltas = Vec::with_capacity(3 * (n * n) as usize);
    for row in 0..n {
        for column in 0..n {
            deltas.push(rectangle(top_corner, [edge(column), edge(column + 1)], [edge(row), edge(row + 1)]));
        }
    }
    for _ in 0..4 {
        for row in 0..n / 2 {
            let height = [1.0 - f64::from(row + 1) * step, 1.0 - f64::from(row) * step];
            for column in 0..n {
                deltas.push(rectangle(side_corner, [edge(column), edge(column + 1)], height));
            }
        }
    }
    let sum: f64 = deltas.iter().sum();
    deltas.iter().map(|delta| (delta / sum) as f32).collect()
}

/// Integral over a rectangle, from an antiderivative at its corners.
fn rectangle(corner: fn(f64, f64) -> f64, x: [f64; 2], y: [f64; 2]) -> f64 {
    corner(x[1], y[1]) - corner(x[0], y[1]) - corner(x[1], y[0]) + corner(x[0], y[0])
}

/// Form factor from the origin to the rectangle (0,0)-(x,y) of the top face, odd in x and y.
///
/// Equation: the integral of 1 / (pi (1 + x^2 + y^2)^2).
fn top_corner(x: f64, y: f64) -> f64 {
    let (a, b) = (x.hypot(1.0), y.hypot(1.0));
    (x / a * (y / a).atan() + y / b * (x / b).atan()) / (2.0 * PI)
}

/// Antiderivative over a side face, x along the horizon and z above it.
///
/// Equation: the integral of z / (pi (1 + x^2 + z^2)^2).
fn side_corner(x: f64, z: f64) -> f64 {
    let a = z.hypot(1.0);
    -(x / a).atan() / a / (2.0 * PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delta_form_factors_sum_to_one() {
        for n in [2, 16, 64, 512] {
            let sum: f64 = delta_form_factors(n).iter().map(|&d| f64::from(d)).sum();
            assert!((sum - 1.0).abs() < 1e-6, "n = {n}: {sum}");
        }
    }

    #[test]
    fn the_antiderivatives_agree_with_the_integrands() {
        // One small pixel against the midpoint rule.
        let deltas = delta_form_factors(512);
        let step: f64 = 2.0 / 512.0;
        let (x, y) = (100.5 * step - 1.0, 300.5 * step - 1.0);
        let top = step * step / (PI * (1.0 + x * x + y * y).powi(2));
        assert!((f64::from(deltas[300 * 512 + 100]) / top - 1.0).abs() < 1e-4);
        let z = 1.0 - 50.5 * step;
        let side = z * step * step / (PI * (1.0 + x * x + z * z).powi(2));
        assert!((f64::from(deltas[(512 + 50) * 512 + 100]) / side - 1.0).abs() < 1e-4);
    }
}

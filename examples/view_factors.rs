//! View factor of two parallel unit squares, by each method that needs no GPU, against the formula of the catalogues.
//!
//! The view factor (form factor) F_AB is the share of the power leaving A that arrives at B.

use std::error::Error;
use std::f64::consts::PI;

use hemicube::form_factor::polygon_pair::{Polygon, PolygonPair};
use hemicube::glam::DVec3;

/// View factor of two directly opposed rectangles a x b at distance c, with X = a / c and Y = b / c.
///
/// Source: Howell, A Catalog of Radiation Heat Transfer Configuration Factors, C-11.
fn opposed_rectangles(x: f64, y: f64) -> f64 {
    let (rx, ry) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    let logarithm = (rx * rx * ry * ry / (1.0 + x * x + y * y)).sqrt().ln();
    let angles = x * ry * (x / ry).atan() + y * rx * (y / rx).atan() - x * x.atan() - y * y.atan();
    2.0 / (PI * x * y) * (logarithm + angles)
}

/// A unit square at height z. Corners are counter-clockwise as seen from the front.
fn square(z: f64, faces_up: bool) -> Result<Polygon, Box<dyn Error>> {
    let mut corners: Vec<DVec3> =
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, z)).to_vec();
    if !faces_up {
        corners.reverse();
    }
    Ok(Polygon::new(corners)?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let expected = opposed_rectangles(1.0, 1.0);
    println!("catalogue:     F = {expected:.6}");

    let open = PolygonPair { a: square(0.0, true)?, b: square(1.0, false)?, blocker: None };
    let closed_form = open.analytic();
    println!("closed form:   F = {:.6} +- {:.0e}", closed_form.factor, closed_form.error);
    let sampled = open.by_hemispheres()?;
    println!("cosine rays:   F = {:.6} +- {:.0e}", sampled.factor, sampled.error);
    assert!((closed_form.factor - expected).abs() < 1e-6);
    assert!((sampled.factor - expected).abs() < 1e-3);

    // A third polygon between them blocks a part of the exchange.
    let half = [(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.5)).to_vec();
    let blocked = PolygonPair { blocker: Some(Polygon::new(half)?), ..open };
    println!("half blocked:  F = {:.6}", blocked.analytic().factor);
    Ok(())
}

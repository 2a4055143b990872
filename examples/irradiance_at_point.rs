//! Compares the illuminance on a desk, measured in a bake, with path tracing and with the formula of a point light.

use std::error::Error;

use hemicube::base::colour::luminance;
use hemicube::base::progress::Unwatched;
use hemicube::glam::Vec3;
use hemicube::raytrace::{MeasuringPoint, PathSettings, irradiance};
use hemicube::scene::{Light, Material};
use hemicube::trace::Tracer;
use hemicube::{BakeSettings, MeasureSettings, Quality, SceneBuilder, bake, measure};

/// Luminous intensity of the lamp, candela, equal in all directions.
const INTENSITY: f32 = 100.0;

fn main() -> Result<(), Box<dyn Error>> {
    // A white room of 4 m x 3 m x 5 m with a point light in the middle, half a metre below the ceiling.
    let mut builder = SceneBuilder::new("office");
    let white = builder.material(Material::diffuse(Vec3::splat(0.7)));
    builder.room(Vec3::ZERO, Vec3::new(4.0, 3.0, 5.0), [white; 6]);
    let lamp = Vec3::new(2.0, 2.5, 2.5);
    let group = builder.group("lamp");
    builder.light(Light { group, ..Light::point(lamp, Vec3::splat(INTENSITY)) });
    let scene = builder.build();

    let baked = bake(&scene, &BakeSettings::preset(Quality::Draft))?.baked;

    // The height of a desk, one metre beside the lamp, facing up.
    let point = MeasuringPoint { position: Vec3::new(3.0, 0.75, 2.5), normal: Vec3::Y };
    let measured = measure(&baked, &[point], &MeasureSettings::preset(Quality::Draft))?[0];
    let total = luminance(measured.total);
    println!("radiosity:    {total:.1} lx, of which {:.1} lx direct", luminance(measured.direct));

    // Direct light of a point light: E = I cos theta / r^2.
    let to_lamp = lamp - point.position;
    let direct = INTENSITY * to_lamp.normalize().dot(point.normal) / to_lamp.length_squared();
    println!("formula:      {direct:.1} lx direct");
    assert!((luminance(measured.direct) - direct).abs() < 1e-3 * direct);

    // The unbiased reference.
    let paths = PathSettings { samples: 1 << 14, ..PathSettings::default() };
    let traced = irradiance(&Tracer::new(&scene), &[point], &paths, &Unwatched).ok_or("cancelled")?[0];
    let (expected, error) = (luminance(traced.total), luminance(traced.total_error));
    println!("path tracing: {expected:.1} +- {error:.1} lx");
    assert!((total - expected).abs() < 0.05 * expected);
    Ok(())
}

//! Radiance of known surfaces under known light.

use std::f32::consts::PI;

use glam::Vec3;
use hemicube::base::ids::GroupId;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::{PictureRequest, RenderSettings, Shading, draw_picture, picture};
use hemicube::scene::Material;

use super::stage::{SIZE, assert_close, centre, display_at, draw, plain, radiance_at};
use crate::support::device::gpu;
use crate::support::quads::{Quads, paint, square_camera};

#[test]
fn a_surface_sends_reflectance_times_irradiance_over_pi_plus_emission() {
    let grey = Quads::square(paint(Vec3::splat(0.5)), Vec3::splat(PI));
    let lamp = Quads::square(
        Material { emission: Vec3::new(3.0, 2.0, 1.0), ..paint(Vec3::new(0.2, 0.4, 0.8)) },
        Vec3::new(PI, 2.0 * PI, PI),
    );
    let Some(radiance) = centre(&grey, &plain()) else { return };
    assert_close(radiance, Vec3::splat(0.5));
    assert_close(centre(&lamp, &plain()).expect("a GPU"), Vec3::new(3.2, 2.8, 1.8));
}

#[test]
fn exactly_the_pixels_of_a_square_are_covered() {
    let quads = Quads::square(paint(Vec3::ONE), Vec3::splat(PI));
    let Some(gpu) = gpu() else { return };
    let mut wide = square_camera();
    wide.projection = hemicube::scene::Projection::Orthographic { half_height: 2.0 };
    let picture = picture(gpu, &quads.baked, &wide, [SIZE; 2], &plain()).expect("a picture");
    let covered = picture.radiance.iter().filter(|pixel| pixel[3] == 1.0).count();
    assert_eq!(covered as u32, SIZE * SIZE / 4);
    assert!(picture.radiance.iter().all(|pixel| pixel[3] == 1.0 || pixel == &[0.0; 4]));
}

#[test]
fn very_bright_lamps_keep_their_radiance() {
    let sun = Quads::square(Material { emission: Vec3::splat(1.6e9), ..paint(Vec3::ONE) }, Vec3::ZERO);
    let Some(radiance) = centre(&sun, &plain()) else { return };
    assert_close(radiance, Vec3::splat(1.6e9));
}

/// Two groups with direct and indirect light. All four lights differ.
fn four_lights() -> Quads {
    let mut quads = Quads::with_groups(2);
    let white = quads.material(paint(Vec3::ONE));
    quads.quad(Vec3::new(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y, white);
    quads.light(GroupId(0), |_| Vec3::splat(1.0 * PI), |_| Vec3::splat(2.0 * PI));
    quads.light(GroupId(1), |_| Vec3::splat(4.0 * PI), |_| Vec3::splat(8.0 * PI));
    quads
}

#[test]
fn radiance_is_linear_in_every_part_of_the_light() {
    let quads = four_lights();
    let Some(all) = centre(&quads, &plain()) else { return };
    assert_close(all, Vec3::splat(15.0));
    let shown = |settings: RenderSettings| centre(&quads, &settings).expect("a GPU");
    assert_close(shown(RenderSettings { direct: 0.0, ..plain() }), Vec3::splat(10.0));
    assert_close(shown(RenderSettings { indirect: 0.0, ..plain() }), Vec3::splat(5.0));
    assert_close(shown(RenderSettings { group_weights: vec![Vec3::ZERO], ..plain() }), Vec3::splat(12.0));
    let red_and_double = vec![Vec3::X, Vec3::splat(2.0)];
    assert_close(shown(RenderSettings { group_weights: red_and_double, ..plain() }), Vec3::new(27.0, 24.0, 24.0));
    let ambient = Vec3::new(0.0, 1.0, 2.0);
    assert_close(shown(RenderSettings { direct: 0.0, indirect: 0.0, ambient, ..plain() }), ambient);
}

#[test]
fn a_dimmed_group_dims_the_emission_of_its_lamps() {
    let lamp = Material { emission: Vec3::ONE, group: Some(GroupId(0)), ..paint(Vec3::ONE) };
    let quads = Quads::square(lamp, Vec3::ZERO);
    let settings = RenderSettings { group_weights: vec![Vec3::new(0.5, 0.25, 0.0)], ..plain() };
    let Some(radiance) = centre(&quads, &settings) else { return };
    assert_close(radiance, Vec3::new(0.5, 0.25, 0.0));
}

#[test]
fn irradiance_is_interpolated_between_vertices() {
    let mut quads = Quads::square(paint(Vec3::ONE), Vec3::ZERO);
    quads.light(GroupId(0), |p| Vec3::splat(PI * (1.0 + p.x)), |_| Vec3::ZERO);
    let Some(picture) = draw(&quads, &plain()) else { return };
    for x in [0, 10, 40, 63] {
        assert_close(radiance_at(&picture, x, 20), Vec3::splat((x as f32 + 0.5) / 32.0));
    }
}

#[test]
fn metals_are_black_unless_shown_as_diffuse() {
    let metal = Material { metallic: 1.0, ..paint(Vec3::new(0.9, 0.6, 0.3)) };
    let quads = Quads::square(metal, Vec3::splat(PI));
    let Some(black) = centre(&quads, &plain()) else { return };
    assert_close(black, Vec3::ZERO);
    let shown = centre(&quads, &RenderSettings { metal_as_diffuse: true, ..plain() }).expect("a GPU");
    assert_close(shown, Vec3::new(0.9, 0.6, 0.3));
}

#[test]
fn unlit_surfaces_show_their_base_colour() {
    let sign = Material { unlit: true, ..paint(Vec3::new(0.1, 0.5, 0.9)) };
    let Some(radiance) = centre(&Quads::square(sign, Vec3::splat(100.0)), &plain()) else { return };
    assert_close(radiance, Vec3::new(0.1, 0.5, 0.9));
}

#[test]
fn albedo_and_normals_are_shown_without_light() {
    let quads = Quads::square(paint(Vec3::new(0.5, 0.25, 0.0)), Vec3::ZERO);
    let shown = |shading| {
        draw(&quads, &RenderSettings { shading, ..RenderSettings::default() }).map(|p| display_at(&p, 30, 30))
    };
    let Some(albedo) = shown(Shading::Albedo) else { return };
    assert_eq!(albedo, [188, 137, 0]);
    assert_eq!(shown(Shading::Normals), Some([188, 188, 255]));
    let lit = Quads::square(paint(Vec3::new(0.5, 0.25, 0.0)), Vec3::splat(PI));
    let light_alone = RenderSettings { shading: Shading::IrradianceOnly, ..plain() };
    assert_close(centre(&lit, &light_alone).expect("a GPU"), Vec3::ONE);
}

#[test]
fn light_can_be_replaced_on_the_device() {
    let Some(gpu) = gpu() else { return };
    let mut quads = Quads::square(paint(Vec3::ONE), Vec3::ZERO);
    let scene = SceneBuffers::new(gpu, &quads.baked);
    quads.light(GroupId(0), |_| Vec3::splat(PI), |_| Vec3::splat(PI));
    scene.set_light(gpu, &quads.baked.light);
    let replaced =
        draw_picture(gpu, &PictureRequest::new(&scene, &square_camera(), [SIZE; 2], &plain()), 1).expect("a picture");
    assert_close(radiance_at(&replaced, 9, 9), Vec3::splat(2.0));
}

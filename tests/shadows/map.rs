//! Shadow maps compared with rays, and with pictures without shadows.

use glam::Vec3;
use hemicube::render::ShadowTechnique;
use hemicube::scene::LightKind;

use super::stage::{Stage, at, settings};
use crate::support::device::gpu;

#[test]
fn case_22_maps_are_right_within_their_resolution_and_show_acne_without_bias() {
    let Some(gpu) = gpu() else { return };
    let kinds = [
        LightKind::Point { position: Vec3::new(0.7, 4.0, 0.4) },
        LightKind::Directional { direction: Vec3::new(0.3, -1.0, -0.4).normalize() },
        LightKind::Spot {
            position: Vec3::new(0.7, 4.0, 0.4),
            direction: Vec3::NEG_Y,
            inner_angle: 0.6,
            outer_angle: 0.8,
        },
    ];
    for kind in kinds {
        let mut stage = Stage::new();
        stage.cube(at(0.0, 1.0, 0.0), 0).sphere(Vec3::new(-1.6, 1.0, 0.3), 0.6).light(kind);
        // A slope that every map shows. A floor below the light has the same depth everywhere and shows no acne.
        stage.quad(Vec3::new(1.2, 0.0, 2.0), Vec3::new(1.4, 1.0, 0.0), Vec3::new(0.0, 0.0, -3.0));
        let shot = stage.shot(gpu);
        let mut map = settings(ShadowTechnique::Map);
        map.maps.resolution = 1024;
        let share = shot.fault(gpu, &map);
        assert!(share <= 0.005, "{kind:?}: {share}");
        (map.maps.normal_offset, map.maps.slope_bias, map.maps.pcf_radius) = (0.0, 0.0, 0);
        let with_acne = shot.fault(gpu, &map);
        assert!(with_acne > 0.01, "{kind:?}: {with_acne} without bias, {share} with");
    }
}

#[test]
fn maps_draw_no_dots_along_the_edges_of_triangles() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    // Fully lit walls, seen at an angle across the diagonals of their squares.
    stage.quad(Vec3::new(-5.0, 0.5, 4.0), -8.0 * Vec3::Z, 4.5 * Vec3::Y);
    stage.quad(Vec3::new(-4.0, 0.5, -5.0), 8.0 * Vec3::X, 4.5 * Vec3::Y);
    stage.seen(Vec3::new(-2.5, 2.0, 6.0), Vec3::new(-2.0, 1.5, 0.0));
    let shot = stage.shot(gpu);
    let [map, none] = [ShadowTechnique::Map, ShadowTechnique::None].map(|t| shot.picture(gpu, &settings(t), 4));
    let pairs = map.radiance.iter().zip(&none.radiance);
    let dots = pairs.filter(|(map, none)| (map[0] - none[0]).abs() > 0.01 * none[0]).count();
    assert_eq!(dots, 0);
}

#[test]
fn casters_of_a_few_texels_throw_shadows() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.light(LightKind::Directional { direction: Vec3::new(0.2, -1.0, -0.1).normalize() });
    stage.seen(Vec3::new(0.0, 3.0, 3.0), Vec3::ZERO);
    // About five texels wide, at any position in a block of eight texels.
    let width = 0.1;
    for (column, row) in (0..14).flat_map(|column| (0..14).map(move |row| (column, row))) {
        let corner = Vec3::new(-2.5 + 0.37 * column as f32, 0.3, -3.0 + 0.41 * row as f32);
        stage.quad(corner, width * Vec3::X, -width * Vec3::Z);
    }
    let shot = stage.shot(gpu);
    let mut map = settings(ShadowTechnique::Map);
    (map.maps.resolution, map.maps.pcf_radius) = (512, 0);
    let pictures = [&map, &settings(ShadowTechnique::Raytraced), &settings(ShadowTechnique::None)]
        .map(|settings| shot.picture(gpu, settings, 1).radiance);
    let [by_map, by_rays, lit] = pictures;
    let dark = |picture: &[[f32; 4]]| picture.iter().zip(&lit).filter(|(seen, lit)| seen[0] < 0.5 * lit[0]).count();
    let (by_map, by_rays) = (dark(&by_map), dark(&by_rays));
    assert!(by_rays > 1000 && by_map.abs_diff(by_rays) < by_rays / 10, "{by_map} pixels are dark, not {by_rays}");
}

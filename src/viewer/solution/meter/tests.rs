//! Tests: a reading equals that of `measure`; a grid lies on its surface and its statistics agree; the table.

use std::sync::{Arc, OnceLock};

use glam::Vec3;

use super::table::table_of;
use super::*;
use crate::bake::{BakeSettings, MeasureContext, MeasureSettings, MeshBudget, Method, Quality, bake, measure_with};
use crate::base::colour::luminance;
use crate::base::progress::Unwatched;
use crate::scene::builtin;
use crate::viewer::camera::collider::{Collider, Pick};
use crate::viewer::settings::light::GroupDial;
use crate::viewer::solution::solved::SolvedScene;

/// Returns the Cornell box, baked once in draft quality by rays.
fn cornell() -> &'static SolvedScene {
    static SOLVED: OnceLock<SolvedScene> = OnceLock::new();
    SOLVED.get_or_init(|| {
        let scene = Arc::new(builtin::cornell());
        let preset = BakeSettings::preset(Quality::Draft);
        let settings = BakeSettings {
            method: Some(Method::Hemisphere),
            budget: MeshBudget { elements: 2000.0, ..preset.budget },
            ..preset
        };
        let done = bake(&scene, &settings).expect("the box is baked");
        SolvedScene::of_bake(scene, done, &settings)
    })
}

/// Picks the floor in a corner of the box from above.
fn floor_pick() -> Pick {
    let collider = Collider::new(&cornell().scene);
    collider.pick(Vec3::new(4.8, 3.0, 0.8), Vec3::NEG_Y, |_| false).expect("the floor")
}

#[test]
fn the_meter_and_measure_give_the_same_number() {
    let solved = cornell();
    let point = point_of(&floor_pick());
    let reading = read(solved, point, &Unwatched).expect("nobody cancels");
    let settings = MeasureSettings::preset(Quality::Draft);
    let context =
        MeasureContext { scene: &solved.scene, mesh: &solved.mesh, baked: &solved.baked, progress: &Unwatched };
    let measured = measure_with(&context, &[point], &settings);
    assert_eq!(measured, Some(vec![reading.measured]));
    assert!(reading.lux() > 0.0 && reading.direct_share() > 0.1 && reading.direct_share() < 0.99, "{reading:?}");
}

#[test]
fn shares_of_groups_sum_to_one_and_dimming_follows_them() {
    let reading = read(cornell(), point_of(&floor_pick()), &Unwatched).expect("nobody cancels");
    assert!((reading.group_shares().iter().sum::<f32>() - 1.0).abs() < 1e-5, "{:?}", reading.groups);
    let dial = |intensity| vec![GroupDial { intensity, ..GroupDial::of("lamp") }; reading.groups.len()];
    assert!((reading.dimmed_lux(&dial(0.5)) - 0.5 * reading.lux()).abs() < 1e-3 * reading.lux());
    assert_eq!(reading.dimmed_lux(&dial(0.0)), 0.0);
    // Stored light is interpolated between vertices, so it only approximates the measured light.
    let stored: f32 = reading.groups.iter().map(|group| luminance(group.direct + group.indirect)).sum();
    assert!((stored / reading.lux() - 1.0).abs() < 0.25, "{stored} {}", reading.lux());
}

#[test]
fn the_reading_names_its_surface() {
    let solved = cornell();
    let pick = floor_pick();
    let reading = read(solved, point_of(&pick), &Unwatched).expect("nobody cancels");
    let surface = reading.surface.clone().expect("a surface");
    let instance = solved.scene.triangles[pick.triangle.index()].instance;
    assert_eq!(surface.instance, solved.scene.instances[instance.index()].name);
    assert_eq!(solved.mesh.elements[surface.element].triangle, pick.triangle);
    let expected = surface.reflectance * reading.measured.total;
    assert!((reading.radiosity().expect("a surface") - expected).length() < 1e-3);
}

#[test]
fn a_grid_lies_on_its_surface_and_its_statistics_agree() {
    let solved = cornell();
    let pick = floor_pick();
    let plan = GridPlan::over(&solved.scene, &pick, 1.1, 0.0);
    assert!(plan.points.len() >= 9 && plan.points.len() <= 400, "{}", plan.points.len());
    for point in &plan.points {
        assert!((point.position - pick.point).dot(pick.normal).abs() < 1e-4, "{point:?}");
    }
    let grid = plan.measure(solved, &Unwatched).expect("nobody cancels");
    assert!(grid.min() <= grid.mean() && grid.mean() <= grid.max() && grid.max() > 0.0);
    assert!((grid.uniformity() - grid.min() / grid.mean()).abs() < 1e-6);
    let table = table_of(&[], Some(&grid)).expect("a table");
    assert_eq!(table.lines().count(), grid.measured.len() + 1);
    assert!(table.starts_with("px,py,pz,nx,ny,nz,E_r"), "{table}");
}

#[test]
fn the_spacing_of_a_grid_is_widened_on_a_large_floor() {
    let plan = GridPlan::over(&cornell().scene, &floor_pick(), 1e-3, 0.8);
    assert!(plan.points.len() <= 400 && plan.spacing > 0.1, "{} at {}", plan.points.len(), plan.spacing);
    assert!((plan.points[0].position.y - floor_pick().point.y - 0.8).abs() < 1e-4);
}

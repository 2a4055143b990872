//! Known answers through the whole GPU route.

use glam::Vec3;
use hemicube::bake::{BakeSettings, Quality, bake};
use hemicube::base::progress::Unwatched;

use crate::support::device::gpu;
use crate::support::scenes;

/// Mean and worst relative deviation from the exact answer, over all vertices.
#[test]
fn in_a_furnace_every_vertex_has_the_closed_form_light() {
    let Some(gpu) = gpu() else { return };
    let (reflectance, exitance) = (Vec3::new(0.5, 0.7, 0.2), Vec3::new(1.0, 2.0, 3.0));
    let scene = scenes::furnace(reflectance, exitance);
    let settings = BakeSettings { element_size: Some(0.1), ..BakeSettings::preset(Quality::Draft) };
    let bake = bake(gpu, &scene, &BakeSettings { threshold: 1e-4, ..settings }, &Unwatched).unwrap();
    let exact = exitance / (Vec3::ONE - reflectance);
    let group = &bake.baked.light.groups[0];
    let mut worst = 0.0f32;
    for (direct, indirect) in group.direct.iter().zip(&group.indirect) {
        let radiosity = exitance + reflectance * (*direct + *indirect);
        worst = worst.max(((radiosity - exact) / exact).abs().max_element());
    }
    println!("{:?}", bake.report);
    assert!(worst < 5e-3, "worst deviation {worst}");
    assert!(bake.report.energy.imbalance < 1e-3, "{:?}", bake.report.energy);
}

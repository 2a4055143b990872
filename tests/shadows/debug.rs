//! Debug views show the data of the techniques.

use glam::Vec3;
use hemicube::gpu::Gpu;
use hemicube::render::shadow::count_colour;
use hemicube::render::shadow::{DebugView, ShadowDebug};
use hemicube::render::{Exposure, Picture, RenderSettings, ShadowSettings, ShadowTechnique, draw_picture};

use super::stage::{SIZE, Shot, Stage, at, settings};
use crate::support::device::gpu;

/// A cube over the middle of the floor, and the light straight above.
fn stage() -> Stage {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.2, 0.0), 0);
    stage.light(hemicube::scene::LightKind::Point { position: Vec3::new(0.0, 4.0, 0.0) });
    stage
}

fn picture(gpu: &Gpu, shot: &Shot, shadows: &ShadowSettings, view: Option<DebugView>) -> Picture {
    let render_settings = RenderSettings {
        shadows: Some(shadows.clone()),
        shadow_debug: view.map(|view| ShadowDebug { view, light: 0 }),
        exposure: Exposure::Ev(0.0),
        ..RenderSettings::default()
    };
    draw_picture(gpu, &shot.request(&render_settings), 1).expect("a picture")
}

fn pixel(picture: &Picture, at: usize) -> [u8; 3] {
    [picture.display[4 * at], picture.display[4 * at + 1], picture.display[4 * at + 2]]
}

fn num_changed(a: &Picture, b: &Picture) -> usize {
    a.display.as_chunks::<4>().0.iter().zip(b.display.as_chunks::<4>().0).filter(|(a, b)| a != b).count()
}

#[test]
fn a_count_of_one_has_the_colour_of_one() {
    let Some(gpu) = gpu() else { return };
    let shot = stage().shot(gpu);
    for technique in [ShadowTechnique::VolumeDepthFail, ShadowTechnique::VolumeDepthPass, ShadowTechnique::Planar] {
        let settings = settings(technique);
        let bits = if technique == ShadowTechnique::Planar { 7 } else { 255 };
        let counts = shot.stencil(gpu, &settings);
        let plain = picture(gpu, &shot, &settings, None);
        let shown = picture(gpu, &shot, &settings, Some(DebugView::StencilCounts));
        let once: Vec<usize> = (0..counts.len()).filter(|&at| counts[at] & bits == 1).collect();
        assert!(once.len() > 100, "{technique:?}: {} pixels", once.len());
        for at in once {
            let (found, under) = (pixel(&shown, at), pixel(&plain, at));
            for channel in 0..3 {
                let expected = 0.78 * f32::from(count_colour(1)[channel]) + 0.22 * f32::from(under[channel]);
                assert!((f32::from(found[channel]) - expected).abs() < 4.0, "{technique:?}: {found:?} over {under:?}");
            }
        }
    }
}

#[test]
fn a_map_shows_the_cube_nearer_than_the_floor() {
    let Some(gpu) = gpu() else { return };
    let shot = stage().shot(gpu);
    let shown = picture(gpu, &shot, &settings(ShadowTechnique::Map), Some(DebugView::Map));
    // The faces are squares of 85 pixels in two rows of three. The light looks down in the first face of the second
    // row.
    let side = SIZE[0] as usize / 3;
    let left = (SIZE[0] as usize - 3 * side) / 2;
    let (row, column) = (SIZE[1] as usize / 2 + side / 2, left + side / 2);
    let [top, floor] = [column, column + side * 3 / 8].map(|x| pixel(&shown, row * SIZE[0] as usize + x)[0]);
    assert!(top > floor + 20, "{top} and {floor}");
    // The face that looks up is empty.
    let [r, _, b] = pixel(&shown, (SIZE[1] as usize / 2 - side / 2) * SIZE[0] as usize + column + 2 * side);
    assert!(b > r + 20, "{r} {b}");
}

#[test]
fn hulls_outlines_and_receivers_are_drawn_over_the_picture() {
    let Some(gpu) = gpu() else { return };
    let shot = stage().shot(gpu);
    let settings = settings(ShadowTechnique::VolumeDepthFail);
    let shown = |view| picture(gpu, &shot, &settings, view);
    let plain = shown(None);
    let outlines = num_changed(&plain, &shown(Some(DebugView::Silhouettes)));
    let hulls = num_changed(&plain, &shown(Some(DebugView::Volumes)));
    let receivers = num_changed(&plain, &shown(Some(DebugView::Receivers)));
    assert!((50..2000).contains(&outlines), "{outlines} pixels of outlines");
    assert!(hulls > 2 * outlines, "{hulls} pixels of hulls");
    let covered = plain.radiance.iter().filter(|pixel| pixel[3] > 0.0).count();
    assert!(receivers > covered * 9 / 10, "{receivers} of {covered} are on receivers");
}

//! One scene with all known hard cases, seen from positions that are difficult for shadows.

use glam::{Mat4, Quat, Vec3};
use hemicube::gpu::Gpu;
use hemicube::render::ShadowTechnique;
use hemicube::render::shadow::shadow_difference;
use hemicube::scene::{AlphaMode, Camera, LightKind, Material};

use super::stage::{Shot, Stage, at, num_different, paint, places, raytraced, settings};
use crate::support::device::gpu;
use crate::support::quads::{slot, texture};

/// The picture is small, because volumes cover it thousands of times.
const SIZE: [u32; 2] = [128, 96];

/// Creates all bodies, side by side. The numbers are those of the cases.
fn bodies() -> Stage {
    let mut stage = Stage::new();
    let turned = Mat4::from_quat(Quat::from_rotation_y(0.7));
    // 9: open meshes. 12: faces turned over.
    stage.cube(at(-3.2, 0.9, 2.8) * Mat4::from_scale(Vec3::splat(0.7)) * turned, 1);
    stage.cube(at(-2.0, 0.9, 2.8) * Mat4::from_scale(Vec3::splat(0.7)), 3);
    let first = stage.scene.triangles.len();
    stage.cube(at(-0.8, 0.6, 2.8) * Mat4::from_scale(Vec3::splat(0.7)), 0);
    stage.scene.triangles[first..].iter_mut().step_by(3).for_each(|triangle| triangle.vertices.swap(1, 2));
    // 10: single quads, one of them with two faces.
    let two_faced = stage.material(Material { double_sided: true, ..paint() });
    stage.quad(Vec3::new(0.2, 0.9, 3.2), 0.7 * Vec3::X, Vec3::new(0.0, 0.2, -0.7));
    stage.quad_of(Vec3::new(1.2, 0.9, 3.2), Vec3::new(0.0, 0.2, -0.7), 0.7 * Vec3::X, two_faced);
    // 11: three faces at an edge.
    for angle in [0.3f32, 2.0, 4.5] {
        stage.quad(Vec3::new(2.4, 0.9, 2.8), 0.8 * Vec3::X, 0.6 * Vec3::new(0.0, angle.sin(), angle.cos()));
    }
    // 13, 14: mirrored and stretched.
    stage.cube(at(-3.2, 0.7, 1.0) * turned * Mat4::from_scale(Vec3::new(-0.4, 1.1, 0.3)), 0);
    stage.cube(at(-2.0, 0.8, 1.0) * Mat4::from_scale(Vec3::new(1.1, 0.08, 0.4)) * turned, 0);
    // 15: twice, and without area.
    stage.cube(at(-0.7, 0.5, 1.0) * Mat4::from_scale(Vec3::splat(0.6)), 0);
    stage.cube(at(-0.7, 0.5, 1.0) * Mat4::from_scale(Vec3::splat(0.6)), 0);
    stage.triangle([Vec3::new(-1.0, 1.0, 0.0), Vec3::new(-0.5, 1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)], 0);
    // 16: corners in the middle of an edge, in a plane with inexact coordinates.
    let (u, v, origin) = (Vec3::new(0.61, 0.17, 0.09), Vec3::new(-0.13, 0.21, -0.71), Vec3::new(0.3, 0.7, 1.4));
    stage.quad(origin, u, v);
    for i in 0..7 {
        let [a, b] = [i, i + 1].map(|i| origin + u + v * (i as f32 / 7.0));
        stage.triangle([a, a + u, b + u], 0).triangle([a, b + u, b], 0);
    }
    // 17: more volumes within each other than the stencil counts.
    for i in 0..260 {
        stage.quad(Vec3::new(2.5, 0.1 + 0.001 * i as f32, 1.3), 0.12 * Vec3::X, -0.12 * Vec3::Z);
    }
    // 19: holes, and surfaces that blend.
    let holes: Vec<[u8; 4]> = (0..16).map(|i| [255, 255, 255, if (i + i / 4) % 2 == 0 { 255 } else { 0 }]).collect();
    stage.scene.textures.push(texture(4, &holes));
    let alpha_mode = AlphaMode::Mask { cutoff: 0.5 };
    let grille = stage.material(Material { alpha_mode, base_colour_texture: Some(slot(0)), ..paint() });
    let mut glass = paint();
    glass.base_colour.w = 0.3;
    let glass = stage.material(Material { alpha_mode: AlphaMode::Blend, ..glass });
    stage.quad_of(Vec3::new(-3.6, 0.9, -0.6), Vec3::X, -Vec3::Z, grille);
    stage.quad_of(Vec3::new(-2.2, 0.9, -0.6), 0.7 * Vec3::X, -0.7 * Vec3::Z, glass);
    // 20: a smooth ball. 21: through the floor, and below it.
    stage.sphere(Vec3::new(-0.6, 0.8, -1.0), 0.6);
    stage.cube(at(0.8, 0.1, -1.0) * Mat4::from_scale(Vec3::splat(0.7)) * turned, 0);
    stage.cube(at(0.8, -1.5, -1.0), 0);
    // 6: a lampshade round a light, open below. 5: a closed room round all, with the floor inside.
    stage.cube(at(2.6, 2.2, -1.4) * Mat4::from_quat(Quat::from_rotation_z(-1.571)), 1);
    stage.cube(at(0.0, 3.0, 0.0) * Mat4::from_scale(Vec3::new(-11.0, 11.0, 11.0)), 0);
    stage
}

fn lights() -> Vec<(&'static str, LightKind)> {
    let point = |x, y, z| LightKind::Point { position: Vec3::new(x, y, z) };
    vec![
        ("in the closed room (5)", point(0.7, 4.0, 0.4)),
        ("in a lampshade (6)", point(2.6, 2.2, -1.4)),
        ("in the plane of a side (7)", point(-0.4, 3.7, 1.3)),
        ("in the plane of a sheet (7)", point(-3.1, 0.9, 0.4)),
    ]
}

fn cameras() -> Vec<(&'static str, Camera)> {
    let looking = |eye: [f32; 3], target: [f32; 3]| Camera::looking_at("", eye.into(), target.into(), 0.9);
    // An eye in the side of the volume that begins at a corner of the mirrored box.
    let light = Vec3::new(0.7, 4.0, 0.4);
    let edge = Vec3::new(-0.4, 0.8, 1.3);
    let cut = edge + 0.3 * (edge - light).normalize();
    vec![
        ("over all", looking([0.0, 3.2, 5.2], [0.0, 0.4, 0.0])),
        ("inside a volume (1)", looking([2.8, 0.3, 1.0], [-2.0, 0.4, 0.5])),
        ("near plane in the side of a volume (2)", looking(cut.to_array(), [2.0, 0.2, -1.0])),
        ("casters behind the eye (3)", looking([-0.5, 0.5, 0.5], [-0.5, 0.2, -3.0])),
        ("caster between light and eye (4)", looking([-0.7, 0.35, 1.3], [-2.0, 0.0, 3.5])),
        ("inside a body", looking([-2.0, 0.9, 2.8], [1.0, 0.0, 0.0])),
    ]
}

/// Returns each camera with one of the lights in turn.
fn views(gpu: &Gpu) -> impl Iterator<Item = (String, Shot)> {
    cameras().into_iter().zip(lights().into_iter().cycle()).map(|((place, camera), (light, kind))| {
        let mut stage = bodies();
        stage.light(kind).camera = camera;
        (format!("eye {place}, light {light}"), Shot { size: SIZE, ..stage.shot(gpu) })
    })
}

#[test]
fn volumes_decide_as_rays_do_from_all_positions() {
    let Some(gpu) = gpu() else { return };
    for (view, shot) in views(gpu) {
        let truth = shot.decisions(gpu, &raytraced());
        for technique in [ShadowTechnique::VolumeDepthFail, ShadowTechnique::VolumeDepthPass] {
            let difference = shadow_difference(&shot.decisions(gpu, &settings(technique)), &truth);
            assert_eq!(num_different(&difference), 0, "{technique:?}, {view}: {:?}", places(&difference));
        }
    }
}

#[test]
fn joined_volumes_and_single_triangles_count_the_same() {
    let Some(gpu) = gpu() else { return };
    for (view, shot) in views(gpu) {
        let joined = settings(ShadowTechnique::VolumeDepthFail);
        let mut alone = joined.clone();
        alone.volumes.joined = false;
        let [joined, alone] = [&joined, &alone].map(|settings| shot.stencil(gpu, settings));
        assert!(joined.iter().any(|&count| count > 0), "{view}: no shadow at all");
        assert_eq!(joined.iter().zip(&alone).filter(|(a, b)| a != b).count(), 0, "{view}");
    }
}

#[test]
fn case_26_all_techniques_agree_with_rays() {
    let Some(gpu) = gpu() else { return };
    let mut map = settings(ShadowTechnique::Map);
    map.maps.resolution = 1024;
    for (view, shot) in views(gpu).step_by(4) {
        let truth = shot.decisions(gpu, &raytraced());
        for (wanted, most) in [(&map, 0.005), (&settings(ShadowTechnique::Planar), 0.0)] {
            let share = shadow_difference(&shot.decisions(gpu, wanted), &truth).share;
            assert!(share <= most, "{:?}, {view}: {share}", wanted.technique);
        }
    }
}

//! Shadows: every technique against rays, on scenes made to break them.

use std::sync::Arc;

use glam::{Mat4, Quat, Vec3, Vec4};
use hemicube::baked::{BakedScene, VertexLight};
use hemicube::base::ids::{GroupId, InstanceId, MaterialId};
use hemicube::gpu::{Gpu, SceneBuffers};
use hemicube::render::picture_in_light;
use hemicube::render::shadow::casters::Casters;
use hemicube::render::shadow::silhouette::{Counting, facing, hull};
use hemicube::render::shadow::{Decisions, ShadowDifference, shadow_difference};
use hemicube::render::{Exposure, Look, Picture, ShadowScene, ShadowSettings, ShadowTechnique, ToneMap, View};
use hemicube::scene::{AlphaMode, Camera, Instance, Light, LightKind, Material, Scene, Triangle, Vertex, builtin};

use crate::support::device::gpu;
use crate::support::quads::{slot, texture};
use crate::support::snapshot::assert_snapshot;

const SIZE: [u32; 2] = [256, 192];

/// A floor of 8 m, and what stands over it.
struct Stage {
    scene: Scene,
    camera: Camera,
}

impl Stage {
    /// The floor alone, lit by a point light, seen from one side.
    fn new() -> Self {
        let mut scene = Scene { materials: vec![paint()], light_groups: vec!["light".to_owned()], ..Scene::default() };
        scene.instances.push(Instance { name: "all".to_owned(), triangles: 0..0 });
        let camera = Camera::looking_at("side", Vec3::new(0.0, 3.0, 7.0), Vec3::new(0.0, 0.5, 0.0), 0.9);
        let mut stage = Self { scene, camera };
        stage.quad(Vec3::new(-4.0, 0.0, 4.0), 8.0 * Vec3::X, -8.0 * Vec3::Z);
        stage.light(LightKind::Point { position: Vec3::new(0.7, 4.0, 0.4) });
        stage
    }

    fn light(&mut self, kind: LightKind) -> &mut Self {
        let intensity = Vec3::splat(30.0);
        self.scene.lights = vec![Light { name: String::new(), kind, intensity, range: None, group: GroupId(0) }];
        self
    }

    fn seen(&mut self, eye: Vec3, target: Vec3) -> &mut Self {
        self.camera = Camera::looking_at("other", eye, target, 0.9);
        self
    }

    fn material(&mut self, material: Material) -> u32 {
        self.scene.materials.push(material);
        self.scene.materials.len() as u32 - 1
    }

    fn triangle(&mut self, corners: [Vec3; 3], material: u32) -> &mut Self {
        let normal = hemicube::scene::normal_of(corners);
        let first = self.scene.vertices.len() as u32;
        let uv = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        for (position, uv) in corners.into_iter().zip(uv) {
            self.scene.vertices.push(Vertex { position, normal, uv: [uv.into(); 2], colour: Vec4::ONE });
        }
        self.scene.triangles.push(Triangle {
            vertices: [first, first + 1, first + 2],
            material: MaterialId(material),
            instance: InstanceId(0),
            is_back_side: false,
        });
        self
    }

    /// A parallelogram with its front towards `u` x `v`; its corners are not shared.
    fn quad(&mut self, origin: Vec3, u: Vec3, v: Vec3) -> &mut Self {
        self.quad_of(origin, u, v, 0)
    }

    fn quad_of(&mut self, origin: Vec3, u: Vec3, v: Vec3, material: u32) -> &mut Self {
        self.triangle([origin, origin + u, origin + u + v], material);
        self.triangle([origin, origin + u + v, origin + v], material)
    }

    /// The sides of a unit cube under `transform`, but for the first `num_open`.
    fn cube(&mut self, transform: Mat4, num_open: usize) -> &mut Self {
        let sides = [(Vec3::Y, Vec3::Z, Vec3::X), (Vec3::X, Vec3::Y, Vec3::Z), (Vec3::Z, Vec3::X, Vec3::Y)];
        let faces = sides.into_iter().flat_map(|(n, u, v)| [(n, u, v), (-n, v, u)]);
        let is_mirrored = transform.determinant() < 0.0;
        for (n, u, v) in faces.skip(num_open) {
            let (u, v) = if is_mirrored { (v, u) } else { (u, v) };
            let origin = transform.transform_point3(0.5 * (n - u - v));
            self.quad(origin, transform.transform_vector3(u), transform.transform_vector3(v));
        }
        self
    }

    fn sphere(&mut self, centre: Vec3, radius: f32) -> &mut Self {
        let (columns, rows) = (20, 10);
        let at = |i: i32, j: i32| {
            let (phi, theta) =
                (i as f32 / columns as f32 * std::f32::consts::TAU, j as f32 / rows as f32 * std::f32::consts::PI);
            // The last column is the first, to the bit.
            let phi = if i == columns { 0.0 } else { phi };
            let theta = if j == rows { std::f32::consts::PI } else { theta };
            let ring = if j == 0 || j == rows { 0.0 } else { theta.sin() };
            centre + radius * Vec3::new(ring * phi.sin(), theta.cos(), ring * phi.cos())
        };
        for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
            let first = self.scene.vertices.len();
            if j > 0 {
                self.triangle([at(i, j), at(i + 1, j + 1), at(i + 1, j)], 0);
            }
            if j + 1 < rows {
                self.triangle([at(i, j), at(i, j + 1), at(i + 1, j + 1)], 0);
            }
            for vertex in &mut self.scene.vertices[first..] {
                vertex.normal = (vertex.position - centre).normalize();
            }
        }
        self
    }

    /// On the device with stored light.
    fn lit(&self, gpu: &Gpu, light: VertexLight) -> SceneBuffers {
        SceneBuffers::new(gpu, &BakedScene { scene: self.scene.clone(), light })
    }

    /// Where the middle of a pixel looks at the floor.
    fn floor_under(&self, x: u32, y: u32) -> Vec3 {
        let view = View::from_camera(&self.camera, SIZE[0] as f32 / SIZE[1] as f32);
        let right = 2.0 * (x as f32 + 0.5) / SIZE[0] as f32 - 1.0;
        let up = 1.0 - 2.0 * (y as f32 + 0.5) / SIZE[1] as f32;
        let seen = view.projection_from_world().inverse().project_point3(Vec3::new(right, up, 0.5));
        let eye = self.camera.position;
        eye + (seen - eye) * (eye.y / (eye.y - seen.y))
    }

    fn shot(&self, gpu: &Gpu) -> Shot {
        let mut scene = self.scene.clone();
        scene.instances[0].triangles = 0..scene.triangles.len();
        let light = VertexLight::dark(1, scene.vertices.len());
        let baked = BakedScene { scene, light };
        Shot {
            buffers: SceneBuffers::new(gpu, &baked),
            shadows: Arc::new(ShadowScene::new(gpu, Arc::new(baked.scene))),
            camera: self.camera.clone(),
        }
    }

    /// Fails unless volumes, joined or not and counted either way, decide as rays do.
    #[track_caller]
    fn assert_volumes_are_exact(&self) {
        let Some(gpu) = gpu() else { return };
        let shot = self.shot(gpu);
        let truth = shot.decisions(gpu, &raytraced());
        let dark = truth.samples[0].lit.iter().filter(|lit| !**lit).count();
        assert!(dark > 100 && dark < truth.samples[0].lit.len(), "{dark} dark pixels show nothing");
        let joined = settings(ShadowTechnique::VolumeDepthFail);
        let mut alone = joined.clone();
        alone.volumes.joined = false;
        for wanted in [&joined, &alone, &settings(ShadowTechnique::VolumeDepthPass)] {
            let difference = shadow_difference(&shot.decisions(gpu, wanted), &truth);
            assert_eq!(num_different(&difference), 0, "{wanted:?} at {:?}", places(&difference));
        }
    }
}

/// A stage on the device.
struct Shot {
    buffers: SceneBuffers,
    shadows: Arc<ShadowScene>,
    camera: Camera,
}

impl Shot {
    fn decisions(&self, gpu: &Gpu, settings: &ShadowSettings) -> Decisions {
        let view = View::from_camera(&self.camera, SIZE[0] as f32 / SIZE[1] as f32);
        Decisions::new(gpu, &self.buffers, &self.shadows, &view, SIZE, settings).expect("decisions")
    }

    /// Share of pixels that differ from the truth.
    fn fault(&self, gpu: &Gpu, settings: &ShadowSettings) -> f32 {
        shadow_difference(&self.decisions(gpu, settings), &self.decisions(gpu, &raytraced())).share
    }

    fn picture(&self, gpu: &Gpu, settings: &ShadowSettings, samples: u32) -> Picture {
        let look = Look {
            shadows: Some(settings.clone()),
            exposure: Exposure::Ev(0.0),
            tone_map: ToneMap::Linear,
            ambient: Vec3::splat(0.1),
            ..Look::default()
        };
        picture_in_light(gpu, &self.buffers, Some(Arc::clone(&self.shadows)), &self.camera, SIZE, &look, samples)
            .expect("a picture")
    }
}

fn paint() -> Material {
    Material { base_colour: Vec4::new(0.5, 0.5, 0.5, 1.0), metallic: 0.0, ..Material::default() }
}

fn settings(technique: ShadowTechnique) -> ShadowSettings {
    ShadowSettings::new(technique)
}

fn raytraced() -> ShadowSettings {
    settings(ShadowTechnique::Raytraced)
}

fn num_different(difference: &ShadowDifference) -> usize {
    difference.count.iter().filter(|&&count| count > 0).count()
}

/// Column, row and whether it is too bright, of the first pixels that differ.
fn places(difference: &ShadowDifference) -> Vec<(usize, usize, bool)> {
    let width = difference.size[0] as usize;
    let differing = (0..difference.count.len()).filter(|&pixel| difference.count[pixel] > 0);
    differing.map(|pixel| (pixel % width, pixel / width, difference.is_too_bright[pixel])).take(8).collect()
}

fn at(x: f32, y: f32, z: f32) -> Mat4 {
    Mat4::from_translation(Vec3::new(x, y, z))
}

// The numbers are those of the cases that are known to break shadows.

#[test]
fn case_01_the_eye_is_inside_a_volume() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 2.5, 0.0), 0);
    stage.seen(Vec3::new(-0.2, 0.6, 0.1), Vec3::new(4.0, 0.0, 0.6));
    stage.assert_volumes_are_exact();
    let Some(gpu) = gpu() else { return };
    let mut plain = settings(ShadowTechnique::VolumeDepthPass);
    plain.volumes.near_plane_cure = false;
    assert!(stage.shot(gpu).fault(gpu, &plain) > 0.1, "the text book's fault is to be seen");
}

#[test]
fn case_02_the_near_plane_cuts_a_volume() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 2.5, 0.0), 0);
    // The side of the volume runs right through the eye.
    let light = Vec3::new(0.7, 4.0, 0.4);
    let edge = Vec3::new(-0.5, 3.0, 0.1);
    let eye = edge + 0.9 * (edge - light);
    stage.seen(eye, Vec3::new(4.0, 0.0, 0.6));
    stage.assert_volumes_are_exact();
}

#[test]
fn case_03_the_caster_is_behind_the_eye() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 2.0, 3.0), 0).light(LightKind::Point { position: Vec3::new(0.2, 3.5, 5.5) });
    stage.seen(Vec3::new(0.0, 1.5, 2.0), Vec3::new(0.0, 0.0, 0.0));
    stage.assert_volumes_are_exact();
}

#[test]
fn case_04_the_caster_is_between_light_and_eye() {
    let mut stage = Stage::new();
    stage.cube(at(0.3, 2.4, 3.0), 0).light(LightKind::Point { position: Vec3::new(0.4, 4.0, 1.0) });
    stage.seen(Vec3::new(0.2, 1.2, 4.6), Vec3::new(0.0, 0.0, 0.0));
    stage.assert_volumes_are_exact();
}

#[test]
fn case_05_the_light_is_in_a_closed_room() {
    let mut stage = Stage::new();
    // The floor lies within the room.
    stage.cube(at(0.0, 2.0, 0.0) * Mat4::from_scale(Vec3::new(-9.0, 9.0, 9.0)), 0);
    stage.cube(at(-1.0, 0.8, 0.0), 0);
    stage.seen(Vec3::new(0.0, 2.0, 4.2), Vec3::new(-0.5, 0.5, 0.0));
    stage.assert_volumes_are_exact();
}

#[test]
fn case_06_the_light_is_inside_a_caster() {
    let mut stage = Stage::new();
    // It is open to one side.
    stage.cube(at(0.7, 4.0, 0.4) * Mat4::from_quat(Quat::from_rotation_z(2.2)), 1);
    stage.assert_volumes_are_exact();
}

#[test]
fn case_07_the_light_is_in_the_plane_of_a_triangle() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.0, 0.0), 0).light(LightKind::Point { position: Vec3::new(2.5, 1.5, 0.3) });
    stage.assert_volumes_are_exact();
    stage.light(LightKind::Point { position: Vec3::new(0.5, 4.0, 0.5) });
    stage.assert_volumes_are_exact();
}

#[test]
fn case_08_the_light_is_infinitely_or_very_far() {
    let direction = Vec3::new(0.3, -1.0, -0.4).normalize();
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.5, 0.0), 0).light(LightKind::Directional { direction });
    stage.assert_volumes_are_exact();
    stage.light(LightKind::Point { position: -1e6 * direction });
    stage.scene.lights[0].intensity = Vec3::splat(1e13);
    stage.assert_volumes_are_exact();
}

#[test]
fn case_09_an_open_mesh() {
    for num_open in 1..=4 {
        let mut stage = Stage::new();
        stage.cube(at(0.0, 1.5, 0.0) * Mat4::from_quat(Quat::from_rotation_y(0.5)), num_open);
        stage.assert_volumes_are_exact();
    }
}

#[test]
fn case_10_a_single_quad_with_one_side_or_two() {
    for double_sided in [false, true] {
        let mut stage = Stage::new();
        let material = stage.material(Material { double_sided, ..paint() });
        stage.quad_of(Vec3::new(-0.5, 1.5, 0.5), Vec3::X, Vec3::new(0.0, 0.3, -1.0), material);
        stage.quad_of(Vec3::new(-2.5, 2.0, 0.5), Vec3::new(0.0, 0.3, -1.0), Vec3::X, material);
        stage.assert_volumes_are_exact();
    }
}

#[test]
fn case_11_an_edge_with_three_faces() {
    let mut stage = Stage::new();
    for angle in [0.3f32, 2.0, 4.5] {
        let spoke = Vec3::new(0.0, angle.sin(), angle.cos());
        stage.quad(Vec3::new(-0.7, 1.8, 0.0), 1.4 * Vec3::X, spoke);
    }
    stage.assert_volumes_are_exact();
}

#[test]
fn case_12_faces_turned_over_within_one_mesh() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.5, 0.0), 0);
    for triangle in stage.scene.triangles.iter_mut().skip(2).step_by(3) {
        triangle.vertices.swap(1, 2);
    }
    stage.assert_volumes_are_exact();
}

#[test]
fn case_13_and_14_mirrored_and_stretched_instances() {
    let mut stage = Stage::new();
    let turned = Mat4::from_quat(Quat::from_rotation_y(0.7));
    stage.cube(at(-1.0, 1.2, 0.0) * turned * Mat4::from_scale(Vec3::new(-0.5, 1.7, 0.4)), 0);
    stage.cube(at(1.2, 1.5, 0.3) * Mat4::from_scale(Vec3::new(2.0, 0.1, 0.6)) * turned, 0);
    stage.assert_volumes_are_exact();
}

#[test]
fn case_15_triangles_twice_and_without_area() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.5, 0.0), 0).cube(at(0.0, 1.5, 0.0), 0);
    stage.triangle([Vec3::new(-2.0, 1.0, 0.0), Vec3::new(-1.0, 1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)], 0);
    stage.triangle([Vec3::ONE; 3], 0);
    stage.assert_volumes_are_exact();
    // What lies twice in one place is lit once.
    let Some(gpu) = gpu() else { return };
    let once = |stage: &Stage| stage.shot(gpu).picture(gpu, &settings(ShadowTechnique::None), 1).radiance;
    let mut single = Stage::new();
    single.cube(at(0.0, 1.5, 0.0), 0);
    assert_eq!(once(&stage), once(&single));
}

#[test]
fn case_16_corners_in_the_middle_of_edges() {
    let mut stage = Stage::new();
    // One quad beside seven that share its edge, in a tilted plane where nothing is exact.
    let (u, v) = (Vec3::new(1.3, 0.17, 0.29), Vec3::new(-0.23, 0.31, -1.1));
    let origin = Vec3::new(-1.0, 1.7, 0.6);
    stage.quad(origin, u, v);
    let near: Vec<Vec3> = (0..=7).map(|i| origin + u + v * (i as f32 / 7.0)).collect();
    let far: Vec<Vec3> = near.iter().map(|&corner| corner + u).collect();
    for i in 0..7 {
        stage.triangle([near[i], far[i], far[i + 1]], 0).triangle([near[i], far[i + 1], near[i + 1]], 0);
    }
    stage.assert_volumes_are_exact();
    let casters = Casters::new(&stage.scene);
    let place = Vec4::new(0.7, 4.0, 0.4, 1.0);
    let sides = hull(&casters, &facing(&casters, place), place, Counting::DepthPass).walls.len() / 6;
    assert_eq!(sides, 4 + 3 + 7 + 2, "sides of the floor and of the outline");
}

#[test]
fn case_17_more_than_255_volumes_within_each_other() {
    let mut stage = Stage::new();
    for i in 0..300 {
        stage.quad(Vec3::new(-0.6, 1.0 + 0.002 * i as f32, 0.6), 1.2 * Vec3::X, -1.2 * Vec3::Z);
    }
    stage.assert_volumes_are_exact();
}

#[test]
fn case_18_the_empty_background_stays_empty() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.5, 0.0), 0).seen(Vec3::new(0.0, 0.5, 7.0), Vec3::new(0.0, 2.5, 0.0));
    stage.assert_volumes_are_exact();
    let Some(gpu) = gpu() else { return };
    let picture = stage.shot(gpu).picture(gpu, &settings(ShadowTechnique::VolumeDepthFail), 1);
    assert!(picture.radiance.iter().filter(|pixel| pixel[3] == 0.0).count() > 1000);
    assert!(picture.radiance.iter().all(|pixel| pixel[3] == 1.0 || pixel == &[0.0; 4]));
}

#[test]
fn case_19_casters_with_holes_and_see_through_ones() {
    let mut stage = Stage::new();
    let holes: Vec<[u8; 4]> = (0..16).map(|i| [255, 255, 255, if (i + i / 4) % 2 == 0 { 255 } else { 0 }]).collect();
    stage.scene.textures.push(texture(4, &holes));
    let base_colour_texture = Some(slot(0));
    let grille =
        stage.material(Material { alpha_mode: AlphaMode::Mask { cutoff: 0.5 }, base_colour_texture, ..paint() });
    let mut glass = paint();
    glass.base_colour.w = 0.3;
    let glass = stage.material(Material { alpha_mode: AlphaMode::Blend, ..glass });
    stage.quad_of(Vec3::new(-1.5, 1.5, 0.7), 1.5 * Vec3::X, -1.5 * Vec3::Z, grille);
    stage.quad_of(Vec3::new(0.8, 1.5, 0.7), Vec3::X, -Vec3::Z, glass);
    stage.assert_volumes_are_exact();
}

#[test]
fn case_20_the_terminator_of_a_smooth_sphere() {
    let mut stage = Stage::new();
    stage.sphere(Vec3::new(0.0, 1.3, 0.0), 1.0);
    stage.assert_volumes_are_exact();
}

#[test]
fn case_21_planar_shadows_show_each_fault_when_its_cure_is_off() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    // One box through the floor, one over another, one whose shadow would stick out, one below the floor.
    stage.cube(at(-1.5, 0.2, 0.0), 0).cube(at(0.5, 1.0, 0.0), 0).cube(at(0.6, 2.2, 0.1), 0).cube(at(3.4, 0.9, 0.0), 0);
    stage.cube(at(1.0, -1.5, 2.5), 0);
    // A lower floor beyond the edge of the upper one.
    stage.quad(Vec3::new(4.0, -1.5, 4.0), 6.0 * Vec3::X, -8.0 * Vec3::Z);
    stage.seen(Vec3::new(2.5, 4.0, 7.0), Vec3::new(2.5, 0.0, 0.0));
    let shot = stage.shot(gpu);
    let mut planar = settings(ShadowTechnique::Planar);
    planar.planar.num_receivers = 1;
    assert_eq!(shot.fault(gpu, &planar), 0.0, "right on its receiver");
    let with = |change: fn(&mut ShadowSettings)| {
        let mut faulty = planar.clone();
        change(&mut faulty);
        faulty
    };
    let right = shot.picture(gpu, &planar, 1);
    let changed = |faulty: &ShadowSettings| {
        let picture = shot.picture(gpu, faulty, 1);
        let pairs = picture.radiance.iter().zip(&right.radiance);
        pairs.filter(|(a, b)| (a[0] - b[0]).abs() > 0.01).count()
    };
    let sticking_out = changed(&with(|s| s.planar.stays_on_receiver = false));
    let fighting = changed(&with(|s| s.planar.is_free_of_depth = false));
    let twice = changed(&with(|s| s.planar.darkens_once = false));
    let below = changed(&with(|s| s.planar.clips_casters = false));
    assert!(sticking_out > 50, "sticking out: {sticking_out}");
    assert!(fighting > 50, "fighting for depth: {fighting}");
    assert!(twice > 50, "darkened twice: {twice}");
    assert!(below > 50, "thrown from below: {below}");
}

#[test]
fn case_21_a_light_under_the_plane_throws_no_planar_shadow() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.0, 0.0), 0).light(LightKind::Point { position: Vec3::new(0.3, -3.0, 0.2) });
    assert_eq!(stage.shot(gpu).fault(gpu, &settings(ShadowTechnique::Planar)), 0.0);
}

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
        let shot = stage.shot(gpu);
        let mut map = settings(ShadowTechnique::Map);
        map.maps.resolution = 1024;
        let share = shot.fault(gpu, &map);
        assert!(share <= 0.005, "{kind:?}: {share}");
        (map.maps.normal_offset, map.maps.slope_bias, map.maps.pcf_radius) = (0.0, 0.0, 0);
        let with_acne = shot.fault(gpu, &map);
        assert!(with_acne > 0.003 && with_acne > 4.0 * share, "{kind:?}: {with_acne} without bias, {share} with");
    }
}

#[test]
fn case_23_several_samples_a_pixel_change_edges_only() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.2, 0.0), 0);
    let shot = stage.shot(gpu);
    for technique in [ShadowTechnique::VolumeDepthFail, ShadowTechnique::VolumeDepthPass, ShadowTechnique::Planar] {
        let [one, four] = [1, 4].map(|samples| shot.picture(gpu, &settings(technique), samples));
        let pairs = one.radiance.iter().zip(&four.radiance);
        let differing = pairs.filter(|(a, b)| (a[0] - b[0]).abs() > 0.01 * a[0].max(0.1)).count();
        assert!(differing < one.radiance.len() / 20, "{technique:?}: {differing}");
    }
}

#[test]
fn case_25_each_light_has_a_stencil_of_its_own() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.2, 0.0), 0);
    let mut other = stage.scene.lights[0].clone();
    other.kind = LightKind::Point { position: Vec3::new(-3.0, 3.0, 1.0) };
    stage.scene.lights.push(other);
    let shot = stage.shot(gpu);
    let truth = shot.decisions(gpu, &raytraced());
    assert_eq!(truth.samples.len(), 2);
    for technique in [ShadowTechnique::VolumeDepthFail, ShadowTechnique::VolumeDepthPass] {
        let found = shadow_difference(&shot.decisions(gpu, &settings(technique)), &truth);
        assert_eq!(num_different(&found), 0);
    }
    let [a, b] =
        [ShadowTechnique::VolumeDepthFail, ShadowTechnique::Raytraced].map(|t| shot.picture(gpu, &settings(t), 1));
    let differing = a.radiance.iter().zip(&b.radiance).filter(|(a, b)| (a[0] - b[0]).abs() > 0.01).count();
    assert!(differing < 100, "{differing}: edges only");
}

#[test]
fn a_far_plane_cuts_volumes_off_and_the_infinite_projection_does_not() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.5, 0.0), 0);
    let shot = stage.shot(gpu);
    let mut cut = settings(ShadowTechnique::VolumeDepthFail);
    cut.volumes.far_plane = Some(9.0);
    assert!(shot.fault(gpu, &cut) > 0.01);
}

#[test]
fn soft_shadows_are_the_mean_of_the_rays_to_the_same_points() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.2, 0.0), 0);
    stage.scene.lights.clear();
    let emission = Vec3::splat(4.0);
    let lamp = stage.material(Material { emission, group: Some(GroupId(0)), ..paint() });
    stage.quad_of(Vec3::new(-0.5, 4.0, -0.5), Vec3::X, Vec3::Z, lamp);
    let shot = stage.shot(gpu);
    let with = |technique| ShadowSettings { light_samples: 64, ..settings(technique) };
    let truth = shot.decisions(gpu, &with(ShadowTechnique::Raytraced));
    let found = shot.decisions(gpu, &with(ShadowTechnique::VolumeDepthFail));
    assert_eq!((truth.samples.len(), num_different(&shadow_difference(&found, &truth))), (64, 0));
    let [soft, rays] =
        [ShadowTechnique::VolumeDepthFail, ShadowTechnique::Raytraced].map(|t| shot.picture(gpu, &with(t), 1));
    // Where no sample's edge passes, the sums agree; a sample's edge may move by a pixel and brings 1 / 64.
    let distance = |(a, b): (&u8, &u8)| a.abs_diff(*b);
    let differing = soft.display.iter().zip(&rays.display).map(distance).filter(|&d| d > 1).count();
    assert!(differing < soft.display.len() / 100, "{differing}");
}

#[test]
fn direct_light_of_many_samples_is_that_of_the_closed_form() {
    let scene = builtin::cornell();
    let (floor, normal) = (Vec3::new(4.5, 0.0, 1.0), Vec3::Y);
    let lamp = [[3.43, 2.27], [3.43, 3.32], [2.13, 3.32], [2.13, 2.27]].map(|[x, z]| Vec3::new(x, 5.488, z));
    let factor = hemicube::form_factor::analytic::point_to_polygon(floor, normal, &lamp);
    let samples = hemicube::render::shadow::light_samples(&scene, 64);
    let sum: Vec3 = samples.iter().map(|sample| sample.irradiance(floor, normal)).sum();
    let expected = Vec3::new(17.0, 12.0, 4.0) * std::f32::consts::PI * factor.abs();
    assert!((sum / expected - 1.0).abs().max_element() < 0.01, "{sum}, not {expected}");
}

#[test]
fn live_direct_light_takes_the_place_of_the_stored_and_leaves_the_indirect() {
    let Some(gpu) = gpu() else { return };
    let stage = Stage::new();
    let mut light = VertexLight::dark(1, stage.scene.vertices.len());
    light.groups[0].direct.fill(Vec3::splat(1000.0));
    light.groups[0].indirect.fill(Vec3::splat(3.0));
    let shot = Shot { buffers: stage.lit(gpu, light), ..stage.shot(gpu) };
    let (x, y) = (SIZE[0] / 2, SIZE[1] / 2 + 20);
    for technique in [ShadowTechnique::VolumeDepthFail, ShadowTechnique::Map, ShadowTechnique::Raytraced] {
        let picture = shot.picture(gpu, &settings(technique), 4);
        let found = picture.radiance[(y * SIZE[0] + x) as usize][0];
        let point = stage.floor_under(x, y);
        let direct = stage.scene.lights[0].arrival(point);
        let received = 3.0 + direct.irradiance.x * direct.to_light.y;
        let expected = 0.5 * (0.1 + received / std::f32::consts::PI);
        assert!((found / expected - 1.0).abs() < 0.01, "{technique:?}: {found}, not {expected}");
    }
}

#[test]
fn each_technique_looks_as_it_did() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage
        .cube(at(-0.9, 0.9, 0.0) * Mat4::from_quat(Quat::from_rotation_y(0.5)), 0)
        .sphere(Vec3::new(1.1, 1.0, 0.2), 0.7);
    let shot = stage.shot(gpu);
    let techniques = [
        (ShadowTechnique::None, "shadows_none"),
        (ShadowTechnique::Map, "shadows_map"),
        (ShadowTechnique::VolumeDepthPass, "shadows_volume_depth_pass"),
        (ShadowTechnique::VolumeDepthFail, "shadows_volume_depth_fail"),
        (ShadowTechnique::Planar, "shadows_planar"),
        (ShadowTechnique::Raytraced, "shadows_raytraced"),
    ];
    for (technique, name) in techniques {
        assert_snapshot(name, &shot.picture(gpu, &settings(technique), 1));
    }
}

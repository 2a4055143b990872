//! Scenes that are difficult for shadows, and assertions about them.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use glam::{Mat4, Vec3, Vec4};
use hemicube::baked::{BakedScene, VertexLight};
use hemicube::base::ids::{InstanceId, MaterialId};
use hemicube::gpu::Gpu;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::shadow::{ComparedScene, Decisions, ShadowComparison, ShadowDifference, shadow_difference};
use hemicube::render::{
    Exposure, Picture, RenderSettings, ShadowScene, ShadowSettings, ShadowTechnique, ToneMap, View,
};
use hemicube::render::{PictureRequest, draw_picture};
use hemicube::scene::{Camera, Instance, Light, LightKind, Material, Scene, Triangle, Vertex};

use crate::support::device::gpu;

pub const SIZE: [u32; 2] = [256, 192];

/// A scene with a floor of 8 m x 8 m, and a camera.
pub struct Stage {
    pub scene: Scene,
    pub camera: Camera,
}

impl Stage {
    /// Creates the floor alone, lit by a point light and seen from one side.
    pub fn new() -> Self {
        let mut scene = Scene { materials: vec![paint()], light_groups: vec!["light".to_owned()], ..Scene::default() };
        scene.instances.push(Instance { name: "all".to_owned(), triangles: 0..0 });
        let camera = Camera::looking_at("side", Vec3::new(0.0, 3.0, 7.0), Vec3::new(0.0, 0.5, 0.0), 0.9);
        let mut stage = Self { scene, camera };
        stage.quad(Vec3::new(-4.0, 0.0, 4.0), 8.0 * Vec3::X, -8.0 * Vec3::Z);
        stage.light(LightKind::Point { position: Vec3::new(0.7, 4.0, 0.4) });
        stage
    }

    pub fn light(&mut self, kind: LightKind) -> &mut Self {
        let intensity = Vec3::splat(30.0);
        self.scene.lights = vec![Light::new(kind, intensity)];
        self
    }

    pub fn seen(&mut self, eye: Vec3, target: Vec3) -> &mut Self {
        self.camera = Camera::looking_at("other", eye, target, 0.9);
        self
    }

    pub fn material(&mut self, material: Material) -> u32 {
        self.scene.materials.push(material);
        self.scene.materials.len() as u32 - 1
    }

    pub fn triangle(&mut self, corners: [Vec3; 3], material: u32) -> &mut Self {
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
        });
        self
    }

    /// Adds a parallelogram with its front towards `u` x `v`. Its corners are not shared.
    pub fn quad(&mut self, origin: Vec3, u: Vec3, v: Vec3) -> &mut Self {
        self.quad_of(origin, u, v, 0)
    }

    pub fn quad_of(&mut self, origin: Vec3, u: Vec3, v: Vec3, material: u32) -> &mut Self {
        self.triangle([origin, origin + u, origin + u + v], material);
        self.triangle([origin, origin + u + v, origin + v], material)
    }

    /// Adds the sides of a unit cube under `transform`, without the first `num_open`.
    pub fn cube(&mut self, transform: Mat4, num_open: usize) -> &mut Self {
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

    pub fn sphere(&mut self, centre: Vec3, radius: f32) -> &mut Self {
        let (columns, rows) = (20, 10);
        let at = |i: i32, j: i32| {
            let (phi, theta) =
                (i as f32 / columns as f32 * std::f32::consts::TAU, j as f32 / rows as f32 * std::f32::consts::PI);
            // The last column has exactly the positions of the first.
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

    /// Uploads the scene with stored light.
    pub fn lit(&self, gpu: &Gpu, light: VertexLight) -> SceneBuffers {
        SceneBuffers::new(gpu, &BakedScene::new(self.scene.clone(), light))
    }

    /// Returns the point of the floor at the centre of a pixel.
    pub fn floor_under(&self, x: u32, y: u32) -> Vec3 {
        let view = View::from_camera(&self.camera, SIZE[0] as f32 / SIZE[1] as f32);
        let right = 2.0 * (x as f32 + 0.5) / SIZE[0] as f32 - 1.0;
        let up = 1.0 - 2.0 * (y as f32 + 0.5) / SIZE[1] as f32;
        let seen = view.projection_from_world().inverse().project_point3(Vec3::new(right, up, 0.5));
        let eye = self.camera.position;
        eye + (seen - eye) * (eye.y / (eye.y - seen.y))
    }

    pub fn shot(&self, gpu: &Gpu) -> Shot {
        let mut scene = self.scene.clone();
        scene.instances[0].triangles = 0..scene.triangles.len();
        let light = VertexLight::dark(1, scene.vertices.len());
        let baked = BakedScene::new(scene, light);
        Shot {
            buffers: SceneBuffers::new(gpu, &baked),
            shadows: Arc::new(ShadowScene::new(gpu, Arc::new(baked.scene))),
            camera: self.camera.clone(),
            size: SIZE,
        }
    }

    /// Fails if the decisions of volumes, joined or not and counted either way, differ from those of rays.
    #[track_caller]
    pub fn assert_volumes_are_exact(&self) {
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
pub struct Shot {
    pub buffers: SceneBuffers,
    pub shadows: Arc<ShadowScene>,
    pub camera: Camera,
    pub size: [u32; 2],
}

impl Shot {
    pub fn decisions(&self, gpu: &Gpu, settings: &ShadowSettings) -> Decisions {
        self.compare(gpu, |comparison, scene| comparison.decisions(gpu, scene, settings).expect("decisions"))
    }

    /// Returns the stencil after the shadows of the first light sample.
    pub fn stencil(&self, gpu: &Gpu, settings: &ShadowSettings) -> Vec<u8> {
        self.compare(gpu, |comparison, scene| comparison.stencil(gpu, scene, settings, 0).expect("a stencil"))
    }

    fn compare<T>(&self, gpu: &Gpu, of: impl FnOnce(&mut ShadowComparison, ComparedScene<'_>) -> T) -> T {
        let size = self.size;
        let view = &View::from_camera(&self.camera, size[0] as f32 / size[1] as f32);
        let scene = ComparedScene { scene: &self.buffers, shadows: &self.shadows, view, size };
        // Passes are created once, because a software driver takes longer to compile them than a test runs.
        static COMPARISON: OnceLock<Mutex<ShadowComparison>> = OnceLock::new();
        let comparison = COMPARISON.get_or_init(|| Mutex::new(ShadowComparison::new(gpu)));
        of(&mut comparison.lock().unwrap_or_else(PoisonError::into_inner), scene)
    }

    /// Returns the share of pixels that differ from the ray-traced reference.
    pub fn fault(&self, gpu: &Gpu, settings: &ShadowSettings) -> f32 {
        shadow_difference(&self.decisions(gpu, settings), &self.decisions(gpu, &raytraced())).share
    }

    /// Creates a request for a picture with the lights of the scene.
    pub fn request<'a>(&'a self, settings: &'a RenderSettings) -> PictureRequest<'a> {
        let request = PictureRequest::new(&self.buffers, &self.camera, SIZE, settings);
        PictureRequest { shadows: Some(&self.shadows), ..request }
    }

    pub fn picture(&self, gpu: &Gpu, settings: &ShadowSettings, samples: u32) -> Picture {
        let render_settings = RenderSettings {
            shadows: Some(settings.clone()),
            exposure: Exposure::Ev(0.0),
            tone_map: ToneMap::Linear,
            ambient: Vec3::splat(0.1),
            ..RenderSettings::default()
        };
        draw_picture(gpu, &self.request(&render_settings), samples).expect("a picture")
    }
}

pub fn paint() -> Material {
    Material::diffuse(Vec3::splat(0.5))
}

pub fn settings(technique: ShadowTechnique) -> ShadowSettings {
    ShadowSettings::new(technique)
}

pub fn raytraced() -> ShadowSettings {
    settings(ShadowTechnique::Raytraced)
}

pub fn num_different(difference: &ShadowDifference) -> usize {
    difference.count.iter().filter(|&&count| count > 0).count()
}

/// Returns the first pixels that differ: column, row, and true if the light is visible by mistake.
pub fn places(difference: &ShadowDifference) -> Vec<(usize, usize, bool)> {
    let width = difference.size[0] as usize;
    let differing = (0..difference.count.len()).filter(|&pixel| difference.count[pixel] > 0);
    differing.map(|pixel| (pixel % width, pixel / width, difference.is_too_bright[pixel])).take(8).collect()
}

pub fn at(x: f32, y: f32, z: f32) -> Mat4 {
    Mat4::from_translation(Vec3::new(x, y, z))
}

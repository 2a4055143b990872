use std::sync::Arc;

use glam::{Affine2, Vec2, Vec3, Vec4};

use super::*;
use crate::base::ids::{GroupId, InstanceId, MaterialId, TextureId};
use crate::scene::{
    AlphaMode, Camera, Image, Instance, Light, LightKind, Material, Projection, Sampler, Texture, TextureSlot,
    Triangle, Vertex, Wrap,
};

/// A one-pixel texture.
fn texture(wrap_u: Wrap) -> Texture {
    let mut encoded = std::io::Cursor::new(Vec::new());
    image::RgbaImage::from_pixel(1, 1, image::Rgba([200, 100, 50, 255]))
        .write_to(&mut encoded, image::ImageFormat::Png)
        .expect("memory does not refuse");
    let image = Image {
        name: "dot".into(),
        width: 1,
        height: 1,
        rgba: vec![200, 100, 50, 255],
        encoded: encoded.into_inner(),
        mime_type: "image/png".into(),
    };
    Texture { image: Arc::new(image), sampler: Sampler { wrap_u, wrap_v: Wrap::Clamp, nearest: true } }
}

fn slot(uv_set: usize) -> TextureSlot {
    let transform = Affine2::from_scale_angle_translation(Vec2::new(2.0, 3.0), 0.5, Vec2::new(0.25, 0.75));
    TextureSlot { texture: TextureId(0), uv_set, transform }
}

/// Materials that differ from the default in every field.
fn materials() -> Vec<Material> {
    let glass = Material {
        name: "glass".into(),
        base_colour: Vec4::new(0.1, 0.2, 0.3, 0.4),
        base_colour_texture: Some(slot(1)),
        metallic: 0.25,
        roughness: 0.5,
        normal_texture: Some((TextureSlot { transform: Affine2::IDENTITY, ..slot(0) }, 0.7)),
        alpha_mode: AlphaMode::Blend,
        double_sided: true,
        transmission: 0.9,
        ior: 1.3,
        ..Material::default()
    };
    let lamp = Material {
        name: "lamp".into(),
        emission: Vec3::new(100.0, 50.0, 25.0),
        group: Some(GroupId(1)),
        alpha_mode: AlphaMode::Mask { cutoff: 0.3 },
        unlit: true,
        ..Material::default()
    };
    vec![glass, lamp]
}

fn lights() -> Vec<Light> {
    let light = |name: &str, group, kind, range| Light {
        name: name.into(),
        kind,
        intensity: Vec3::new(40.0, 20.0, 10.0),
        range,
        group: GroupId(group),
    };
    let position = Vec3::new(1.0, 2.0, 3.0);
    let direction = Vec3::new(0.6, 0.0, -0.8);
    let spot = LightKind::Spot { position, direction, inner_angle: 0.2, outer_angle: 0.4 };
    vec![
        light("bulb", 1, LightKind::Point { position }, Some(7.0)),
        light("spot", 1, spot, None),
        light("sun", 0, LightKind::Directional { direction }, None),
    ]
}

/// Two squares of two materials in one instance, the second square once more as its own back, and one of everything.
fn scene() -> Scene {
    let corner = |(x, y): (f32, f32), z: f32| Vertex {
        position: Vec3::new(x / 3.0, y / 7.0, z),
        normal: Vec3::Z,
        uv: [Vec2::new(x, y), Vec2::new(y, x)],
        colour: Vec4::new(1.0, 0.5, 0.25, 1.0),
    };
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let vertices = [0.1, 0.2, 0.2].into_iter().flat_map(|z| square.map(|at| corner(at, z))).collect();
    let triangle = |vertices: [u32; 3], material: u32, is_back_side| Triangle {
        vertices,
        material: MaterialId(material),
        instance: InstanceId(0),
        is_back_side,
    };
    let triangles = vec![
        triangle([0, 1, 2], 0, false),
        triangle([4, 5, 6], 1, false),
        triangle([0, 2, 3], 0, false),
        triangle([4, 6, 7], 1, false),
        triangle([10, 9, 8], 1, true),
    ];
    let mut ortho = Camera::looking_at("plan", Vec3::new(0.0, 5.0, 0.1), Vec3::ZERO, 1.0);
    ortho.projection = Projection::Orthographic { half_height: 2.0 };
    Scene {
        name: "all".into(),
        instances: vec![Instance { name: "squares".into(), triangles: 0..triangles.len() }],
        vertices,
        triangles,
        materials: materials(),
        textures: vec![texture(Wrap::Mirror)],
        lights: lights(),
        cameras: vec![Camera::looking_at("eye", Vec3::ONE, Vec3::ZERO, 0.9), ortho],
        light_groups: vec!["sun".into(), "lamps".into()],
        ..Scene::default()
    }
}

fn baked() -> BakedScene {
    let scene = scene();
    let mut light = VertexLight::dark(2, scene.vertices.len());
    for (g, group) in light.groups.iter_mut().enumerate() {
        for v in 0..scene.vertices.len() {
            group.direct[v] = Vec3::new(v as f32 / 3.0, g as f32, 0.1);
            group.indirect[v] = Vec3::new(0.2, v as f32 / 7.0, g as f32);
        }
    }
    BakedScene { scene, light }
}

#[test]
fn the_file_is_valid_gltf_with_shared_vertices_and_sides_apart() {
    let glb = to_glb(&baked(), 9.5).expect("small");
    let file = gltf::Gltf::from_slice(&glb).expect("valid glTF");
    let mesh = file.meshes().next().expect("one mesh");
    let counts: Vec<_> = mesh
        .primitives()
        .map(|part| {
            let positions = part.get(&gltf::Semantic::Positions).expect("positions");
            (part.material().index(), part.extras().is_some(), positions.count(), part.indices().map(|i| i.count()))
        })
        .collect();
    assert_eq!(counts, [(Some(0), false, 4, Some(6)), (Some(1), false, 4, Some(6)), (Some(1), true, 3, Some(3))]);
}

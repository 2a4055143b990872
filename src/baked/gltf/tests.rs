mod elements;
mod tree;

use std::sync::Arc;

use glam::{Affine2, Vec2, Vec3, Vec4};

use super::*;
use crate::baked::{BakedScene, VertexLight};
use crate::base::ids::{GroupId, InstanceId, MaterialId, TextureId, TriangleId};
use crate::scene::{
    AlphaMode, Camera, Image, Instance, Light, LightKind, Material, Projection, Sampler, Scene, Sides, Texture,
    TextureSlot, Triangle, Vertex, Wrap,
};

/// Returns a one-pixel texture.
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
        emissive_texture: Some(slot(0)),
        metallic_roughness_texture: Some(slot(0)),
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
        range,
        group: GroupId(group),
        ..Light::new(kind, Vec3::new(40.0, 20.0, 10.0))
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

/// Returns a scene of two squares of two materials in one instance, with a back for the second square, and one item of
/// every other kind.
fn scene() -> Scene {
    let corner = |(x, y): (f32, f32), z: f32| Vertex {
        position: Vec3::new(x / 3.0, y / 7.0, z),
        normal: Vec3::Z,
        uv: [Vec2::new(x, y), Vec2::new(y, x)],
        colour: Vec4::new(1.0, 0.5, 0.25, 0.75),
    };
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let vertices = [0.1, 0.2, 0.2].into_iter().flat_map(|z| square.map(|at| corner(at, z))).collect();
    let triangle = |vertices: [u32; 3], material: u32| Triangle {
        vertices,
        material: MaterialId(material),
        instance: InstanceId(0),
    };
    let triangles = vec![
        triangle([0, 1, 2], 0),
        triangle([4, 5, 6], 1),
        triangle([0, 2, 3], 0),
        triangle([4, 6, 7], 1),
        triangle([10, 9, 8], 1),
    ];
    let mut ortho = Camera::looking_at("plan", Vec3::new(0.0, 5.0, 0.1), Vec3::ZERO, 1.0);
    ortho.projection = Projection::Orthographic { half_height: 2.0 };
    let mut sides = Sides::default();
    sides.add_back(TriangleId(4));
    Scene {
        name: "all".into(),
        sides,
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
    BakedScene::new(scene, light)
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

/// Returns the scene as the program's own loader reads it.
fn reloaded(glb: &[u8]) -> Scene {
    crate::scene::gltf::from_slice("all", glb).expect("our own file loads")
}

/// Returns the corners of the triangles in file order: those of one primitive side by side.
fn sorted_triangles(scene: &Scene) -> Vec<(bool, &Triangle)> {
    let is_back = |t: usize| scene.sides.is_back(TriangleId::new(t));
    let mut triangles: Vec<(bool, &Triangle)> =
        scene.triangles.iter().enumerate().map(|(t, triangle)| (is_back(t), triangle)).collect();
    triangles.sort_by_key(|(is_back, triangle)| (triangle.material, *is_back));
    triangles
}

#[test]
fn positions_and_light_come_back_bit_by_bit() {
    let stored = baked();
    let Ok(back) = from_scene(reloaded(&to_glb(&stored, 9.5).expect("small"))) else { panic!("the light is lost") };
    assert_eq!(back.scene.triangles.len(), stored.scene.triangles.len());
    for ((a_is_back, a), (b_is_back, b)) in
        sorted_triangles(&stored.scene).into_iter().zip(sorted_triangles(&back.scene))
    {
        assert_eq!((a.material, a_is_back), (b.material, b_is_back));
        for (v, w) in a.vertices.map(|v| v as usize).into_iter().zip(b.vertices.map(|v| v as usize)) {
            assert_eq!(stored.scene.vertices[v], back.scene.vertices[w]);
            for (stored, back) in stored.light.groups.iter().zip(&back.light.groups) {
                assert_eq!((stored.direct[v], stored.indirect[v]), (back.direct[w], back.indirect[w]));
            }
        }
    }
    assert!(back.scene.irradiance.is_empty(), "light is kept once");
}

#[test]
fn everything_but_the_mesh_comes_back() {
    let stored = scene();
    let back = reloaded(&scene_to_glb(&stored).expect("small"));
    assert_eq!(back.light_groups, stored.light_groups);
    assert_eq!(back.textures, stored.textures);
    assert_eq!(back.lights.len(), stored.lights.len());
    for (stored, back) in stored.materials.iter().zip(&back.materials) {
        assert_same_material(stored, back);
    }
    for (stored, back) in stored.lights.iter().zip(&back.lights) {
        assert_eq!((&stored.name, stored.group, stored.range), (&back.name, back.group, back.range));
        let point = Vec3::new(1.4, 0.5, 1.5);
        let (stored, back) = (stored.arrival(point), back.arrival(point));
        assert!((stored.to_light - back.to_light).length() < 1e-6);
        assert!((stored.irradiance - back.irradiance).length() <= 1e-5 * stored.irradiance.length());
    }
    for (stored, back) in stored.cameras.iter().zip(&back.cameras) {
        assert_eq!((&stored.name, stored.position, stored.projection), (&back.name, back.position, back.projection));
        assert!((stored.forward() - back.forward()).length() < 1e-6);
    }
}

/// Asserts that materials are equal except for the rounding of a texture transform, which is stored as scale, angle and
/// offset.
fn assert_same_material(stored: &Material, back: &Material) {
    let slots = |material: &Material| {
        let normal = material.normal_texture.map(|(slot, _)| slot);
        [material.base_colour_texture, material.metallic_roughness_texture, material.emissive_texture, normal]
    };
    for (stored, back) in slots(stored).into_iter().zip(slots(back)) {
        let at = [Vec2::new(0.3, 0.6), Vec2::new(0.8, 0.1)];
        let coordinate = |slot: Option<TextureSlot>| slot.map_or(Vec2::ZERO, |slot| slot.coordinate(at));
        assert!((coordinate(stored) - coordinate(back)).length() < 1e-5);
    }
    let without_slots = |material: &Material| Material {
        base_colour_texture: None,
        metallic_roughness_texture: None,
        emissive_texture: None,
        normal_texture: None,
        ..material.clone()
    };
    assert_eq!(without_slots(stored), without_slots(back));
}

#[test]
fn a_bake_keeps_its_original_materials() {
    let stored = baked();
    let back = reloaded(&to_glb(&stored, 0.0).expect("small"));
    assert_eq!(back.materials.len(), stored.scene.materials.len());
    for (stored, back) in stored.scene.materials.iter().zip(&back.materials) {
        assert_same_material(stored, back);
    }
}

/// Returns the COLOR_0 of all primitives, as other programs read it.
fn shown_colours(glb: &[u8]) -> Vec<[f32; 4]> {
    let file = gltf::Gltf::from_slice_without_validation(glb).expect("glTF");
    let blob = file.blob.as_deref().expect("a binary half");
    let of_primitive = |part: gltf::Primitive<'_>| {
        let accessor = part.get(&gltf::Semantic::Colors(0)).expect("colours");
        assert!(accessor.normalized() && accessor.data_type() == gltf::accessor::DataType::U16);
        let bytes = &blob[accessor.view().expect("bytes").offset()..][..8 * accessor.count()];
        let words = bytes.chunks_exact(2).map(|word| f32::from(u16::from_le_bytes([word[0], word[1]])) / 65_535.0);
        let words: Vec<f32> = words.collect();
        words.chunks_exact(4).map(|c| [c[0], c[1], c[2], c[3]]).collect::<Vec<_>>()
    };
    file.meshes().flat_map(|mesh| mesh.primitives().flat_map(of_primitive).collect::<Vec<_>>()).collect()
}

#[test]
fn other_programs_see_exposed_light_on_unlit_surfaces() {
    let mut scene = Scene { lights: Vec::new(), cameras: Vec::new(), textures: Vec::new(), ..scene() };
    let paint = Material { base_colour: Vec4::new(0.5, 0.25, 1.0, 1.0), ..Material::default() };
    scene.materials =
        vec![paint, Material { emission: Vec3::splat(0.1), group: Some(GroupId(0)), ..paint_of_nothing() }];
    let mut light = VertexLight::dark(2, scene.vertices.len());
    light.groups[1].direct.fill(Vec3::splat(0.25 * std::f32::consts::PI));
    light.groups[0].indirect.fill(Vec3::splat(0.25 * std::f32::consts::PI));
    let glb = to_glb(&BakedScene::new(scene, light), 1.0).expect("small");
    // Vertex paint is (1, 0.5, 0.25, 0.75); radiance of white is 0.5, shown twice as bright.
    let colours = shown_colours(&glb);
    let close = |a: [f32; 4], b: [f32; 4]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4);
    assert!(close(colours[0], [0.5, 0.125, 0.25, 0.75]), "{:?}", colours[0]);
    assert!(close(colours[4], [0.2, 0.2, 0.2, 0.75]), "{:?}", colours[4]);
    let file = gltf::Gltf::from_slice_without_validation(&glb).expect("glTF");
    for material in file.materials() {
        assert!(material.unlit() && !material.double_sided());
        assert_eq!(material.pbr_metallic_roughness().base_color_factor()[..3], [1.0; 3]);
    }
}

fn paint_of_nothing() -> Material {
    Material { base_colour: Vec4::W, ..Material::default() }
}

#[test]
fn images_of_formats_beyond_plain_gltf_are_written_as_png() {
    let mut image = (*texture(Wrap::Repeat).image).clone();
    image.mime_type = "image/ktx2".into();
    image.encoded = vec![1, 2, 3];
    let mut stored = scene();
    stored.textures[0].image = Arc::new(image);
    let back = reloaded(&scene_to_glb(&stored).expect("small"));
    assert_eq!(
        (back.textures[0].image.mime_type.as_str(), &back.textures[0].image.rgba[..3]),
        ("image/png", &[200, 100, 50][..])
    );
}

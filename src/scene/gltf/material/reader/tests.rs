use serde_json::json;

use super::*;
use crate::scene::gltf::fixture::Fixture;

fn close(a: Vec2, b: Vec2) -> bool {
    (a - b).length() < 1e-6
}

#[test]
fn a_texture_transform_scales_then_rotates_then_translates() {
    let mut fixture = Fixture::triangle();
    let texture = fixture.texture(&[[255; 4]]);
    let transform =
        json!({"offset": [10, 20], "rotation": std::f32::consts::FRAC_PI_2, "scale": [2, 3], "texCoord": 1});
    let info = json!({"index": texture, "extensions": {"KHR_texture_transform": transform}});
    fixture.material(json!({"pbrMetallicRoughness": {"baseColorTexture": info}, "normalTexture": info}));
    let material = &fixture.load().materials[0];
    let slot = material.base_colour_texture.expect("a texture");
    // With v pointing down, a quarter turn counter-clockwise maps u to -v.
    assert!(close(slot.coordinate([Vec2::ZERO, Vec2::X]), Vec2::new(10.0, 18.0)));
    assert!(close(slot.coordinate([Vec2::ZERO, Vec2::Y]), Vec2::new(13.0, 20.0)));
    assert_eq!(material.normal_texture.map(|(slot, _)| slot), Some(slot));
}

#[test]
fn a_material_may_use_any_two_sets_of_coordinates() {
    let mut fixture = Fixture::triangle();
    let texture = fixture.texture(&[[255; 4]]);
    fixture.floats("TEXCOORD_5", "VEC2", &[0.5; 6]);
    fixture.floats("TEXCOORD_1", "VEC2", &[0.25; 6]);
    let [base, glow] = [5, 1].map(|set| json!({"index": texture, "texCoord": set}));
    fixture.material(json!({"pbrMetallicRoughness": {"baseColorTexture": base}, "emissiveTexture": glow}));
    let scene = fixture.load();
    let uv = scene.vertices[0].uv;
    let at = |slot: Option<TextureSlot>| slot.expect("a texture").coordinate(uv).x;
    assert_eq!(at(scene.materials[0].base_colour_texture), 0.5);
    assert_eq!(at(scene.materials[0].emissive_texture), 0.25);
}

#[test]
fn a_third_set_of_coordinates_is_noted() {
    let mut fixture = Fixture::triangle();
    let texture = fixture.texture(&[[255; 4]]);
    let info = |set: u32| json!({"index": texture, "texCoord": set});
    let base = json!({"baseColorTexture": info(0), "metallicRoughnessTexture": info(1)});
    fixture.material(json!({"pbrMetallicRoughness": base, "emissiveTexture": info(2)}));
    let scene = fixture.load();
    assert!(scene.materials[0].emissive_texture.is_none());
    assert!(scene.notes.iter().any(|note| note.contains("TEXCOORD_2")), "{:?}", scene.notes);
}

#[test]
fn factors_emission_and_flags_are_read() {
    let mut fixture = Fixture::triangle();
    fixture.material(json!({
        "name": "lamp", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25,
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5},
        "emissiveFactor": [1, 0.5, 0],
        "extensions": {
            "KHR_materials_emissive_strength": {"emissiveStrength": 20}, "KHR_materials_unlit": {},
            "KHR_materials_transmission": {"transmissionFactor": 0.75}, "KHR_materials_ior": {"ior": 1.25},
        },
    }));
    let scene = fixture.load();
    let material = &scene.materials[0];
    assert_eq!((material.base_colour, material.metallic), (Vec4::new(0.1, 0.2, 0.3, 0.4), 0.5));
    assert_eq!(
        (material.emission, material.alpha_mode),
        (Vec3::new(20.0, 10.0, 0.0), AlphaMode::Mask { cutoff: 0.25 })
    );
    assert!(material.double_sided && material.unlit);
    assert_eq!((material.transmission, material.ior), (0.75, 1.25));
    assert_eq!((scene.light_groups.as_slice(), material.group.map(|g| g.0)), (["lamp".to_owned()].as_slice(), Some(0)));
}

#[test]
fn the_diffuse_part_of_specular_glossiness_is_used() {
    let mut fixture = Fixture::triangle();
    let extension = json!({"diffuseFactor": [0.5, 0.5, 0.5, 1], "specularFactor": [1, 1, 1]});
    fixture.material(json!({"extensions": {"KHR_materials_pbrSpecularGlossiness": extension}}));
    let material = &fixture.load().materials[0];
    assert_eq!((material.base_colour.x, material.metallic), (0.5, 0.0));
}

#[test]
fn factors_beyond_f32_are_refused() {
    let mut fixture = Fixture::triangle();
    fixture.material(json!({"name": "x", "emissiveFactor": [1e39, 0, 0]}));
    assert!(fixture.error().contains("factor of material \"x\""), "{}", fixture.error());
}

#[test]
fn a_surface_that_reflects_everything_is_noted() {
    let mut fixture = Fixture::triangle();
    fixture.material(json!({"name": "snow", "pbrMetallicRoughness": {"metallicFactor": 0}}));
    let notes = fixture.load().notes;
    assert!(notes.iter().any(|note| note.contains("\"snow\" reflects 1.00")), "{notes:?}");
}

use glam::{Vec2, Vec3, Vec4};
use serde_json::json;

use crate::scene::gltf::fixture::Fixture;

#[test]
fn sparse_values_replace_rows() {
    let mut fixture = Fixture::triangle();
    let rows = fixture.view(&[2]);
    let values = fixture.view(&[0f32, 3.0, 0.0].map(f32::to_le_bytes).concat());
    fixture.json["accessors"][0]["sparse"] = json!({
        "count": 1, "indices": {"bufferView": rows, "componentType": 5121}, "values": {"bufferView": values},
    });
    assert_eq!(fixture.load().vertices[2].position, Vec3::new(0.0, 3.0, 0.0));
}

#[test]
fn an_accessor_without_a_view_is_zero() {
    let mut fixture = Fixture::triangle();
    let colour = json!({"componentType": 5126, "type": "VEC3", "count": 3});
    fixture.json["accessors"].as_array_mut().expect("a list").push(colour);
    fixture.primitive()["attributes"]["COLOR_0"] = json!(2);
    assert_eq!(fixture.load().vertices[0].colour, Vec4::new(0.0, 0.0, 0.0, 1.0));
    fixture.json["accessors"][2]["count"] = json!(4_000_000_000u32);
    assert!(fixture.error().contains("accessor 2: it has no data"), "{}", fixture.error());
}

#[test]
fn quantised_positions_are_plain_integers_and_may_have_a_stride() {
    let mut fixture = Fixture::triangle();
    let bytes = [0i8, 0, 0, 99, 100, 0, 0, 99, 0, -50, 0, 99].map(|value| value as u8);
    let positions = fixture.accessor(5120, "VEC3", 3, &bytes);
    let view = fixture.json["accessors"][positions]["bufferView"].as_u64().expect("a view") as usize;
    fixture.json["bufferViews"][view]["byteStride"] = json!(4);
    fixture.primitive()["attributes"]["POSITION"] = json!(positions);
    let scene = fixture.load();
    assert_eq!(scene.vertices[1].position, Vec3::new(100.0, 0.0, 0.0));
    assert_eq!(scene.vertices[2].position, Vec3::new(0.0, -50.0, 0.0));
}

#[test]
fn normalised_integers_are_fractions() {
    let mut fixture = Fixture::triangle();
    let uv = fixture.accessor(5121, "VEC2", 3, &[0, 0, 255, 51, 0, 255]);
    fixture.json["accessors"][uv]["normalized"] = json!(true);
    fixture.primitive()["attributes"]["TEXCOORD_1"] = json!(uv);
    let bytes = [0u16, 65535, 0, 65535].map(u16::to_le_bytes).concat().repeat(3);
    let colour = fixture.accessor(5123, "VEC4", 3, &bytes);
    fixture.primitive()["attributes"]["COLOR_0"] = json!(colour);
    let vertex = fixture.load().vertices[1];
    assert_eq!(vertex.uv, [Vec2::ZERO, Vec2::new(1.0, 0.2)]);
    assert_eq!(vertex.colour, Vec4::new(0.0, 1.0, 0.0, 1.0), "integer colours are fractions even unmarked");
}

#[test]
fn reading_outside_a_view_names_the_accessor() {
    for (field, value) in [("count", json!(4)), ("byteOffset", json!(4)), ("byteOffset", json!(u64::MAX))] {
        let mut fixture = Fixture::triangle();
        fixture.json["accessors"][0][field] = value;
        assert!(fixture.error().contains("accessor 0: its count, offset or stride"), "{}", fixture.error());
    }
}

#[test]
fn a_view_outside_its_buffer_is_named() {
    for (field, value) in [("byteLength", json!(1u64 << 40)), ("byteOffset", json!(u64::MAX))] {
        let mut fixture = Fixture::triangle();
        fixture.json["bufferViews"][0][field] = value;
        assert!(fixture.error().contains("buffer view 0 reaches outside buffer 0"), "{}", fixture.error());
    }
}

#[test]
fn an_accessor_with_nan_is_refused() {
    let mut fixture = Fixture::triangle();
    fixture.floats("POSITION", "VEC3", &[f32::NAN, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    assert!(fixture.error().contains("accessor 2: it holds NaN"), "{}", fixture.error());
}

#[test]
fn attributes_shorter_than_the_positions_are_refused() {
    let mut fixture = Fixture::triangle();
    fixture.json["accessors"][1]["count"] = json!(2);
    assert!(fixture.error().contains("accessor 1: row 2 is read"), "{}", fixture.error());
}

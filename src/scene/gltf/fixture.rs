//! Small glTF files for the tests of this folder.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::{LoadError, from_slice};
use crate::scene::Scene;

/// A glTF file under construction; tests edit its JSON directly.
pub struct Fixture {
    /// The JSON without the buffer.
    pub json: Value,
    bytes: Vec<u8>,
}

impl Fixture {
    /// Returns a file with one scene and one node. The node has mesh 0, which has one primitive without attributes.
    pub fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {}}]}], "accessors": [], "bufferViews": [],
        });
        Self { json, bytes: Vec::new() }
    }

    /// Returns a file with the triangle (0,0,0), (1,0,0), (0,1,0) and normals along +Z.
    pub fn triangle() -> Self {
        let mut fixture = Self::new();
        fixture.floats("POSITION", "VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        fixture.floats("NORMAL", "VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
        fixture
    }

    /// Returns primitive 0 of mesh 0.
    pub fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    /// Adds a buffer view and returns its index.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        self.bytes.extend_from_slice(bytes);
        push(&mut self.json["bufferViews"], view)
    }

    /// Adds an accessor over its own buffer view and returns its index.
    pub fn accessor(&mut self, component: u32, shape: &str, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let accessor = json!({"bufferView": view, "componentType": component, "type": shape, "count": count});
        push(&mut self.json["accessors"], accessor)
    }

    /// Adds a float attribute to the primitive and returns its accessor.
    pub fn floats(&mut self, name: &str, shape: &str, values: &[f32]) -> usize {
        let width = match shape {
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let accessor = self.accessor(5126, shape, values.len() / width, &bytes);
        self.primitive()["attributes"][name] = json!(accessor);
        accessor
    }

    /// Gives the primitive 8-bit indices.
    pub fn indices(&mut self, indices: &[u8]) {
        let accessor = self.accessor(5121, "SCALAR", indices.len(), indices);
        self.primitive()["indices"] = json!(accessor);
    }

    /// Gives the primitive a material and returns its index.
    pub fn material(&mut self, material: Value) -> usize {
        let index = push(&mut self.json["materials"], material);
        self.primitive()["material"] = json!(index);
        index
    }

    /// Adds a texture with a PNG image of these RGBA pixels in one row and returns its index.
    pub fn texture(&mut self, pixels: &[[u8; 4]]) -> usize {
        let mut png = std::io::Cursor::new(Vec::new());
        let row = image::RgbaImage::from_raw(pixels.len() as u32, 1, pixels.concat()).expect("sizes fit");
        row.write_to(&mut png, image::ImageFormat::Png).expect("PNG can be written");
        let view = self.view(png.get_ref());
        let source = push(&mut self.json["images"], json!({"bufferView": view, "mimeType": "image/png"}));
        push(&mut self.json["textures"], json!({"source": source}))
    }

    /// Returns the bytes of a .gltf file with an embedded buffer.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&self.bytes));
        json["buffers"] = json!([{"byteLength": self.bytes.len(), "uri": uri}]);
        json.to_string().into_bytes()
    }

    /// Loads the file, which must be valid.
    pub fn load(&self) -> Scene {
        self.try_load().expect("the fixture is valid")
    }

    /// Loads the file.
    pub fn try_load(&self) -> Result<Scene, LoadError> {
        from_slice("fixture", &self.to_bytes())
    }

    /// Returns the message of the error that loading the file returns.
    pub fn error(&self) -> String {
        self.try_load().expect_err("the file must be refused").to_string()
    }
}

fn push(list: &mut Value, item: Value) -> usize {
    if list.is_null() {
        *list = json!([]);
    }
    let items = list.as_array_mut().expect("a list");
    items.push(item);
    items.len() - 1
}

//! Decoding of compressed primitives (KHR_draco_mesh_compression).
//!
//! The result is bytes in the format of the primitive's accessors, so accessors read them like bytes of the file.
//!
//! Source: the extension's specification; the decoder of the draco-core crate is used.

use std::collections::{BTreeMap, HashMap};

use draco_core::{DataType, DecodeLimits, DecoderBuffer, FaceIndex, Mesh, MeshDecoder, PointAttribute, PointIndex};
use gltf::json::Index;
use gltf::json::accessor::{Accessor, ComponentType, GenericComponentType};
use gltf::json::buffer::View;
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation::Checked;
use serde::Deserialize;

use crate::scene::gltf::error::Cause;
use crate::scene::gltf::file::document::Document;

/// Name of the extension.
pub(crate) const EXTENSION: &str = "KHR_draco_mesh_compression";

/// Largest number of bytes of a decoded primitive.
const MAX_DECODED_BYTES: u64 = 2 << 30;

/// Decoded bytes by the index of their accessor.
pub(crate) type Decoded = HashMap<usize, Vec<u8>>;

/// The extension's JSON.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Stream {
    buffer_view: u32,
    /// Unique id in the stream of each attribute.
    attributes: BTreeMap<String, u32>,
}

/// Decodes a primitive that has the extension; the result is empty for any other primitive.
///
/// # Errors
/// Returns an error if the stream is invalid or does not match the accessors.
pub(crate) fn decode(document: &Document<'_>, primitive: &Primitive, name: &str) -> Result<Decoded, Cause> {
    let extension = primitive.extensions.as_ref().and_then(|extensions| extensions.others.get(EXTENSION));
    let Some(extension) = extension else { return Ok(Decoded::new()) };
    let failed = |problem: String| Cause::Broken(format!("{name}: {EXTENSION}: {problem}"));
    let stream = Stream::deserialize(extension).map_err(|error| failed(error.to_string()))?;
    let (bytes, _) = document.view(Index::<View>::new(stream.buffer_view), || name.to_owned())?;
    let accessor_of = |index: Index<Accessor>| document.find(index, "accessor", || name.to_owned());

    let indices = primitive.indices.map(accessor_of).transpose()?;
    let mesh = decode_mesh(bytes, indices.map(|indices| indices.count.0)).map_err(failed)?;
    let mut decoded = Decoded::new();
    if let (Some(index), Some(accessor)) = (primitive.indices, indices) {
        decoded.insert(index.value(), index_bytes(&mesh, accessor).map_err(failed)?);
    }
    for (semantic, id) in &stream.attributes {
        // An attribute without an accessor is not read.
        let Some(&index) = primitive.attributes.get(&semantic_of(semantic)) else { continue };
        let attribute = mesh.attribute_by_unique_id(*id).ok_or_else(|| failed(format!("{semantic} is missing")))?;
        let accessor = accessor_of(index)?;
        decoded.insert(index.value(), attribute_bytes(&mesh, attribute, accessor).map_err(failed)?);
    }
    Ok(decoded)
}

fn decode_mesh(bytes: &[u8], num_indices: Option<u64>) -> Result<Mesh, String> {
    let limits = DecodeLimits::default().with_max_decoded_bytes(MAX_DECODED_BYTES);
    let limits = num_indices.map_or(limits, |indices| limits.with_max_faces(indices / 3));
    let mut mesh = Mesh::new();
    let status = MeshDecoder::new().decode(&mut DecoderBuffer::new(bytes).with_limits(limits), &mut mesh);
    // The decoder's messages may have several lines; ours have one.
    status.map_err(|error| error.to_string().split_whitespace().collect::<Vec<_>>().join(" "))?;
    Ok(mesh)
}

/// Parses an attribute name by way of the typed model, whose own parser is private.
fn semantic_of(name: &str) -> Checked<Semantic> {
    serde_json::from_value(name.into()).unwrap_or(Checked::Invalid)
}

fn index_bytes(mesh: &Mesh, accessor: &Accessor) -> Result<Vec<u8>, String> {
    let corners = (0..mesh.num_faces()).flat_map(|face| mesh.face(FaceIndex(face as u32))).map(|point| point.0);
    if accessor.count.0 != 3 * mesh.num_faces() as u64 {
        return Err(format!("{} indices instead of {}", 3 * mesh.num_faces(), accessor.count.0));
    }
    let size = match accessor.component_type {
        Checked::Valid(GenericComponentType(ComponentType::U32)) => 4,
        Checked::Valid(GenericComponentType(ComponentType::U16)) => 2,
        Checked::Valid(GenericComponentType(ComponentType::U8)) => 1,
        _ => return Err("its indices are not unsigned integers".to_owned()),
    };
    let fits = size == 4 || mesh.num_points() as u64 <= 1 << (8 * size);
    if !fits {
        return Err(format!("{} vertices do not fit its indices of {size} bytes", mesh.num_points()));
    }
    Ok(corners.flat_map(|corner| corner.to_le_bytes().into_iter().take(size)).collect())
}

/// Returns the values of an attribute in vertex order. The accessor must have the same type as the stream.
fn attribute_bytes(mesh: &Mesh, attribute: &PointAttribute, accessor: &Accessor) -> Result<Vec<u8>, String> {
    let (Checked::Valid(GenericComponentType(component)), Checked::Valid(shape)) =
        (accessor.component_type, accessor.type_)
    else {
        return Err("an accessor of unknown type".to_owned());
    };
    let width = shape.multiplicity();
    if accessor.count.0 != mesh.num_points() as u64 {
        return Err(format!("{} vertices instead of {}", mesh.num_points(), accessor.count.0));
    }
    if attribute.data_type() != data_type(component) || usize::from(attribute.num_components()) != width {
        return Err("the type of an attribute differs from that of its accessor".to_owned());
    }
    let size = width * component.size();
    let stride = usize::try_from(attribute.byte_stride()).map_err(|_| "a negative stride".to_owned())?;
    let values = attribute.buffer().data();
    let mut bytes = Vec::with_capacity(mesh.num_points() * size);
    for point in 0..mesh.num_points() {
        let row = attribute.mapped_index(PointIndex(point as u32)).0 as usize;
        let start = row.checked_mul(stride).ok_or("an attribute refers to a missing value")?;
        let value = values.get(start..).and_then(|rest| rest.get(..size));
        bytes.extend_from_slice(value.ok_or("an attribute refers to a missing value")?);
    }
    Ok(bytes)
}

fn data_type(component: ComponentType) -> DataType {
    match component {
        ComponentType::I8 => DataType::Int8,
        ComponentType::U8 => DataType::Uint8,
        ComponentType::I16 => DataType::Int16,
        ComponentType::U16 => DataType::Uint16,
        ComponentType::U32 => DataType::Uint32,
        ComponentType::F32 => DataType::Float32,
    }
}

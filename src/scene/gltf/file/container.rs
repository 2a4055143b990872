//! Splits the bytes of a file into typed JSON and the binary chunk.
//!
//! The entry points of the gltf crate are not used: some can panic (a header length below 12), and some are stricter
//! than necessary. They reject a scene without nodes, an integer written as `3.0`, and an invalid animation, which is
//! never played here.

use gltf::Glb;
use gltf::json::Root;
use serde_json::Value;

use crate::scene::gltf::error::Cause;

const GLB_HEADER_BYTES: usize = 12;

/// The parts of a file.
pub(crate) struct Parts<'a> {
    /// Typed JSON.
    pub root: Root,
    /// Skins as untyped JSON: an invalid skin is an error only if a mesh uses it.
    pub skins: Vec<Value>,
    /// The binary chunk of a .glb.
    pub blob: Option<&'a [u8]>,
}

/// Splits a .gltf or .glb file into its parts.
///
/// # Errors
/// Returns an error if the file is not glTF 2 or is cut off.
pub(crate) fn split(bytes: &[u8]) -> Result<Parts<'_>, Cause> {
    if !bytes.starts_with(b"glTF") {
        return parse_json(bytes, None);
    }
    let Glb { json, bin, .. } = split_glb(bytes)?;
    let blob = match bin {
        Some(std::borrow::Cow::Borrowed(blob)) => Some(blob),
        _ => None,
    };
    parse_json(&json, blob)
}

fn split_glb(bytes: &[u8]) -> Result<Glb<'_>, Cause> {
    if bytes.len() < GLB_HEADER_BYTES {
        return Err(Cause::CutOff { expected: GLB_HEADER_BYTES, found: bytes.len() });
    }
    let word = |at: usize| u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
    let (version, expected) = (word(4), word(8) as usize);
    if version != 2 {
        return Err(Cause::Version(version.to_string()));
    }
    if expected > bytes.len() {
        return Err(Cause::CutOff { expected, found: bytes.len() });
    }
    // The bytes are limited to the length in the header. A header that states less than its own size is then refused as
    // too short.
    Glb::from_slice(&bytes[..expected]).map_err(|error| match error {
        gltf::Error::Binary(gltf::binary::Error::Io(_)) => Cause::NotGltf("its last chunk is cut off".to_owned()),
        error => Cause::NotGltf(format!("broken .glb container: {error}")),
    })
}

fn parse_json<'a>(bytes: &[u8], blob: Option<&'a [u8]>) -> Result<Parts<'a>, Cause> {
    let mut json: Value = serde_json::from_slice(without_byte_order_mark(bytes))
        .map_err(|error| Cause::NotGltf(format!("no valid JSON, {error}")))?;
    let version = json.pointer("/asset/version").and_then(Value::as_str).unwrap_or("unknown");
    if !version.starts_with("2.") {
        return Err(Cause::Version(format!("{version:?}")));
    }
    let skins = json.get_mut("skins").map_or(Value::Null, Value::take);
    let skins = if let Value::Array(skins) = skins { skins } else { Vec::new() };
    be_lenient(&mut json);
    let root = serde_json::from_value(json).map_err(|error| Cause::NotGltf(error.to_string()))?;
    Ok(Parts { root, skins, blob })
}

fn without_byte_order_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// Removes or completes parts that the typed model refuses, although the standard allows them or the loader ignores
/// them.
fn be_lenient(json: &mut Value) {
    if let Value::Object(root) = json {
        root.remove("animations");
        root.remove("skins");
        for scene in root.get_mut("scenes").and_then(Value::as_array_mut).into_iter().flatten() {
            if let Value::Object(scene) = scene {
                scene.entry("nodes").or_insert_with(|| Value::Array(Vec::new()));
            }
        }
    }
    write_whole_numbers_as_integers(json);
}

fn write_whole_numbers_as_integers(json: &mut Value) {
    const EXACT: f64 = 9_007_199_254_740_992.0;
    match json {
        Value::Array(items) => items.iter_mut().for_each(write_whole_numbers_as_integers),
        Value::Object(fields) => fields.values_mut().for_each(write_whole_numbers_as_integers),
        Value::Number(number) if number.is_f64() => {
            if let Some(whole) = number.as_f64().filter(|x| x.fract() == 0.0 && x.abs() < EXACT) {
                *number = (whole as i64).into();
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glb(length: u32, rest: &[u8]) -> Vec<u8> {
        [b"glTF".as_slice(), &2u32.to_le_bytes(), &length.to_le_bytes(), rest].concat()
    }

    #[test]
    fn a_header_length_below_the_header_is_an_error() {
        assert!(matches!(split(&glb(3, b"")), Err(Cause::NotGltf(_))));
    }

    #[test]
    fn a_file_shorter_than_its_header_says_is_cut_off() {
        assert!(matches!(split(&glb(100, b"")), Err(Cause::CutOff { expected: 100, found: 12 })));
    }

    #[test]
    fn whole_floats_are_read_as_integers_and_scenes_need_no_nodes() {
        let json = br#"{"asset":{"version":"2.0"},"scenes":[{}],"scene":0.0,"skins":[{"joints":"no"}]}"#;
        let Parts { root, skins, blob } = split(json).expect("valid");
        assert_eq!(root.scene.map(|scene| scene.value()), Some(0));
        assert!(root.scenes[0].nodes.is_empty() && skins.len() == 1 && blob.is_none());
    }

    #[test]
    fn version_one_is_named() {
        assert!(matches!(split(br#"{"asset":{"version":"1.0"}}"#), Err(Cause::Version(_))));
    }
}

//! The lower floors of Hemicube without the GPU, the viewer and the command line. They build in a minute.

#[path = "../../src/baked/mod.rs"]
pub mod baked;
#[path = "../../src/base/mod.rs"]
pub mod base;
#[path = "../../src/patch/mod.rs"]
pub mod patch;
#[path = "../../src/scene/mod.rs"]
pub mod scene;

/// Returns a .glb file made from the fuzzer's bytes. Bytes that begin with `glTF` are unchanged. Others become a valid
/// container of the JSON before the first zero byte and the binary chunk after it, so that the fuzzer need not find
/// valid lengths.
#[must_use]
pub fn glb_of(data: &[u8]) -> Vec<u8> {
    if data.starts_with(b"glTF") {
        return data.to_vec();
    }
    let end = data.iter().position(|&byte| byte == 0).unwrap_or(data.len());
    let (json, binary) = (&data[..end], &data[(end + 1).min(data.len())..]);
    let word = |n: usize| (n as u32).to_le_bytes();
    let padded = |length: usize| length.next_multiple_of(4);
    let total = 12 + 8 + padded(json.len()) + 8 + padded(binary.len());
    let mut glb = [*b"glTF", word(2), word(total), word(padded(json.len())), *b"JSON"].concat();
    glb.extend(json);
    glb.resize(20 + padded(json.len()), b' ');
    glb.extend([word(padded(binary.len())), *b"BIN\0"].concat());
    glb.extend(binary);
    glb.resize(total, 0);
    glb
}

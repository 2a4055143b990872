//! The lower floors of hemicube, without windows and graphics cards: they build in a minute.

#[path = "../../src/baked/mod.rs"]
pub mod baked;
#[path = "../../src/base/mod.rs"]
pub mod base;
#[path = "../../src/scene/mod.rs"]
pub mod scene;

/// A .glb of what a fuzzer made up: as it is where it begins with `glTF`, else a JSON half and a binary half, parted by
/// the first zero byte, in a sound container, so that the fuzzer need not learn lengths.
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

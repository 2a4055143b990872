//! A file with stored light can be written again, and reads back as the same light.

#![no_main]

use hemicube_fuzz::baked::{self, BakedScene};
use hemicube_fuzz::glb_of;
use hemicube_fuzz::scene::gltf::from_slice;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    if let Some(first) = baked(&glb_of(data)) {
        let written = baked::gltf::to_glb(&first, baked::exposure::suited(&first)).expect("small");
        let second = baked(&written).expect("what we write, we read");
        assert_eq!(first.light.groups.len(), second.light.groups.len());
        assert_eq!(first.scene.triangles.len(), second.scene.triangles.len());
        assert_eq!(total(&first), total(&second));
    }
});

fn baked(glb: &[u8]) -> Option<BakedScene> {
    baked::gltf::from_scene(from_slice("fuzz", glb).ok()?).ok()
}

/// The light at the corners of all triangles, whose order may differ: bits, sorted.
fn total(baked: &BakedScene) -> Vec<[u32; 3]> {
    let corners = baked.scene.triangles.iter().flat_map(|triangle| triangle.vertices);
    let groups = &baked.light.groups;
    let halves = |v: u32| groups.iter().flat_map(move |group| [group.direct[v as usize], group.indirect[v as usize]]);
    let mut bits: Vec<_> = corners.flat_map(halves).map(|light| light.to_array().map(f32::to_bits)).collect();
    bits.sort_unstable();
    bits
}

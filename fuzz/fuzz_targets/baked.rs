//! Checks that a file with baked light can be written again, and that loading the result gives the same light.

#![no_main]

use hemicube_fuzz::baked::BakedScene;
use hemicube_fuzz::baked::exposure::suited;
use hemicube_fuzz::baked::gltf::{from_scene, to_glb};
use hemicube_fuzz::glb_of;
use hemicube_fuzz::scene::gltf::from_slice;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Ok(Ok(first)) = from_slice("fuzz", &glb_of(data)).map(from_scene) else { return };
    let written = to_glb(&first, suited(&first)).expect("small");
    let reloaded = from_slice("written", &written).expect("what we write, we read");
    assert_eq!(first.scene.triangles.len(), reloaded.triangles.len());
    // Unused vertices and their light are not written.
    if !first.scene.triangles.is_empty() {
        let second = from_scene(reloaded).expect("it has light");
        assert_eq!(first.light.groups.len(), second.light.groups.len());
        assert_eq!(corner_light(&first), corner_light(&second));
    }
});

/// Returns the bits of the light at the corners of all triangles, sorted, because the order of triangles may differ.
fn corner_light(baked: &BakedScene) -> Vec<[u32; 3]> {
    let corners = baked.scene.triangles.iter().flat_map(|triangle| triangle.vertices);
    let groups = &baked.light.groups;
    let halves = |v: u32| groups.iter().flat_map(move |group| [group.direct[v as usize], group.indirect[v as usize]]);
    let mut bits: Vec<_> = corners.flat_map(halves).map(|light| light.to_array().map(f32::to_bits)).collect();
    bits.sort_unstable();
    bits
}

//! Checks that any bytes either load as a scene or yield an error of one line. The mesh doctor examines every scene.

#![no_main]

use hemicube_fuzz::scene::gltf::{LoadOptions, from_slice_with};
use hemicube_fuzz::{glb_of, scene};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let (bytes, options) = (glb_of(data), LoadOptions { variant: None });
    match from_slice_with("fuzz", &bytes, &options) {
        Ok(scene) => {
            let _ = scene::doctor::examine(&scene).lines();
        }
        Err(error) => {
            let line = error.to_string();
            assert!(!line.is_empty() && !line.contains('\n'), "{line:?}");
        }
    }
});

//! The files in assets/ equal the output of their generators.
//!
//! `UPDATE_ASSETS=1 cargo test` (or `make assets`) writes the files.

use std::path::Path;

use hemicube::baked::gltf::scene_to_glb;
use hemicube::scene::builtin;

#[test]
fn stored_scenes_equal_generated_ones() {
    for name in builtin::NAMES {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets").join(format!("{name}.glb"));
        let scene = builtin::by_name(name).expect("its name is in the list");
        let generated = scene_to_glb(&scene).expect("small");
        if std::env::var_os("UPDATE_ASSETS").is_some() {
            std::fs::write(&file, &generated).expect("assets/ can be written");
        }
        let stored = std::fs::read(&file).unwrap_or_default();
        assert!(stored == generated, "assets/{name}.glb differs from its generator; `make assets` writes it");
    }
}

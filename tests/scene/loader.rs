//! Invalid input: every file either loads or yields an error of one line. Nothing panics.

use std::fs;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

use hemicube::base::sampling::hash;
use hemicube::scene::gltf::{self, LoadError};
use hemicube::scene::{Scene, doctor};
use serde_json::{Value, json};

/// Returns a grey image of one pixel.
fn png() -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    image::GrayImage::new(1, 1).write_to(&mut file, image::ImageFormat::Png).expect("PNG can be written");
    file.into_inner()
}

/// Returns the JSON of a lit, textured, emissive triangle over [`triangle_bytes`].
fn triangle_json() -> Value {
    let png_bytes = png().len();
    json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"children": [1, 2]},
            {"mesh": 0, "scale": [1, 2, 3]},
            {"extensions": {"KHR_lights_punctual": {"light": 0}}},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1, "material": 0}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
            {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 3},
            {"bufferView": 2, "componentType": 5126, "type": "VEC2", "count": 3},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 36},
            {"buffer": 0, "byteOffset": 36, "byteLength": 6},
            {"buffer": 0, "byteOffset": 44, "byteLength": 24},
            {"buffer": 0, "byteOffset": 68, "byteLength": png_bytes},
        ],
        "buffers": [{"byteLength": 68 + png_bytes}],
        "images": [{"bufferView": 3, "mimeType": "image/png"}],
        "textures": [{"source": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "emissiveFactor": [1, 1, 1]}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}}]}},
    })
}

fn triangle_bytes() -> Vec<u8> {
    let positions = [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes).concat();
    let indices = [0u16, 1, 2, 0].map(u16::to_le_bytes).concat();
    let uv = [0f32, 0.0, 1.0, 0.0, 0.0, 1.0].map(f32::to_le_bytes).concat();
    [positions, indices, uv, png()].concat()
}

/// Returns a .glb file with these two chunks.
fn glb(json: &Value, binary: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let word = |n: usize| (n as u32).to_le_bytes();
    let header = [*b"glTF", word(2), word(28 + text.len() + binary.len())].concat();
    let json_head = [word(text.len()), *b"JSON"].concat();
    let binary_head = [word(binary.len()), *b"BIN\0"].concat();
    [header, json_head, text, binary_head, binary].concat()
}

fn good_glb() -> Vec<u8> {
    glb(&triangle_json(), &triangle_bytes())
}

/// Calls `load`, fails the test if it panics, and checks that an error has one line.
fn load_without_panic(what: &str, load: impl FnOnce() -> Result<Scene, LoadError>) -> Result<Scene, LoadError> {
    let result = catch_unwind(AssertUnwindSafe(load)).unwrap_or_else(|_| panic!("{what} made the loader panic"));
    if let Err(error) = &result {
        let line = error.to_string();
        assert!(!line.is_empty() && !line.contains('\n'), "{what}: not one line: {line:?}");
    }
    result
}

/// Writes `bytes` to a file of this name and checks that loading it returns an error with this name and this cause.
fn assert_error(name: &str, bytes: &[u8], cause: &str) {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let path = folder.path().join(name);
    fs::write(&path, bytes).expect("it can be written");
    let error = load_without_panic(name, || gltf::load(&path)).expect_err("the file is bad").to_string();
    assert!(error.contains(name) && error.contains(cause), "{error:?} should contain {name} and {cause:?}");
}

/// Calls [`assert_error`] for the valid triangle with one value of its JSON changed.
fn assert_json_error(place: &str, value: Value, cause: &str) {
    let mut json = triangle_json();
    *json.pointer_mut(place).expect("the place exists") = value;
    assert_error("changed.glb", &glb(&json, &triangle_bytes()), cause);
}

#[test]
fn the_valid_triangle_loads_without_notes() {
    let scene = gltf::from_slice("triangle", &good_glb()).expect("it is valid");
    assert_eq!((scene.triangles.len(), scene.lights.len(), scene.textures.len()), (1, 1, 1));
    assert_eq!(scene.light_groups, ["light 0", "material 0"]);
    assert!(scene.notes.is_empty(), "{:?}", scene.notes);
}

#[test]
fn a_missing_file_and_a_folder_are_errors_with_their_name() {
    let error = gltf::load(Path::new("no/such/scene.glb")).expect_err("it is not there").to_string();
    assert_eq!(error, "no/such/scene.glb: there is no such file");
    let error = gltf::load(Path::new("tests")).expect_err("it is no file").to_string();
    assert!(error.contains("it is a folder"), "{error}");
}

#[test]
fn files_that_are_not_gltf_are_errors_with_their_name() {
    assert_error("poem.glb", b"Roses are red", "not a glTF file");
    assert_error("empty.glb", b"", "not a glTF file");
    assert_error("list.gltf", b"[1, 2]", "version");
    assert_error("old.gltf", br#"{"asset": {"version": "1.0"}}"#, "version \"1.0\"");
    assert_error("deep.gltf", "[".repeat(100_000).as_bytes(), "not a glTF file");
}

#[test]
fn a_file_cut_off_anywhere_is_an_error() {
    let whole = good_glb();
    for length in [0, 3, 4, 11, 12, 19, 20, 200, whole.len() - 1] {
        assert_error("cut.glb", &whole[..length], "it is ");
    }
    assert_error("cut.glb", &whole[..200], &format!("it is cut off: 200 of {} bytes are there", whole.len()));
}

#[test]
fn a_required_unsupported_extension_is_an_error_with_advice() {
    let mut json = triangle_json();
    json["extensionsRequired"] = json!(["EXT_texture_avif"]);
    assert_error("avif.glb", &glb(&json, &triangle_bytes()), "gltf-transform png");
}

#[test]
fn invalid_values_are_errors_with_their_item() {
    assert_json_error("/nodes/2/extensions", json!({"KHR_lights_punctual": {"light": 5}}), "node 2 refers to light 5");
    assert_json_error("/nodes/0/children", json!([0]), "node 0 occurs twice");
    assert_json_error("/accessors/1/count", json!(4), "accessor 1");
    assert_json_error("/accessors/0/count", json!(2), "accessor 1: index 2 refers to no vertex");
    assert_json_error("/accessors/0/componentType", json!(1), "accessor 0: unknown component type");
    assert_json_error("/accessors/2/type", json!("MAT3"), "accessor 2: a matrix");
    assert_json_error("/accessors/1/componentType", json!(5126), "accessor 1");
    assert_json_error("/buffers/0/byteLength", json!(1u64 << 40), "buffer 0: it is cut off");
    assert_json_error("/nodes/1/scale", json!([1e39, 1, 1]), "transform of node 1");
    assert_json_error("/materials/0/emissiveFactor", json!([1e30, 0, 0]), "material 0");
}

#[test]
fn a_position_of_nan_is_an_error_with_its_accessor() {
    let mut bytes = triangle_bytes();
    bytes[..4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_error("nan.glb", &glb(&triangle_json(), &bytes), "accessor 0: it holds NaN");
}

#[test]
fn buffers_are_read_only_from_the_folder_of_the_scene() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).expect("it can be made");
    fs::write(inner.join("my data.bin"), triangle_bytes()).expect("it can be written");
    fs::write(folder.path().join("secret.bin"), triangle_bytes()).expect("it can be written");
    let load_with = |uri: &str| {
        let mut json = triangle_json();
        json["buffers"][0]["uri"] = json!(uri);
        fs::write(inner.join("scene.gltf"), json.to_string()).expect("it can be written");
        gltf::load(&inner.join("scene.gltf")).map_err(|error| error.to_string())
    };
    assert_eq!(load_with("my%20data.bin").map(|scene| scene.triangles.len()), Ok(1));
    assert!(load_with("absent.bin").expect_err("missing").contains("\"absent.bin\" is missing"));
    let absolute = folder.path().join("secret.bin");
    for uri in ["../secret.bin", "x/../../secret.bin", "file:///secret.bin", &absolute.to_string_lossy()] {
        assert!(load_with(uri).expect_err("outside").contains("is refused"), "{uri}");
    }
}

/// Instances multiply the triangles of a mesh, so a small file may describe more than fits into memory. The loader
/// returns an error before memory is allocated.
#[test]
fn a_small_file_with_a_huge_scene_is_refused() {
    let mut json = triangle_json();
    json["accessors"][0] = json!({"componentType": 5126, "type": "VEC3", "count": 1_000_000});
    json["meshes"][0]["primitives"] = json!([{"attributes": {"POSITION": 0, "NORMAL": 0}}]);
    json["nodes"] = json!(vec![json!({"mesh": 0}); 200]);
    json["scenes"][0]["nodes"] = json!((0..200).collect::<Vec<_>>());
    assert_error("huge.glb", &glb(&json, &triangle_bytes()), "too large");
}

/// Returns the bytes of a valid file with some flipped, overwritten or cut off; the same in every run.
fn corrupted(good: &[u8], variant: u32) -> Vec<u8> {
    let mut bytes = good.to_vec();
    let mut state = variant;
    let mut random = |below: usize| {
        state = hash(state.wrapping_add(1));
        state as usize % below
    };
    for _ in 0..=random(8) {
        let at = random(bytes.len());
        bytes[at] = match random(3) {
            0 => bytes[at] ^ (1 << random(8)),
            1 => b"0123456789-.[]{},\":e"[random(20)],
            _ => random(256) as u8,
        };
    }
    if random(4) == 0 {
        bytes.truncate(random(bytes.len()));
    }
    bytes
}

#[test]
fn corrupted_files_never_panic() {
    let good = good_glb();
    let loads = |variant: &u32| {
        let bytes = corrupted(&good, *variant);
        load_without_panic(&format!("variant {variant}"), || gltf::from_slice("corrupted", &bytes)).is_ok()
    };
    let num_loaded = (0..300).filter(loads).count();
    assert!((1..300).contains(&num_loaded), "{num_loaded} of 300 loaded: the corruption tests nothing");
}

/// Longest time for a file of the corpus, generous because the machine may be busy.
const MAX_SECONDS: f32 = 5.0;

/// Files with which a fuzzer once made the loader or the doctor fail.
#[test]
fn files_that_once_caused_a_crash_do_not_panic() {
    let mut num_files = 0;
    for entry in fs::read_dir("tests/crashes").expect("the folder is there").flatten() {
        let bytes = fs::read(entry.path()).expect("it can be read");
        let name = entry.path().display().to_string();
        let _ =
            load_without_panic(&name, || gltf::from_slice(&name, &bytes)).map(|scene| doctor::examine(&scene).lines());
        num_files += 1;
    }
    assert!(num_files > 0, "the folder of crashes is empty");
}

fn scenes_below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            scenes_below(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "gltf" || extension == "glb") {
            found.push(path);
        }
    }
}

#[test]
fn every_file_of_the_corpus_loads_or_yields_an_error_of_one_line() {
    let shared = std::env::var_os("HEMICUBE_SHARED").map_or_else(|| PathBuf::from("../shared"), PathBuf::from);
    let mut files = Vec::new();
    scenes_below(&shared.join("corpus"), &mut files);
    if files.is_empty() {
        println!("skipped: no corpus of glTF files in {}", shared.display());
    }
    for file in files {
        // The file may be valid or not.
        let start = Instant::now();
        let scene = load_without_panic(&file.display().to_string(), || gltf::load(&file));
        let _ = scene.map(|scene| doctor::examine(&scene));
        assert!(start.elapsed().as_secs_f32() < MAX_SECONDS, "{} took {:?}", file.display(), start.elapsed());
    }
}

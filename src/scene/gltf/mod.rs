//! The only place that knows glTF input: a .gltf or .glb file becomes a validated [`Scene`].
//!
//! The route: bytes -> `container` (JSON and blob) -> `document` (buffers, checked look-ups) -> `tree` (flattened nodes,
//! held against a `budget`) -> `material` and `texture` -> `populate` (`mesh`: `geometry` read through `accessor`, brought
//! into its rest pose by `morph` and `skin`, then `place`d in the world; `devices`: lights and cameras) -> `groups`, or
//! `stated_groups` where the file has its own. `compression` stands behind the document and the geometry: nobody else
//! knows whether bytes were packed. The gltf crate gives the typed JSON only: its accessors and its importer can panic on
//! broken files, ours check every range, so that any file either loads or ends in one [`LoadError`].
//!
//! Deliberately absent: animation. Skins and morph targets are shown as the file's nodes and weights place them.
//!
//! Source: Khronos Group, "glTF 2.0 Specification" (ISO/IEC 12113:2022) and its extension registry.

mod accessor;
mod baked_paint;
mod budget;
mod compression;
mod container;
mod devices;
mod document;
mod error;
mod extension;
#[cfg(test)]
mod fixture;
mod geometry;
mod groups;
mod ies;
mod instancing;
mod material;
mod mesh;
mod morph;
mod place;
mod populate;
mod resource;
mod skin;
mod stated_groups;
mod texture;
mod tree;
mod variant;

use std::io::Read as _;
use std::path::{Path, PathBuf};

use gltf::json::{Index, Node, Root};

pub use error::{Cause, LoadError};

use self::document::Document;
use self::material::MaterialReader;
use self::mesh::Meshes;
use self::populate::Population;
use crate::scene::{MAX_REFLECTANCE, Scene, doctor};

/// What of a file is loaded, where it leaves a choice.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// Name of a material variant (KHR_materials_variants); none for the materials worn without.
    pub variant: Option<String>,
}

/// Loads a .gltf or .glb file; `FILE#NAME` or `FILE#1` chooses one of its scenes by name or index.
///
/// Errors: one line that names the file and the cause.
pub fn load(path: &Path) -> Result<Scene, LoadError> {
    load_with(path, &LoadOptions::default())
}

/// As [`load`], with choices.
///
/// Errors: as [`load`]; there is no such variant.
pub fn load_with(path: &Path, options: &LoadOptions) -> Result<Scene, LoadError> {
    let (file, wanted) = split_scene_name(path);
    let failed = |cause| LoadError { file: file.display().to_string(), cause };
    let bytes = read_file(&file).map_err(failed)?;
    let name = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    // A file named without a folder lies in the working one.
    let folder = file.parent().map(|folder| if folder == Path::new("") { Path::new(".") } else { folder });
    read_scene(name, &bytes, folder, wanted.as_deref(), options).map_err(failed)
}

/// Loads a scene from the bytes of a file that needs no others, such as a built-in .glb.
///
/// Errors: as [`load`], with `name` for the file.
pub fn from_slice(name: &str, bytes: &[u8]) -> Result<Scene, LoadError> {
    from_slice_with(name, bytes, &LoadOptions::default())
}

/// As [`from_slice`], with choices.
///
/// Errors: as [`load_with`], with `name` for the file.
pub fn from_slice_with(name: &str, bytes: &[u8], options: &LoadOptions) -> Result<Scene, LoadError> {
    let failed = |cause| LoadError { file: name.to_owned(), cause };
    read_scene(name.to_owned(), bytes, None, None, options).map_err(failed)
}

/// The file, and the scene asked for after `#` unless a file has that very name.
fn split_scene_name(path: &Path) -> (PathBuf, Option<String>) {
    if let Some((file, scene)) = path.to_str().filter(|_| !path.exists()).and_then(|text| text.rsplit_once('#')) {
        return (PathBuf::from(file), Some(scene.to_owned()));
    }
    (path.to_owned(), None)
}

fn read_file(path: &Path) -> Result<Vec<u8>, Cause> {
    let unreadable = |error: std::io::Error| Cause::Unreadable(error.to_string());
    match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => return Err(Cause::Unreadable("it is a folder".to_owned())),
        Ok(metadata) if metadata.len() > resource::MAX_FILE_BYTES => {
            return Err(Cause::TooLarge(format!("{} bytes in one file", metadata.len())));
        }
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Err(Cause::NoSuchFile),
        _ => {}
    }
    // A pipe or device has no length that could be looked at before.
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(unreadable)?;
    file.take(resource::MAX_FILE_BYTES).read_to_end(&mut bytes).map_err(unreadable)?;
    Ok(bytes)
}

fn read_scene(
    name: String,
    bytes: &[u8],
    folder: Option<&Path>,
    wanted: Option<&str>,
    options: &LoadOptions,
) -> Result<Scene, Cause> {
    let document = Document::parse(bytes, folder)?;
    let variants = variant::names(&document.root);
    let chosen = options.variant.as_ref().map(|wanted| variant::index(&variants, wanted)).transpose()?;
    let mut scene = Scene { name, variants, ..Scene::default() };
    scene.notes.extend(extension::check(&document.root)?);
    let nodes = tree::flatten(&document, &root_nodes(&document, wanted)?)?;
    budget::check(&document, &nodes)?;
    let uv_sets = read_materials(&document, &mut scene)?;

    let meshes = Meshes::new(&document, &nodes, uv_sets, chosen);
    let mut population = Population::new(&document, &nodes, scene, meshes);
    nodes.iter().enumerate().try_for_each(|(place, node)| population.add(place, node))?;
    let (mut scene, light_definitions) = population.finish();
    if !stated_groups::assign(&mut scene, &light_definitions, &document.root) {
        groups::assign(&mut scene, &light_definitions, &light_names(&document.root));
    }
    note_bright_materials(&mut scene);
    Ok(scene)
}

/// Fills in materials and textures; returns the texture coordinate sets that each material wants.
fn read_materials(document: &Document<'_>, scene: &mut Scene) -> Result<Vec<[u32; 2]>, Cause> {
    let mut reader = MaterialReader::new(document);
    scene.materials = reader.read_all()?;
    scene.notes.append(&mut reader.notes);
    scene.textures = reader.textures.load(document, &mut scene.notes)?;
    material::drop_missing_data_textures(&mut scene.materials, &scene.textures);
    Ok(reader.uv_sets)
}

/// Roots of the wanted scene, else of the default one, else of the first, else of all nodes.
fn root_nodes(document: &Document<'_>, wanted: Option<&str>) -> Result<Vec<Index<Node>>, Cause> {
    let root = &document.root;
    let scene = match (wanted, root.scene) {
        (Some(wanted), _) => Some(&root.scenes[scene_index(root, wanted)?]),
        (None, Some(default)) => Some(document.find(default, "scene", || "the file".to_owned())?),
        (None, None) => root.scenes.first(),
    };
    Ok(scene.map_or_else(|| nodes_without_parent(root), |scene| scene.nodes.clone()))
}

/// A name wins over an index, so that a scene named "1" can be had.
fn scene_index(root: &Root, wanted: &str) -> Result<usize, Cause> {
    let by_name = root.scenes.iter().position(|scene| scene.name.as_deref() == Some(wanted));
    let by_index = || wanted.parse().ok().filter(|&index: &usize| index < root.scenes.len());
    by_name.or_else(by_index).ok_or_else(|| {
        let names = root.scenes.iter().enumerate().map(|(i, scene)| match &scene.name {
            Some(name) => format!("#{i} {name:?}"),
            None => format!("#{i}"),
        });
        let available = names.collect::<Vec<_>>().join(", ");
        let available = if available.is_empty() { "none at all".to_owned() } else { available };
        Cause::NoSuchScene { wanted: wanted.to_owned(), available }
    })
}

fn nodes_without_parent(root: &Root) -> Vec<Index<Node>> {
    let mut is_root = vec![true; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
        if let Some(is_root) = is_root.get_mut(child.value()) {
            *is_root = false;
        }
    }
    (0..).zip(is_root).filter(|&(_, is_root)| is_root).map(|(i, _)| Index::new(i)).collect()
}

/// Names of the light definitions: the punctual ones, then the photometric files.
fn light_names(root: &Root) -> Vec<Option<String>> {
    let extension = root.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
    let punctual = extension.map_or(&[][..], |lights| &lights.lights).iter().map(|light| light.name.clone());
    let photometric = ies::definitions(root).iter().map(|light| light["name"].as_str().map(str::to_owned));
    punctual.chain(photometric).collect()
}

/// The user should know where transport clamps what the file says.
fn note_bright_materials(scene: &mut Scene) {
    for (m, reflectance) in doctor::mean_reflectances(scene).into_iter().enumerate() {
        if reflectance > MAX_REFLECTANCE {
            let name = &scene.materials[m].name;
            scene
                .notes
                .push(format!("material {name:?} reflects {reflectance:.2}; it is clamped to {MAX_REFLECTANCE}"));
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::fixture::Fixture;
    use super::*;

    #[test]
    fn a_scene_is_chosen_by_name_or_index() {
        let mut fixture = Fixture::triangle();
        fixture.json["scenes"] = json!([{"nodes": [0]}, {"name": "empty"}]);
        let folder = tempfile::tempdir().expect("a folder for the test");
        let file = folder.path().join("two.gltf");
        std::fs::write(&file, fixture.to_bytes()).expect("it can be written");
        let load_part = |part: &str| load(Path::new(&format!("{}{part}", file.display())));
        let triangles = |part: &str| load_part(part).expect("there is such a scene").triangles.len();
        assert_eq!([triangles(""), triangles("#0"), triangles("#1"), triangles("#empty")], [1, 1, 0, 0]);
        let error = load_part("#attic").expect_err("there is no such scene").to_string();
        assert!(error.ends_with("it has no scene \"attic\"; there is #0, #1 \"empty\""), "{error}");
    }

    #[test]
    fn without_scenes_all_roots_are_shown() {
        let mut fixture = Fixture::triangle();
        fixture.json["nodes"] = json!([{"mesh": 0}, {"children": [0]}, {"mesh": 0}]);
        let root = fixture.json.as_object_mut().expect("an object");
        root.remove("scene");
        root.remove("scenes");
        assert_eq!(fixture.load().triangles.len(), 2);
    }

    #[test]
    fn indices_that_point_nowhere_say_who_and_what() {
        let cases = [
            ("/scene", json!(7), "the file refers to scene 7"),
            ("/scenes/0/nodes/0", json!(7), "the node tree refers to node 7"),
            ("/nodes/0/mesh", json!(7), "node 0 refers to mesh 7"),
            ("/meshes/0/primitives/0/attributes/POSITION", json!(7), "mesh 0, primitive 0 refers to accessor 7"),
            ("/accessors/0/bufferView", json!(7), "accessor 0 refers to buffer view 7"),
            ("/bufferViews/0/buffer", json!(7), "buffer view 0 refers to buffer 7"),
        ];
        for (place, value, expected) in cases {
            let mut fixture = Fixture::triangle();
            *fixture.json.pointer_mut(place).expect("the place exists") = value;
            assert!(fixture.error().contains(expected), "{}", fixture.error());
        }
    }
}

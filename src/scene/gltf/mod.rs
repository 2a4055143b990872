//! The only place that knows glTF input: a .gltf or .glb file becomes a validated [`Scene`].
//!
//! The route: bytes -> [`container`] (JSON and blob) -> [`document`] (buffers, checked look-ups) -> [`material`] and
//! [`texture`] -> [`nodes`] (the tree; [`geometry`] read through [`accessor`], then [`place`]d in the world) ->
//! [`groups`]. The gltf crate gives the typed JSON only: its accessors and its importer can panic on broken files, ours
//! check every range, so that any file either loads or ends in one [`LoadError`].
//!
//! Deliberately absent: animation, skinning, morphing, and compressed geometry (Draco, meshopt).
//!
//! Source: Khronos Group, "glTF 2.0 Specification" (ISO/IEC 12113:2022) and its extension registry.

mod accessor;
mod container;
mod devices;
mod document;
mod error;
mod extension;
#[cfg(test)]
mod fixture;
mod geometry;
mod groups;
mod material;
mod nodes;
mod place;
mod resource;
mod texture;

use std::path::{Path, PathBuf};

use glam::DAffine3;
use gltf::json::{Index, Node, Root};

pub use error::{Cause, LoadError};

use self::document::Document;
use self::material::MaterialReader;
use self::nodes::Walk;
use self::texture::TextureTable;
use crate::scene::{MAX_REFLECTANCE, Scene, doctor};

/// Loads a .gltf or .glb file; `FILE#NAME` or `FILE#1` chooses one of its scenes by name or index.
///
/// Errors: one line that names the file and the cause.
pub fn load(path: &Path) -> Result<Scene, LoadError> {
    let (file, wanted) = split_scene_name(path);
    let failed = |cause| LoadError { file: file.display().to_string(), cause };
    let bytes = read_file(&file).map_err(failed)?;
    let name = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    read_scene(name, &bytes, file.parent(), wanted.as_deref()).map_err(failed)
}

/// Loads a scene from the bytes of a file that needs no others, such as a built-in .glb.
///
/// Errors: as [`load`], with `name` for the file.
pub fn from_slice(name: &str, bytes: &[u8]) -> Result<Scene, LoadError> {
    let failed = |cause| LoadError { file: name.to_owned(), cause };
    read_scene(name.to_owned(), bytes, None, None).map_err(failed)
}

/// The file, and the scene asked for after `#` unless a file has that very name.
fn split_scene_name(path: &Path) -> (PathBuf, Option<String>) {
    if let Some((file, scene)) = path.to_str().filter(|_| !path.exists()).and_then(|text| text.rsplit_once('#')) {
        return (PathBuf::from(file), Some(scene.to_owned()));
    }
    (path.to_owned(), None)
}

fn read_file(path: &Path) -> Result<Vec<u8>, Cause> {
    match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => return Err(Cause::Unreadable("it is a folder".to_owned())),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Err(Cause::NoSuchFile),
        _ => {}
    }
    std::fs::read(path).map_err(|error| Cause::Unreadable(error.to_string()))
}

fn read_scene(name: String, bytes: &[u8], folder: Option<&Path>, wanted: Option<&str>) -> Result<Scene, Cause> {
    let document = Document::parse(bytes, folder)?;
    let mut scene = Scene { name, ..Scene::default() };
    scene.notes.extend(extension::check(&document.root)?);
    read_materials(&document, &mut scene)?;

    let mut walk = Walk::new(&document, scene);
    for root in root_nodes(&document, wanted)? {
        walk.visit(root, DAffine3::IDENTITY, 0)?;
    }
    let (mut scene, light_definitions) = walk.finish();
    groups::assign(&mut scene, &light_definitions, &light_names(&document.root));
    note_bright_materials(&mut scene);
    Ok(scene)
}

fn read_materials(document: &Document<'_>, scene: &mut Scene) -> Result<(), Cause> {
    let mut reader = MaterialReader { document, textures: TextureTable::default(), notes: Vec::new() };
    scene.materials = reader.read_all()?;
    scene.notes.append(&mut reader.notes);
    scene.textures = reader.textures.load(document, &mut scene.notes)?;
    material::drop_missing_data_textures(&mut scene.materials, &scene.textures);
    Ok(())
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

fn light_names(root: &Root) -> Vec<Option<String>> {
    let extension = root.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
    extension.map_or_else(Vec::new, |lights| lights.lights.iter().map(|light| light.name.clone()).collect())
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

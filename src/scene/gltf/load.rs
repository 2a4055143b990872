//! The steps from the path or the bytes of a file to a scene.

use std::io::Read as _;
use std::path::Path;

use gltf::json::Root;

use super::budget;
use super::error::{Cause, LoadError};
use super::file::document::Document;
use super::file::{extension, resource};
use super::light::{groups, photometric, stated_groups};
use super::material::reader::{MaterialReader, drop_missing_data_textures};
use super::material::variant;
use super::mesh::meshes::Meshes;
use super::node::tree;
use super::populate::Population;
use super::scene_choice::{root_nodes, split_scene_name};
use crate::scene::reflectance::mean_reflectances;
use crate::scene::{MAX_REFLECTANCE, Scene};

/// Options of loading.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// Name of the material variant to use (KHR_materials_variants); `None` for the primitives' default materials.
    pub variant: Option<String>,
}

/// Loads a .gltf or .glb file; `FILE#NAME` or `FILE#1` selects one of its scenes by name or index.
///
/// ```no_run
/// let scene = hemicube::load("house.glb#Ground floor".as_ref())?;
/// println!("{}: {} triangles, {:.1} m2", scene.name, scene.triangles.len(), scene.area());
/// # Ok::<(), hemicube::scene::gltf::LoadError>(())
/// ```
///
/// # Errors
/// Returns an error if the file cannot be read or is not valid glTF 2.0; its message is one line with the file and the
/// cause.
pub fn load(path: &Path) -> Result<Scene, LoadError> {
    load_with(path, &LoadOptions::default())
}

/// Loads a file as [`load`] does, with options.
///
/// # Errors
/// Returns an error as [`load`] does, and if the file has no material variant of the given name.
pub fn load_with(path: &Path, options: &LoadOptions) -> Result<Scene, LoadError> {
    let (file, wanted) = split_scene_name(path);
    let failed = |cause| LoadError { file: file.display().to_string(), cause };
    let bytes = read_file(&file).map_err(failed)?;
    let name = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    // The folder of a bare file name is the working directory.
    let folder = file.parent().map(|folder| if folder == Path::new("") { Path::new(".") } else { folder });
    read_scene(name, &bytes, folder, wanted.as_deref(), options).map_err(failed)
}

/// Loads a scene from the bytes of a .glb or .gltf file without external files. `name` is the file's name in messages.
///
/// # Errors
/// Returns an error as [`load`] does, and if the file refers to an external file.
pub fn from_slice(name: &str, bytes: &[u8]) -> Result<Scene, LoadError> {
    from_slice_with(name, bytes, &LoadOptions::default())
}

/// Loads a scene as [`from_slice`] does, with options.
///
/// # Errors
/// Returns an error as [`from_slice`] does, and if the file has no material variant of the given name.
pub fn from_slice_with(name: &str, bytes: &[u8], options: &LoadOptions) -> Result<Scene, LoadError> {
    let failed = |cause| LoadError { file: name.to_owned(), cause };
    read_scene(name.to_owned(), bytes, None, None, options).map_err(failed)
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
    // Pipes and devices have no length in their metadata, so the limit is also applied while reading.
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
    nodes.iter().enumerate().try_for_each(|(scene_node, node)| population.add(scene_node, node))?;
    let (mut scene, light_definitions) = population.finish();
    if !stated_groups::assign(&mut scene, &light_definitions, &document.root) {
        groups::assign(&mut scene, &light_definitions, &light_names(&document.root));
    }
    note_bright_materials(&mut scene);
    Ok(scene)
}

/// Reads materials and textures into the scene; returns the two texture coordinate sets that each material uses `[m]`.
fn read_materials(document: &Document<'_>, scene: &mut Scene) -> Result<Vec<[u32; 2]>, Cause> {
    let mut reader = MaterialReader::new(document);
    scene.materials = reader.read_all()?;
    scene.notes.append(&mut reader.notes);
    scene.textures = reader.textures.load(document, &mut scene.notes)?;
    drop_missing_data_textures(&mut scene.materials, &scene.textures);
    Ok(reader.uv_sets)
}

/// Returns the names of the file's light definitions: punctual lights first, then photometric files.
fn light_names(root: &Root) -> Vec<Option<String>> {
    let extension = root.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
    let punctual = extension.map_or(&[][..], |lights| &lights.lights).iter().map(|light| light.name.clone());
    let photometric = photometric::definitions(root).iter().map(|light| light["name"].as_str().map(str::to_owned));
    punctual.chain(photometric).collect()
}

/// Adds a note for each material whose reflectance is clamped in light transport.
fn note_bright_materials(scene: &mut Scene) {
    for (m, reflectance) in mean_reflectances(scene).into_iter().enumerate() {
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

    use super::super::fixture::Fixture;

    #[test]
    fn a_dangling_index_is_reported_with_the_referring_item() {
        let cases = [
            ("/scene", json!(7), "the file refers to scene 7"),
            ("/scenes/0/nodes/0", json!(7), "the node tree refers to node 7"),
            ("/nodes/0/mesh", json!(7), "node 0 refers to mesh 7"),
            ("/meshes/0/primitives/0/attributes/POSITION", json!(7), "mesh 0, primitive 0 refers to accessor 7"),
            ("/accessors/0/bufferView", json!(7), "accessor 0 refers to buffer view 7"),
            ("/bufferViews/0/buffer", json!(7), "buffer view 0 refers to buffer 7"),
        ];
        for (pointer, value, expected) in cases {
            let mut fixture = Fixture::triangle();
            *fixture.json.pointer_mut(pointer).expect("the value exists") = value;
            assert!(fixture.error().contains(expected), "{}", fixture.error());
        }
    }
}

//! The rules of ARCHITECTURE.md: a file uses lower floors and its own folder only, no files use each other in a circle,
//! wgpu stays where it belongs, and folders stay small.

mod circles;
mod imports;
mod names;
mod rules;
mod samples;
mod tokens;

use std::path::{Path, PathBuf};

use imports::{Imports, Sources};

use crate::support::sources::files_below;

/// Folders whose files may still form a circle. An entry without one fails: this list only gets shorter.
const KNOWN_CIRCLES: &[&str] = &["baked/gltf", "lightmap"];

/// Folders that may still hold too many files.
const KNOWN_CROWDS: &[&str] = &[];

/// The code files with this extension below `folder` of the project, by their path relative to it, with slashes.
fn listed(folder: &str, extension: &str) -> Vec<(String, PathBuf)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let relative = |path: &Path| path.strip_prefix(&root).expect("it lies below").to_string_lossy().replace('\\', "/");
    let files = if root.is_dir() { files_below(&root, extension) } else { Vec::new() };
    files.into_iter().map(|path| (relative(&path), path)).collect()
}

fn sources() -> Sources {
    let text = |path| std::fs::read_to_string(path).expect("sources are text");
    listed("src", "rs").into_iter().map(|(file, path)| (file, text(path))).collect()
}

fn assert_none(found: &[String]) {
    assert!(found.is_empty(), "\n{}\n", found.join("\n"));
}

/// The breaches outside of the `known` places, and the known places without a breach; a breach is (place, description).
fn unexpected(breaches: Vec<(String, String)>, known: &[&str]) -> Vec<String> {
    let is_in = |place: &str, known: &str| place == known || place.starts_with(&format!("{known}/"));
    let cured = known.iter().filter(|known| !breaches.iter().any(|(place, _)| is_in(place, known)));
    let mut found: Vec<String> = cured.map(|known| format!("{known} is cured: remove it from the list")).collect();
    let is_new = |place: &str| !known.iter().any(|known| is_in(place, known));
    found.extend(breaches.into_iter().filter(|(place, _)| is_new(place)).map(|(_, description)| description));
    found
}

#[test]
fn every_file_uses_lower_floors_only() {
    let sources = sources();
    assert_none(&rules::misplaced_files(&sources));
    assert_none(&rules::upward_imports(&Imports::of(&sources)));
}

#[test]
fn every_room_uses_lower_rooms_only() {
    assert_none(&rules::upward_imports_in_rooms(&Imports::of(&sources()), rules::ROOMS));
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    let circles = rules::file_circles(&Imports::of(&sources()));
    let breaches = circles.into_iter().map(|(files, description)| (common_folder(&files), description)).collect();
    assert_none(&unexpected(breaches, KNOWN_CIRCLES));
}

/// The deepest folder that holds all files.
fn common_folder(files: &[String]) -> String {
    let folder = |file: &str| file.rsplit_once('/').map_or(String::new(), |(folder, _)| folder.to_owned());
    let mut common = folder(&files[0]);
    while !files.iter().all(|file| common.is_empty() || file.starts_with(&format!("{common}/"))) {
        common = folder(&common);
    }
    common
}

#[test]
fn wgpu_is_named_where_it_belongs() {
    assert_none(&rules::misplaced_wgpu(&sources()));
}

#[test]
fn no_folder_is_crowded() {
    let mut files = Vec::new();
    for folder in ["src", "shaders", "tests", "benches", "examples"] {
        for extension in rules::CODE {
            files.extend(listed(folder, extension).into_iter().map(|(file, _)| format!("{folder}/{file}")));
        }
    }
    let crowds = rules::crowded(files.iter().map(String::as_str));
    let breaches =
        crowds.into_iter().map(|(folder, count)| (folder.clone(), format!("{folder} holds {count} files"))).collect();
    assert_none(&unexpected(breaches, KNOWN_CROWDS));
}

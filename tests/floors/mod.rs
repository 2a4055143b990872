//! Checks the rules of ARCHITECTURE.md. A floor is a layer: a file uses lower floors and its own folder only.
//! Dependencies between files have no cycles, wgpu appears only in certain folders, and folders are small.

mod circles;
mod imports;
mod names;
mod rules;
mod samples;
mod tokens;

use std::path::{Path, PathBuf};

use imports::{Imports, Sources};

use crate::support::sources::files_below;

/// Lists the code files with this extension below `folder` of the project, with their path relative to it, with
/// slashes.
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
    assert_none(&rules::file_circles(&Imports::of(&sources())));
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
    assert_none(&rules::crowded(files.iter().map(String::as_str)));
}

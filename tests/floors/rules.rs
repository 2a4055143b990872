//! The rules of ARCHITECTURE.md. Each function returns one line for each breach.

use std::collections::BTreeMap;

use super::circles::{circles, describe};
use super::imports::{Imports, Sources, Uses};
use super::tokens::{text_at, tokens};

/// Floor (layer) of each folder directly below src/. A file uses its own folder and folders on lower floors. Folders on
/// the same floor never use each other.
const FLOORS: [(&str, f32); 14] = [
    ("base", 0.0),
    ("scene", 1.0),
    ("gpu", 1.0),
    ("patch", 2.0),
    ("trace", 2.0),
    // The coarse mesh merges the elements that `patch` has cut, so `baked` lies above it.
    ("baked", 2.5),
    ("form_factor", 3.0),
    ("lightmap", 3.0),
    ("raytrace", 3.0),
    ("render", 3.0),
    ("radiosity", 4.0),
    ("bake", 5.0),
    ("viewer", 6.0),
    ("cli", 7.0),
];

/// Folders that stand above the device and still never use it: geometry and rays work without a GPU.
const WITHOUT_DEVICE: [&str; 3] = ["patch", "trace", "baked"];

/// Floors inside a folder: names of its files and folders, the lowest floor first. Those on one floor never use each
/// other. Files that are not listed are free, for example settings that contain those of each technique.
pub type Rooms<'a> = (&'a str, &'a [&'a [&'a str]]);

pub const ROOMS: &[Rooms<'_>] = &[
    ("form_factor", &[&["row"], &["source"], &["hemicube", "hemisphere", "point_to_polygon", "row_cache"]]),
    (
        "radiosity",
        &[&["field"], &["reconstruction", "viewpoints"], &["adaptive_subdivision", "direct", "gather", "solver"]],
    ),
    ("bake", &[&["settings"], &["context", "error"], &["forecast", "measure", "report", "stages"]]),
    (
        "viewer",
        &[
            &["background", "options", "camera"],
            &["settings"],
            &["action", "preferences", "solution"],
            &["job", "picture"],
            &["session"],
            &["panels"],
            &["software"],
            &["drawing"],
            &["window"],
        ],
    ),
    (
        "render/shadow",
        &[
            &["shared"],
            &["light"],
            &["map", "volume", "planar", "raytraced", "cutout"],
            &["dispatch", "few_lights"],
            &["real_time"],
            &["debug", "comparison"],
        ],
    ),
];

/// Folders in which wgpu may be used.
const WGPU_FOLDERS: [&str; 4] = ["gpu/", "form_factor/hemicube/", "render/", "viewer/"];

/// Roots of the crate, which may use all floors.
const ENTRANCES: [&str; 2] = ["lib.rs", "main.rs"];

/// Largest number of code files beside each other in one folder.
const MOST_FILES: usize = 15;

/// Extensions of code files.
pub const CODE: [&str; 5] = ["rs", "wgsl", "py", "mjs", "sh"];

/// Finds imports of a folder that is not on a lower floor.
pub fn upward_imports(imports: &Imports) -> Vec<String> {
    let height = |part: &str| FLOORS.iter().find(|(known, _)| *known == part).map(|&(_, height)| height);
    let mut found = Vec::new();
    for (file, target, names) in ties(&[&imports.used, &imports.passed_on]) {
        if ENTRANCES.contains(&file) {
            continue;
        }
        let (part, below) = (house_part(file), house_part(target));
        let is_lower = height(part).zip(height(below)).is_some_and(|(part, below)| below < part);
        let is_banned = below == "gpu" && WITHOUT_DEVICE.contains(&part);
        if part != below && (!is_lower || is_banned) {
            found.push(format!("{file} uses {names} of {target}, and {part} must not use {below}"));
        }
    }
    found
}

/// Finds files in a folder without a floor.
pub fn misplaced_files(sources: &Sources) -> Vec<String> {
    let is_misplaced = |file: &&String| {
        !ENTRANCES.contains(&file.as_str()) && FLOORS.iter().all(|(part, _)| *part != house_part(file))
    };
    sources.keys().filter(is_misplaced).map(|file| format!("{file} stands on no floor")).collect()
}

/// Finds imports of a room that is not on a lower floor, inside the folders that `rooms` divides.
pub fn upward_imports_in_rooms(imports: &Imports, rooms: &[Rooms<'_>]) -> Vec<String> {
    let mut found = Vec::new();
    for (file, target, names) in ties(&[&imports.used, &imports.passed_on]) {
        for (folder, floors) in rooms {
            let height = |room: &str| floors.iter().position(|floor| floor.contains(&room));
            let (Some(room), Some(below)) = (room_in(file, folder), room_in(target, folder)) else {
                continue;
            };
            if room != below && height(room).zip(height(below)).is_some_and(|(room, below)| below >= room) {
                found.push(format!("{file} uses {names} of {target}: in {folder}, {below} is not below {room}"));
            }
        }
    }
    found
}

/// Finds cycles in the dependencies between files.
pub fn file_circles(imports: &Imports) -> Vec<String> {
    let mut used = imports.used.clone();
    used.retain(|file, _| !ENTRANCES.contains(&file.as_str()));
    circles(&used).iter().map(|circle| describe(circle, &used)).collect()
}

/// Finds lines that use wgpu outside of [`WGPU_FOLDERS`].
pub fn misplaced_wgpu(sources: &Sources) -> Vec<String> {
    let mut found = Vec::new();
    for (file, text) in sources.iter().filter(|(file, _)| !WGPU_FOLDERS.iter().any(|folder| file.starts_with(folder))) {
        let tokens = tokens(text);
        for (at, token) in tokens.iter().enumerate() {
            if matches!(token.text.as_str(), "wgpu" | "egui_wgpu") && text_at(&tokens, at + 1) == "::" {
                found.push(format!("{file}:{}: wgpu is named outside of {WGPU_FOLDERS:?}", token.line));
            }
        }
    }
    found
}

/// Finds folders with too many code files beside each other. `files` are paths below the root of the project.
pub fn crowded<'a>(files: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for file in files {
        let (folder, name) = file.rsplit_once('/').unwrap_or(("", file));
        if name.rsplit_once('.').is_some_and(|(_, extension)| CODE.contains(&extension)) {
            *counts.entry(folder).or_default() += 1;
        }
    }
    let crowds = counts.into_iter().filter(|&(_, count)| count > MOST_FILES);
    crowds.map(|(folder, count)| format!("{folder} holds {count} code files beside each other")).collect()
}

/// Lists each (file, file that it uses, names through which it does).
fn ties<'a>(uses: &[&'a Uses]) -> Vec<(&'a str, &'a str, String)> {
    let mut all = Vec::new();
    for (file, targets) in uses.iter().flat_map(|uses| uses.iter()) {
        for (target, names) in targets {
            all.push((file.as_str(), target.as_str(), names.iter().cloned().collect::<Vec<_>>().join(", ")));
        }
    }
    all
}

/// Returns the folder, or file stem, directly below src/.
fn house_part(file: &str) -> &str {
    file.split('/').next().unwrap_or(file).trim_end_matches(".rs")
}

/// Returns the folder, or file stem, directly below `folder`, if the file lies there.
fn room_in<'a>(file: &'a str, folder: &str) -> Option<&'a str> {
    file.strip_prefix(folder)?.strip_prefix('/').map(house_part)
}

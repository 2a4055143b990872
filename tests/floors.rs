//! The house of ARCHITECTURE.md: a file names its own folder and lower floors only, and wgpu stays where it belongs.

use std::path::Path;

use crate::support::sources::files_below;

/// Height of each folder or file directly below src/; equals never name each other.
const FLOORS: [(&str, f32); 15] = [
    ("base", 0.0),
    ("scene", 1.0),
    ("gpu", 1.0),
    ("patch", 2.0),
    ("trace", 2.0),
    // On a landing of its own: its coarse mesh undoes what `patch` has cut.
    ("baked", 2.5),
    ("form_factor", 3.0),
    ("lightmap", 3.0),
    ("raytrace", 3.0),
    ("render", 3.0),
    ("radiosity", 4.0),
    ("bake", 5.0),
    ("measure", 5.0),
    ("viewer", 6.0),
    ("cli", 7.0),
];

/// Where wgpu may be named.
const WGPU_FOLDERS: [&str; 4] = ["gpu/", "form_factor/hemicube/", "render/", "viewer/"];

/// Entrances: they see all floors.
const ENTRANCES: [&str; 2] = ["lib.rs", "main.rs"];

fn floor(name: &str) -> Option<f32> {
    FLOORS.iter().find(|(known, _)| *known == name).map(|&(_, floor)| floor)
}

/// Folder, or file stem, directly below src/.
fn house_part(file: &str) -> &str {
    file.split('/').next().unwrap_or(file).trim_end_matches(".rs")
}

/// What the text of src/`file` imports or says against the rules, one line each.
fn violations(file: &str, text: &str) -> Vec<String> {
    let part = house_part(file);
    let Some(height) = floor(part) else {
        return vec![format!("{file}: {part} stands on no floor")];
    };
    let mut found = Vec::new();
    for (line, code) in text.lines().map(code_of).enumerate().map(|(i, code)| (i + 1, code)) {
        for target in crate_paths(code).filter(|&target| target != part) {
            if floor(target).is_some_and(|target| target >= height) {
                found.push(format!("{file}:{line}: {part} names {target}, which is not below it"));
            }
        }
        if code.contains("wgpu::") && !WGPU_FOLDERS.iter().any(|folder| file.starts_with(folder)) {
            found.push(format!("{file}:{line}: wgpu is named outside of {WGPU_FOLDERS:?}"));
        }
    }
    found
}

/// A line without its comment.
fn code_of(line: &str) -> &str {
    line.split("//").next().unwrap_or(line)
}

/// Parts of the house that a line of code names through `crate::`.
fn crate_paths(code: &str) -> impl Iterator<Item = &str> {
    let after = code.split("crate::").skip(1);
    after.flat_map(|path| {
        // A group such as crate::{base::ids, scene} names one part after each comma of its outer level.
        let names = path.strip_prefix('{').map_or_else(|| vec![path], outer_items);
        names.into_iter().map(|name| name.trim().split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or(""))
    })
}

/// Items of a `{a::{b, c}, d}` group whose opening brace is cut off.
fn outer_items(group: &str) -> Vec<&str> {
    let (mut depth, mut start, mut items) = (0, 0, Vec::new());
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                items.push(&group[start..at]);
                start = at + 1;
                if c == '}' {
                    return items;
                }
            }
            _ => {}
        }
    }
    items.push(&group[start..]);
    items
}

#[test]
fn every_file_stays_on_its_floor() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    for path in files_below(&src, "rs") {
        let file = path.strip_prefix(&src).expect("it lies there").to_string_lossy().replace('\\', "/");
        if !ENTRANCES.contains(&file.as_str()) {
            found.extend(violations(&file, &std::fs::read_to_string(&path).expect("it is text")));
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_broken_rule_is_caught() {
    let breaks = |file: &str, line: &str| violations(file, line).len() == 1;
    assert!(breaks("scene/mod.rs", "use crate::radiosity::Solution;"), "an upper floor");
    assert!(breaks("render/frame.rs", "use crate::form_factor::Row;"), "a neighbour on the same floor");
    assert!(breaks("base/ids.rs", "use crate::{base::colour, scene::Scene};"), "in a group");
    assert!(breaks("patch/mod.rs", "    let gpu = crate::gpu::Gpu::headless();"), "without a use");
    assert!(breaks("form_factor/analytic.rs", "fn f(device: &wgpu::Device) {}"), "wgpu out of place");
    assert!(breaks("attic/mod.rs", ""), "a folder on no floor");
}

#[test]
fn what_is_allowed_passes() {
    let passes = |file: &str, line: &str| violations(file, line).is_empty();
    assert!(passes("radiosity/mod.rs", "use crate::{base::{ids, colour}, form_factor::Row, scene::Scene};"));
    assert!(passes("radiosity/direct.rs", "use crate::radiosity::emitter::Emitter;"));
    assert!(passes("scene/mod.rs", "//! Later becomes a [`crate::baked::BakedScene`]."));
    assert!(passes("form_factor/hemicube/atlas.rs", "fn f(device: &wgpu::Device) {}"));
}

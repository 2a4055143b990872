//! The Markdown files name files that exist, and the book has all of its pages.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::support::sources::files_below;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the path, relative to the root, and the text of each Markdown file.
fn documents() -> Vec<(PathBuf, String)> {
    let folders = ["docs", "assets", "fuzz", "examples", "scripts"].map(|folder| root().join(folder));
    let mut files: Vec<PathBuf> =
        folders.iter().filter(|folder| folder.is_dir()).flat_map(|folder| files_below(folder, "md")).collect();
    let top = std::fs::read_dir(root()).expect("the root is readable").map(|entry| entry.expect("readable").path());
    files.extend(top.filter(|path| path.extension().is_some_and(|extension| extension == "md")));
    let relative = |path: &Path| path.strip_prefix(root()).expect("it lies below").to_owned();
    files.iter().map(|path| (relative(path), std::fs::read_to_string(path).expect("it is text"))).collect()
}

/// Returns the targets of links and pictures of a document that are files.
fn linked_files(text: &str) -> impl Iterator<Item = &str> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split([')', ' ', '#']).next());
    targets.filter(|target| !target.is_empty() && !target.contains(':'))
}

/// Returns the words in code style that are paths: they contain a folder and end in a source file, or in a slash for a
/// folder.
fn named_sources(text: &str) -> impl Iterator<Item = &str> {
    let code = text.split('`').skip(1).step_by(2);
    let is_path = |word: &&str| word.chars().all(|c| c.is_alphanumeric() || "/._-".contains(c));
    let is_source = |word: &&str| {
        [".rs", ".wgsl", "/"].iter().any(|end| word.strip_suffix(end).is_some_and(|path| path.contains('/')))
    };
    code.filter(move |word| is_path(word) && is_source(word))
}

#[test]
fn links_lead_to_files() {
    let mut missing = Vec::new();
    for (document, text) in documents() {
        let path = root().join(&document);
        let folder = path.parent().expect("it is a file");
        let targets = linked_files(&text).filter(|target| !folder.join(target).exists());
        missing.extend(targets.map(|target| format!("{} links to {target}", document.display())));
    }
    assert!(missing.is_empty(), "these do not exist:\n{}", missing.join("\n"));
}

#[test]
fn named_sources_exist() {
    let mut missing = Vec::new();
    let exists = |word: &str| ["", "src", "shaders"].iter().any(|folder| root().join(folder).join(word).exists());
    for (document, text) in documents() {
        let words = named_sources(&text).filter(|word| !exists(word));
        missing.extend(words.map(|word| format!("{} names {word}", document.display())));
    }
    assert!(missing.is_empty(), "these are neither there nor in src or shaders:\n{}", missing.join("\n"));
}

#[test]
fn the_book_has_all_of_its_pages() {
    let source = root().join("docs/src");
    let summary = std::fs::read_to_string(source.join("SUMMARY.md")).expect("the book has a summary");
    let listed: BTreeSet<PathBuf> = linked_files(&summary).map(|page| source.join(page)).collect();
    let written = files_below(&source, "md").into_iter().filter(|page| !page.ends_with("SUMMARY.md")).collect();
    assert_eq!(listed, written);
}

#[test]
fn the_book_links_only_to_what_is_in_it() {
    for (document, text) in documents().iter().filter(|(document, _)| document.starts_with("docs/src")) {
        for target in linked_files(text) {
            let is_inside = !target.contains('/') || target.starts_with("../../assets/pictures/");
            assert!(is_inside, "{} links to {target}, which the built book cannot reach", document.display());
        }
    }
}

#[test]
fn files_are_found_in_the_text() {
    let text = "See [shadows](shadows.md#maps), ![](a/b.png), [home](https://example.org) and `base/ids.rs` or `scene/gltf/` \
                with `--size 3`, `ids.rs` and `a.rs b`.";
    assert_eq!(linked_files(text).collect::<Vec<_>>(), ["shadows.md", "a/b.png"]);
    assert_eq!(named_sources(text).collect::<Vec<_>>(), ["base/ids.rs", "scene/gltf/"]);
}

//! Every shader of the program, found by the `shader!` declarations in the sources, is valid WGSL; every WGSL file is
//! used.

use std::collections::BTreeSet;
use std::path::Path;

use crate::support::sources::files_below;

/// Returns name and files of each `shader!("name", "file", ...)` in a source text.
fn declarations(text: &str) -> Vec<(String, Vec<String>)> {
    let mut found = Vec::new();
    for after in text.split("shader!(").skip(1) {
        let arguments = after.split(')').next().unwrap_or("");
        let mut strings = arguments.split('"').skip(1).step_by(2).map(str::to_owned);
        if let Some(name) = strings.next() {
            found.push((name, strings.collect()));
        }
    }
    found
}

fn all_declarations() -> Vec<(String, Vec<String>)> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let texts = files_below(&src, "rs").into_iter().map(|path| std::fs::read_to_string(path).expect("it is text"));
    texts.flat_map(|text| declarations(&text)).filter(|(_, files)| !files.is_empty()).collect()
}

/// Parses and validates WGSL.
fn validate(source: &str) -> Result<(), String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all())
        .validate(&module)
        .map_err(|error| error.emit_to_string(source))?;
    Ok(())
}

#[test]
fn every_shader_is_valid() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let declarations = all_declarations();
    assert!(declarations.len() > 20, "only {} declarations were found", declarations.len());
    for (name, files) in declarations {
        let read = |file: &String| {
            std::fs::read_to_string(folder.join(file)).unwrap_or_else(|error| panic!("{name}: {file}: {error}"))
        };
        let source = files.iter().map(read).collect::<Vec<_>>().join("\n");
        if let Err(message) = validate(&source) {
            panic!("{name}: {message}");
        }
    }
}

#[test]
fn every_wgsl_file_is_part_of_a_shader() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let used: BTreeSet<String> = all_declarations().into_iter().flat_map(|(_, files)| files).collect();
    for path in files_below(&folder, "wgsl") {
        let file = path.strip_prefix(&folder).expect("it lies there").to_string_lossy().replace('\\', "/");
        assert!(used.contains(&file), "shaders/{file} is in no shader");
    }
}

#[test]
fn declarations_are_read_from_text() {
    let text = "const A: Shader = shader!(\n    \"a b\",\n    \"shared/frame.wgsl\",\n    \"a.wgsl\"\n);";
    let files = vec!["shared/frame.wgsl".to_owned(), "a.wgsl".to_owned()];
    assert_eq!(declarations(text), [("a b".to_owned(), files)]);
}

//! `hemicube render` as a user runs it, with ambient light, which needs no bake.

use std::path::Path;
use std::process::{Command, Output};

use crate::support::device::gpu;

/// Renders the built-in Cornell box in 64 x 64 pixels to `file` in `folder`.
fn render(folder: &Path, file: &str, options: &[&str]) -> Output {
    render_sized(folder, "64x64", file, options)
}

fn render_sized(folder: &Path, size: &str, file: &str, options: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hemicube"))
        .args(["render", "builtin:cornell", "--lighting", "ambient", "--size", size, "-o", file])
        .args(options)
        .current_dir(folder)
        .output()
        .expect("the program runs")
}

/// Asserts that the program fails with a message that contains these words.
#[track_caller]
fn assert_fails(output: &Output, words: &[&str]) {
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && words.iter().all(|word| message.contains(word)), "{message}");
}

#[test]
fn a_picture_agrees_with_itself_and_not_with_another() {
    if gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    for reference in ["a.png", "a.exr"] {
        let written = render(folder.path(), reference, &[]);
        assert!(written.status.success(), "{written:?}");
        let same = render(folder.path(), "b.png", &["--reference", reference, "--threshold", "0.001"]);
        assert!(same.status.success(), "{same:?}");
    }
    let brighter = render(folder.path(), "b.png", &["--exposure", "3", "--reference", "a.png"]);
    assert_fails(&brighter, &["differs", "relative error", "b.png"]);
    // Radiance does not depend on exposure.
    let brighter = render(folder.path(), "b.png", &["--exposure", "3", "--reference", "a.exr"]);
    assert!(brighter.status.success(), "{brighter:?}");
    let larger = render_sized(folder.path(), "80x64", "b.png", &["--reference", "a.png"]);
    assert_fails(&larger, &["80x64", "64x64"]);
}

#[test]
fn errors_name_the_option_at_fault() {
    if gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    assert_fails(&render(folder.path(), "a.gif", &[]), &["a.gif", ".png"]);
    assert_fails(&render(folder.path(), "a.png", &["--camera", "attic"]), &["attic"]);
    assert_fails(&render_sized(folder.path(), "99999x10", "a.png", &[]), &["99999x10"]);
    assert_fails(&render(folder.path(), "a.png", &["--reference", "missing.png"]), &["missing.png"]);
    assert_fails(&render(folder.path(), "no/such/a.png", &[]), &["no/such/a.png"]);
    assert_eq!(std::fs::read_dir(folder.path()).expect("listed").count(), 0, "nothing was written");
}

#[test]
fn a_quiet_command_without_a_desktop_prints_nothing() {
    if gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let output = Command::new(env!("CARGO_BIN_EXE_hemicube"))
        .args(["render", "builtin:cornell", "--lighting", "ambient", "--size", "8x8", "-o", "a.png", "--quiet"])
        .current_dir(folder.path())
        .env_remove("XDG_RUNTIME_DIR")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .expect("the program runs");
    let printed = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    assert!(output.status.success() && printed.iter().all(|text| text.is_empty()), "{printed:?}");
}

#[test]
fn traced_pictures_need_no_gpu_and_are_the_same_each_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let bytes = |file: &str| {
        let written = render(folder.path(), file, &["--renderer", "two-pass", "--spp", "4"]);
        assert!(written.status.success(), "{written:?}");
        assert!(String::from_utf8_lossy(&written.stderr).contains("standard error"), "{written:?}");
        std::fs::read(folder.path().join(file)).expect("written")
    };
    assert!(bytes("a.exr") == bytes("b.exr"));
    assert_fails(&render(folder.path(), "c.png", &["--renderer", "path"]), &["path", "ambient"]);
    assert!(!folder.path().join("c.png").exists());
}

//! Each rule catches an injected breach and passes what is allowed.

use super::imports::{Imports, Sources};
use super::rules::{self, Rooms};

fn sources(files: &[(&str, &str)]) -> Sources {
    let root = [("lib.rs", "")];
    root.iter().chain(files).map(|&(file, text)| (file.to_owned(), text.to_owned())).collect()
}

fn imports(files: &[(&str, &str)]) -> Imports {
    Imports::of(&sources(files))
}

fn circles(files: &[(&str, &str)]) -> Vec<String> {
    rules::file_circles(&imports(files))
}

fn upward(files: &[(&str, &str)]) -> usize {
    rules::upward_imports(&imports(files)).len()
}

#[test]
fn an_upward_import_is_caught() {
    let above = ("radiosity/mod.rs", "pub struct Solution;");
    assert_eq!(upward(&[("scene/mod.rs", "use crate::radiosity::Solution;"), above]), 1, "by a use");
    assert_eq!(upward(&[("scene/mod.rs", "fn f() -> crate::radiosity::Solution {}"), above]), 1, "by a path in code");
    assert_eq!(upward(&[("scene/mod.rs", "pub use crate::radiosity::Solution;"), above]), 1, "by passing it on");
    assert_eq!(upward(&[("scene/light.rs", "use super::super::radiosity::Solution;"), ("scene/mod.rs", ""), above]), 1);
    let root = ("lib.rs", "pub mod radiosity; pub mod scene; pub use radiosity::Solution;");
    assert_eq!(upward(&[("scene/mod.rs", "use crate::Solution;"), root, above]), 1, "by way of the crate root");
    let group = "use crate::{base::{ids, colour}, radiosity::{self, Solution}};";
    assert_eq!(
        upward(&[("scene/mod.rs", group), ("base/mod.rs", "pub mod ids; pub mod colour;"), above]),
        1,
        "in a group"
    );
}

#[test]
fn a_sideways_import_is_caught() {
    let row = ("form_factor/mod.rs", "pub struct Row;");
    assert_eq!(upward(&[("render/frame.rs", "use crate::form_factor::Row;"), row]), 1);
}

#[test]
fn geometry_that_uses_the_device_is_caught() {
    let gpu = ("gpu/mod.rs", "pub struct Gpu;");
    let path = "fn f() { let gpu = crate::gpu::Gpu; }";
    for file in ["patch/mod.rs", "trace/mod.rs", "baked/mod.rs"] {
        assert_eq!(upward(&[(file, path), gpu]), 1, "{file}");
    }
    assert_eq!(upward(&[("render/mod.rs", path), gpu]), 0);
}

#[test]
fn a_visibility_is_no_import() {
    let root = ("lib.rs", "pub mod bake;\npub use bake::bake;");
    let child = ("bake/clock.rs", "pub(in crate::bake) struct Clock;");
    assert_eq!(upward(&[root, ("bake/mod.rs", "mod clock;\npub fn bake() {}"), child]), 0);
}

#[test]
fn a_downward_import_passes() {
    let below = [("scene/mod.rs", "pub struct Scene;"), ("base/ids.rs", "pub struct Id;"), ("base/mod.rs", "")];
    let with = |text| upward(&[&below[..], &[("radiosity/mod.rs", text)]].concat());
    assert_eq!(with("use crate::{base::ids::Id, scene::Scene};"), 0);
    assert_eq!(with("//! Becomes a [`crate::viewer::Window`].\nfn f() { \"crate::viewer::Window\"; }"), 0, "in words");
    assert_eq!(with("#[cfg(test)] mod tests { use crate::viewer::Window; }"), 0, "in tests");
}

#[test]
fn a_folder_on_no_floor_is_caught() {
    assert_eq!(
        rules::misplaced_files(&sources(&[("attic/mod.rs", ""), ("main.rs", ""), ("scene/mod.rs", "")])).len(),
        1
    );
}

#[test]
fn a_circle_by_imports_is_caught() {
    let found = circles(&[
        ("scene/mod.rs", "mod a; mod b; mod c;"),
        ("scene/a.rs", "use super::b::{self, B};\npub struct A;"),
        ("scene/b.rs", "use crate::scene::c::C;\npub struct B;"),
        ("scene/c.rs", "pub struct C(super::a::A);"),
    ]);
    assert_eq!(found, ["circle: scene/a.rs -[B]-> scene/b.rs -[C]-> scene/c.rs -[A]-> scene/a.rs"]);
}

#[test]
fn a_circle_by_re_exports_is_caught() {
    let found = circles(&[
        ("scene/mod.rs", "mod a; mod b; pub use a::A; pub(crate) use b::{B as Other, *};"),
        ("scene/a.rs", "use super::Other;\npub struct A;"),
        ("scene/b.rs", "pub struct B;\nfn f() { super::A::new() }"),
    ]);
    assert_eq!(found, ["circle: scene/a.rs -[B]-> scene/b.rs -[A]-> scene/a.rs"]);
}

#[test]
fn a_circle_between_a_folder_and_its_child_is_caught() {
    let child = ("scene/a.rs", "use super::Base;\npub struct A(Base);\npub fn f() {}");
    let with = |text| circles(&[("scene/mod.rs", text), child]).len();
    assert_eq!(with("mod a;\npub struct Base;\nfn g() { a::f() }"), 1, "by a path into the child");
    assert_eq!(with("mod a;\npub use a::A;\npub struct Base { a: A }"), 1, "by a name that it passes on, too");
    assert_eq!(with("mod a;\nuse a::f;\npub struct Base;"), 1, "by a use");
    assert_eq!(with("mod a;\npub use a::A;\npub struct Base;"), 0, "it only passes on");
    assert_eq!(
        with("mod a;\npub use a::A;\npub struct Base;\n#[cfg(test)]\nmod tests { fn f(a: super::A) {} }"),
        0,
        "in tests"
    );
}

#[test]
fn a_circle_by_methods_is_caught() {
    let methods =
        ("scene/b.rs", "use super::A;\nimpl A { pub fn turn(&self) {} }\nimpl Clone for A { fn copy(&self) {} }");
    let with = |text| circles(&[("scene/mod.rs", "mod a; mod b; pub use a::A;"), ("scene/a.rs", text), methods]);
    let expected = ["circle: scene/a.rs -[A::turn]-> scene/b.rs -[A]-> scene/a.rs"];
    assert_eq!(with("pub struct A;\nimpl A { fn f(&self) { self.turn() } }"), expected);
    assert_eq!(with("pub struct A;\nfn f(a: &A) { A::turn(a) }"), expected);
    assert!(with("pub struct A;\nimpl A { fn f(&self) { self.copy().turn } }").is_empty(), "a trait, and a field");
    assert!(with("pub struct A;\nfn turn() { turn() }").is_empty(), "a function of the same name");
}

#[test]
fn files_without_a_circle_pass() {
    let found = circles(&[
        ("scene/mod.rs", "pub mod a; pub mod b; mod c; pub use {a::A, b::b};\n#[cfg(test)] mod samples;"),
        ("scene/a.rs", "pub struct A;\nfn f(b: f32) { let c = self.b.c; c(b) } // super::b::b\n"),
        ("scene/b.rs", "use super::{A, c};\npub fn b() { c::deep::<A>(\"crate::scene::b\") }"),
        (
            "scene/c.rs",
            "use crate::scene::a;\npub fn deep<T>() { a::A; }\n#[cfg(test)] mod tests { use super::super::b; fn f() { b::b() } }",
        ),
        ("scene/samples.rs", "use super::A;"),
        ("scene/a/tests.rs", "use crate::scene::b::b; fn f() { b() }"),
    ]);
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn an_upward_import_between_rooms_is_caught() {
    const ROOMS: &[Rooms<'_>] = &[("render/shadow", &[&["shared"], &["light"], &["map", "volume"]])];
    let house = [
        ("render/mod.rs", ""),
        ("render/shadow/mod.rs", "pub use map::Map;"),
        ("render/shadow/shared/mod.rs", ""),
        ("render/shadow/light/mod.rs", "pub struct Light;"),
        ("render/shadow/map/mod.rs", "pub struct Map;"),
    ];
    let with =
        |file, text| rules::upward_imports_in_rooms(&imports(&[&house[..], &[(file, text)]].concat()), ROOMS).len();
    assert_eq!(with("render/shadow/shared/a.rs", "use crate::render::shadow::map::Map;"), 1, "shared uses a technique");
    assert_eq!(with("render/shadow/shared/a.rs", "use super::super::Map;"), 1, "through a name passed on");
    assert_eq!(
        with("render/shadow/volume/a.rs", "use crate::render::shadow::map::Map;"),
        1,
        "techniques use each other"
    );
    assert_eq!(with("render/shadow/map/a.rs", "use crate::render::shadow::light::Light;"), 0);
    assert_eq!(
        with("render/shadow/recipe.rs", "use super::{Map, light::Light};"),
        0,
        "a file that is not listed is free"
    );
    assert_eq!(with("render/frame.rs", "use crate::render::shadow::map::Map;"), 0, "outside of the rooms");
}

#[test]
fn wgpu_out_of_place_is_caught() {
    let found = |file, text| rules::misplaced_wgpu(&sources(&[(file, text)])).len();
    assert_eq!(found("form_factor/analytic.rs", "fn f(device: &wgpu::Device) {}"), 1);
    assert_eq!(found("form_factor/hemicube/atlas.rs", "fn f(device: &wgpu::Device) {}"), 0);
    assert_eq!(found("scene/mod.rs", "//! Lies in a [`wgpu::Buffer`] later."), 0);
}

#[test]
fn a_crowded_folder_is_caught() {
    let files = |folder: &str, count: usize| (0..count).map(|at| format!("{folder}/{at}.rs")).collect::<Vec<_>>();
    let crowds = |files: &[String]| rules::crowded(files.iter().map(String::as_str));
    assert_eq!(crowds(&files("src/scene", 16)), ["src/scene holds 16 code files beside each other"]);
    assert!(
        crowds(&[files("src/scene", 15), files("src/scene/gltf", 15), vec!["src/scene/a.png".to_owned()]].concat())
            .is_empty()
    );
}

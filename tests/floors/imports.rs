//! Dependencies between the files of the crate: each path is followed through re-exports to the file that defines its
//! item.

use std::collections::{BTreeMap, BTreeSet};

use super::names::{Names, Path};

/// Text of each file by its path below src/.
pub type Sources = BTreeMap<String, String>;

/// Names through which one file uses another.
pub type Ties = BTreeSet<String>;

/// The files that each file uses, and through which names.
pub type Uses = BTreeMap<String, BTreeMap<String, Ties>>;

/// Dependencies between the files of a crate.
pub struct Imports {
    files: BTreeMap<String, Names>,
    by_module: BTreeMap<Path, String>,
    /// Items that a file names in its code or imports for it.
    pub used: Uses,
    /// Items that a file only passes on with `pub use`.
    pub passed_on: Uses,
}

/// Target of a path.
enum Target {
    /// An item of a file.
    Item { file: String, name: String },
    /// A module.
    Module(Path),
}

impl Imports {
    pub fn of(sources: &Sources) -> Self {
        let mut files: BTreeMap<String, Names> =
            sources.iter().map(|(file, text)| (file.clone(), Names::of(text))).collect();
        remove_tests(&mut files);
        let by_module = files.keys().map(|file| (module_of(file), file.clone())).collect();
        let mut imports = Self { files, by_module, used: Uses::new(), passed_on: Uses::new() };
        (imports.used, imports.passed_on) = imports.follow_all();
        imports
    }

    fn follow_all(&self) -> (Uses, Uses) {
        let (mut used, mut passed_on) = (Uses::new(), Uses::new());
        for (file, names) in &self.files {
            let module = module_of(file);
            for import in &names.imports {
                let uses = if import.public { &mut passed_on } else { &mut used };
                match self.resolve(&module, &import.path, 0) {
                    Some(Target::Item { file: target, name }) => tie(uses, file, &target, &name),
                    Some(Target::Module(target)) if import.name == "*" => {
                        tie(uses, file, &self.by_module[&target], "*")
                    }
                    _ => {}
                }
            }
            for mention in &names.mentions {
                if let Some(Target::Item { file: target, name }) = self.resolve(&module, mention, 0) {
                    tie(&mut used, file, &target, &name);
                }
            }
            self.follow_methods(file, &mut used);
        }
        (used, passed_on)
    }

    /// Adds dependencies by methods. If `file` implements methods of a type that another file defines, and that file
    /// calls them, it uses `file`.
    fn follow_methods(&self, file: &str, used: &mut Uses) {
        // Types of the standard library have methods of these names too, so a call says nothing about the type.
        const COMMON: [&str; 10] = ["clear", "get", "insert", "is_empty", "iter", "len", "map", "new", "push", "take"];
        for (name, methods) in &self.files[file].methods {
            let Some(Target::Item { file: owner, .. }) = self.resolve(&module_of(file), std::slice::from_ref(name), 0)
            else {
                continue;
            };
            let calls = &self.files[&owner];
            let own = calls.methods.get(name);
            let is_called = |method: &&String| calls.called.contains(*method) && !COMMON.contains(&method.as_str());
            let is_own = |method: &&String| own.is_some_and(|own| own.contains(*method));
            for method in methods.iter().filter(is_called).filter(|method| !is_own(method)) {
                tie(used, &owner, file, &format!("{name}::{method}"));
            }
        }
    }

    /// Resolves `path` in `module`; `None` if it leads out of the crate or to a local name.
    fn resolve(&self, module: &Path, path: &[String], depth: usize) -> Option<Target> {
        const DEEPEST: usize = 16; // A name that imports itself, as in `use image;`, would be followed forever.
        let (first, rest) = path.split_first()?;
        if depth > DEEPEST {
            return None;
        }
        match first.as_str() {
            "crate" | "hemicube" => return self.descend(Vec::new(), rest, depth),
            "self" => return self.descend(module.clone(), rest, depth),
            "super" => {
                let parent = module[..module.len().checked_sub(1)?].to_vec();
                return if rest.first().is_some_and(|next| next == "super") {
                    self.resolve(&parent, rest, depth)
                } else {
                    self.descend(parent, rest, depth)
                };
            }
            _ => {}
        }
        let names = &self.files[self.by_module.get(module)?];
        let is_known =
            names.has(first) || self.child(module, first).is_some() || self.glob_with(module, first, depth).is_some();
        if is_known { self.descend(module.clone(), path, depth) } else { None }
    }

    /// Resolves `rest` downward from `module`.
    fn descend(&self, module: Path, rest: &[String], depth: usize) -> Option<Target> {
        let file = self.by_module.get(&module)?;
        let Some((next, after)) = rest.split_first() else {
            return Some(Target::Module(module));
        };
        let names = &self.files[file];
        let item = |file: &String| Some(Target::Item { file: file.clone(), name: next.clone() });
        if let Some(child) = self.child(&module, next)
            && (!after.is_empty() || self.is_module_only(&module, next))
        {
            return self.descend(child, after, depth);
        }
        if names.defined.contains(next) {
            return item(file);
        }
        if let Some(import) = names.import(next) {
            let path: Path = import.path.iter().chain(after).cloned().collect();
            return self.resolve(&module, &path, depth + 1);
        }
        if let Some(beyond) = self.glob_with(&module, next, depth) {
            return self.descend(beyond, rest, depth + 1);
        }
        // The name is a macro of the crate root, or an item that a macro generates.
        let exports = |names: &Names| module.is_empty() && names.exported_macros.contains(next);
        item(self.files.iter().find(|(_, names)| exports(names)).map_or(file, |(file, _)| file))
    }

    fn child(&self, module: &Path, name: &str) -> Option<Path> {
        let child: Path = module.iter().cloned().chain([name.to_owned()]).collect();
        self.by_module.contains_key(&child).then_some(child)
    }

    /// Returns true if no item of `module` has the same name as its module `name`. A function may be named like its
    /// file.
    fn is_module_only(&self, module: &Path, name: &str) -> bool {
        self.files[&self.by_module[module]].import(name).is_none()
    }

    /// Returns the module with `name` among those whose names `module` imports with `*`.
    fn glob_with(&self, module: &Path, name: &str, depth: usize) -> Option<Path> {
        let names = &self.files[self.by_module.get(module)?];
        names.globs().find_map(|glob| match self.resolve(module, &glob.path, depth + 1) {
            Some(Target::Module(target)) if target != *module => {
                self.files[&self.by_module[&target]].has(name).then_some(target)
            }
            _ => None,
        })
    }
}

fn tie(uses: &mut Uses, file: &str, target: &str, name: &str) {
    if file != target {
        uses.entry(file.to_owned()).or_default().entry(target.to_owned()).or_default().insert(name.to_owned());
    }
}

/// Returns the path of the module that `file` is.
fn module_of(file: &str) -> Path {
    let stem = file.trim_end_matches(".rs");
    let stem = stem.strip_suffix("mod").filter(|rest| rest.ends_with('/')).unwrap_or(stem);
    let is_root = stem == "lib";
    stem.split('/').filter(|part| !part.is_empty() && !is_root).map(str::to_owned).collect()
}

/// Removes modules that exist in tests only, and all modules below them.
fn remove_tests(files: &mut BTreeMap<String, Names>) {
    let tests: Vec<Path> = files
        .iter()
        .flat_map(|(file, names)| {
            let module = module_of(file);
            names.test_modules.iter().map(move |name| module.iter().cloned().chain([name.clone()]).collect())
        })
        .collect();
    let is_test = |module: &Path| {
        module.iter().any(|part| part == "tests") || tests.iter().any(|test: &Path| module.starts_with(test))
    };
    files.retain(|file, _| !is_test(&module_of(file)));
}

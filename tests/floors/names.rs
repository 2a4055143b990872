//! The names that one file defines, imports and uses in its code.

use std::collections::{BTreeMap, BTreeSet};

use super::tokens::{Token, text_at, tokens, without_tests};

/// The segments of a path such as `crate::base::ids`.
pub type Path = Vec<String>;

/// One name of a `use`.
#[derive(Clone, Debug)]
pub struct Import {
    /// Name of the import in the file; `*` if it is a glob.
    pub name: String,
    pub path: Path,
    /// True for `pub use` in any form, which re-exports the name.
    pub public: bool,
}

/// The names of one file without its tests.
#[derive(Debug, Default)]
pub struct Names {
    /// Items outside of any block.
    pub defined: BTreeSet<String>,
    /// Macros that the crate root exports.
    pub exported_macros: BTreeSet<String>,
    pub imports: Vec<Import>,
    /// Paths in code outside of `use`.
    pub mentions: Vec<Path>,
    /// Names of the methods of each type in `impl Type` blocks, without those of traits.
    pub methods: BTreeMap<String, BTreeSet<String>>,
    /// Methods and associated functions that the code calls, of whatever type.
    pub called: BTreeSet<String>,
    /// Modules that exist in tests only.
    pub test_modules: Vec<String>,
}

/// Position of a word in the structure of a file.
#[derive(Clone, Copy)]
struct Scope {
    /// Number of blocks around it.
    depth: i32,
    /// Number of inline modules around it.
    inline: usize,
}

impl Scope {
    /// Returns the path as it would be written outside of the inline modules.
    fn seen_from_file(self, mut path: Path) -> Path {
        let leads_out = path.iter().take(self.inline).take_while(|segment| *segment == "super").count();
        if leads_out > 0 {
            path.splice(..leads_out, ["self".to_owned()]);
        }
        path
    }
}

impl Names {
    pub fn of(text: &str) -> Self {
        let (tokens, test_modules) = without_tests(&tokens(text));
        let mut names = Self { test_modules, ..Self::default() };
        let (mut at, mut depth, mut inline, mut type_of_impl) = (0, 0, Vec::new(), None);
        while at < tokens.len() {
            match tokens[at].text.as_str() {
                "{" => depth += 1,
                "impl" if depth == 0 => type_of_impl = inherent_type(&tokens[at + 1..]),
                "}" => {
                    depth -= 1;
                    inline.retain(|&outer| outer < depth);
                }
                "mod" if text_at(&tokens, at + 2) == "{" => inline.push(depth),
                _ => {}
            }
            if let Some(name) = type_of_impl.as_ref().filter(|_| depth == 1 && tokens[at].text == "fn") {
                names.methods.entry(name.clone()).or_default().insert(text_at(&tokens, at + 1).to_owned());
            }
            let scope = Scope { depth, inline: inline.len() };
            at = if tokens[at].is_word() { names.read_word(&tokens, at, scope) } else { at + 1 };
        }
        names
    }

    /// Returns true if the file defines or imports `name`.
    pub fn has(&self, name: &str) -> bool {
        self.defined.contains(name) || self.import(name).is_some()
    }

    pub fn import(&self, name: &str) -> Option<&Import> {
        self.imports.iter().find(|import| import.name == name)
    }

    pub fn globs(&self) -> impl Iterator<Item = &Import> {
        self.imports.iter().filter(|import| import.name == "*")
    }

    /// Reads the word at `at` with the tokens that belong to it. Returns the index after them.
    fn read_word(&mut self, tokens: &[Token], at: usize, scope: Scope) -> usize {
        let before = if at == 0 { "" } else { text_at(tokens, at - 1) };
        match tokens[at].text.as_str() {
            "use" if text_at(tokens, at + 1) != "<" => self.read_use(tokens, at, matches!(before, "pub" | ")"), scope),
            "macro_rules" => {
                let name = text_at(tokens, at + 2).to_owned();
                let attribute = &tokens[at.saturating_sub(4)..at];
                if attribute.iter().any(|token| token.text == "macro_export") {
                    self.exported_macros.insert(name.clone());
                }
                self.defined.insert(name);
                at + 3
            }
            "fn" | "struct" | "enum" | "trait" | "type" | "const" | "static" | "union" | "mod" => {
                let name = at + 1 + usize::from(text_at(tokens, at + 1) == "mut");
                let is_name = tokens.get(name).is_some_and(|token| token.is_word() && token.text != "fn");
                if is_name && scope.depth == 0 {
                    self.defined.insert(text_at(tokens, name).to_owned());
                }
                if is_name { name + 1 } else { at + 1 }
            }
            _ => self.read_path(tokens, at, before, scope),
        }
    }

    fn read_path(&mut self, tokens: &[Token], at: usize, before: &str, scope: Scope) -> usize {
        let mut path = vec![tokens[at].text.clone()];
        let mut end = at + 1;
        while text_at(tokens, end) == "::" && tokens.get(end + 1).is_some_and(Token::is_word) {
            path.push(tokens[end + 1].text.clone());
            end += 2;
        }
        // A lone lower-case word is a local variable or a field unless it is called.
        let names_an_item =
            path.len() > 1 || path[0].starts_with(char::is_uppercase) || matches!(text_at(tokens, end), "(" | "!");
        let is_call = matches!(text_at(tokens, end), "(" | "::");
        if path.len() > 1 || before == "." && is_call {
            self.called.extend(path.last().cloned());
        }
        // `pub(in path)` limits the visibility of an item and is no use of `path`.
        let is_visibility =
            before == "in" && at > 2 && text_at(tokens, at - 2) == "(" && text_at(tokens, at - 3) == "pub";
        if names_an_item && !is_visibility && !matches!(before, "." | "::") {
            self.mentions.push(scope.seen_from_file(path));
        }
        end
    }

    fn read_use(&mut self, tokens: &[Token], keyword: usize, public: bool, scope: Scope) -> usize {
        let end = (keyword..tokens.len()).find(|&at| text_at(tokens, at) == ";").unwrap_or(tokens.len());
        let mut leaves = Vec::new();
        use_leaves(&tokens[keyword + 1..end], &mut Vec::new(), &mut leaves);
        self.imports.extend(leaves.into_iter().map(|(name, path)| Import {
            name,
            path: scope.seen_from_file(path),
            public,
        }));
        end
    }
}

/// Returns the type of an `impl Type {` whose tokens follow the keyword; `None` if a trait is implemented.
fn inherent_type(tokens: &[Token]) -> Option<String> {
    let (mut depth, mut name) = (0, None);
    for token in tokens {
        match token.text.as_str() {
            "<" => depth += 1,
            ">" => depth -= 1,
            "for" if depth == 0 => return None,
            "{" | "where" => break,
            _ if depth == 0 && token.is_word() => name = Some(token.text.clone()),
            _ => {}
        }
    }
    name
}

/// Appends each (name, path) of a tree such as `a::{b, c::{self, d as e}}` below `prefix`.
fn use_leaves(tree: &[Token], prefix: &mut Path, leaves: &mut Vec<(String, Path)>) {
    for branch in branches(tree) {
        let length = prefix.len();
        let mut at = 0;
        while at < branch.len() && !matches!(text_at(branch, at), "{" | "as") {
            if !matches!(text_at(branch, at), "::" | "self" | "*")
                || (text_at(branch, at) == "self" && prefix.is_empty())
            {
                prefix.push(branch[at].text.clone());
            }
            at += 1;
        }
        match text_at(branch, at) {
            "{" => use_leaves(&branch[at + 1..branch.len() - 1], prefix, leaves),
            "as" => leaves.push((text_at(branch, at + 1).to_owned(), prefix.clone())),
            _ if branch.last().is_some_and(|last| last.text == "*") => leaves.push(("*".to_owned(), prefix.clone())),
            _ => leaves.push((prefix.last().cloned().unwrap_or_default(), prefix.clone())),
        }
        prefix.truncate(length);
    }
}

/// Splits at the commas of the outer level.
fn branches(tree: &[Token]) -> Vec<&[Token]> {
    let (mut parts, mut start, mut depth) = (Vec::new(), 0, 0);
    for (at, token) in tree.iter().enumerate() {
        match token.text.as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            "," if depth == 0 => {
                parts.push(&tree[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&tree[start..]);
    parts.retain(|part| !part.is_empty());
    parts
}

//! Modules of a crate use one another in one direction.
//!
//! Among the modules that share a parent, each with all that stands below it, no one uses another
//! that uses the first, directly or by way of others. A module and what stands below it are one
//! thing and may use each other. A name that a module imports or re-exports counts as used where it
//! is defined. Both `use` declarations and paths within code count.

use super::crates::{all, code};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A module, or an item in one, by the names on its way from the root.
type Names = Vec<String>;

/// Largest number of imports through which one name is followed.
const MAX_IMPORTS: usize = 8;

/// What a `use` declaration brings into its module: a name, or `*`, and the path behind it.
struct Import {
    name: String,
    path: Names,
}

/// Modules of one crate, their imports, and their uses of one another.
struct Uses {
    imports: BTreeMap<Names, Vec<Import>>,
    of: BTreeMap<Names, BTreeSet<Names>>,
}

/// The module of a source.
fn module(source: &Path) -> Names {
    let names = source.with_extension("");
    let names = names.components().map(|name| name.as_os_str().to_string_lossy().into_owned());
    names.filter(|name| !["lib", "main"].contains(&name.as_str())).collect()
}

/// The `use` declarations of a source, and its code without them.
fn split(code: &str) -> (Vec<Import>, String) {
    let is_of_word = |c: char| c.is_alphanumeric() || c == '_';
    let is_of_tree = |c: char| is_of_word(c) || c.is_whitespace() || ":{},*".contains(c);
    let (mut imports, mut rest) = (Vec::new(), String::new());
    for statement in code.split(';') {
        let parts = statement.rfind("use ").map(|at| (&statement[..at], &statement[at + 4..]));
        match parts
            .filter(|(before, tree)| !before.ends_with(is_of_word) && tree.chars().all(is_of_tree))
        {
            Some((before, tree)) => {
                rest.push_str(before);
                expand(&mut Vec::new(), tree, &mut imports);
            }
            None => rest.push_str(statement),
        }
        rest.push(';');
    }
    (imports, rest)
}

/// The imports of a tree such as `a::{self, b as d, c::{e, f}}`.
fn expand(before: &mut Names, tree: &str, found: &mut Vec<Import>) {
    let (names, inner) = match tree.find('{') {
        Some(at) => (&tree[..at], tree[at + 1..].trim_end().strip_suffix('}')),
        None => (tree, None),
    };
    let (names, alias) = match names.split_once(" as ") {
        Some((names, alias)) => (names, Some(alias.trim())),
        None => (names, None),
    };
    let depth = before.len();
    for name in names.split("::").map(str::trim) {
        if !name.is_empty() && (name != "self" || before.is_empty()) {
            before.push(name.to_owned());
        }
    }
    if let Some(inner) = inner {
        let (mut level, mut start) = (0, 0);
        for (at, c) in inner.char_indices().chain([(inner.len(), ',')]) {
            match c {
                '{' => level += 1,
                '}' => level -= 1,
                ',' if level == 0 => {
                    if !inner[start..at].trim().is_empty() {
                        expand(before, inner[start..at].trim(), found);
                    }
                    start = at + 1;
                }
                _ => {}
            }
        }
    } else if let Some(name) = alias.or(before.last().map(String::as_str)) {
        found.push(Import { name: name.to_owned(), path: before.clone() });
    }
    before.truncate(depth);
}

/// The paths of several names that stand in code.
fn paths(code: &str) -> Vec<Names> {
    let words = code.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
    let paths = words.map(|word| word.split("::").map(str::to_owned).collect::<Names>());
    paths.filter(|path| path.len() > 1 && !path[0].is_empty()).collect()
}

impl Uses {
    fn of(sources: &[(Names, String)]) -> Self {
        let (mut imports, mut paths_of) = (BTreeMap::new(), BTreeMap::new());
        for (module, text) in sources {
            let (imported, rest) = split(text);
            let of_use = imported.iter().map(|import| import.path.clone());
            let all: Vec<Names> = of_use.chain(paths(&rest)).collect();
            paths_of.insert(module.clone(), all);
            imports.insert(module.clone(), imported);
        }
        let mut uses = Self { imports, of: BTreeMap::new() };
        for (module, paths) in paths_of.into_iter().filter(|(module, _)| !module.is_empty()) {
            let used = paths.iter().filter_map(|path| uses.module_of(&module, path, MAX_IMPORTS));
            let used: BTreeSet<Names> = used.collect();
            uses.of.insert(module, used);
        }
        uses
    }

    /// The module in which stands what a path in another module leads to; none outside the crate.
    fn module_of(&self, from: &[String], path: &[String], imports: usize) -> Option<Names> {
        let up = path.iter().take_while(|name| *name == "super").count();
        let (mut module, names) = match path.first()?.as_str() {
            "crate" => (Vec::new(), &path[1..]),
            "self" => (from.to_vec(), &path[1..]),
            "super" => (from[..from.len().checked_sub(up)?].to_vec(), &path[up..]),
            name => {
                let is_known = self.is_module(from, name) || self.imported(from, name).is_some();
                (is_known.then(|| from.to_vec())?, path)
            }
        };
        for (at, name) in names.iter().enumerate() {
            if self.is_module(&module, name) {
                module.push(name.clone());
            } else if let Some(import) = self.imported(&module, name) {
                let rest = [&import.path, &names[at + 1..]].concat();
                return self.module_of(&module, &rest, imports.checked_sub(1)?);
            } else {
                break;
            }
        }
        Some(module)
    }

    fn is_module(&self, parent: &[String], name: &str) -> bool {
        let module = [parent, &[name.to_owned()]].concat();
        self.imports.contains_key(&module)
    }

    /// The declaration in a module that brings in a name.
    fn imported(&self, module: &[String], name: &str) -> Option<&Import> {
        self.imports.get(module)?.iter().find(|import| import.name == name)
    }

    /// Modules that import all of another one: whose names they use is not seen.
    fn with_globs(&self) -> Vec<String> {
        let is_of_crate = |module: &Names, import: &Import| {
            import.name == "*" && self.module_of(module, &import.path, MAX_IMPORTS).is_some()
        };
        let with = self
            .imports
            .iter()
            .filter(|(module, imports)| imports.iter().any(|import| is_of_crate(module, import)));
        with.map(|(module, _)| module.join("::")).collect()
    }

    /// Uses among modules that share a parent, each with what stands below it.
    fn among_siblings(&self) -> BTreeMap<Names, BTreeSet<Names>> {
        let mut of: BTreeMap<Names, BTreeSet<Names>> = BTreeMap::new();
        for (user, all) in &self.of {
            for used in all {
                let common = user.iter().zip(used).take_while(|(a, b)| a == b).count();
                if common < user.len() && common < used.len() {
                    let (user, used) = (user[..=common].to_vec(), used[..=common].to_vec());
                    of.entry(user).or_default().insert(used);
                }
            }
        }
        of
    }

    /// The modules that lead back to themselves.
    fn in_circles(&self) -> Vec<String> {
        let of = self.among_siblings();
        let leads_back = |start: &Names| {
            let mut seen = BTreeSet::new();
            let mut open: Vec<&Names> = of[start].iter().collect();
            while let Some(next) = open.pop() {
                if next == start {
                    return true;
                }
                if seen.insert(next) {
                    open.extend(of.get(next).into_iter().flatten());
                }
            }
            false
        };
        of.keys().filter(|start| leads_back(start)).map(|module| module.join("::")).collect()
    }
}

#[test]
fn modules_use_one_another_in_one_direction() {
    let (mut found, mut globs) = (Vec::new(), Vec::new());
    let mut uses = 0;
    for of in all() {
        let sources: Vec<(Names, String)> =
            of.code().into_iter().map(|(path, code)| (module(&path), code)).collect();
        let graph = Uses::of(&sources);
        uses += graph.of.values().map(BTreeSet::len).sum::<usize>();
        assert!(graph.imports.len() > 1, "{} has no modules", of.name);
        found.extend(graph.in_circles().into_iter().map(|name| format!("{}: {name}", of.name)));
        globs.extend(graph.with_globs().into_iter().map(|name| format!("{}: {name}", of.name)));
    }
    assert!(uses > 500, "only {uses} uses were seen");
    assert!(found.is_empty(), "modules in circles:\n{}", found.join("\n"));
    assert!(globs.is_empty(), "modules that import all of another one:\n{}", globs.join("\n"));
}

#[test]
fn a_circle_is_seen() {
    let source = |name: &str, text: &str| (module(Path::new(name)), code(text));
    let lib = source("lib.rs", "pub mod a; pub mod b; pub use b::{deep::Thing, Deeper};");
    let a = source("a.rs", "use crate::{Thing, std::fmt};\npub fn f() {}");
    let b = source("b.rs", "mod deep; mod side; pub use deep::{self, Thing, Thing as Deeper};");
    let deep = source("b/deep.rs", "use std::fmt; /// use crate::a::f;\npub struct Thing;");
    let side = source("b/side.rs", "fn f() -> super::Thing { todo!(\"of no use here\") }");
    let straight = [lib, a, b, deep, side];
    let circles = |place: usize, text: &str| {
        let mut sources = straight.clone();
        sources[place].1.push_str(text);
        Uses::of(&sources).in_circles()
    };
    let none: [&str; 0] = [];
    assert_eq!(circles(0, ""), none);
    assert_eq!(circles(4, "use super::deep; fn g() { deep::Thing }"), none);
    // a path from above, and one through a name of the root
    assert_eq!(circles(3, "use super::super::a::{f, g};"), ["a", "b"]);
    assert_eq!(circles(3, "fn g() { crate::a::f(); }"), ["a", "b"]);
    // the parent re-exports what `side` uses
    assert_eq!(circles(3, "fn g() { super::side::f(); }"), ["b::deep", "b::side"]);
    assert_eq!(circles(3, "use super as up; fn g() { up::side::f(); }"), ["b::deep", "b::side"]);
    let mut sources = straight.clone();
    sources[4].1 = "use super::deep::*;".to_owned();
    assert_eq!(Uses::of(&sources).with_globs(), ["b::side"]);
}

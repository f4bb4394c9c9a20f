//! Modules of a crate use one another in one direction.
//!
//! Among the modules that share a parent, each with all that stands below it, no one uses another
//! that uses the first, directly or by way of others. A module and what stands below it are one
//! thing and may use each other. What a crate's root re-exports counts as used where it is defined.

use super::crates::{all, code};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A module by the names on its way from the root.
type Module = Vec<String>;

/// Uses of modules of one crate by one another.
struct Uses {
    modules: BTreeSet<Module>,
    of: BTreeMap<Module, BTreeSet<Module>>,
}

/// The module of a source.
fn module(source: &Path) -> Module {
    let names = source.with_extension("");
    let names = names.components().map(|name| name.as_os_str().to_string_lossy().into_owned());
    names.filter(|name| !["lib", "main"].contains(&name.as_str())).collect()
}

/// All paths of `use` declarations, with whether they are public.
fn paths(code: &str) -> Vec<(bool, Vec<String>)> {
    let mut found = Vec::new();
    for declaration in code.split(';') {
        let Some(at) = declaration.rfind("use ") else { continue };
        let before = declaration[..at].trim_end();
        let is_public = before.ends_with("pub") || before.ends_with("pub(crate)");
        let is_declaration = is_public || !before.ends_with(|c: char| c.is_alphanumeric());
        if is_declaration {
            let mut all = Vec::new();
            expand(&mut Vec::new(), declaration[at + 4..].trim(), &mut all);
            found.extend(all.into_iter().map(|path| (is_public, path)));
        }
    }
    found
}

/// The paths of a tree such as `a::{b, c::{d, e}}`.
fn expand(before: &mut Vec<String>, tree: &str, found: &mut Vec<Vec<String>>) {
    let (names, inner) = match tree.find('{') {
        Some(at) => (&tree[..at], tree[at + 1..].trim_end().strip_suffix('}')),
        None => (tree.split(" as ").next().unwrap_or_default(), None),
    };
    let depth = before.len();
    let names = names.split("::").map(str::trim).filter(|name| !name.is_empty());
    before.extend(names.map(str::to_owned));
    match inner {
        None => found.push(before.clone()),
        Some(inner) => {
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
        }
    }
    before.truncate(depth);
}

impl Uses {
    fn of(sources: &[(Module, String)]) -> Self {
        let modules: BTreeSet<Module> = sources.iter().map(|(module, _)| module.clone()).collect();
        let root = sources.iter().find(|(module, _)| module.is_empty());
        let root = root.map(|(_, text)| paths(text)).unwrap_or_default();
        let exported: BTreeMap<String, Vec<String>> = root
            .into_iter()
            .filter(|(is_public, path)| *is_public && path.len() > 1)
            .map(|(_, path)| (path[path.len() - 1].clone(), path))
            .collect();
        let mut of: BTreeMap<Module, BTreeSet<Module>> = BTreeMap::new();
        for (module, text) in sources.iter().filter(|(module, _)| !module.is_empty()) {
            for (_, path) in paths(text) {
                let absolute = match path.first().map(String::as_str) {
                    Some("crate") => path[1..].to_vec(),
                    Some("super") => {
                        let up = path.iter().take_while(|name| *name == "super").count();
                        let parent = &module[..module.len().saturating_sub(up)];
                        [parent, &path[up..]].concat()
                    }
                    _ => continue,
                };
                let absolute = match absolute.as_slice() {
                    [one] => exported.get(one).cloned().unwrap_or(absolute),
                    _ => absolute,
                };
                let lengths = (1..=absolute.len()).rev();
                let used = lengths.map(|n| absolute[..n].to_vec()).find(|m| modules.contains(m));
                if let Some(used) = used {
                    of.entry(module.clone()).or_default().insert(used);
                }
            }
        }
        Self { modules, of }
    }

    /// Uses among modules that share a parent, each with what stands below it.
    fn among_siblings(&self) -> BTreeMap<Module, BTreeSet<Module>> {
        let mut of: BTreeMap<Module, BTreeSet<Module>> = BTreeMap::new();
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
        let leads_back = |start: &Module| {
            let mut seen = BTreeSet::new();
            let mut open: Vec<&Module> = of[start].iter().collect();
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
    let mut found = Vec::new();
    let mut uses = 0;
    for of in all() {
        let sources: Vec<(Module, String)> =
            of.code().into_iter().map(|(path, code)| (module(&path), code)).collect();
        let graph = Uses::of(&sources);
        uses += graph.of.values().map(BTreeSet::len).sum::<usize>();
        assert!(graph.modules.len() > 1, "{} has no modules", of.name);
        found.extend(graph.in_circles().into_iter().map(|name| format!("{}: {name}", of.name)));
    }
    assert!(uses > 500, "only {uses} uses were seen");
    assert!(found.is_empty(), "modules in circles:\n{}", found.join("\n"));
}

#[test]
fn a_circle_is_seen() {
    let source = |name: &str, text: &str| (module(Path::new(name)), code(text));
    let lib = source("lib.rs", "pub mod a; pub mod b; pub use b::deep::{Thing, other::Other};");
    let a = source("a.rs", "use crate::{Thing, std::fmt};\npub fn f() {}");
    let deep = source("b/deep.rs", "use std::fmt; /// use crate::a::f;\npub struct Thing;");
    let b = source("b.rs", "mod deep; use crate::b::deep::Thing;");
    let straight = [lib, a, b, deep];
    assert!(Uses::of(&straight).in_circles().is_empty());
    let mut round = straight;
    round[3].1 = "use super::super::a::{f, g}; pub struct Thing;".to_owned();
    assert_eq!(Uses::of(&round).in_circles(), ["a", "b"]);
}

//! The crates of the project as they lie on the disk.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A crate.
pub struct Crate {
    /// Its name without `trackdyn-`.
    pub name: String,
    /// Text of its manifest.
    pub manifest: String,
    /// Its folder.
    pub folder: PathBuf,
}

/// All crates below `crates`, sorted by name.
pub fn all() -> Vec<Crate> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let mut found: Vec<Crate> = [crates.clone(), crates.join("laboratory")]
        .iter()
        .flat_map(|place| fs::read_dir(place).expect("a folder of crates"))
        .filter_map(|entry| {
            let folder = entry.expect("readable").path();
            let manifest = fs::read_to_string(folder.join("Cargo.toml")).ok()?;
            let table: toml::Table = manifest.parse().expect("TOML");
            let name = table["package"]["name"].as_str().expect("a name");
            let name = name.strip_prefix("trackdyn-").unwrap_or(name).to_owned();
            Some(Crate { name, manifest, folder })
        })
        .collect();
    found.sort_by(|a, b| a.name.cmp(&b.name));
    assert!(found.len() > 10, "the crates are not where they were");
    found
}

impl Crate {
    /// Paths below `src` and texts of its sources, sorted.
    pub fn sources(&self) -> Vec<(PathBuf, String)> {
        let is_source = |path: &Path| path.extension().is_some_and(|ending| ending == "rs");
        files_below(&self.folder.join("src"), &is_source)
    }

    /// Paths below `src` and code of the sources that are compiled for more than tests, sorted.
    pub fn code(&self) -> Vec<(PathBuf, String)> {
        let all: BTreeMap<PathBuf, String> = self.sources().into_iter().collect();
        let compiled = all.iter().filter(|(path, _)| !is_of_tests(path, &all));
        compiled.map(|(path, text)| (path.clone(), code(text))).collect()
    }
}

/// A text without comments and without what is compiled for tests only.
pub fn code(text: &str) -> String {
    let is_of_tests =
        |after: &str| after.lines().next().is_some_and(|l| l.ends_with("mod tests {"));
    let mut marks = text.match_indices("#[cfg(test)]\n");
    let tests = marks.find(|(at, mark)| is_of_tests(&text[at + mark.len()..]));
    let end = tests.map_or(text.len(), |(at, _)| at);
    let lines = text[..end].lines().map(|line| line.split("//").next().unwrap_or_default());
    lines.collect::<Vec<_>>().join("\n")
}

/// Whether the module of a source is declared for tests only, or stands below one that is.
fn is_of_tests(path: &Path, sources: &BTreeMap<PathBuf, String>) -> bool {
    let Some((name, folder)) = path.file_stem().zip(path.parent()) else { return false };
    if folder == Path::new("") {
        let roots = ["lib.rs", "main.rs"].iter().filter_map(|root| sources.get(Path::new(root)));
        return roots.into_iter().any(|root| declares_for_tests(root, &name.to_string_lossy()));
    }
    let parent = folder.with_extension("rs");
    let declared = sources.get(&parent);
    declared.is_some_and(|text| declares_for_tests(text, &name.to_string_lossy()))
        || is_of_tests(&parent, sources)
}

fn declares_for_tests(text: &str, module: &str) -> bool {
    text.contains(&format!("#[cfg(test)]\nmod {module};"))
}

/// Paths below a folder and texts of the files in it that are wanted, sorted. What cargo and git
/// keep there is passed over.
pub fn files_below(root: &Path, is_wanted: &dyn Fn(&Path) -> bool) -> Vec<(PathBuf, String)> {
    let mut folders = vec![root.to_owned()];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("readable").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if path.is_dir() {
                if name != "target" && !name.starts_with('.') {
                    folders.push(path);
                }
            } else if is_wanted(&path) {
                let text = fs::read_to_string(&path).expect("a text");
                found.push((path.strip_prefix(root).expect("below").to_owned(), text));
            }
        }
    }
    found.sort();
    found
}

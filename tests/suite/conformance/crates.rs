//! The crates of the project as they lie on the disk.

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
        sources_below(&self.folder.join("src"))
    }
}

/// Paths below a folder and texts of the sources in it, sorted.
pub fn sources_below(root: &Path) -> Vec<(PathBuf, String)> {
    let mut folders = vec![root.to_owned()];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("sources") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let text = fs::read_to_string(&path).expect("a source");
                found.push((path.strip_prefix(root).expect("below").to_owned(), text));
            }
        }
    }
    found.sort();
    found
}

//! Crates that others build on can be packaged: all that they need lies in their folder.

use super::crates::{Crate, all};
use std::fs;
use std::path::Path;

/// Files of the project that lie in a crate too, for it embeds them.
const EMBEDDED_FILES: [(&str, &str); 8] = [
    ("configs/vehicles/auriga-alpha.toml", "crates/trackdyn-model/src/auriga-alpha.toml"),
    ("configs/vehicles/husky-a200.toml", "crates/trackdyn/src/preset/husky-a200.toml"),
    ("configs/vehicles/marmotte.toml", "crates/trackdyn/src/preset/marmotte.toml"),
    ("configs/vehicles/maxxii.toml", "crates/trackdyn/src/preset/maxxii.toml"),
    ("configs/vehicles/warthog.toml", "crates/trackdyn/src/preset/warthog.toml"),
    ("configs/sensors/perfect.toml", "crates/trackdyn-drive/src/sensors/perfect.toml"),
    ("configs/sensors/laboratory.toml", "crates/trackdyn-drive/src/sensors/laboratory.toml"),
    ("configs/sensors/field.toml", "crates/trackdyn-drive/src/sensors/field.toml"),
];

fn read(path: impl AsRef<Path>) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The table `[package]` of a crate that is meant for others; none of one that is not.
fn package(of: &Crate) -> Option<toml::Table> {
    let manifest: toml::Table = of.manifest.parse().expect("TOML");
    let package = manifest["package"].as_table().expect("a table").clone();
    (package.get("publish") != Some(&toml::Value::Boolean(false))).then_some(package)
}

#[test]
fn embedded_files_are_those_of_configs() {
    for (original, copy) in EMBEDDED_FILES {
        assert!(read(original) == read(copy), "{copy} is not {original}: copy it");
    }
}

/// `--vehicle NAME` knows every vehicle of the project.
#[test]
fn vehicles_of_configs_are_known_by_name() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../configs/vehicles");
    let files = fs::read_dir(folder).expect("vehicles").map(|entry| entry.expect("a file").path());
    let mut stems: Vec<String> =
        files.map(|file| file.file_stem().expect("a name").to_string_lossy().into()).collect();
    stems.sort();
    assert_eq!(stems, trackdyn::Vehicle::names().collect::<Vec<_>>());
}

#[test]
fn crates_for_others_say_what_they_are() {
    let licence = read("LICENSE");
    let mut count = 0;
    for of in all() {
        let Some(package) = package(&of) else { continue };
        let keys = ["description", "license", "documentation", "readme", "keywords", "categories"];
        for key in keys {
            assert!(package.contains_key(key), "{}: no {key}", of.name);
        }
        let text = |file| fs::read_to_string(of.folder.join(file)).unwrap_or_default();
        assert!(text("LICENSE") == licence, "{}: LICENSE is not that of the project", of.name);
        let name = package["name"].as_str().expect("a name");
        assert!(text("README.md").starts_with(&format!("# {name}\n")), "{name}: no README.md");
        count += 1;
    }
    assert!(count > 10, "{count} crates for others");
}

#[test]
fn crates_for_others_need_only_one_another() {
    let crates = all();
    let is_for_others = |name: &str| {
        let name = name.strip_prefix("trackdyn-").unwrap_or(name);
        crates.iter().any(|of| of.name == name && package(of).is_some())
    };
    for of in crates.iter().filter(|of| package(of).is_some()) {
        let manifest: toml::Table = of.manifest.parse().expect("TOML");
        for dependency in manifest["dependencies"].as_table().expect("a table").keys() {
            let is_ours = dependency.starts_with("trackdyn");
            assert!(!is_ours || is_for_others(dependency), "{}: {dependency}", of.name);
        }
    }
}

#[test]
fn crates_for_others_embed_nothing_from_outside() {
    for of in all().into_iter().filter(|of| package(of).is_some()) {
        for (path, text) in of.sources() {
            for part in text.split("include_").skip(1) {
                let file = part.split('"').nth(1).unwrap_or_default();
                let up = file.matches("../").count();
                let depth = path.components().count();
                // the name of the file stands for `src`, below the folder of the crate
                assert!(up <= depth, "{}: {} embeds {file}", of.name, path.display());
            }
        }
    }
}

/// The folders that a pattern of the workspace stands for: a folder, or a `*` at the end.
fn members(pattern: &str) -> Vec<String> {
    let Some(start) = pattern.strip_suffix('*') else { return vec![pattern.to_owned()] };
    let (folder, prefix) = start.rsplit_once('/').expect("a folder before the star");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(folder);
    let entries = fs::read_dir(root).expect("a folder").map(|entry| entry.expect("an entry"));
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| name.starts_with(prefix)).map(|name| format!("{folder}/{name}")).collect()
}

/// `cargo run`, as the README has it, asks which one where there are several.
#[test]
fn the_workspace_has_one_program_to_run() {
    let workspace: toml::Table = read("Cargo.toml").parse().expect("TOML");
    let patterns = workspace["workspace"]["default-members"].as_array().expect("a list");
    let mut programs = Vec::new();
    for folder in patterns.iter().flat_map(|of| members(of.as_str().expect("a pattern"))) {
        let manifest: toml::Table = read(format!("{folder}/Cargo.toml")).parse().expect("TOML");
        let named = manifest.get("bin").and_then(toml::Value::as_array).into_iter().flatten();
        let named: Vec<String> =
            named.map(|bin| bin["name"].as_str().expect("a name").to_owned()).collect();
        let main = format!("{folder}/src/main.rs");
        let has_main = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(&main).exists();
        if named.is_empty() && has_main {
            programs.push(main);
        }
        programs.extend(named);
    }
    assert_eq!(programs, ["trackdyn"]);
}

//! docs/adding-an-effect.md, followed word for word on a copy of the sources.

use super::crates;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const PAGE: &str = include_str!("../../../docs/adding-an-effect.md");

/// What the page adds.
#[derive(Debug)]
enum Addition {
    /// A file with this text.
    File(PathBuf, String),
    /// A line at the end of the list of a file.
    Line(PathBuf, String),
}

/// The blocks of Rust of a page, each with the sentence above it, which says where it goes.
fn additions(page: &str) -> Vec<Addition> {
    let mut found = Vec::new();
    let (mut above, mut lines) = ("", page.lines());
    while let Some(line) = lines.next() {
        if line == "```rust" {
            let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
            let path = above.split('`').nth(1).expect("a path in the sentence above a block");
            let (path, text) = (PathBuf::from(path), block.join("\n") + "\n");
            found.push(match above.strip_prefix("One line in the list of ") {
                Some(_) => Addition::Line(path, text),
                None => Addition::File(path, text),
            });
        } else if !line.is_empty() {
            above = line;
        }
    }
    found
}

/// The commands of the page, without what takes their output.
fn commands(page: &str) -> Vec<Vec<&str>> {
    let (_, after) = page.split_once("```sh\n").expect("a block of commands");
    let lines = after.lines().take_while(|line| *line != "```");
    lines.map(|line| line.split_whitespace().take_while(|word| *word != ">").collect()).collect()
}

/// All files below a folder of the project, by their paths from its root.
fn read(root: &Path, below: &Path, files: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(root.join(below)).expect("a folder") {
        let name = below.join(entry.expect("readable").file_name());
        let path = root.join(&name);
        if path.is_dir() {
            read(root, &name, files);
        } else {
            files.insert(name, fs::read(path).expect("a file"));
        }
    }
}

/// Makes a folder hold these files and no others. Files that do not change keep their stamps, so
/// that what was compiled of them is not compiled again.
fn write(folder: &Path, files: &BTreeMap<PathBuf, Vec<u8>>) {
    let mut there = BTreeMap::new();
    fs::create_dir_all(folder).expect("a folder");
    read(folder, Path::new(""), &mut there);
    for name in there.keys().filter(|name| !files.contains_key(*name)) {
        fs::remove_file(folder.join(name)).expect("removed");
    }
    for (name, bytes) in files.iter().filter(|(name, bytes)| there.get(*name) != Some(bytes)) {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, bytes).expect("written");
    }
}

#[test]
fn the_page_adds_an_effect_to_model_second_simulator_and_trial() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = BTreeMap::new();
    for folder in ["crates", "tests", "benches"] {
        read(&root, Path::new(folder), &mut files);
    }
    for name in ["Cargo.toml", "Cargo.lock"] {
        files.insert(PathBuf::from(name), fs::read(root.join(name)).expect("a file"));
    }
    let additions = additions(PAGE);
    assert_eq!(additions.len(), 4, "an effect and a mechanism, a file and a line each");
    for addition in additions {
        match addition {
            Addition::File(path, text) => {
                assert!(files.insert(path, text.into_bytes()).is_none(), "a file of its own");
            }
            Addition::Line(path, line) => {
                let of = files.get_mut(&path).expect("a list");
                let text = String::from_utf8(of.clone()).expect("text");
                let (_, list) = text.split_once("! {\n").expect("a list");
                let end = text.len() - list.len() + list.find("\n}").expect("its end") + 1;
                *of = format!("{}    {line}{}", &text[..end], &text[end..]).into_bytes();
            }
        }
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("adding-an-effect");
    write(&folder, &files);
    let commands = commands(PAGE);
    // The others compile all tests, or the whole program.
    let [tests, _, _, list] = commands.as_slice() else { panic!("{commands:?}") };
    let said = run(&folder, tests);
    for test in ["cards_are_complete", "every_law_has_a_dose", "every_mechanism_has_a_place"] {
        assert!(said.contains(test), "{test} did not run:\n{said}");
    }
    let said = run(&folder, list);
    assert!(said.contains("\n| hull-drag | F = −c v/2"), "{said}");
}

/// What a command of the page prints in the copy.
fn run(folder: &Path, command: &[&str]) -> String {
    // The libraries that the project uses are compiled already, in the same profile.
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("the target folder");
    let is_release = std::env::current_exe().expect("a path").starts_with(target.join("release"));
    let words = command.iter().copied().skip(1);
    let words = words.filter(|word| is_release || *word != "--release");
    // An example runs by itself: cargo runs none of several packages.
    let words: Vec<&str> = words.map(|word| if word == "run" { "build" } else { word }).collect();
    let end = words.iter().position(|word| *word == "--").unwrap_or(words.len());
    // The libraries are those of the project if they have its features. The program asks for all of
    // them (`compiled_once`). It has no library and no example: none of it is compiled.
    let features = ["--package", "trackdyn-cli"];
    // Not optimised, the crates of the copy compile in a fraction of the time, and their few tests
    // take longer.
    let plain = crates::all().into_iter().filter(|of| of.name != "trackdyn").flat_map(|of| {
        let key = format!("profile.release.package.trackdyn-{}.opt-level", of.name);
        ["--config".to_owned(), format!("{key}=0")]
    });
    let said = printed(
        Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
            .args(&words[..end])
            .args(features)
            .args(["--offline", "--target-dir"])
            .arg(target)
            .args(plain)
            .args(&words[end..])
            // Set where tests are timed (`--report-time`); all libraries would be compiled anew by
            // it, and again without it.
            .env_remove("RUSTC_BOOTSTRAP")
            .current_dir(folder),
    );
    match words.iter().position(|word| *word == "--example") {
        Some(at) => {
            let profile = if is_release { "release" } else { "debug" };
            printed(&mut Command::new(target.join(profile).join("examples").join(words[at + 1])))
        }
        None => said,
    }
}

/// What a program prints, which has to succeed.
fn printed(command: &mut Command) -> String {
    let run = command.output().expect("it runs");
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(run.status.success(), "{said}\n{}", String::from_utf8_lossy(&run.stderr));
    said
}

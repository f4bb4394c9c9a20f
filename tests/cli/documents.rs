//! What the program prints of itself, and the documents made from it.

use crate::{Workplace, project_text};

#[test]
fn catalogue_page_is_fresh() {
    let printed = Workplace::new().run("effects --markdown").stdout;
    assert!(
        printed == project_text("docs/effects.md"),
        "docs/effects.md is stale: cargo run --release -- effects --markdown > docs/effects.md"
    );
}

#[test]
fn catalogue_lists_every_effect() {
    let place = Workplace::new();
    let list = place.run("effects").stdout;
    for line in project_text("docs/effects.md").lines() {
        if let Some(id) = line.strip_prefix("## ") {
            assert!(list.contains(id), "{id}");
            let card = place.run(&format!("effects {id}")).stdout;
            assert!(card.contains("law") && card.contains("source"), "{card}");
        }
    }
}

#[test]
fn sessions_of_the_readme_are_fresh() {
    let readme = project_text("README.md");
    let place = Workplace::new();
    for command in ["map --cog -0.015,0.04", "kinematics --speeds 0.3,0.9"] {
        assert!(readme.contains(command), "{command} is not in the README");
        let printed = place.run(command).stdout;
        assert!(
            readme.contains(&printed),
            "the README does not show what {command} prints:\n{printed}"
        );
    }
}

#[test]
fn vehicles_are_valid() {
    let place = Workplace::new();
    for entry in std::fs::read_dir(crate::project_file("configs/vehicles")).expect("vehicles") {
        let path = entry.expect("an entry").path();
        let run = place.run(&format!("map --grid 3 --vehicle {}", path.display()));
        assert_eq!(run.status, 0, "{}", run.stderr);
    }
}

#[test]
fn completions_and_manual_are_printed() {
    let place = Workplace::new();
    let bash = place.run("completions bash");
    assert!(bash.status == 0 && bash.stdout.contains("_trackdyn"));
    let manual = place.run("man");
    assert!(manual.status == 0 && manual.stdout.starts_with(".ie"), "{}", manual.stdout);
    assert!(manual.stdout.contains("\n.TH trackdyn-map 1"), "a page for each command");
    assert_eq!(place.run("--version").stdout, format!("trackdyn {}\n", env!("CARGO_PKG_VERSION")));
}

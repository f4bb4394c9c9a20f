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
fn completions_and_manual_are_printed() {
    let place = Workplace::new();
    let bash = place.run("completions bash");
    assert!(bash.status == 0 && bash.stdout.contains("_trackdyn"));
    let manual = place.run("man");
    assert!(manual.status == 0 && manual.stdout.starts_with(".ie"), "{}", manual.stdout);
    assert_eq!(place.run("--version").stdout, format!("trackdyn {}\n", env!("CARGO_PKG_VERSION")));
}

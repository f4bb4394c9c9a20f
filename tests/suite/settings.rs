//! Settings of the diagnosis: their tree, files that set them, and their page.

use toml::{Table, Value};
use trackdyn_core::document::Document;
use trackdyn_diagnose::settings::{Entry, SettingError, Settings, page};

fn table(text: &str) -> Table {
    text.parse().expect("a table")
}

#[test]
fn every_default_lies_in_its_range_and_is_explained() {
    Settings::default().check().expect("defaults in range");
    let entries = Settings::entries();
    let mut paths: Vec<&str> = entries.iter().map(|entry| &*entry.path).collect();
    paths.sort_unstable();
    paths.dedup();
    assert_eq!(paths.len(), entries.len(), "paths are unique");
    for Entry { path, meaning, why, if_wrong, .. } in &entries {
        let texts: Vec<&str> = [meaning, *why].into_iter().chain(*if_wrong).collect();
        assert!(texts.iter().all(|text| text.ends_with('.')), "{path}: {texts:?}");
        let words = texts.join(" ");
        assert!(words.split_whitespace().count() <= 36, "{path} is too long");
    }
}

#[test]
fn a_table_sets_what_it_names_and_nothing_else() {
    let text = "[verdict]\nmax_p = 0.001\n[location]\nmemories = [2, 8.5]\n";
    let settings = Settings::from_table(&table(text)).expect("settings");
    assert_eq!(settings.verdict.max_p, 0.001);
    assert_eq!(settings.location.memories, [2.0, 8.5]);
    let differences = settings.differences();
    assert_eq!(differences, table(&text.replace("2,", "2.0,")));
    assert_eq!(Settings::from_table(&differences), Ok(settings.clone()));
    let written = toml::to_string(&settings).expect("TOML");
    assert_eq!(table(&written), differences);
    assert_eq!(toml::from_str::<Settings>(&written).expect("settings"), settings);
    assert!(Settings::default().are_defaults() && !settings.are_defaults());
    assert!(Settings::default().differences().is_empty());
}

#[test]
fn what_is_no_setting_is_refused_by_name() {
    let refused = |text: &str| Settings::from_table(&table(text)).expect_err("refused").to_string();
    let message = refused("[verdict]\nmax_q = 0.01\n");
    assert!(message.starts_with("verdict.max_q: expected one of verdict.max_p"), "{message}");
    let message = refused("[rules]\n");
    assert!(message.starts_with("rules: expected one of evidence, reference"), "{message}");
    assert_eq!(refused("verdict = 3\n"), "verdict = 3: expected a table of settings");
    let message = refused("[verdict]\nmax_p = 2\n");
    assert_eq!(message, "verdict.max_p = 2: expected a number from 0 to 1");
    let message = refused("[search]\nmax_effects = 2.5\n");
    assert_eq!(message, "search.max_effects = 2.5: expected a whole number from 0 to 10");
    let message = refused("[location]\nmemories = [1.0]\n");
    assert!(message.starts_with("location.memories = [1.0]: expected 2 numbers"), "{message}");
}

#[test]
fn a_file_is_refused_by_line_and_key() {
    let read = |text: &str| Settings::from_document(&Document::new("settings.toml", text));
    let text = "[verdict]\nmax_p = 0.001\n";
    let settings = read(text).expect("settings");
    assert_eq!(settings.verdict.max_p, 0.001);
    let refused = |text: &str| read(text).expect_err("refused").to_string();
    let message = refused(&text.replace("0.001", "7"));
    let expected = "settings.toml:2: verdict.max_p = 7: expected a number from 0 to 1";
    assert!(message.starts_with(expected), "{message}");
    let message = refused(&text.replace("max_p", "maximum"));
    assert!(
        message.starts_with("settings.toml:2: verdict.maximum = 0.001: expected one of"),
        "{message}"
    );
    let message = refused("\n[rules]\n");
    assert!(message.starts_with("settings.toml:2: rules"), "{message}");
}

#[test]
fn a_value_set_in_rust_is_checked_too() {
    let mut settings = Settings::default();
    settings.set("verdict.max_p", &Value::Float(0.05)).expect("set");
    assert_eq!(settings.get("verdict.max_p"), Some(Value::Float(0.05)));
    settings.verdict.max_p = f64::NAN;
    let error = settings.check().expect_err("no number");
    assert!(matches!(error, SettingError::Value { path, .. } if path == "verdict.max_p"));
    assert_eq!(settings.get("verdict"), None);
    // of a group that stands beside its code
    settings.set("clock.last", &Value::Integer(7200)).expect("set");
    assert_eq!(settings.clock.last, 7200.0);
}

/// The page of the documents is what the program prints.
#[test]
fn the_page_is_the_tree() {
    let path = "docs/theory/diagnosis/settings.md";
    let written = include_str!("../../docs/theory/diagnosis/settings.md");
    assert_eq!(written, page(), "cargo run -p trackdyn-diagnose --example settings > {path}");
}

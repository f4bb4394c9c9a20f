//! `trackdyn diagnose` where the catalogue does not know what is there.

use crate::Workplace;
use crate::diagnose::{diagnosed, drive};

/// The terms of the law that a diagnosis proposes.
fn proposed(file: &toml::Table) -> Vec<&toml::Table> {
    let terms = file.get("proposed").and_then(toml::Value::as_array);
    terms.into_iter().flatten().map(|term| term.as_table().expect("a table")).collect()
}

fn letters(term: &toml::Table) -> String {
    let symmetries = term["symmetries"].as_array().expect("letters");
    symmetries.iter().map(|letter| letter.as_str().expect("a letter")).collect()
}

fn number(table: &toml::Value, key: &str) -> f64 {
    table[key].as_float().expect("a number")
}

#[test]
fn a_form_is_found_again_with_its_coefficients_and_runs_as_a_force() {
    let place = Workplace::new();
    let truth =
        [("turn_turning_cos_double_heading", 0.03), ("turn_turning_sin_double_heading", 0.04)];
    let settings = truth.map(|(key, value)| format!("{key}={value}")).join(",");
    drive(&place, &format!("--effect force-law:{settings}"));
    let (run, file) = diagnosed(&place, "");
    assert_eq!(file["status"].as_str(), Some("unexplained"), "{}", run.stdout);
    let terms = proposed(&file);
    assert_eq!(terms.len(), 1, "{}", run.stdout);
    assert_eq!(letters(terms[0]), "H");
    let parameters = terms[0]["parameters"].as_array().expect("coefficients");
    for (parameter, (key, value)) in parameters.iter().zip(truth) {
        assert_eq!(parameter["name"].as_str(), Some(key));
        // Half as wide again as the 95 % interval: 99.7 %.
        let half = (number(parameter, "high95") - number(parameter, "low95")) / 2.0;
        let off = (number(parameter, "value") - value).abs();
        assert!(off < 1.5 * half && half < 0.2 * value, "{key}: {parameter}");
    }
    assert!(run.stdout.contains("form     not in the catalogue"), "{}", run.stdout);
    assert!(run.stdout.contains("cos 2(heading − 2"), "{}", run.stdout);
    assert!(number(&file["proposal"], "explains") > 0.8, "{file}");

    // As a force it runs wherever effects run.
    let text = String::from_utf8(place.read("found/vehicle.corrected.toml")).expect("text");
    assert!(text.contains("[effect.force-law]\nturn_turning_cos_double_heading"), "{text}");
    assert!(!text.contains("world_x"), "coefficients of zero are left out: {text}");
    for command in ["map --grid 5 --out map", "simulate --runs 1 --duration 3 --out again"] {
        let run = place.run(&format!("{command} --vehicle found/vehicle.corrected.toml"));
        assert_eq!(run.status, 0, "{command}: {}", run.stderr);
    }
}

#[test]
fn friction_that_hangs_on_the_heading_gets_a_form_that_does() {
    let place = Workplace::new();
    drive(&place, "--ground independent --mechanism brushed-ground");
    let (run, file) = diagnosed(&place, "");
    assert_eq!(file["status"].as_str(), Some("unexplained"), "{}", run.stdout);
    let terms = proposed(&file);
    assert!(!terms.is_empty(), "{}", run.stdout);
    for term in &terms {
        // It is the same in reverse, at all speeds, at all places.
        let broken = letters(term);
        assert!(broken.contains('H'), "{}", run.stdout);
        assert!(!broken.contains(['S', 'X', 'T', '0']), "{}", run.stdout);
        let angle = term["what"].as_str().expect("words");
        assert!(angle.contains("cos 2(heading"), "grain has no head: {angle}");
    }
    assert!(number(&file["proposal"], "explains") > 0.8, "{file}");
}

#[test]
#[ignore = "the longest search, a minute: cargo test --release -p trackdyn-cli --test cli -- --ignored grip"]
fn grip_that_hangs_on_commands_gets_a_form_that_hangs_on_speed() {
    let place = Workplace::new();
    drive(&place, "--ground independent --mechanism steering-grip");
    let (run, file) = diagnosed(&place, "");
    assert_eq!(file["status"].as_str(), Some("unexplained"), "{}", run.stdout);
    let terms = proposed(&file);
    assert!(!terms.is_empty(), "{}", run.stdout);
    for term in terms {
        let broken = letters(term);
        assert!(broken.contains('S') && !broken.contains(['H', 'X', 'T']), "{}", run.stdout);
    }
}

#[test]
fn wind_is_explained_by_its_twins_or_gets_a_form_of_the_heading() {
    let place = Workplace::new();
    drive(&place, "--ground independent --mechanism side-wind");
    let (run, file) = diagnosed(&place, "");
    let terms = proposed(&file);
    let twins = ["slope", "tether"].iter().any(|twin| file["missing"].to_string().contains(twin));
    assert!(twins || !terms.is_empty(), "{}", run.stdout);
    for term in terms {
        assert_eq!(file["status"].as_str(), Some("unexplained"));
        assert!(letters(term).contains('H'), "{}", run.stdout);
    }
}

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

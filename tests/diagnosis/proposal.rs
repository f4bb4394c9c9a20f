//! A law that no catalogue has gets a form that depends on what the law depends on.

use trackdyn_diagnose::{Diagnosis, DiagnosisFile, Status};
use trackdyn_drive::ScheduleKind;
use trackdyn_model::kinematics::Source;
use trackdyn_tests::concealed::diagnosed_law;

/// The diagnosis of a drive by hand with this law, and its file.
fn diagnosis(law: &str) -> (Diagnosis, toml::Table) {
    let found = diagnosed_law(law, ScheduleKind::Manual, 1);
    let text = DiagnosisFile::new(&found, &Source::default()).to_toml();
    (found, text.parse().expect("TOML"))
}

/// The terms of the form that is proposed: the letters of the symmetries that each breaks, and the
/// term in words.
fn proposed(file: &toml::Table) -> Vec<(String, String)> {
    let terms = file.get("proposed").and_then(toml::Value::as_array);
    let term = |term: &toml::Value| {
        let symmetries = term["symmetries"].as_array().expect("letters");
        let letters = symmetries.iter().map(|letter| letter.as_str().expect("a letter"));
        (letters.collect(), term["what"].as_str().expect("words").to_owned())
    };
    terms.into_iter().flatten().map(term).collect()
}

#[test]
fn friction_that_hangs_on_the_heading_gets_a_form_that_does() {
    let (found, file) = diagnosis("brushed-ground");
    assert_eq!(found.answer.status, Status::Unexplained);
    let terms = proposed(&file);
    assert!(!terms.is_empty(), "{file}");
    for (broken, angle) in &terms {
        // Brushed ground does not change with the direction of motion, speed, place or time.
        assert!(broken.contains('H') && !broken.contains(['S', 'X', 'T', '0']), "{terms:?}");
        assert!(angle.contains("cos 2(heading"), "grain has no head: {angle}");
    }
    assert!(file["proposal"]["explains"].as_float().expect("a share") > 0.8, "{file}");
}

#[test]
fn grip_that_hangs_on_commands_gets_a_form_that_hangs_on_speed() {
    let (found, file) = diagnosis("steering-grip");
    assert_eq!(found.answer.status, Status::Unexplained);
    let terms = proposed(&file);
    assert!(!terms.is_empty(), "{file}");
    for (broken, _) in &terms {
        assert!(broken.contains('S') && !broken.contains(['H', 'X', 'T']), "{terms:?}");
    }
}

#[test]
fn wind_is_explained_by_its_twins_or_gets_a_form_of_the_heading() {
    let (found, file) = diagnosis("side-wind");
    let terms = proposed(&file);
    let missing = file.get("missing").map(ToString::to_string).unwrap_or_default();
    let has_twin = ["slope", "tether"].iter().any(|twin| missing.contains(twin));
    assert!(has_twin || !terms.is_empty(), "{file}");
    for (broken, _) in &terms {
        assert_eq!(found.answer.status, Status::Unexplained);
        assert!(broken.contains('H'), "{terms:?}");
    }
}

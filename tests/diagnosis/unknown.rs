//! Laws that the catalogue does not have are located all the same.

use trackdyn_diagnose::{Diagnosis, Status};
use trackdyn_drive::ScheduleKind;
use trackdyn_model::effect::Symmetry;
use trackdyn_tests::concealed::diagnosed_law;

fn diagnosis(law: &str, kind: ScheduleKind) -> Diagnosis {
    let diagnosis = diagnosed_law(law, kind, 5);
    assert_eq!(diagnosis.answer.status, Status::Unexplained, "{law}");
    diagnosis
}

/// Waves average out over every area that the plain contrasts of places know of.
#[test]
fn waves_of_the_ground_are_located_with_their_length_and_direction() {
    for (depth, length) in [(0.03, 0.9), (0.1, 1.7)] {
        let law = format!("washboard:depth={depth},wavelength_m={length}");
        let diagnosis = diagnosis(&law, ScheduleKind::Manual);
        let wave = diagnosis.evidence.after.wave.expect("a wave");
        println!("{length} m: {wave:?}");
        assert!(
            diagnosis.answer.broken.contains(&Symmetry::Place),
            "{:?}",
            diagnosis.answer.broken
        );
        assert!((wave.length / length - 1.0).abs() < 0.1, "{wave:?} of {length} m");
        assert!(wave.direction.abs() < 0.2, "{wave:?} along x");
    }
}

/// Rubber that softens by its own slip, and cools within 15 s: what speeds and times say is taken
/// up by other laws.
#[test]
fn what_hangs_on_the_past_breaks_what_holds_at_steady_speeds() {
    let diagnosis = diagnosis("warm-rubber:softening=1", ScheduleKind::Manual);
    let left: Vec<Symmetry> = diagnosis.evidence.after.broken();
    println!("{left:?}: {:?}", diagnosis.evidence.after.tests);
    assert!(left.contains(&Symmetry::Transient), "{left:?}");
}

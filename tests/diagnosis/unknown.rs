//! Laws that the catalogue does not have are located all the same.

use trackdyn_diagnose::locate::Along;
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
        let found = &diagnosis.evidence.after.waves;
        let wave = found.iter().find_map(|wave| match wave.along {
            Along::Ground { direction } => Some((wave.length, direction)),
            Along::Belts => None,
        });
        println!("{length} m: {found:?}");
        let (found, direction) = wave.expect("a wave of the ground");
        assert!(
            diagnosis.answer.broken.contains(&Symmetry::Place),
            "{:?}",
            diagnosis.answer.broken
        );
        assert!((found / length - 1.0).abs() < 0.1, "{found} of {length} m");
        assert!(direction.abs() < 0.2, "{direction} along x");
    }
}

/// A sprocket that runs out of true is located with the way of a turn.
#[test]
fn waves_of_the_belts_are_located_with_their_length() {
    let law = "eccentric-sprocket:eccentricity=0.02,turn_m=0.9";
    let diagnosis = diagnosis(law, ScheduleKind::Manual);
    let found = &diagnosis.evidence.after.waves;
    let wave = found.iter().find(|wave| wave.along == Along::Belts).expect("a wave of the belts");
    assert!((wave.length / 0.9 - 1.0).abs() < 0.05, "{wave:?}");
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

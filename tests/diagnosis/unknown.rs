//! Laws that the catalogue does not have are located all the same.

use trackdyn_diagnose::{Diagnosis, Status};
use trackdyn_drive::ScheduleKind;
use trackdyn_drive::sensors::Preset;
use trackdyn_model::effect::Symmetry;
use trackdyn_tests::concealed::{Drive, diagnosed, owned, runs, sensors};

fn diagnosis(law: &str, kind: ScheduleKind) -> Diagnosis {
    let file = owned(&[]);
    let drive = Drive::new(&file.vehicle, &[law], &runs(kind, 8, 5), 5).expect("it drives");
    let diagnosis = diagnosed(&drive.recording(&sensors(Preset::Laboratory), 5), &file);
    let diagnosis = diagnosis.expect("enough to say something");
    assert_eq!(diagnosis.status, Status::Unexplained, "{law}");
    diagnosis
}

/// Waves average out over every area that the plain contrasts of places know of.
#[test]
fn waves_of_the_ground_are_located_with_their_length_and_direction() {
    for (depth, length) in [(0.03, 0.9), (0.1, 1.7)] {
        let law = format!("washboard:depth={depth},wavelength_m={length}");
        let diagnosis = diagnosis(&law, ScheduleKind::Manual);
        let wave = diagnosis.after.wave.expect("a wave");
        println!("{length} m: {wave:?}");
        assert!(diagnosis.broken.contains(&Symmetry::Place), "{:?}", diagnosis.broken);
        assert!((wave.length / length - 1.0).abs() < 0.1, "{wave:?} of {length} m");
        assert!(wave.direction.abs() < 0.2, "{wave:?} along x");
    }
}

/// Rubber that softens by its own slip, and cools within 15 s: what speeds and times say is taken
/// up by other laws.
#[test]
fn what_hangs_on_the_past_breaks_what_holds_at_steady_speeds() {
    let diagnosis = diagnosis("warm-rubber:softening=1", ScheduleKind::Manual);
    let left: Vec<Symmetry> = diagnosis.after.broken();
    println!("{left:?}: {:?}", diagnosis.after.tests);
    assert!(left.contains(&Symmetry::Transient), "{left:?}");
}

//! What the owner measured opens the class of constants.

use std::collections::BTreeSet;
use trackdyn_diagnose::diagnosis::Kind;
use trackdyn_drive::ScheduleKind;
use trackdyn_drive::sensors::Preset;
use trackdyn_model::VehicleFile;
use trackdyn_recording::Recording;
use trackdyn_tests::concealed::{Drive, diagnosed, named, owned, runs, sensors};

fn drive(concealed: &[&str]) -> Recording {
    let runs = runs(ScheduleKind::Manual, 4, 5);
    let drive = Drive::new(&owned(concealed).vehicle, concealed, &runs, 5).expect("it drives");
    drive.recording(&sensors(Preset::Laboratory), 5)
}

/// Members of the class of constants that are left.
fn constants(recording: &Recording, file: &VehicleFile) -> BTreeSet<&'static str> {
    let diagnosis = diagnosed(recording, file).expect("enough driving");
    let constants = named(&diagnosis).into_iter().filter(|(kind, _)| *kind == Kind::Constant);
    constants.flat_map(|(_, members)| members).collect()
}

#[test]
fn a_friction_that_was_measured_cannot_be_what_is_wrong() {
    let recording = drive(&["cog-shift:x_m=0.03,y_m=0.02"]);
    let file = owned(&[]);
    let unknown = constants(&recording, &file);
    assert!(unknown.contains("cog-shift") && unknown.contains("friction-anisotropy"));

    // Pulled along and across with a spring balance, to half a percent.
    let mut pulled = file.clone();
    pulled.vehicle.uncertainty.friction.across = Some(0.0045);
    pulled.vehicle.uncertainty.friction.along = Some(0.0035);
    let left = constants(&recording, &pulled);
    assert!(left.contains("cog-shift"), "{left:?}");
    assert!(!left.contains("friction-anisotropy"), "{left:?}");

    // One coefficient alone says nothing of their ratio.
    pulled.vehicle.uncertainty.friction.along = None;
    assert_eq!(constants(&recording, &pulled), unknown);
}

#[test]
fn a_centre_of_gravity_that_was_weighed_cannot_be_what_is_wrong() {
    let recording = drive(&["friction-anisotropy:ratio=1.25"]);
    let mut weighed = owned(&[]);
    let unknown = constants(&recording, &weighed);
    assert!(unknown.contains("cog-shift") && unknown.contains("friction-anisotropy"));
    weighed.vehicle.uncertainty.cog = Some([0.002, 0.002]);
    let left = constants(&recording, &weighed);
    assert!(left.contains("friction-anisotropy"), "{left:?}");
    assert!(!left.contains("cog-shift"), "{left:?}");
}

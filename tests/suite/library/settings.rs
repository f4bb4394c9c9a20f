//! Settings: which runs are held out, and errors that name what is to be changed.

use super::driven;
use trackdyn::diagnose::{Prepared, every_fourth};
use trackdyn::simulate::Driving;
use trackdyn::{
    DiagnoseSettings, DriveSettings, Error, Gauge, HeldOut, Path, Recording, SimulateSettings,
    Vehicle, drive, simulate,
};

fn held_out(recording: &Recording, held_out: HeldOut) -> Result<Vec<usize>, Error> {
    let settings = DiagnoseSettings { held_out, ..DiagnoseSettings::default() };
    let model = Vehicle::auriga_alpha().with_inertia(true);
    let prepared = Prepared::new(std::slice::from_ref(recording), &model, &settings)?;
    Ok(prepared.held_out().to_vec())
}

#[test]
fn every_fourth_of_many_runs_is_held_out() {
    assert!(every_fourth(7).is_empty());
    assert_eq!(every_fourth(12), [3, 7, 11]);
    let [few, many] = [7, 8].map(|runs| driven(runs).recording);
    assert!(held_out(&few, HeldOut::ByRule).expect("evidence").is_empty());
    assert_eq!(held_out(&many, HeldOut::ByRule).expect("evidence"), [3, 7]);
    assert!(held_out(&many, HeldOut::None).expect("evidence").is_empty());
    let runs = |list: &str| HeldOut::Runs(list.parse().expect("a list"));
    assert_eq!(held_out(&many, runs("1,6")).expect("evidence"), [1, 6]);
    let error = held_out(&many, runs("0-7")).expect_err("nothing is left");
    assert!(matches!(error, Error::AllHeldOut));
    let error = held_out(&many, runs("99")).expect_err("not there");
    assert_eq!(error.setting(), Some("held_out"));
}

#[test]
fn a_clock_offset_that_is_known_is_not_estimated() {
    let (recording, model) = (driven(2).recording, Vehicle::auriga_alpha());
    let offset = |tau| {
        let settings = DiagnoseSettings { tau, ..DiagnoseSettings::default() };
        let prepared = Prepared::new(std::slice::from_ref(&recording), &model, &settings);
        prepared.expect("evidence").evidence().tau()
    };
    assert!(offset(None).abs() < 0.05);
    assert_eq!(offset(Some(0.12)), 0.12);
}

#[test]
fn messages_begin_with_the_setting_to_be_changed() {
    let vehicle = Vehicle::auriga_alpha;
    let square = Path::square(1.0, true, 1).expect("a square");
    let runs = vec![];
    let driving = Driving::Runs(runs);
    let with_runs = SimulateSettings { driving, runs: Some(2), ..SimulateSettings::default() };
    let fast = DriveSettings { speed: 99.0, ..DriveSettings::default() };
    let errors = [
        vehicle().with_cog([9.0, 0.0]).map(drop),
        Vehicle::choose("no-such-vehicle").map(drop),
        Gauge::new(-1.0).map(drop),
        trackdyn::simulate::sensors("no-such-sensors").map(drop),
        simulate(&vehicle(), &with_runs).map(drop),
        drive(&vehicle(), &square, &[], &fast).map(drop),
        held_out(&driven(1).recording, HeldOut::Runs("0".parse().expect("a list"))).map(drop),
    ];
    for error in errors {
        let error = error.expect_err("not accepted");
        let setting = error.setting().unwrap_or_else(|| panic!("{error}: no setting"));
        assert!(error.to_string().starts_with(setting), "{error}");
    }
}

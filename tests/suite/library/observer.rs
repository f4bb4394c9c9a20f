//! Observers are told how far the work is, and can stop it.

use super::driven;
use std::ops::ControlFlow;
use std::sync::Mutex;
use trackdyn::diagnose::Prepared as Diagnose;
use trackdyn::drive::Prepared as Drive;
use trackdyn::identify::Prepared as Identify;
use trackdyn::simulate::Prepared as Simulate;
use trackdyn::{
    DiagnoseSettings, DriveSettings, Error, IcrMap, IdentifySettings, MapSettings, Observer, Path,
    Progress, SimulateSettings, Vehicle,
};

/// Work under an observer.
type Work<'a> = &'a dyn Fn(&Observer) -> Result<(), Error>;

/// What an observer was told that goes on.
fn told(work: Work) -> Vec<Progress> {
    let told = Mutex::new(Vec::new());
    let observer = |progress| {
        told.lock().expect("nobody panics").push(progress);
        ControlFlow::Continue(())
    };
    work(&observer).expect("it goes on to its end");
    told.into_inner().expect("nobody panics")
}

/// What an observer was told that wants no more from the first part on, with what came of it.
fn stopped(work: Work) -> (usize, Result<(), Error>) {
    let count = Mutex::new(0);
    let result = work(&|_| {
        *count.lock().expect("nobody panics") += 1;
        ControlFlow::Break(())
    });
    (count.into_inner().expect("nobody panics"), result)
}

fn goes_on_and_stops(name: &str, work: Work) {
    let all = told(work);
    let last = all.iter().map(|progress| progress.done).max().expect("it is told");
    assert!(all.iter().all(|of| of.done <= of.total && of.total == all[0].total), "{name}");
    assert_eq!(last, all[0].total, "{name}: the last part is told of");
    let (parts, result) = stopped(work);
    assert!(matches!(result, Err(Error::Cancelled)), "{name}: {result:?}");
    // threads that are at work meanwhile finish their part
    assert!(parts < all.len(), "{name}: {parts} parts of {} after the first", all.len());
}

#[test]
fn maps_stop() {
    let vehicle = Vehicle::auriga_alpha();
    let settings = MapSettings::default();
    goes_on_and_stops("map", &|observer| IcrMap::solve(&vehicle, &settings, observer).map(drop));
}

#[test]
fn simulations_stop() {
    let settings =
        SimulateSettings { runs: Some(40), duration: Some(2.0), ..SimulateSettings::default() };
    let prepared = Simulate::new(&Vehicle::auriga_alpha(), &settings).expect("a schedule");
    goes_on_and_stops("simulation", &|observer| prepared.run(observer).map(drop));
}

#[test]
fn identifications_stop() {
    let (recording, vehicle) = (driven(2).recording, Vehicle::auriga_alpha());
    let settings = IdentifySettings::default();
    let prepared = Identify::new(&recording, &vehicle, &settings).expect("motion");
    goes_on_and_stops("identification", &|observer| prepared.run(observer).map(drop));
}

#[test]
fn drives_stop() {
    let path = Path::square(2.0, true, 1).expect("a square");
    let settings = DriveSettings { inertia: false, ..DriveSettings::default() };
    let prepared = Drive::new(&Vehicle::auriga_alpha(), &path, &[], &settings).expect("a drive");
    goes_on_and_stops("drive", &|observer| prepared.clone().run(observer).map(drop));
}

#[test]
fn a_diagnosis_stops_at_once() {
    let recording = driven(2).recording;
    let model = Vehicle::auriga_alpha().with_inertia(true);
    let settings = DiagnoseSettings::default();
    let prepare = || Diagnose::new(std::slice::from_ref(&recording), &model, &settings);
    let (parts, result) = stopped(&|observer| prepare().expect("evidence").run(observer).map(drop));
    assert!(matches!(result, Err(Error::Cancelled)) && parts == 1, "{result:?} after {parts}");
}

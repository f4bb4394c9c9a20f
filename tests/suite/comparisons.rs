//! Comparisons of two sets of drives on the second simulator, with other schedules.

use std::sync::LazyLock;
use trackdyn_core::document::Document;
use trackdyn_diagnose::Resampling;
use trackdyn_diagnose::compare::document::ComparisonFile;
use trackdyn_diagnose::compare::{Comparison, Status, Subject, Which, compare};
use trackdyn_diagnose::diagnosis::Examination;
use trackdyn_diagnose::progress::Watch;
use trackdyn_drive::sensors::Preset;
use trackdyn_drive::{ScheduleKind, ScheduleOptions};
use trackdyn_model::kinematics::Source;
use trackdyn_model::{EffectId, Vehicle, VehicleFile};
use trackdyn_tests::concealed::{Drive, examined, owned, sensors};

const RUNS: usize = 4;
const RUN_TIME: f64 = 12.0;

/// Drives by hand of this robot, with this concealed, examined against the vehicle as its owner
/// knows it.
fn set(concealed: &[&str], seed: u64, change: impl FnOnce(&mut Vehicle)) -> Examination {
    set_of(&owned(&[]), concealed, seed, change)
}

/// As [`set`], of another vehicle file.
fn set_of(
    file: &VehicleFile,
    concealed: &[&str],
    seed: u64,
    change: impl FnOnce(&mut Vehicle),
) -> Examination {
    let options = ScheduleOptions {
        runs: Some(RUNS),
        seed,
        duration: Some(RUN_TIME),
        ..ScheduleOptions::default()
    };
    let runs = ScheduleKind::Manual.generate(&options).expect("a schedule");
    let mut vehicle = file.vehicle.clone();
    change(&mut vehicle);
    let drive = Drive::new(&vehicle, concealed, &runs, seed).expect("it drives");
    let recording = drive.recording(&sensors(Preset::Laboratory), seed);
    examined(&recording, file).expect("an answer")
}

static PLAIN_SET: LazyLock<Examination> = LazyLock::new(|| set(&[], 3, |_| ()));

fn compared(sim: &Examination, real: &Examination) -> Comparison {
    compared_by(&owned(&[]), sim, real)
}

fn compared_by(file: &VehicleFile, sim: &Examination, real: &Examination) -> Comparison {
    compare([sim, real], file, Resampling::default(), &Watch::none()).expect("an answer")
}

fn effect(id: &str) -> EffectId {
    EffectId::of(id).expect("an effect")
}

#[test]
fn nothing_differs_between_equal_robots_on_other_schedules() {
    let found = compared(&PLAIN_SET, &set(&[], 5, |_| ()));
    let differences: Vec<_> = found.differences.iter().map(|one| one.group.subject).collect();
    assert_eq!(found.status(), Status::NothingDiffers, "{differences:?}, {}", found.place());
    // a ratio of 1.25 is named below
    let ratio = effect("friction-anisotropy");
    let smallest = found.smallest.iter().find(|one| one.effect == ratio);
    let smallest = smallest.and_then(|one| one.size).expect("a size");
    assert!((0.01..0.25).contains(&smallest), "{smallest}");
}

#[test]
fn another_friction_ratio_stands_among_the_constants() {
    let found = compared(&PLAIN_SET, &set(&[], 7, |vehicle| vehicle.friction.across *= 1.25));
    let [one] = &found.differences[..] else { panic!("{}: {:?}", found.place(), found.effects) };
    assert_eq!(one.group.subject, Subject::Constants);
    assert!(one.one_of.contains(&effect("friction-anisotropy")), "{:?}", one.one_of);
    let [sim, corrected, _] = found.closer.errors;
    assert!(corrected < sim, "{sim} {corrected}");
    let file = ComparisonFile::new(&found, [&Source::default(), &Source::default()]);
    let text = file.to_toml();
    let read = ComparisonFile::from_document(&Document::new("compare.toml", &text));
    assert_eq!(read.expect("its own file").to_toml(), text);
    assert_eq!(file.differs[0].what, "constants");
}

/// Neither set lacks it, and neither has it as the file says.
#[test]
fn an_effect_of_the_vehicle_file_differs_by_its_size() {
    let mut file = owned(&[]);
    file.effects.insert("load-transfer:cog_height_m=0.15".parse().expect("an effect"));
    let high = |height: &str, seed: u64| {
        set_of(&file, &[&format!("load-transfer:cog_height_m={height}")], seed, |_| ())
    };
    let found = compared_by(&file, &high("0.1", 11), &high("0.25", 12));
    let [one] = &found.differences[..] else { panic!("{}: {:?}", found.place(), found.effects) };
    assert_eq!((one.which, &one.one_of), (Which::Both, &vec![effect("load-transfer")]));
    let [sim, real] = one.group.numbers[0].each;
    assert!(sim.holds(0.1) && real.holds(0.25), "{sim:?} {real:?}");
}

//! A dozen diagnoses from the drive to the answer.
//!
//! Each drive is on the second simulator, short, with something concealed from the owner's vehicle
//! file. The long tests of the diagnosis stand in `tests/diagnosis`.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::Mutex;
use trackdyn_core::document::Document;
use trackdyn_diagnose::diagnosis::{Kind, Missing, STAGES};
use trackdyn_diagnose::verdict::Refusal;
use trackdyn_diagnose::{
    Diagnosis, DiagnosisFile, Error, Evidence, Options, Progress, Resampling, Settings, Stage,
    Status, diagnose,
};
use trackdyn_drive::sensors::{Imu, Preset};
use trackdyn_drive::{ScheduleKind, ScheduleOptions, Sensors};
use trackdyn_estimate::noise::{self, noise};
use trackdyn_model::kinematics::Source;
use trackdyn_recording::{Recording, Run};
use trackdyn_tests::concealed::{
    Drive, diagnosed, diagnosed_by, diagnosed_by_gyroscope, named, owned, sensors,
};

/// Runs of a drive, and the time of each, s: short, and enough for two held-out runs. Half as many
/// leave more open, and take longer.
const RUNS: usize = 8;
const RUN_TIME: f64 = 15.0;

/// A drive by hand on which this (`id:key=value`) is concealed.
fn recording(concealed: &[&str]) -> Recording {
    recording_by(concealed, &sensors(Preset::Laboratory))
}

/// Such a drive as these sensors see it.
fn recording_by(concealed: &[&str], sensors: &Sensors) -> Recording {
    let options = ScheduleOptions {
        runs: Some(RUNS),
        seed: 3,
        duration: Some(RUN_TIME),
        ..ScheduleOptions::default()
    };
    let runs = ScheduleKind::Manual.generate(&options).expect("a schedule");
    let file = owned(concealed);
    let drive = Drive::new(&file.vehicle, concealed, &runs, 3).expect("it drives");
    drive.recording(sensors, 3)
}

/// A hundred poses, at 4 Hz, of one drive that neither rests nor runs steadily for long.
#[test]
fn half_a_minute_without_rest_is_diagnosed() {
    let concealed = ["load-transfer:cog_height_m=0.2"];
    let options = ScheduleOptions {
        runs: Some(1),
        seed: 3,
        duration: Some(25.0),
        ..ScheduleOptions::default()
    };
    let runs = ScheduleKind::Manual.generate(&options).expect("a schedule");
    let file = owned(&concealed);
    let drive = Drive::new(&file.vehicle, &concealed, &runs, 3).expect("it drives");
    let mut sensors = sensors(Preset::Laboratory);
    sensors.pose.interval = 0.25;
    let recording = drive.recording(&sensors, 3);
    let measured = noise(&recording, sensors.clock_offset(), &noise::Settings::default());
    assert!(measured.standing.is_none() && measured.moving.is_none(), "{measured:?}");
    let found = diagnosed(&recording, &file).expect("an answer");
    assert_eq!(physics(&found), [BTreeSet::from(["load-transfer"])]);
    // Errors of poses are 3 mm and 0.1 degrees; a hundred numbers show them to a tenth.
    let seen = found.evidence.seen.noise().expect("of a drive");
    for (found, truth) in seen.pose.into_iter().zip([3e-3, 3e-3, 0.1_f64.to_radians()]) {
        assert!((found.sqrt() / truth).ln().abs() < 0.5, "{seen:?}");
    }
}

/// A height that the file has wrong, beside Newton's law that it lacks, looks like strengths of
/// inertia that differ. The corrected vehicle drives as the fit does.
#[test]
fn a_wrong_height_is_named_beside_inertia_that_is_missing() {
    let height = "load-transfer:cog_height_m=0.22";
    let concealed = ["yaw-inertia", "centripetal", height];
    let mut file = owned(&concealed);
    file.effects.insert("load-transfer:cog_height_m=0.1".parse().expect("an effect"));
    let found = diagnosed(&recording(&concealed), &file).expect("an answer");
    let names = physics(&found);
    for name in ["yaw-inertia", "centripetal", "load-transfer"] {
        assert!(names.contains(&BTreeSet::from([name])), "{names:?}");
    }
    assert_eq!(names.len(), 3, "{names:?}");
    let sizes = |name: &str| {
        let one = found.answer.missing.iter().find(|one| one.verdict.effect.name() == name);
        one.expect("a claim").parameters[0]
    };
    let height = sizes("load-transfer");
    assert!(height.low < 0.22 && 0.22 < height.high && height.low > 0.15, "{height:?}");
    let place = found.evidence.drift.place.expect("enough driving");
    assert!(place.after.value < 0.7 * place.before.value, "{place:?}");
}

/// The headings of a map are good to two degrees: a drift of the friction hides in them, and shows
/// with its size beside a gyroscope.
#[test]
fn a_gyroscope_shows_what_coarse_headings_hide() {
    const RATE: f64 = 0.000_12;
    // It settles within 300 s: from the first to the last of eight runs, 22 s apart, it is on
    // average (1 − exp(−t/T))/(t/T) of that.
    let passed: f64 = 8.0 * 22.0 / 300.0;
    let mean_rate = RATE * -(-passed).exp_m1() / passed;
    let concealed = format!("friction-drift:rate_1_per_s={RATE}");
    let mut sensors = sensors(Preset::Laboratory);
    sensors.pose.white.yaw = 2_f64.to_radians();
    sensors.imu = Some(Imu::default());
    let recording = recording_by(&[&concealed], &sensors);
    let file = owned(&[&concealed]);
    let without = diagnosed(&recording, &file).expect("an answer");
    assert!(physics(&without).is_empty(), "{:?}", named(&without));
    let with = diagnosed_by_gyroscope(&recording, &file).expect("an answer");
    let is_one_of =
        |one: &&Missing| one.verdict.one_of.iter().any(|of| of.name() == "friction-drift");
    let drift = with.answer.missing.iter().find(is_one_of);
    let drift = drift.unwrap_or_else(|| panic!("{:?}", named(&with)));
    assert!(drift.verdict.one_of.len() <= 2, "{:?}", named(&with));
    let [low, high] = [drift.parameters[0].low, drift.parameters[0].high];
    assert!((low..=high).contains(&mean_rate), "{low} to {high}");
    let found = with.evidence.seen.gyroscope().expect("asked").as_ref().expect("it serves");
    assert!(found.error_with_it < 0.1 * found.error_of_poses, "{found}");
}

/// A pose a second tells little of what takes a tenth of one. A gyroscope saw it.
#[test]
#[ignore = "half a minute: .ci/nightly runs it"]
fn a_gyroscope_shows_what_lies_between_poses() {
    const LAG: f64 = 0.1;
    let concealed = format!("split-lag:left_s={LAG}");
    let mut sensors = sensors(Preset::Laboratory);
    sensors.pose.interval = 1.0;
    sensors.imu = Some(Imu::default());
    let recording = recording_by(&[&concealed], &sensors);
    // It is silent at the end of one run: poses stay there as they are.
    let with_gap = recording.runs().iter().enumerate().map(|(index, run)| {
        let mut rows = run.clone().into_rows();
        rows.imu.samples.retain(|row| index > 0 || !(11.0..13.0).contains(&row.t));
        Run::new(rows, &mut Vec::new())
    });
    let recording = recording.with_runs(with_gap.collect());
    let file = owned(&[&concealed]);
    let found = diagnosed_by_gyroscope(&recording, &file).expect("an answer");
    let is_lag = |one: &&Missing| one.verdict.effect.card().id == "split-lag";
    let lag = found.answer.missing.iter().find(is_lag);
    let lag = &lag.unwrap_or_else(|| panic!("{:?}", named(&found))).parameters[0];
    assert!((lag.low..=lag.high).contains(&LAG), "{} to {}", lag.low, lag.high);
    assert!(lag.high - lag.low < 0.01, "{} to {}", lag.low, lag.high);

    let gauge = file.vehicle.gauge;
    let evidence = |by_gyroscope: bool| {
        Evidence::of_drive(&recording, gauge, &Settings::default(), by_gyroscope, None)
            .expect("enough")
    };
    let [without, with] = [false, true].map(evidence);
    let time = |of: &Evidence| of.samples().iter().map(|sample| sample.duration).sum::<f64>();
    assert!(time(&with) > 0.98 * time(&without), "{} {}", time(&with), time(&without));
    let count = [&with, &without].map(|of| of.samples().len());
    assert!(count[0] > 5 * count[1], "{count:?}");
    let places = |of: &Evidence| of.samples().iter().filter(|one| one.has_place[1]).count();
    assert_eq!(places(&with), places(&without));
}

/// The diagnosis of a drive by hand on which this is concealed.
fn diagnosis(concealed: &[&str]) -> Diagnosis {
    diagnosed(&recording(concealed), &owned(concealed)).expect("an answer")
}

/// Sets of physics that are named.
fn physics(diagnosis: &Diagnosis) -> Vec<BTreeSet<&'static str>> {
    let named = named(diagnosis).into_iter();
    named.filter(|(kind, _)| *kind == Kind::Physics).map(|(_, members)| members).collect()
}

/// Asserts that one set of physics is named, that it holds what is concealed, and that the
/// corrected model leaves held-out runs nearer to the noise.
fn is_named(concealed: &str) {
    let id = concealed.split(':').next().expect("an id");
    let found = diagnosis(&[concealed]);
    let named = physics(&found);
    assert!(matches!(&named[..], [one] if one.contains(id)), "{concealed}: {named:?}");
    assert!(
        matches!(found.answer.status, Status::Explained | Status::Ambiguous),
        "{:?}",
        found.answer.status
    );
    let errors = &found.evidence.errors;
    assert!(errors.after < errors.before, "{} to {}", errors.before, errors.after);
}

/// Instruments that few robots have wrong are looked for, and named with their sizes.
#[test]
#[ignore = "half a minute: .ci/nightly runs it"]
fn a_side_that_follows_late_or_turns_less_backward_is_named() {
    for (concealed, size) in
        [("backward-gain:left=0.96,right=1", 0.96), ("split-lag:left_s=0.1", 0.1)]
    {
        let found = diagnosis(&[concealed]);
        let id = concealed.split(':').next().expect("an id");
        let missing = found.answer.missing.iter();
        let of = |missing: &&Missing| missing.verdict.effect.card().id == id;
        let one = missing.clone().find(of).unwrap_or_else(|| panic!("{:?}", named(&found)));
        assert_eq!((one.kind, one.verdict.one_of.len()), (Kind::Instrument, 1), "{concealed}");
        let [low, high] = [one.parameters[0].low, one.parameters[0].high];
        assert!((low..=high).contains(&size), "{concealed}: {low} to {high}");
        assert!(physics(&found).is_empty(), "{concealed}: {:?}", named(&found));
    }
}

/// Runs on grass among runs on asphalt, or rain that begins.
#[test]
#[ignore = "half a minute: .ci/nightly runs it"]
fn another_ground_between_two_times_is_named_with_its_times() {
    let found = diagnosis(&["ground-change:across_factor=1.3,from_s=50,until_s=101"]);
    assert_eq!(physics(&found), [BTreeSet::from(["ground-change"])], "{:?}", named(&found));
    let parameters = &found.answer.missing[0].parameters;
    for (interval, truth) in parameters.iter().zip([1.3, 50.0, 101.0]) {
        let off = (interval.value / truth).ln().abs();
        assert!(off < 0.06, "{interval:?} for {truth}");
    }
    // to two samples of 0.27 s
    for (interval, truth) in parameters[1..].iter().zip([50.0, 101.0]) {
        assert!((interval.value - truth).abs() < 0.6, "{interval:?} for {truth}");
    }
}

#[test]
fn nothing_is_named_where_nothing_is_concealed() {
    let found = diagnosis(&[]);
    assert!(physics(&found).is_empty(), "{:?}", physics(&found));
    assert_ne!(found.answer.status, Status::Unexplained);
    // What could have been there unseen is said for the effects that driving shows.
    let file = DiagnosisFile::new(&found, &Source::default()).to_toml();
    assert!(file.contains("[detectable.centripetal]"), "{file}");
}

/// A robot on ice: all inertia is felt eight times as strongly as by the friction of the file. It
/// is no clock.
#[test]
fn a_slide_is_inertia_and_no_clock() {
    let concealed = ["yaw-inertia:strength=8", "centripetal:strength=8"];
    let found = diagnosis(&concealed);
    let [inertia, centripetal] = ["yaw-inertia", "centripetal"].map(|id| BTreeSet::from([id]));
    let named = physics(&found);
    assert!(named.contains(&inertia) && named.contains(&centripetal), "{named:?}");
    let [friction, ..] = found.friction_by_inertia().expect("it slides farther than the file says");
    assert!((friction * 8.0).ln().abs() < 0.3, "{friction}");
    let file = DiagnosisFile::new(&found, &Source::default());
    assert!((file.friction_by_inertia.expect("in the file").factor - friction).abs() < 1e-6);
    let best = &found.models.best.fit.hypothesis;
    let delay = best.effects.iter().fold(0.0, |sum, effect| {
        let alone = std::iter::once(effect.clone()).collect();
        let vehicle = best.vehicle.clone();
        sum + trackdyn_model::Model::new(vehicle, alone).sensor().delay
    });
    let offset = sensors(Preset::Laboratory).clock_offset();
    assert!((delay - offset).abs() < 0.05, "{delay} s, not {offset}");
}

/// The file knows of a height, and a wrong one: no form of its law, and no other law.
#[test]
#[ignore = "half a minute: .ci/nightly runs it"]
fn a_wrong_height_in_the_file_is_named_with_the_right_one() {
    const HEIGHT: f64 = 0.25;
    let concealed = format!("load-transfer:cog_height_m={HEIGHT}");
    let mut file = owned(&[&concealed]);
    file.effects.insert("load-transfer:cog_height_m=0.1".parse().expect("an effect"));
    let found = diagnosed(&recording(&[&concealed]), &file).expect("an answer");
    assert_eq!(physics(&found), [BTreeSet::from(["load-transfer"])], "{:?}", named(&found));
    let [parameter] = &found.answer.missing[0].parameters[..] else { panic!("one size") };
    assert!((parameter.value / HEIGHT - 1.0).abs() < 0.1, "{parameter:?}");
}

#[test]
fn inertia_is_named() {
    is_named("yaw-inertia");
}

#[test]
#[ignore = "half a minute: .ci/nightly runs it"]
fn friction_that_falls_with_slip_speed_is_named() {
    is_named("stribeck-friction");
}

#[test]
fn lugs_that_grip_better_one_way_are_named() {
    is_named("directional-lugs");
}

#[test]
#[ignore = "half a minute: .ci/nightly runs it"]
fn a_drag_behind_the_robot_is_named() {
    is_named("hitch-drag");
}

#[test]
fn resistance_of_one_side_is_named() {
    is_named("resistance-split");
}

#[test]
#[ignore = "half a minute: .ci/nightly runs it"]
fn a_slope_is_named() {
    is_named("slope:angle_deg=3");
}

#[test]
fn friction_that_drifts_is_named() {
    is_named("friction-drift");
}

#[test]
fn gains_of_the_encoders_are_an_instrument() {
    let found = diagnosis(&["encoder-scale:left=0.97,right=1.02"]);
    let named = named(&found);
    let is_instrument = |(kind, members): &(Kind, BTreeSet<&str>)| {
        *kind == Kind::Instrument && members.contains("encoder-scale")
    };
    assert!(named.iter().any(is_instrument), "{named:?}");
    assert!(physics(&found).is_empty(), "{named:?}");
}

/// A rule that nothing can keep refuses what is claimed by default, and the file says which number
/// was another.
#[test]
fn a_setting_changes_the_answer_and_stands_in_its_file() {
    let concealed = ["yaw-inertia"];
    let mut settings = Settings::default();
    settings.verdict.min_ln_bayes_factor = 9000.0;
    let found = diagnosed_by(&recording(&concealed), &owned(&concealed), &settings);
    let found = found.expect("an answer");
    assert!(named(&found).is_empty(), "{:?}", named(&found));
    let refused: Vec<_> = found.answer.refused.iter().map(|verdict| &verdict.refused).collect();
    let is_weak = |one: &&Option<Refusal>| match one {
        Some(Refusal::Weak { needed, .. }) => *needed == 9000.0,
        _ => false,
    };
    assert!(!refused.is_empty() && refused.iter().all(is_weak), "{refused:?}");
    let file = DiagnosisFile::new(&found, &Source::default());
    let text = file.to_toml();
    assert!(text.contains("[settings.verdict]\nmin_ln_bayes_factor = 9000.0\n"), "{text}");
    let read = DiagnosisFile::from_document(&Document::new("diagnosis.toml", text));
    assert_eq!(read.expect("a file").settings, settings);
    settings.verdict.max_p = 2.0;
    let error = diagnosed_by(&recording(&concealed), &owned(&concealed), &settings).err();
    let error = error.expect("no probability").to_string();
    assert_eq!(error, "verdict.max_p = 2.0: expected a number from 0 to 1");
}

/// Progress counts to what was announced, whatever is repeated; a diagnosis ends where its observer
/// stops it, be it between two refits.
#[test]
fn progress_ends_at_its_total_and_an_observer_may_stop_it() {
    let file = owned(&[]);
    let settings = Settings::default();
    let evidence = Evidence::of_recording(&recording(&[]), file.vehicle.gauge, &settings);
    let evidence = evidence.expect("enough");
    let resampling = Resampling { draws: 100, ..Resampling::default() };
    let options = Options { resampling, ..Options::default() };
    let told: Mutex<Vec<Progress>> = Mutex::default();
    let follow = |at: Progress| {
        told.lock().expect("one thread").push(at);
        ControlFlow::Continue(())
    };
    diagnose(&evidence, &file, &options, &follow).expect("an answer");
    let told = told.into_inner().expect("one thread");
    assert!(told.is_sorted_by_key(|at| at.done), "{told:?}");
    assert!(told.iter().all(|at| at.total == STAGES));
    assert_eq!(told.last().map(|at| (at.stage, at.done)), Some((Stage::Correction, STAGES)));
    let stop = |at: Progress| match at.stage {
        Stage::Search => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let stopped = diagnose(&evidence, &file, &options, &stop).err();
    assert_eq!(stopped, Some(Error::Cancelled));
}

//! What is no physics changes nothing: the order of runs, the side that is called left, the frame
//! of the world, the origin of time.

use std::collections::BTreeSet;
use std::sync::LazyLock;
use trackdyn_core::Pose;
use trackdyn_diagnose::diagnosis::Kind;
use trackdyn_diagnose::{Diagnosis, Evidence, Options, Settings, diagnose, unobserved};
use trackdyn_drive::ScheduleKind;
use trackdyn_drive::sensors::Preset;
use trackdyn_model::VehicleFile;
use trackdyn_recording::{Recording, UncheckedRun};
use trackdyn_tests::concealed::{Drive, members, named, owned, recording, runs, sensors};

/// Part of the half width of an interval by which an image's estimate may differ.
///
/// A fit ends where a step lowers χ² by less than 0.2, which is 0.45 standard deviations or a
/// quarter of the half width; its difference quotients step to one side, which an image exchanges.
const MAX_DIFFERENCE: f64 = 0.25;

/// A drive of so many runs with something concealed.
fn drive(concealed: &[&str], count: usize, seed: u64) -> Recording {
    let vehicle = owned(concealed).vehicle;
    let runs = runs(ScheduleKind::Manual, count, seed);
    let drive = Drive::new(&vehicle, concealed, &runs, seed).expect("it drives");
    drive.recording(&sensors(Preset::Laboratory), seed)
}

fn diagnosed(recording: &Recording, file: &VehicleFile) -> Diagnosis {
    let evidence = Evidence::of_recording(recording, file.vehicle.gauge, &Settings::default())
        .expect("enough");
    diagnose(&evidence, file, &Options::default(), &unobserved).expect("a diagnosis")
}

/// What left and right tell apart: a resistance and encoders that differ.
const SPLIT: [&str; 2] = ["resistance-split:difference=0.08", "encoder-scale:left=0.98,right=1.01"];

/// A drive with that, and its diagnosis.
static ORIGINAL_DRIVE: LazyLock<(Recording, Diagnosis)> = LazyLock::new(|| {
    let recording = drive(&SPLIT, 4, 3);
    let diagnosis = diagnosed(&recording, &owned(&SPLIT));
    for wanted in ["resistance-split", "encoder-scale"] {
        assert!(named(&diagnosis).iter().any(|(_, members)| members.contains(wanted)), "{wanted}");
    }
    (recording, diagnosis)
});

/// The recording with all rows of each run changed.
fn changed(of: &Recording, change: impl Fn(&mut UncheckedRun)) -> Recording {
    let rows = of.runs().iter().map(|run| {
        let mut rows = run.clone().into_rows();
        change(&mut rows);
        rows
    });
    recording(rows.collect())
}

/// A named parameter with half the width of its interval.
fn parameter(diagnosis: &Diagnosis, effect: &str, key: &str) -> (f64, f64) {
    let named = diagnosis.answer.missing.iter().find(|one| members(one).contains(effect));
    let parameters = &named.unwrap_or_else(|| panic!("{effect} is not named")).parameters;
    let interval = parameters
        .iter()
        .find(|interval| interval.unknown.parameter().is_some_and(|one| one.key == key));
    let interval = interval.unwrap_or_else(|| panic!("{effect} has no {key}"));
    (interval.value, (interval.high - interval.low) / 2.0)
}

/// Both name the same, with the same parameters but for `image`, which says what becomes of a
/// parameter (its key) and its value.
fn assert_images(
    one: &Diagnosis,
    other: &Diagnosis,
    within: f64,
    image: impl Fn(&str, &str, f64) -> (String, f64),
) {
    assert_eq!(named(one), named(other));
    assert_eq!(one.answer.status, other.answer.status);
    println!("{:?}", named(one));
    for missing in &one.answer.missing {
        for interval in &missing.parameters {
            let card = missing.verdict.effect.card();
            let key = interval.unknown.parameter().expect("of an effect").key;
            let (key, wanted) = image(card.id, key, interval.value);
            let (found, half) = parameter(other, card.id, &key);
            let off = (found - wanted).abs() / half;
            println!("{} {key}: {wanted} and {found}, off by {off:.1e} half widths", card.id);
            assert!(off < within, "{} {key}: {found} instead of {wanted} ({half})", card.id);
        }
    }
}

fn same(_: &str, key: &str, value: f64) -> (String, f64) {
    (key.to_owned(), value)
}

#[test]
fn shuffled_runs_say_the_same() {
    let (recording, one) = &*ORIGINAL_DRIVE;
    // Runs are taken in the order of their numbers.
    let shuffled = changed(recording, |run| {
        run.id = [2, 0, 3, 1][usize::try_from(run.id).expect("a number from 0")];
    });
    let other = diagnosed(&shuffled, &owned(&SPLIT));
    // Sums in another order: rounding, in places where a fit that ends a step earlier would be
    // seen.
    assert_images(one, &other, 1e-3, same);
    for (one, other) in one.answer.missing.iter().zip(&other.answer.missing) {
        let [one, other] = [one, other].map(|missing| missing.verdict.support.ln_bayes_factor);
        assert!((one - other).abs() < 1e-3 * one.abs(), "ln Bayes factors {one} and {other}");
    }
}

#[test]
fn a_mirrored_recording_has_the_mirrored_answer() {
    let (recording, one) = &*ORIGINAL_DRIVE;
    let mirrored = changed(recording, |run| {
        for track in &mut run.tracks.samples {
            std::mem::swap(&mut track.v_left, &mut track.v_right);
        }
        for sample in &mut run.poses.samples {
            sample.pose = Pose::new(sample.pose.x, -sample.pose.y, -sample.pose.yaw);
        }
    });
    let mut file = owned(&SPLIT);
    file.vehicle.cog[0] = -file.vehicle.cog[0];
    let other = diagnosed(&mirrored, &file);
    assert_images(one, &other, MAX_DIFFERENCE, |effect, key, value| match (effect, key) {
        ("encoder-scale", "left") => ("right".to_owned(), value),
        ("encoder-scale", "right") => ("left".to_owned(), value),
        ("resistance-split", _) | (_, "yaw_deg") => (key.to_owned(), -value),
        _ => (key.to_owned(), value),
    });
    assert_eq!(one.answer.broken, other.answer.broken);
}

#[test]
fn another_frame_of_the_world_turns_directions_with_it() {
    /// Degrees; directions are tried every 45.
    const TURN: f64 = 110.0;
    const CONCEALED_EFFECT: [&str; 1] = ["slope:angle_deg=0.7,uphill_deg=0"];
    let recording = drive(&CONCEALED_EFFECT, 6, 1);
    let file = owned(&CONCEALED_EFFECT);
    let one = diagnosed(&recording, &file);
    let slope = |(kind, members): &(Kind, BTreeSet<&str>)| {
        *kind == Kind::Physics && members.contains("slope")
    };
    assert!(named(&one).iter().any(slope), "{:?}, {:?}", named(&one), one.answer.refused);
    let frame = Pose::new(7.0, -3.0, TURN.to_radians());
    let turned = changed(&recording, |run| {
        for sample in &mut run.poses.samples {
            // new_from_body = new_from_world · world_from_body; yaw stays continuous
            let yaw = sample.pose.yaw + frame.yaw;
            let moved = frame.compose(&sample.pose);
            sample.pose = Pose::new(moved.x, moved.y, yaw);
        }
    });
    let other = diagnosed(&turned, &file);
    assert!(named(&other).iter().any(slope), "{:?}, {:?}", named(&other), other.answer.refused);
    assert_images(&one, &other, MAX_DIFFERENCE, |_, key, value| {
        if key != "uphill_deg" {
            return (key.to_owned(), value);
        }
        let (there, _) = parameter(&other, "slope", "uphill_deg");
        let turns = ((value + TURN - there) / 360.0).round();
        (key.to_owned(), value + TURN - 360.0 * turns)
    });
}

/// The recording with stamps that count from elsewhere.
fn at_other_times(recording: &Recording, by: f64) -> Recording {
    changed(recording, |run| {
        run.tracks.samples.iter_mut().for_each(|sample| sample.t += by);
        run.poses.samples.iter_mut().for_each(|sample| sample.t += by);
    })
}

#[test]
fn the_origin_of_time_says_nothing() {
    let (recording, one) = &*ORIGINAL_DRIVE;
    // Stamps since 1970, as robots write them: rounded to 0.2 µs.
    let other = diagnosed(&at_other_times(recording, 1.6e9), &owned(&SPLIT));
    assert_images(one, &other, MAX_DIFFERENCE, same);
    assert_eq!(one.answer.broken, other.answer.broken);
}

#[test]
fn a_drift_with_time_is_found_whatever_time_counts_from() {
    const CONCEALED_EFFECT: [&str; 1] = ["friction-drift:rate_1_per_s=0.0006"];
    let recording = drive(&CONCEALED_EFFECT, 6, 3);
    let file = owned(&CONCEALED_EFFECT);
    let one = diagnosed(&recording, &file);
    let drift = |of: &Diagnosis| named(of).iter().any(|(_, m)| m.contains("friction-drift"));
    assert!(drift(&one), "{:?}", named(&one));
    let other = diagnosed(&at_other_times(&recording, 1.6e9), &file);
    assert!(drift(&other), "{:?} with stamps since 1970", named(&other));
}

#[test]
fn a_vehicle_file_that_says_it_all_leaves_nothing_missing() {
    let (recording, _) = &*ORIGINAL_DRIVE;
    let mut file = owned(&SPLIT);
    for known in SPLIT {
        file.effects.insert(known.parse().expect("an effect"));
    }
    let found = diagnosed(recording, &file);
    let beside_clock = named(&found).into_iter().filter(|(_, m)| !m.contains("time-offset"));
    assert_eq!(beside_clock.count(), 0, "{:?}", named(&found));
}

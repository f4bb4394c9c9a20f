//! Distances between the ICRs, identified from public recordings of real robots.
//!
//! Source: independent fits of yaw rates in the steady parts, whose makers do not say whether the
//! gyroscope's or the poses'. Goal: x_r − x_l within 2 %, from poses alone. Conditions: no α; of
//! the Warthog the windows that are marked as steady; of the Husky those whose stamps are right
//! (docs/validation.md says what is wrong with the others).

use crate::validation::recordings::{at_20_hertz, identified, steady};
use trackdyn_estimate::identification::{Options, icrs_alone};
use trackdyn_estimate::{Clock, Interval, Nuisance, clock, gyroscope, with_gyroscope};
use trackdyn_recording::{Recording, RunList};
use trackdyn_tests::real_recording;

/// Largest difference, %: the goal.
const GOAL: f64 = 2.0;

/// Difference in standard errors of ours that one of five recordings has in 5 % of the cases.
const MAX_CHANCE_DIFFERENCE: f64 = 2.6;

/// Which runs count.
type Choice = fn(&Recording) -> RunList;

/// Recording, gauge (m), runs, independent x_r − x_l (m).
const CASES: [(&str, f64, Choice, f64); 5] = [
    ("marmotte-boreal", 0.52, Recording::run_list, 0.624),
    ("warthog-asphalt-a", 1.08, steady, 1.83),
    ("warthog-asphalt-slow", 1.08, steady, 1.89),
    ("warthog-gravel", 1.08, steady, 1.79),
    ("husky-tile", 0.555, at_20_hertz, 1.044),
];

#[test]
fn distances_agree_with_independent_fits() {
    let mut rows = Vec::new();
    for (name, gauge, choice, independent) in CASES {
        let Some(recording) = real_recording(name) else { continue };
        let part = recording.of_runs(&choice(&recording)).expect(name);
        let found = identified(&part, gauge, &[]);
        let gap = found.fits[0].least_squares.as_ref().expect(name).gap();
        let error = 100.0 * (gap.value / independent - 1.0);
        let row =
            format!("| {:.3} ({:.3}) | {independent} | {error:+.1} % |", gap.value, gap.deviation);
        println!("{name} {row}");
        let chance = 100.0 * MAX_CHANCE_DIFFERENCE * gap.deviation / independent;
        rows.push((name, row, error, chance));
    }
    let page = include_str!("../../../docs/validation.md").lines().collect::<Vec<_>>();
    for (name, row, error, chance) in rows {
        let is_there = |line: &&str| line.contains(name) && line.ends_with(&row);
        assert!(page.iter().any(is_there), "docs/validation.md: {name} {row}");
        assert!(error.abs() < GOAL.max(chance), "{name}: {error:+.1} %");
    }
}

/// Poses of the Warthog on grass have stamps that err by 0.1 s; its gyroscope has not. The
/// independent fit is of its yaw rates.
#[test]
fn a_gyroscope_halves_the_error_of_the_distance_on_grass() {
    const GYROSCOPE_DISTANCE: f64 = 1.823;
    let Some(recording) = real_recording("warthog-grass") else { return };
    let clock = Clock::of(&recording, None, &clock::Settings::default()).expect("turns");
    let corrected = with_gyroscope(&recording, clock.tau(), &gyroscope::Settings::default())
        .expect("it serves");
    let gap = |recording: &Recording, yaw_scale: f64| {
        let options = Options { yaw_scale, ..Options::new(1.08) };
        icrs_alone(recording, &options).expect("determined").gap()
    };
    let without = gap(&recording, 0.0);
    let with = gap(&corrected.recording, corrected.gyroscope.scale_deviation);
    let row = |of: &Interval| {
        let error = 100.0 * (of.value / GYROSCOPE_DISTANCE - 1.0);
        format!("{:.3} ({:.3}), {error:+.1} %", of.value, of.deviation)
    };
    let sentence = format!("{}; with `--gyroscope` {}", row(&without), row(&with));
    println!("{sentence}");
    assert!(with.deviation < 0.75 * without.deviation, "{sentence}");
    assert!((with.value / GYROSCOPE_DISTANCE - 1.0).abs() < GOAL / 100.0, "{sentence}");
    let page = include_str!("../../../docs/validation.md").split_whitespace();
    let page = page.collect::<Vec<_>>().join(" ");
    assert!(page.contains(&sentence), "docs/validation.md: {sentence}");
}

#[test]
fn stamps_that_are_stretched_stretch_the_distance() {
    let Some(recording) = real_recording("husky-tile") else { return };
    let distance = |runs: &RunList| {
        let part = recording.of_runs(runs).expect("runs");
        identified(&part, 0.555, &[]).fits[0]
            .least_squares
            .as_ref()
            .expect("determined")
            .gap()
            .value
    };
    let right = at_20_hertz(&recording);
    let is_stretched = |number: &i64| !right.numbers().contains(number);
    let all = recording.run_list();
    let stretched = RunList::new(all.numbers().iter().copied().filter(is_stretched));
    let (right, stretched) = (distance(&right), distance(&stretched));
    println!("20 Hz {right:.3} m, others {stretched:.3} m");
    // Their stamps run slow by 3 % on the mean; slip is the same.
    assert!((0.02..0.05).contains(&(stretched / right - 1.0)), "{right} {stretched}");
}

#[test]
fn clock_and_yaw_of_the_sensor_are_those_of_the_page() {
    let page = include_str!("../../../docs/validation.md");
    let mut stale = Vec::new();
    for (name, gauge, ..) in CASES {
        let Some(recording) = real_recording(name) else { continue };
        let wanted = [Nuisance::TimeOffset, Nuisance::SensorYaw];
        let found = identified(&recording, gauge, &wanted);
        let estimate = found.fits[0].least_squares.as_ref().expect(name);
        let [tau, psi] = wanted.map(|nuisance| estimate.nuisance(nuisance).expect("fitted"));
        let (clock, error) = (found.clock.tau(), found.clock.standard_error().expect("estimated"));
        let row = format!(
            "| {name} | {clock:.3} ({error:.3}) | {:.3} ({:.3}) | {:.1} ({:.1}) | {:.3} ({:.3}) |",
            tau.value,
            tau.deviation,
            psi.value.to_degrees(),
            psi.deviation.to_degrees(),
            estimate.gap().value,
            estimate.gap().deviation
        );
        println!("{row}");
        if !page.contains(&row) {
            stale.push(row);
        }
    }
    assert!(stale.is_empty(), "docs/validation.md does not have these rows:\n{}", stale.join("\n"));
}

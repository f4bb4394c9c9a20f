//! Driving that shows one side of things only: what needs the other side is not named.

use std::collections::BTreeSet;
use trackdyn_core::{Command, PerSide, Schedule};
use trackdyn_diagnose::Diagnosis;
use trackdyn_diagnose::diagnosis::Kind;
use trackdyn_diagnose::document::separate_by;
use trackdyn_drive::ScheduledRun;
use trackdyn_drive::sensors::Preset;
use trackdyn_model::Stationary;
use trackdyn_model::{Circumstance, Effects, Model, Vehicle};
use trackdyn_tests::concealed::{Drive, diagnosed, members, named, owned, sensors};

/// Time between commands, s.
const INTERVAL: f64 = 0.03;

/// Runs through these track speeds, 3 s each, with changes of 1 m/s² between them.
fn through(speeds: &[(f64, f64)], count: i64) -> Vec<ScheduledRun> {
    let run = |id: i64| {
        let mut now = PerSide::default();
        let mut commands = Vec::new();
        let turn = usize::try_from(id).expect("a number of a run") % speeds.len();
        // Each run begins with another one, so that nothing is always done at the same time.
        let order = speeds[turn..].iter().chain(&speeds[..turn]).chain(&[(0.0, 0.0)]);
        for &(left, right) in order {
            for _ in 0..100 {
                let towards = |now: f64, to: f64| now + (to - now).clamp(-INTERVAL, INTERVAL);
                now = PerSide::new(towards(now.left, left), towards(now.right, right));
                let t = INTERVAL * trackdyn_core::real(commands.len());
                commands.push(Command { t, speeds: now });
            }
        }
        ScheduledRun { id, schedule: Schedule::new(commands).expect("a schedule") }
    };
    (0..count).map(run).collect()
}

/// Arcs to the left, forward.
fn left_arcs() -> Vec<ScheduledRun> {
    let speeds = [(0.2, 0.5), (0.5, 0.9), (0.1, 0.4), (0.3, 0.9), (0.4, 0.6), (0.15, 0.75)];
    through(&speeds, 6)
}

/// Spins, both ways.
fn spins() -> Vec<ScheduledRun> {
    let speeds = [0.2, -0.6, 0.4, -0.2, 0.7, -0.4].map(|v| (-v, v));
    through(&speeds, 6)
}

fn diagnosis(runs: &[ScheduledRun], concealed: &[&str]) -> Diagnosis {
    let drive = Drive::new(&owned(concealed).vehicle, concealed, runs, 7).expect("it drives");
    diagnosed(&drive.recording(&sensors(Preset::Laboratory), 7), &owned(concealed)).expect("turns")
}

/// What is named beside the clock, which all these sensors have late.
fn beside_clock(diagnosis: &Diagnosis) -> Vec<(Kind, BTreeSet<&'static str>)> {
    named(diagnosis).into_iter().filter(|(_, m)| !m.contains("time-offset")).collect()
}

/// Error of the ICRs of the independent ground, whose contact is cut into shoes, m: 0.46 mm rms.
///
/// Where the robot turns one way all the time, yaw adds up and constants are known to less.
const SHOES: f64 = 1e-3;

/// Largest change of an ICR coordinate from the owner's vehicle to the corrected one, in a slow
/// spin, m.
fn moved(diagnosis: &Diagnosis) -> f64 {
    let spin = |vehicle: &Vehicle| {
        let model = Model::new(vehicle.clone(), Effects::none());
        let solver = Stationary::new(&model, &Circumstance::default());
        solver.solve(PerSide::new(-0.1, 0.1)).icrs.expect("it turns").to_array()
    };
    let (filed, corrected) = (spin(&owned(&[]).vehicle), spin(&diagnosis.corrected.vehicle));
    filed.iter().zip(corrected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn one_sided_driving_names_nothing_where_nothing_is_concealed() {
    for (name, runs) in [("left arcs", left_arcs()), ("spins", spins())] {
        let found = diagnosis(&runs, &[]);
        let moved = moved(&found);
        println!("{name}: ICRs moved by {:.3} mm, {:?}", 1e3 * moved, named(&found));
        for (kind, members) in beside_clock(&found) {
            assert!(
                kind == Kind::Constant && moved < SHOES,
                "{name}: {kind:?} {members:?}, {moved} m"
            );
        }
    }
}

/// What is concealed moves no more than constant ICRs in this driving: the answer is the class of
/// constants with it in it, or nothing.
fn assert_cannot_tell(runs: &[ScheduledRun], concealed: &str) {
    let id = concealed.split(':').next().expect("an id");
    let found = diagnosis(runs, &[concealed]);
    for (kind, members) in beside_clock(&found) {
        assert!(kind == Kind::Constant, "{concealed}: {kind:?} {members:?}");
        assert!(members.contains(id), "{concealed}: {members:?}");
        assert!(members.len() > 1, "{concealed}: {members:?}");
    }
}

#[test]
fn lugs_are_not_named_by_a_robot_that_never_reversed() {
    assert_cannot_tell(&left_arcs(), "directional-lugs:excess=0.15");
}

#[test]
fn motion_resistance_is_not_named_by_a_robot_that_only_spun() {
    assert_cannot_tell(&spins(), "motion-resistance:coefficient=0.15");
}

#[test]
fn driving_the_other_way_is_said_to_decide_where_it_does() {
    let found = diagnosis(&left_arcs(), &["directional-lugs:excess=0.15"]);
    let class = found.missing.iter().find(|one| members(one).contains("directional-lugs"));
    let class = class.expect("three numbers that differ from the file's");
    // Constant ICRs that lugs, too, may have moved: reversing tells.
    let decides = separate_by(class);
    let told = "driving forward and backward tells whether it is directional-lugs";
    assert!(decides.contains(told), "{decides}");
}

//! Real recordings in which something is hidden that a real sensor, robot or ground could do.
//!
//! Poses, speeds and ground are those of the recording; what is altered is said at each test.
//! Nobody knows all that is in a real recording, so that what is asked is the difference that the
//! alteration makes.

use std::collections::BTreeSet;
use std::sync::LazyLock;
use trackdyn_diagnose::diagnosis::Kind;
use trackdyn_diagnose::fit::Fit;
use trackdyn_diagnose::hypothesis::Unknown;
use trackdyn_diagnose::{Diagnosis, Evidence, Options, Settings, diagnose, unobserved};
use trackdyn_recording::UncheckedRun;
use trackdyn_recording::{Recording, Run};
use trackdyn_tests::concealed::{diagnosed, members, named, recording};
use trackdyn_tests::{real_recording, vehicle};

fn changed(run: &Run, change: impl Fn(&mut UncheckedRun)) -> UncheckedRun {
    let mut rows = UncheckedRun {
        id: run.id(),
        tracks: run.track_series().clone(),
        poses: run.pose_series().clone(),
        imu: run.imu_series().clone(),
    };
    change(&mut rows);
    rows
}

/// What was fitted as the sum of these parameters, claimed or not, and its standard deviation.
fn fitted(fit: &Fit, parameters: &[(&str, &str)]) -> (f64, f64) {
    let is_asked = |unknown: &Unknown| {
        let parts = unknown.card().zip(unknown.parameter());
        parts.is_some_and(|(card, parameter)| parameters.contains(&(card.id, parameter.key)))
    };
    let places: Vec<usize> =
        (0..fit.unknowns.len()).filter(|&k| is_asked(&fit.unknowns[k])).collect();
    let sum = places.iter().map(|&k| fit.hypothesis.get(fit.unknowns[k])).sum();
    let pairs = places.iter().flat_map(|&a| places.iter().map(move |&b| (a, b)));
    let variance: f64 = pairs.map(|pair| fit.solution.covariance[pair]).sum();
    (sum, variance.sqrt())
}

fn said(diagnosis: &Diagnosis) -> Vec<BTreeSet<&'static str>> {
    named(diagnosis).into_iter().map(|(_, members)| members).collect()
}

/// A recording as it was made, and what is said of it.
struct Real {
    vehicle: &'static str,
    recording: Recording,
    diagnosis: Diagnosis,
}

impl Real {
    /// None where the recording is not at hand.
    fn new(name: &str, vehicle: &'static str) -> Option<Self> {
        let recording = real_recording(name)?;
        let diagnosis = diagnosed(&recording, &self::vehicle(vehicle)).expect("turns");
        Some(Self { vehicle, recording, diagnosis })
    }

    /// What is said where every run is altered.
    fn altered(&self, change: impl Fn(&mut UncheckedRun)) -> Diagnosis {
        let runs = self.recording.runs().iter().map(|run| changed(run, &change)).collect();
        diagnosed(&recording(runs), &vehicle(self.vehicle)).expect("turns")
    }
}

static ASPHALT: LazyLock<Option<Real>> =
    LazyLock::new(|| Real::new("warthog-asphalt-a", "warthog"));
static HUSKY: LazyLock<Option<Real>> = LazyLock::new(|| Real::new("husky-tile", "husky-a200"));

/// Those that are at hand.
fn reals() -> impl Iterator<Item = &'static Real> {
    [&ASPHALT, &HUSKY].into_iter().filter_map(|real| real.as_ref())
}

/// Altered: stamps of the poses, 0.08 s later. Real: all else.
#[test]
fn poses_that_come_later_are_found() {
    const MORE_DELAY: f64 = 0.08;
    for real in reals() {
        let before = &real.diagnosis;
        let after = &real.altered(|run| {
            run.poses.samples.iter_mut().for_each(|pose| pose.t += MORE_DELAY);
        });
        // Wheels that follow late, poses that come late and a body that is slow to turn look alike
        // in windows of two seconds: which of them is named differs between both diagnoses. What is
        // there beside constants and instruments does not.
        let late = [("time-offset", "delay_s"), ("drivetrain-lag", "time_constant_s")];
        println!("{}: {:?}, then {:?}", real.vehicle, said(before), said(after));
        let [before, after] =
            [before, after].map(|diagnosis| fitted(&diagnosis.models.base.fit, &late));
        let (found, deviation) = (after.0 - before.0, after.1.hypot(before.1));
        println!("{found:.3} ± {deviation:.3} s later");
        assert!(
            (found - MORE_DELAY).abs() < 2.6 * deviation && deviation < MORE_DELAY / 2.0,
            "{found}"
        );
    }
}

/// Altered: speeds of the left wheels, as if they were 4 % larger than their encoders think. Real:
/// all else.
#[test]
fn a_larger_wheel_on_one_side_is_found() {
    const FILED_SCALE: f64 = 0.96;
    for real in reals() {
        let before = &real.diagnosis;
        let after = &real.altered(|run| {
            run.tracks.samples.iter_mut().for_each(|reading| reading.v_left *= FILED_SCALE);
        });
        let gain = |diagnosis: &Diagnosis| {
            fitted(&diagnosis.models.best.fit, &[("encoder-scale", "left")]).0
        };
        let found = gain(after) / gain(before);
        println!("{}: {found:.4} times: {:?}, then {:?}", real.vehicle, said(before), said(after));
        assert!((found * FILED_SCALE - 1.0).abs() < 0.005, "{found}");
        assert!(said(after).iter().any(|one| one.contains("encoder-scale")));
    }
}

/// Altered: every second window is one of gravel. Real: both halves. That there are two grounds is
/// not found: what holds is no more than that something is missing.
#[test]
fn gravel_among_asphalt_is_not_found() {
    let Some(Real { recording: asphalt, .. }) = &*ASPHALT else { return };
    let Some(gravel) = real_recording("warthog-gravel") else { return };
    let file = vehicle("warthog");
    let pairs = asphalt.runs().iter().zip(gravel.runs()).enumerate();
    let mixed = pairs.map(|(k, (asphalt, gravel))| {
        changed(if k % 2 == 0 { asphalt } else { gravel }, |run| {
            run.id = i64::try_from(k).expect("few");
        })
    });
    let diagnosis = diagnosed(&recording(mixed.collect()), &file).expect("turns");
    println!(
        "{} {:?} {:?}",
        diagnosis.answer.status.name(),
        said(&diagnosis),
        diagnosis.answer.broken
    );
    assert_ne!(diagnosis.answer.status.name(), "nothing-missing");
}

/// Withheld: the windows of the fastest third. Real: all.
#[test]
fn what_slow_driving_shows_forecasts_fast_driving() {
    let Some(real) = real_recording("warthog-gravel") else { return };
    let file = vehicle("warthog");
    let speed = |run: &Run| {
        let speeds =
            run.tracks().iter().map(|reading| (reading.v_left + reading.v_right).abs() / 2.0);
        speeds.fold(0.0, f64::max)
    };
    let mut order: Vec<usize> = (0..real.runs().len()).collect();
    order.sort_by(|a, b| speed(&real.runs()[*a]).total_cmp(&speed(&real.runs()[*b])));
    let held_out = order.split_off(2 * order.len() / 3);
    let evidence =
        Evidence::of_recording(&real, file.vehicle.gauge, &Settings::default()).expect("segments");
    let options = Options { held_out, ..Options::default() };
    let diagnosis = diagnose(&evidence, &file, &options, &unobserved).expect("turns");
    let physics = diagnosis.answer.missing.iter().filter(|missing| missing.kind == Kind::Physics);
    let physics: Vec<_> = physics.map(members).collect();
    println!("{physics:?} {:?}", diagnosis.evidence.errors);
    assert!(!physics.is_empty());
    assert!(diagnosis.evidence.errors.after < diagnosis.evidence.errors.before);
}

/// A vehicle file for asphalt, on ice: an independent model of four wheels finds a friction of
/// 0.098 and a radius of gyration of 0.54 m, and no delay. The windows were cut out of slides, and
/// the speeds of the wheels are held for 0.25 s.
#[test]
fn ice_is_inertia_and_little_friction_and_no_clock() {
    let Some(real) = Real::new("warthog-ice-6s", "warthog") else { return };
    let found = &real.diagnosis;
    let said = said(found);
    assert!(said.contains(&BTreeSet::from(["yaw-inertia"])), "{said:?}");
    assert!(said.contains(&BTreeSet::from(["centripetal"])), "{said:?}");
    let late = ["time-offset", "drivetrain-lag"];
    assert!(!said.iter().flatten().any(|one| late.contains(one)), "{said:?}");
    let file = vehicle(real.vehicle).vehicle.friction.along;
    let [friction, ..] = found.friction_by_inertia().expect("another friction").map(|by| by * file);
    assert!((0.08..0.13).contains(&friction), "{friction}");
    let errors = found.evidence.errors;
    assert!(errors.after < 0.6 * errors.before, "{errors:?}");
}

//! Effects that explain a recording alike are one answer.

use nalgebra::DVector;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::sync::Arc;
use trackdyn_diagnose::candidate::{Beside, Catalogue, Variant, candidates};
use trackdyn_diagnose::diagnosis::{Kind, Models};
use trackdyn_diagnose::equations::Equations;
use trackdyn_diagnose::hypothesis::neutral;
use trackdyn_diagnose::search::Search;
use trackdyn_diagnose::{Diagnosis, Settings};
use trackdyn_drive::sensors::{Preset, Sensors};
use trackdyn_drive::{ScheduleKind, ScheduleOptions, ScheduledRun};
use trackdyn_model::EffectId;
use trackdyn_tests::concealed::{Drive, diagnosed, named, owned, runs, sensors};

/// Effects that only move the constant ICRs, whatever is driven.
const CONSTANTS: [&str; 8] = [
    "friction-anisotropy",
    "cog-shift",
    "friction-split",
    "friction-gradient",
    "pressure-concentration",
    "cohesion",
    "bulldozing",
    "sensor-lever-arm",
];

/// The diagnosis of a short drive by hand.
fn diagnosis(concealed: &str, sensors: &Sensors) -> Diagnosis {
    diagnosis_of(&runs(ScheduleKind::Manual, 4, 11), concealed, sensors)
}

fn diagnosis_of(runs: &[ScheduledRun], concealed: &str, sensors: &Sensors) -> Diagnosis {
    let vehicle = owned(&[concealed]).vehicle;
    let drive = Drive::new(&vehicle, &[concealed], runs, 11).expect("it drives");
    diagnosed(&drive.recording(sensors, 11), &owned(&[concealed])).expect("enough")
}

fn id(concealed: &str) -> &str {
    concealed.split(':').next().expect("an id")
}

/// Slow driving, in which the centripetal force (a fortieth of the friction's range) moves no ICR:
/// nothing but three numbers can be told.
fn slow() -> Vec<ScheduledRun> {
    let options = ScheduleOptions {
        runs: Some(4),
        seed: 11,
        fastest: 0.2,
        duration: Some(45.0),
        ..ScheduleOptions::default()
    };
    ScheduleKind::Manual.generate(&options).expect("a schedule")
}

/// What is named beside the clock, where that is not one answer with all of the class; none where
/// it is.
fn split(concealed: &str) -> Option<String> {
    let found = diagnosis_of(&slow(), concealed, &sensors(Preset::Laboratory));
    let beside_clock = named(&found).into_iter().filter(|(_, m)| !m.contains("time-offset"));
    let beside_clock: Vec<_> = beside_clock.collect();
    let whole = |members: &BTreeSet<&str>| CONSTANTS.iter().all(|id| members.contains(id));
    match beside_clock.as_slice() {
        [(Kind::Constant, members)] if whole(members) => None,
        other => Some(format!("{concealed}: {other:?}")),
    }
}

#[test]
fn the_class_of_constants_is_one_answer() {
    let concealed = ["friction-gradient:gradient=0.3", "sensor-lever-arm:x_m=0.05,y_m=0.08"];
    let split: Vec<String> = concealed.par_iter().filter_map(|one| split(one)).collect();
    assert!(split.is_empty(), "{split:#?}");
}

#[test]
#[ignore = "eight drives: cargo test --release -p trackdyn-tests --test diagnosis -- --ignored"]
fn every_member_of_the_class_of_constants_is_one_answer() {
    let split: Vec<String> = CONSTANTS.par_iter().filter_map(|one| split(one)).collect();
    assert!(split.is_empty(), "{split:#?}");
}

/// At speed the centripetal force, which the owner knows, tells a little more than three numbers:
/// whatever that leaves of the class, the truth is in it.
#[test]
#[ignore = "eight drives: cargo test --release -p trackdyn-tests --test diagnosis -- --ignored"]
fn at_speed_the_truth_is_in_the_class_of_constants() {
    let wrong = CONSTANTS.par_iter().filter_map(|truth| {
        let found = diagnosis(truth, &sensors(Preset::Laboratory));
        let beside_clock = named(&found).into_iter().filter(|(_, m)| !m.contains("time-offset"));
        let beside_clock: Vec<_> = beside_clock.collect();
        let is_right = matches!(beside_clock.as_slice(), [(_, members)] if members.contains(truth));
        (!is_right).then(|| format!("{truth}: {beside_clock:?}"))
    });
    let wrong: Vec<String> = wrong.collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// What a diagnosis names beyond what its evidence can tell apart.
///
/// A single name is too much where it is not the truth, or where another effect is closer than the
/// rules allow: by the signatures beside the base, its own at the size that was found.
fn over_claims(concealed: &str, preset: Preset) -> Vec<String> {
    let found = diagnosis(concealed, &sensors(preset));
    let truth = id(concealed);
    let mut wrong = Vec::new();
    for missing in found.answer.missing.iter().filter(|missing| missing.kind == Kind::Physics) {
        let ids: Vec<&str> = missing.verdict.one_of.iter().map(|&e| e.name()).collect();
        if !ids.contains(&truth) {
            wrong.push(format!("{concealed}: {ids:?}"));
            continue;
        }
        let [only] = missing.verdict.one_of[..] else { continue };
        for (other, apart) in separations(&found, only) {
            if apart < Settings::default().answer.min_separation {
                let other = other.name();
                wrong.push(format!("{concealed}: {truth} alone, {apart:.1} from {other}"));
            }
        }
    }
    wrong
}

/// Every variant of every other candidate, with the part of an effect's signature, at the size that
/// was found, that neither it nor the base can stand for, in standard deviations.
fn separations(found: &Diagnosis, effect: EffectId) -> Vec<(EffectId, f64)> {
    let (Models { base, best, .. }, evidence) = (&found.models, &found.evidence.seen);
    let active = best.fit.hypothesis.effect(effect).expect("what is named is there");
    let own = Variant { effect, values: active.values().to_vec() };
    let parameters = effect.card().parameters;
    let sizes = own.sizes().into_iter().map(|k| own.values[k] - neutral(&parameters[k]));
    let sizes = DVector::from_iterator(own.sizes().len(), sizes);
    let others = candidates(&EffectId::all().collect::<Vec<_>>(), &base.instruments, evidence);
    let others = others.into_iter().filter(|other| other.effect != effect);
    let tried: Vec<Variant> = std::iter::once(own).chain(others).collect();
    let entries = Beside::new(&base.fit.hypothesis, evidence).signatures(&tried);
    let catalogue = Catalogue { entries };
    let search = Search::new(evidence.clone(), Arc::clone(base), catalogue);
    let (nothing, entries) = (search.nothing(), &search.catalogue.entries);
    let apart = |rival: usize| {
        let Equations { normal, priors, free, groups } = search.equations(&nothing, &[0, rival]);
        let projected = normal.projected(&[&free[..], &groups[1]].concat(), &priors);
        let square = sizes.dot(&(projected.information(&groups[0]) * &sizes));
        (entries[rival].0.effect, square.max(0.0).sqrt())
    };
    assert_eq!(entries[0].0.effect, effect, "its signature is there");
    (1..entries.len()).map(apart).collect()
}

/// Small sizes and far places, where a neighbour does as well.
const CLOSE_CASES: [&str; 10] = [
    "drivetrain-lag:time_constant_s=0.03",
    "viscous-friction:growth_s_per_m=0.2",
    "stribeck-friction:excess=0.1",
    "friction-creep:speed_m_per_s=0.01",
    "motion-resistance:coefficient=0.015",
    "hitch-drag:drag=0.015",
    "belt-slip:slip=0.02",
    "slope:angle_deg=0.6",
    "tether:tension_n=60,anchor_x_m=400,anchor_y_m=300",
    "resistance-split:difference=0.02",
];

#[test]
fn close_neighbours_are_not_split() {
    let wrong = over_claims("friction-creep:speed_m_per_s=0.01", Preset::Laboratory);
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
#[ignore = "twenty drives: cargo test --release -p trackdyn-tests --test diagnosis -- --ignored"]
fn no_close_neighbours_are_split() {
    let cases = CLOSE_CASES.par_iter().flat_map(|one| {
        [Preset::Laboratory, Preset::Field].into_par_iter().map(move |preset| (one, preset))
    });
    let wrong: Vec<String> = cases.flat_map(|(one, preset)| over_claims(one, preset)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Poses in time with the encoders: what comes late is the robot.
fn in_time() -> Sensors {
    let mut sensors = sensors(Preset::Laboratory);
    sensors.pose.delay -= sensors.clock_offset();
    sensors
}

/// A lag of the drivetrain far below the time of a change of speed, and a clock that is late,
/// differ by less than poses err in a short drive.
#[test]
fn a_lag_and_a_late_clock_are_one_answer() {
    /// Delay of either, s.
    const DELAY: f64 = 0.03;
    let lag = EffectId::of("drivetrain-lag").expect("an effect");
    let typical = lag.card().parameters[0].typical;
    let mut split = Vec::new();
    for concealed in ["drivetrain-lag:time_constant_s", "time-offset:delay_s"] {
        let found = diagnosis(&format!("{concealed}={DELAY}"), &in_time());
        // The part of a lag that a clock, which is free, cannot stand for goes as the square of its
        // time: 1/(1 + s T) − exp(−s T) = (s T)²/2 + …
        let of = &found.limits.resemblance;
        let place = of.effects.iter().position(|effect| *effect == lag);
        let apart = place.map(|place| of.detection[place] * (DELAY / typical).powi(2));
        println!("{concealed}: {apart:?} apart, {:?}", named(&found));
        let late = named(&found).into_iter().filter(|(_, members)| {
            members.contains("time-offset") || members.contains("drivetrain-lag")
        });
        let late: Vec<_> = late.collect();
        assert!(!late.is_empty(), "{concealed}: {DELAY} s are not seen");
        let least = Settings::default().answer.min_separation;
        let is_twin = apart.is_some_and(|apart| apart < least);
        if is_twin && late.iter().any(|(_, members)| members.len() < 2) {
            split.push(format!("{concealed}: {apart:?} apart, {late:?}"));
        }
    }
    assert!(split.is_empty(), "{split:#?}");
}

//! Comparisons of two sets of drives: equal robots on other schedules, and robots that differ.

use rayon::prelude::*;
use trackdyn_diagnose::Resampling;
use trackdyn_diagnose::compare::{Comparison, Status, compare, words};
use trackdyn_diagnose::diagnosis::Examination;
use trackdyn_diagnose::progress::Watch;
use trackdyn_drive::ScheduleKind;
use trackdyn_drive::sensors::Preset;
use trackdyn_model::Vehicle;
use trackdyn_tests::concealed::{Drive, examined, owned, runs, sensors};

/// A robot with something concealed, and with other numbers.
fn set(concealed: &[&str], seed: u64, change: fn(&mut Vehicle)) -> Examination {
    let file = owned(&[]);
    let mut vehicle = file.vehicle.clone();
    change(&mut vehicle);
    let runs = runs(ScheduleKind::Manual, 8, seed);
    let drive = Drive::new(&vehicle, concealed, &runs, seed).expect("it drives");
    examined(&drive.recording(&sensors(Preset::Laboratory), seed), &file).expect("an answer")
}

fn compared(sim: &Examination, real: &Examination) -> Comparison {
    compare([sim, real], &owned(&[]), Resampling::default(), &Watch::none()).expect("an answer")
}

/// Effects of which each explains a difference, of all differences.
fn named(comparison: &Comparison) -> Vec<Vec<&'static str>> {
    let differences = comparison.differences.iter();
    let of = differences.map(|one| one.one_of.iter().map(|effect| effect.name()).collect());
    of.collect()
}

fn say(what: &str, comparison: &Comparison) {
    println!("{what}: {} {:?}", comparison.status().name(), named(comparison));
    for one in &comparison.differences {
        println!("    {}", words::sentence(one));
    }
}

#[test]
fn equal_robots_differ_in_nothing() {
    let sets: Vec<Examination> =
        (1..=7).into_par_iter().map(|seed| set(&[], seed, |_| ())).collect();
    let pairs = sets.windows(2).map(|pair| compared(&pair[0], &pair[1]));
    let wrong: Vec<_> = pairs
        .inspect(|found| say("plain", found))
        .filter(|found| found.status() != Status::NothingDiffers)
        .map(|found| named(&found))
        .collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn what_differs_is_named_or_stands_in_its_class() {
    let plain = set(&[], 20, |_| ());
    let none: fn(&mut Vehicle) = |_| ();
    let cases: [(&str, &[&str], fn(&mut Vehicle)); 8] = [
        ("friction-anisotropy", &[], |vehicle| vehicle.friction.across *= 1.25),
        ("cog-shift", &[], |vehicle| vehicle.cog[1] += 0.04),
        ("cog-shift", &[], |vehicle| vehicle.cog[0] += 0.03),
        ("load-transfer", &["load-transfer:cog_height_m=0.25"], none),
        ("hitch-drag", &["hitch-drag"], none),
        ("slope", &["slope:angle_deg=4"], none),
        ("yaw-inertia", &["yaw-inertia:strength=2"], none),
        ("stribeck-friction", &["stribeck-friction"], none),
    ];
    let wrong: Vec<_> = cases
        .into_par_iter()
        .zip(21..)
        .filter_map(|((expected, concealed, change), seed)| {
            let found = compared(&plain, &set(concealed, seed, change));
            say(expected, &found);
            let is_named = named(&found).iter().any(|class| class.contains(&expected));
            (!is_named).then(|| (expected, found.status().name(), named(&found)))
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

//! Comparisons of two sets of drives: equal robots on other schedules, and robots that differ.

use rayon::prelude::*;
use trackdyn_diagnose::Resampling;
use trackdyn_diagnose::compare::{Comparison, Status, Which, compare, words};
use trackdyn_diagnose::diagnosis::Examination;
use trackdyn_diagnose::progress::Watch;
use trackdyn_drive::ScheduleKind;
use trackdyn_drive::sensors::Preset;
use trackdyn_model::{EffectId, Vehicle};
use trackdyn_tests::concealed::{Drive, examined, owned, runs, sensors};

/// What is expected to be named, what is concealed, and what changes of the vehicle.
type Case = (&'static str, &'static [&'static str], fn(&mut Vehicle));

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

/// Seeds of cases, one after the other.
fn seed_of(first: u64, place: usize) -> u64 {
    first + place as u64
}

fn say(what: &str, comparison: &Comparison) {
    println!("{what}: {} {:?}", comparison.status().name(), named(comparison));
    for one in &comparison.differences {
        println!("    {}", words::sentence(one));
    }
    for one in words::refused(comparison) {
        println!("    refused {one}");
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
    let cases: [Case; 8] = [
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
        .enumerate()
        .filter_map(|(place, (expected, concealed, change))| {
            let found = compared(&plain, &set(concealed, seed_of(21, place), change));
            say(expected, &found);
            let is_named = named(&found).iter().any(|class| class.contains(&expected));
            (!is_named).then(|| (expected, found.status().name(), named(&found)))
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// A centre of gravity above the ground that SIM lacks: its size there stands at its bound.
#[test]
fn what_one_set_alone_has_is_named_and_brings_the_simulator_closer() {
    let plain = set(&[], 3, |_| ());
    let high = set(&["load-transfer:cog_height_m=0.2"], 4, |_| ());
    let found = compared(&plain, &high);
    say("high", &found);
    let [one] = &found.differences[..] else { panic!("{}: {:?}", found.place(), found.effects) };
    let height = EffectId::of("load-transfer").expect("an effect");
    assert!(one.one_of.contains(&height), "{:?}", one.one_of);
    assert_eq!(one.which, Which::Second);
    let [none, some] = &one.group.numbers[0].each;
    assert!(none.high < 0.05, "{none:?}");
    assert!((some.low..=some.high).contains(&0.2), "{some:?}");
    let [sim, corrected, _] = found.closer.errors;
    assert!(corrected < sim, "{sim} {corrected}");
    // the other way round the simulator has it alone
    let found = compared(&high, &plain);
    assert!(matches!(&found.differences[..], [one] if one.which == Which::First));
    let other = set(&["load-transfer:cog_height_m=0.2"], 6, |_| ());
    let found = compared(&high, &other);
    say("both high", &found);
    assert_eq!(found.status(), Status::NothingDiffers, "{}", found.place());
    assert_eq!(found.common().collect::<Vec<_>>(), [height]);
}

/// Laws that the catalogue does not have: in one set alone they differ, whatever is named.
#[test]
fn what_no_catalogue_has_is_a_difference_all_the_same() {
    let plain = set(&[], 30, |_| ());
    let laws = ["brushed-ground", "steering-grip", "warm-rubber:softening=1"];
    let wrong: Vec<_> = laws
        .into_par_iter()
        .enumerate()
        .filter_map(|(place, law)| {
            let found = compared(&plain, &set(&[law], seed_of(31, place), |_| ()));
            say(law, &found);
            (found.status() != Status::Unexplained).then(|| (law, found.status().name()))
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

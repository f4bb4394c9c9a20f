//! Intervals end where the likelihood says.

use trackdyn_diagnose::fit::Fit;
use trackdyn_diagnose::hypothesis::Unknown;
use trackdyn_diagnose::prior::prior;
use trackdyn_diagnose::uncertainty::Interval;
use trackdyn_diagnose::{Diagnosis, Evidence, Options, Settings, diagnose, unobserved};
use trackdyn_drive::ScheduleKind;
use trackdyn_drive::sensors::Preset;
use trackdyn_tests::concealed::{Drive, members, owned, runs, sensors};

/// Other ground in one place: neither its place nor its radius acts in proportion.
const PATCH: &str = "terrain-patch:x_m=0.4,y_m=0.3,radius_m=1.5,ratio=1.3";

/// By how much twice the misfit, all else fitted anew, has risen where a number is held at a value.
fn risen(diagnosis: &Diagnosis, held: Unknown, value: f64) -> f64 {
    let (evidence, best) = (&diagnosis.evidence.seen, &diagnosis.models.best);
    let others = best.fit.unknowns.iter().copied().filter(|unknown| *unknown != held);
    let others: Vec<Unknown> = others.collect();
    let start = best.fit.hypothesis.with(held, value);
    let fit = Fit::new(start, &others, evidence, None);
    let known = prior(&fit.hypothesis, held, evidence);
    let cost = |value: f64| ((value - known.mean) / known.deviation).powi(2);
    fit.objective + cost(value) - best.fit.objective
}

/// Fits from nothing but the numbers themselves, without the slopes and starts that the search for
/// the ends takes over.
///
/// The edges of a patch make the misfit rough: a single end may be caught beside the minimum of the
/// others.
#[test]
fn both_ends_are_equally_unlikely_with_all_else_fitted_anew() {
    /// 95 % of one number, at the least: where noise is what it is taken for and runs are many.
    const NORMAL_CHI_SQUARE: f64 = 3.84;
    /// Ends are found to 3 % of the width, which twice the misfit goes with the square of; fits end
    /// 0.2 above the minimum.
    const END_TOLERANCE: f64 = 0.2;
    const DRIVES: std::ops::Range<u64> = 5..8;
    let mut unequal = Vec::new();
    let mut most_lopsided: f64 = 0.0;
    for seed in DRIVES {
        let diagnosis = diagnosed(seed);
        let patch =
            diagnosis.answer.missing.iter().find(|one| members(one).contains("terrain-patch"));
        let patch = patch.expect("a patch that shows");
        for &Interval { unknown, value, low, high } in &patch.parameters {
            let [below, above] = [low, high].map(|end| risen(&diagnosis, unknown, end));
            let key = unknown.parameter().expect("of an effect").key;
            println!("{key} = {value} [{low}, {high}]: {below} and {above}");
            assert!(
                below.min(above) > (1.0 - END_TOLERANCE) * NORMAL_CHI_SQUARE,
                "{key}: {below} and {above}"
            );
            unequal.push((below / above).ln().abs());
            most_lopsided = most_lopsided.max(((high - value) / (value - low)).ln().abs());
        }
    }
    unequal.sort_by(f64::total_cmp);
    let three_of_four = unequal[3 * unequal.len() / 4];
    assert!(three_of_four < END_TOLERANCE, "ends differ: {unequal:?}");
    assert!(most_lopsided > 0.1, "a parabola would have done: {most_lopsided}");
}

/// A diagnosis of a drive over the patch.
fn diagnosed(seed: u64) -> Diagnosis {
    let vehicle = owned(&[PATCH]).vehicle;
    let schedule = runs(ScheduleKind::Manual, 6, seed);
    let drive = Drive::new(&vehicle, &[PATCH], &schedule, seed).expect("it drives");
    let recording = drive.recording(&sensors(Preset::Laboratory), seed);
    let evidence =
        Evidence::of_recording(&recording, vehicle.gauge, &Settings::default()).expect("enough");
    diagnose(&evidence, &owned(&[PATCH]), &Options::default(), &unobserved).expect("a diagnosis")
}

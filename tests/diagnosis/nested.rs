//! A hypothesis with one effect more never fits worse: the effect may be as good as absent.

use rayon::prelude::*;
use trackdyn_diagnose::base::Base;
use trackdyn_diagnose::candidate::{Beside, Catalogue, candidates};
use trackdyn_diagnose::evidence::Evidence;
use trackdyn_diagnose::noise::with_remaining_noise;
use trackdyn_diagnose::progress::Watch;
use trackdyn_diagnose::search::Search;
use trackdyn_diagnose::{Settings, Weighted};
use trackdyn_drive::sensors::Preset;
use trackdyn_drive::{ScheduleKind, ScheduleOptions};
use trackdyn_model::EffectId;
use trackdyn_tests::concealed::{Drive, owned, sensors};

/// Rise of twice the objective that is rounding, and the end of a descent.
const MAX_RISE: f64 = 0.1;

/// A search in a short drive on which this (`id:key=value`) is concealed.
fn search(concealed: &[&str], seed: u64) -> Search {
    let options =
        ScheduleOptions { runs: Some(6), seed, duration: Some(10.0), ..ScheduleOptions::default() };
    let runs = ScheduleKind::Manual.generate(&options).expect("a schedule");
    let file = owned(concealed);
    let drive = Drive::new(&file.vehicle, concealed, &runs, seed).expect("it drives");
    let recording = drive.recording(&sensors(Preset::Laboratory), seed);
    let settings = Settings::default();
    let evidence = Evidence::of_recording(&recording, file.vehicle.gauge, &settings);
    let evidence = Weighted::new(evidence.expect("enough"));
    let base = Base::new(&file, &evidence, &Watch::none()).expect("not cancelled");
    let evidence =
        with_remaining_noise(&evidence, &base.fit, &Watch::none()).expect("not cancelled");
    let base = base.refitted(&evidence);
    let tried = candidates(&EffectId::all().collect::<Vec<_>>(), &base.instruments, &evidence);
    let entries = Beside::new(&base.fit.hypothesis, &evidence).signatures(&tried);
    Search::new(evidence, base, Catalogue { entries })
}

#[test]
fn a_refit_with_an_effect_never_fits_worse_than_without() {
    let concealed = [
        "load-transfer:cog_height_m=0.2",
        "viscous-friction",
        "stribeck-friction",
        "shear-displacement",
        "hitch-drag",
        "slope:angle_deg=3",
        "belt-slip",
        "friction-gradient",
    ];
    let all: Vec<(usize, Vec<String>)> = concealed
        .iter()
        .zip(1..)
        .map(|(concealed, seed)| {
            let search = search(&[concealed], seed);
            let nothing = search.nothing();
            let screened = search.screen(&nothing);
            let seen: Vec<_> = screened.iter().filter(|one| one.gain.is_finite()).collect();
            let worse = seen.par_iter().filter_map(|one| {
                let found = search.refit(&nothing, &[(*one).clone()]);
                let rise = found.fit.objective - nothing.fit.objective;
                let effect = one.effect.name();
                (rise > MAX_RISE).then(|| format!("{concealed}: {effect} rises by {rise:.2}"))
            });
            (seen.len(), worse.collect())
        })
        .collect();
    let refits: usize = all.iter().map(|(refits, _)| refits).sum();
    let worse: Vec<&String> = all.iter().flat_map(|(_, worse)| worse).collect();
    assert!(refits > 50, "{refits} refits");
    assert!(worse.is_empty(), "{} of {refits} refits: {worse:#?}", worse.len());
}

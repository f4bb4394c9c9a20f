//! The order in which candidates stand says nothing.

use trackdyn_diagnose::base::Base;
use trackdyn_diagnose::candidate::{Beside, Catalogue, candidates};
use trackdyn_diagnose::evidence::Evidence;
use trackdyn_diagnose::fit::Fit;
use trackdyn_diagnose::progress::Watch;
use trackdyn_diagnose::search::{Found, Search};
use trackdyn_diagnose::{Settings, Weighted};
use trackdyn_model::EffectId;

use trackdyn_estimate::synthetic::{Synthetic, random_steps};
use trackdyn_model::{Effects, VehicleFile};
use trackdyn_recording::Recording;

/// A drive with constant ICRs: the lugs that its owner believes in do not grip more one way than
/// the other.
fn recording() -> Recording {
    let synthetic = Synthetic {
        schedules: (0..6).map(|run| random_steps(14, 1.98, 0.8, 400 + run)).collect(),
        track_interval: 0.03,
        pose_interval: 0.09,
        encoder_noise: 0.02,
        position_noise: 0.002,
        yaw_noise: 0.002,
        seed: 4,
        ..Synthetic::default()
    };
    synthetic.recording().expect("long enough")
}

fn owned() -> VehicleFile {
    let effects: Effects =
        ["directional-lugs"].iter().map(|text| text.parse().expect("an effect")).collect();
    VehicleFile { effects, ..VehicleFile::auriga_alpha() }
}

/// The best hypothesis with the candidates in one order and in the other.
fn both_ways() -> [Found; 2] {
    let file = owned();
    let evidence = Evidence::of_recording(&recording(), file.vehicle.gauge, &Settings::default())
        .expect("enough");
    let evidence = Weighted::new(evidence);
    let base = Base::new(&file, &evidence, &Watch::none()).expect("not cancelled");
    let tried = candidates(&EffectId::all().collect::<Vec<_>>(), &base.instruments, &evidence);
    let mut entries = Beside::new(&base.fit.hypothesis, &evidence).signatures(&tried);
    [false, true].map(|is_reversed| {
        if is_reversed {
            entries.reverse();
        }
        let catalogue = Catalogue { entries: entries.clone() };
        let search = Search::new(evidence.clone(), base.clone(), catalogue);
        search.best(&Watch::none()).expect("nobody stops it")
    })
}

#[test]
fn reversed_candidates_give_the_same_hypothesis() {
    let [one, other] = both_ways();
    // What the file says is not so: there is something to find.
    assert!(!one.effects.is_empty());
    assert_eq!(one.effects, other.effects);
    // Sums of columns in another order: rounding.
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-6 * a.abs().max(1.0);
    assert!(near(one.ln_evidence, other.ln_evidence), "{} {}", one.ln_evidence, other.ln_evidence);
    let values = |fit: &Fit| -> Vec<_> {
        let mut unknowns = fit.unknowns.clone();
        unknowns.sort();
        unknowns.iter().map(|unknown| (*unknown, fit.hypothesis.get(*unknown))).collect()
    };
    for ((unknown, one), (_, other)) in values(&one.fit).into_iter().zip(values(&other.fit)) {
        assert!(near(one, other), "{unknown:?}: {one} and {other}");
    }
}

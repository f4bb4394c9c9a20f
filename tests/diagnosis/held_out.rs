//! Runs that are held out teach nothing.

use nalgebra::Vector3;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use trackdyn_core::Pose;
use trackdyn_diagnose::evidence::planned::{PlannedRun, READINGS};
use trackdyn_diagnose::hypothesis::Hypothesis;
use trackdyn_diagnose::mechanics::{Instruments, Mechanics};
use trackdyn_diagnose::{Diagnosis, Evidence, Options, Settings, diagnose, unobserved};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_model::VehicleFile;
use trackdyn_recording::TrackSample;
use trackdyn_tests::concealed::{named, owned};
use trackdyn_tests::uniform;

const RUNS: u64 = 4;
const HELD_OUT: usize = 3;
const SAMPLES: usize = 80;
/// Time between readings, s.
const INTERVAL: f64 = 0.03;
/// Size of the noise, m and rad.
const NOISE: f64 = 1e-3;

/// Speeds that change every two seconds or so, up to a size (m/s).
fn run(seed: u64, fastest: f64) -> PlannedRun {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut speeds = [0.0; 2];
    let readings = 0..=u32::try_from(SAMPLES * READINGS).expect("few");
    let tracks = readings.map(|k| {
        if k % 70 == 0 {
            speeds = [(); 2].map(|()| uniform(&mut random, -fastest, fastest));
        }
        TrackSample { t: INTERVAL * f64::from(k), v_left: speeds[0], v_right: speeds[1] }
    });
    let blocks = (0..SAMPLES * READINGS).step_by(SAMPLES * READINGS / 4).collect();
    PlannedRun { tracks: tracks.collect(), pose: Pose::default(), blocks }
}

/// What a robot with more on board than its file says shows of four runs, the last of them with
/// speeds up to this (m/s) and `wrong` times as far as they lead.
fn evidence(last: f64, wrong: f64) -> Evidence {
    let truth = VehicleFile {
        effects: ["yaw-inertia", "centripetal", "load-transfer:cog_height_m=0.2"]
            .map(|effect| effect.parse().expect("an effect"))
            .into_iter()
            .collect(),
        ..VehicleFile::auriga_alpha()
    };
    let truth = Hypothesis::filed(&truth, &Settings::default().prior);
    let runs: Vec<PlannedRun> =
        (0..RUNS).map(|seed| run(seed, if seed + 1 == RUNS { last } else { 0.8 })).collect();
    let variance = NOISE * NOISE;
    let noise = SegmentNoise { pose: [variance; 3], walk: [variance; 3], heading: 0.0, stamp: 0.0 };
    Evidence::planned(&runs, noise, 0.0, &Settings::default(), |evidence| {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let moved = Mechanics::new(&truth, evidence).predict(&Instruments::of(&truth), evidence);
        let samples = evidence.samples().iter().zip(moved);
        let seen = samples.map(|(sample, motion)| {
            let off = Vector3::from_fn(|_, _| uniform(&mut random, -3.0 * NOISE, 3.0 * NOISE));
            if sample.run == HELD_OUT { wrong * motion + off } else { motion + off }
        });
        seen.collect()
    })
}

fn diagnosis(evidence: &Evidence) -> Diagnosis {
    let options = Options { held_out: vec![HELD_OUT], ..Options::default() };
    diagnose(evidence, &owned(&[]), &options, &unobserved).expect("enough driving")
}

/// All that is claimed, to the last bit.
fn claims(diagnosis: &Diagnosis) -> String {
    let sizes = diagnosis.answer.missing.iter().flat_map(|missing| &missing.parameters);
    let sizes: Vec<[f64; 3]> = sizes.map(|one| [one.value, one.low, one.high]).collect();
    format!("{:?} {sizes:?} {:?}", named(diagnosis), diagnosis.answer.corrected.to_toml())
}

#[test]
fn held_out_runs_teach_nothing() {
    let [as_it_is, another] =
        [evidence(0.5, 1.0), evidence(0.3, 1.3)].map(|evidence| diagnosis(&evidence));
    assert!(!as_it_is.answer.missing.is_empty());
    assert_eq!(claims(&as_it_is), claims(&another));
    // They judge.
    assert!(as_it_is.evidence.errors.are_held_out && another.evidence.errors.are_held_out);
    assert!(another.evidence.errors.after > 2.0 * as_it_is.evidence.errors.after);
}

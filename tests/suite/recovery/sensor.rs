//! Clock and mount of the pose sensor, fitted beside the kinematic parameters.

use crate::recovery::{GAUGE, TRUTH, shares, start};
use trackdyn_core::{PerSide, Pose};
use trackdyn_estimate::SegmentOptions;
use trackdyn_estimate::genetic::GeneticOptions;
use trackdyn_estimate::identification::{Options, identify};
use trackdyn_estimate::least_squares::{Loss, lacks_nuisance};
use trackdyn_estimate::noise::{self, noise};
use trackdyn_estimate::synthetic::{ConstantIcr, Stretch, Synthetic, random_steps};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_estimate::{
    Doubt, Estimate, Free, Nuisance, Observations, Parameters, Unknowns, Weighting, least_squares,
};
use trackdyn_recording::{Recording, Source};

/// True clock offset, s: a reading and two thirds.
const TAU: f64 = 0.05;

/// True yaw of the sensor, rad: 2.3 degrees.
const YAW: f64 = 0.04;

/// Runs like those of the other tests; poses come every 0.097 s, which is no multiple of the
/// readings, as clocks that run apart have it.
fn noisy(schedules: Vec<Vec<Stretch>>, seed: u64) -> Synthetic {
    let [x_left, x_right, y, left, right] = TRUTH;
    Synthetic {
        kinematics: ConstantIcr { x_left, x_right, y, alpha: PerSide::new(left, right) },
        schedules,
        track_interval: 0.03,
        pose_interval: 0.097,
        encoder_noise: 0.02,
        position_noise: 0.002,
        yaw_noise: 0.002,
        tau: TAU,
        seed,
    }
}

/// The recording of a sensor that stands at `mount` on the body.
fn mounted(synthetic: &Synthetic, mount: Pose) -> Recording {
    let recording = synthetic.recording().expect("long enough");
    let runs = recording.runs().iter().cloned().map(|run| {
        let mut rows = run.into_rows();
        for sample in &mut rows.poses.samples {
            // world_from_sensor = world_from_body · body_from_sensor
            sample.pose = sample.pose.compose(&mount);
        }
        rows
    });
    let runs = runs.collect();
    Recording::new("mounted", "synthetic", runs, Source::computed(), Vec::new()).expect("runs")
}

fn drive(schedules: Vec<Vec<Stretch>>, seed: u64) -> Recording {
    mounted(&noisy(schedules, seed), turned())
}

fn turned() -> Pose {
    Pose::new(0.0, 0.0, YAW)
}

fn steps(seed: u64) -> Vec<Vec<Stretch>> {
    (0..9).map(|run| random_steps(12, 1.98, 0.8, 100 * seed + run)).collect()
}

/// Segments cut at a clock offset that is wrong by `off`, s.
fn observe(recording: &Recording, off: f64) -> Observations {
    let options = SegmentOptions { tau: TAU + off, tau_margin: 0.1, ..SegmentOptions::default() };
    Observations::new(recording, &options)
}

const BOTH: [Nuisance; 2] = [Nuisance::TimeOffset, Nuisance::SensorYaw];

fn fit(recording: &Recording, nuisances: &[Nuisance], off: f64) -> Estimate {
    let measured = SegmentNoise::measured(&noise(recording, TAU, &noise::Settings::default()), 0.8)
        .expect("steady driving");
    let unknowns = Unknowns { free: Free::IcrsAndAlphas, nuisances: nuisances.to_vec() };
    let weighting = Weighting::Noise(measured);
    least_squares(&observe(recording, off), &start(), &unknowns, &weighting, Loss::Huber)
        .expect("settles")
}

#[test]
fn clock_and_yaw_of_the_sensor_are_found_beside_the_parameters() {
    let recording = drive(steps(1), 1);
    let plain = fit(&recording, &[], 0.02);
    let whole = fit(&recording, &BOTH, 0.02);
    for (nuisance, truth, enough) in
        [(Nuisance::TimeOffset, TAU, 0.003), (Nuisance::SensorYaw, YAW, 0.003)]
    {
        let interval = whole.nuisance(nuisance).expect("fitted");
        let error = (interval.value - truth).abs();
        assert!(error < 4.0 * interval.deviation, "{nuisance}: {interval:?} of {truth}");
        assert!(interval.deviation < enough, "{nuisance}: {interval:?}");
        assert_eq!(plain.nuisance(nuisance), None);
    }
    for (k, truth) in TRUTH.into_iter().enumerate() {
        let interval = whole.interval(k).expect("free");
        let error = (interval.value - truth).abs();
        assert!(error < 4.0 * interval.deviation, "{}: {interval:?}", Parameters::NAMES[k]);
    }
    // What is not fitted shows in the residuals.
    assert!(
        plain.whitened_rms > 1.2 * whole.whitened_rms,
        "{} {}",
        plain.whitened_rms,
        whole.whitened_rms
    );
    assert!((0.7..1.4).contains(&whole.whitened_rms), "{}", whole.whitened_rms);
}

/// Least squares on the cost (17) of a recording without noise.
fn fit_exactly(recording: &Recording, free: Free, nuisances: &[Nuisance]) -> Estimate {
    let weighting = Weighting::Distance { lever: GAUGE / 2.0 };
    let unknowns = Unknowns { free, nuisances: nuisances.to_vec() };
    least_squares(&observe(recording, 0.03), &start(), &unknowns, &weighting, Loss::Squares)
        .expect("settles")
}

fn without_noise(mount: Pose) -> Recording {
    mounted(
        &Synthetic {
            encoder_noise: 0.0,
            position_noise: 0.0,
            yaw_noise: 0.0,
            ..noisy(steps(2), 2)
        },
        mount,
    )
}

#[test]
fn without_noise_they_are_exact() {
    let estimate = fit_exactly(&without_noise(turned()), Free::IcrsAndAlphas, &BOTH);
    // 1 µs and 1 µrad: the cost has its least value, zero, at the truth.
    assert!((estimate.sensor.tau - TAU).abs() < 1e-6, "{:?}", estimate.sensor);
    assert!((estimate.sensor.yaw - YAW).abs() < 1e-6, "{:?}", estimate.sensor);
}

#[test]
fn a_lever_arm_moves_the_icrs_and_nothing_else() {
    let fitted = |mount| fit_exactly(&without_noise(mount), Free::IcrsAndAlphas, &BOTH);
    let (bare, mounted) = (fitted(Pose::default()), fitted(Pose::new(0.3, 0.2, 0.0)));
    // 0.3 m forward, 0.2 m to the left: ICRs 0.2 m further right and 0.3 m further back. 1 µm is
    // rounding.
    for (k, shift) in [0.2, 0.2, -0.3, 0.0, 0.0].into_iter().enumerate() {
        let moved = mounted.parameters.0[k] - bare.parameters.0[k];
        assert!((moved - shift).abs() < 1e-6, "{}: {moved}", Parameters::NAMES[k]);
    }
    // Nothing is left that a lever arm could explain: over a thousand segments, less than a
    // micrometre each.
    assert!(bare.cost < 1e-9 && mounted.cost < 1e-9, "{} {}", bare.cost, mounted.cost);
}

/// Why a property of the sensor cannot be fitted to such driving.
fn refused(schedule: Vec<Stretch>, nuisance: Nuisance) -> Option<Doubt> {
    let recording = drive(vec![schedule], 4);
    lacks_nuisance(
        &observe(&recording, 0.0),
        &noise(&recording, TAU, &noise::Settings::default()),
        nuisance,
    )
}

#[test]
fn what_the_driving_does_not_show_is_refused_with_the_reason() {
    let stretch = |duration, left, right| Stretch { duration, speeds: PerSide::new(left, right) };
    let spin = vec![stretch(30.0, -0.5, 0.5), stretch(30.0, 0.5, -0.5)];
    let circle = vec![stretch(30.0, 0.2, 0.6), stretch(30.0, -0.2, -0.6)];
    let two_circles = vec![stretch(30.0, 0.2, 0.6), stretch(30.0, 0.6, 0.2)];
    let constant = vec![stretch(60.0, 0.2, 0.6)];
    for (schedule, nuisance, expected) in [
        (spin, Nuisance::SensorYaw, Some(Doubt::NoTranslation)),
        (circle, Nuisance::SensorYaw, Some(Doubt::NoTranslation)),
        (two_circles, Nuisance::SensorYaw, None),
        (constant, Nuisance::TimeOffset, Some(Doubt::NoChange)),
        (steps(5).remove(0), Nuisance::TimeOffset, None),
        (steps(5).remove(0), Nuisance::LeverArm, Some(Doubt::LeverArm)),
    ] {
        assert_eq!(refused(schedule, nuisance), expected, "{nuisance}");
    }
}

#[test]
fn the_others_are_fitted_where_one_is_refused() {
    let options = Options {
        nuisances: Nuisance::ALL.to_vec(),
        genetic: GeneticOptions { generations: 1, ..GeneticOptions::default() },
        ..Options::new(GAUGE)
    };
    let found = identify(&drive(steps(6), 6), &options, &|_| ()).expect("enough");
    for fit in found.fits {
        assert_eq!(fit.refused, [Doubt::LeverArm]);
        let estimate = fit.least_squares.expect("determined");
        assert_eq!(estimate.unknowns.nuisances, BOTH);
        assert!(estimate.nuisance(Nuisance::LeverArm).is_none());
    }
}

#[test]
fn a_clock_offset_that_is_far_off_is_found_too() {
    // Two and a half times what the readings around a segment allow for: segments are cut anew.
    let options = Options {
        tau: Some(TAU + 0.25),
        nuisances: vec![Nuisance::TimeOffset],
        genetic: GeneticOptions { generations: 1, ..GeneticOptions::default() },
        ..Options::new(GAUGE)
    };
    let found = identify(&drive(steps(7), 7), &options, &|_| ()).expect("enough");
    let estimate = found.fits[1].least_squares.as_ref().expect("determined");
    let interval = estimate.nuisance(Nuisance::TimeOffset).expect("fitted");
    assert!((interval.value - TAU).abs() < 4.0 * interval.deviation, "{interval:?}");
}

/// Shares of `count` recordings whose 95 % interval holds the truth: τ, ψ and the kinematic
/// parameters.
fn coverage(count: u32, seed: u64) -> [f64; 7] {
    shares(count, seed, |seed| {
        let estimate = fit(&drive(steps(seed), seed), &BOTH, 0.01);
        std::array::from_fn(|k| {
            let (interval, truth) = match k {
                0 => (estimate.nuisance(Nuisance::TimeOffset), TAU),
                1 => (estimate.nuisance(Nuisance::SensorYaw), YAW),
                k => (estimate.interval(k - 2), TRUTH[k - 2]),
            };
            let interval = interval.expect("fitted");
            (interval.low..=interval.high).contains(&truth)
        })
    })
}

#[test]
fn intervals_cover_the_truth() {
    let shares = coverage(200, 3_000);
    println!("tau, psi, {:?}: {shares:?}", Parameters::NAMES);
    // Four standard deviations of a share of 0.95 among 200.
    let allowed = 4.0 * (0.95_f64 * 0.05 / 200.0).sqrt();
    assert!(shares.iter().all(|share| (share - 0.95).abs() < allowed), "{shares:?}");
}

//! Steady operating points: parameters, intervals, and motors that saturate.

use crate::recovery::{GAUGE, TRUTH, start};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};
use trackdyn_estimate::least_squares::Loss;
use trackdyn_estimate::steady::{Grouping, fit_points, lagging};
use trackdyn_estimate::{Doubt, Error, Free};
use trackdyn_recording::OperatingPoint;

/// Speeds of each track, m/s.
const SPEEDS: [f64; 9] = [-0.4, -0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4];

/// Every pair of speeds, measured with 5 mm/s and 20 mrad/s of noise; motors cannot exceed `limit`
/// m/s on the right where they run against the left.
fn points(seed: u64, limit: f64) -> Vec<OperatingPoint> {
    let [x_l, x_r, y, alpha_l, alpha_r] = TRUTH;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut noise =
        |deviation: f64| Normal::new(0.0, deviation).expect("a deviation").sample(&mut random);
    let mut points = Vec::new();
    for v_left in SPEEDS {
        for v_right in SPEEDS {
            let reached =
                if v_left * v_right < 0.0 { v_right.clamp(-limit, limit) } else { v_right };
            let w = (alpha_r * reached - alpha_l * v_left) / (x_r - x_l);
            points.push(OperatingPoint {
                v_left,
                v_right,
                v_forward: Some(alpha_l * v_left - w * x_l + noise(0.005)),
                v_lateral: Some(-w * y + noise(0.005)),
                yaw_rate: Some(w + noise(0.02)),
            });
        }
    }
    points
}

#[test]
fn intervals_cover_the_truth() {
    let mut hits = [0_u32; 5];
    for seed in 0..400 {
        let found = fit_points(&points(seed, 1.0), &start(), Free::IcrsAndAlphas, Loss::Huber);
        let found = found.expect("settles");
        for (k, hits) in hits.iter_mut().enumerate() {
            let interval = found.interval(k).expect("free");
            *hits += u32::from((interval.low..=interval.high).contains(&TRUTH[k]));
        }
        assert!(found.doubts(GAUGE).is_empty());
    }
    let shares = hits.map(|hits| f64::from(hits) / 400.0);
    println!("{shares:?}");
    // Three standard deviations of a share of 0.95 among 400 below; above is only wide: the widest
    // of three jackknifes counts.
    let allowed = 3.0 * (0.95_f64 * 0.05 / 400.0).sqrt();
    assert!(shares.iter().all(|share| *share > 0.95 - allowed), "{shares:?}");
}

#[test]
fn what_was_not_measured_is_left_out() {
    let mut points = points(1, 1.0);
    for point in points.iter_mut().step_by(3) {
        point.v_lateral = None;
        point.v_forward = None;
    }
    let found = fit_points(&points, &start(), Free::Icrs, Loss::Huber).expect("settles");
    assert!((found.gap().value - (TRUTH[1] - TRUTH[0])).abs() < 0.02);
    for point in &mut points {
        point.v_lateral = None;
    }
    let found = fit_points(&points, &start(), Free::Icrs, Loss::Huber).expect("settles");
    let doubts = found.doubts(GAUGE);
    assert_eq!(doubts, [Doubt::NoLateralSpeed]);
    assert_eq!(found.scatter[1], None);
    let error = fit_points(&points[..4], &start(), Free::Icrs, Loss::Huber).expect_err("too few");
    assert!(matches!(error, Error::TooFewMeasurements { needed: 12, .. }), "{error}");
}

#[test]
fn errors_that_a_track_speed_shares_widen_the_intervals() {
    let mut points = points(2, 1.0);
    for point in &mut points {
        // 10 % more or less than reported, at every other speed of the right track
        let sign = if (point.v_right * 10.0).rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 };
        point.v_right *= 1.0 + 0.1 * sign;
    }
    let found = fit_points(&points, &start(), Free::Icrs, Loss::Huber).expect("settles");
    assert_eq!((found.grouping, found.groups), (Grouping::RightSpeed, 9));
}

#[test]
fn motors_that_saturate_are_noticed_without_a_model() {
    // 0.1 m/s where 0.4 is asked for: 0.24 rad/s less than with the left track at rest, 8 times
    // the scatter of a difference
    let saturated = points(3, 0.1);
    let found = lagging(&saturated);
    assert!(!found.is_empty());
    for lag in &found {
        let point = saturated[lag.point];
        assert!(point.v_right.abs() > 0.1 && point.v_left * point.v_right < 0.0, "{point:?}");
    }
    let false_alarms: usize = (0..200).map(|seed| lagging(&points(seed, 1.0)).len()).sum();
    // 16,200 points: one in ten thousand may look so by chance
    assert!(false_alarms <= 2, "{false_alarms}");
}

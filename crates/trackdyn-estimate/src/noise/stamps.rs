//! Errors of the stamps of poses, from steady driving.
//!
//! A pose that was taken ε later than it says lies ε times the body's twist u further, so the
//! covariance of a triple's e grows by s² u uᵀ (1 + λ² + (1 − λ)²): with the square of the speed,
//! and forward and yaw together. White noise does neither. The variances R, q and s² maximise a
//! likelihood with heavy tails over all triples. An error of the stamps is told only where the
//! likelihood asks for it clearly.

use super::{Component, Settings};
use crate::variances::{Climb, LN_ZERO, heavy_tailed};
use nalgebra::{Matrix3, SVector, Vector3};
use trackdyn_core::real;
use trackdyn_core::robust::{MEDIAN_OF_CHI_SQUARE_3, median};

/// A triple of poses.
pub(super) struct Triple {
    /// e: distance of its middle pose from the motion between the outer ones, forward (m), left
    /// (m), yaw (rad).
    pub off: Vector3<f64>,
    /// Mean twist of the body, m/s and rad/s.
    pub twist: Vector3<f64>,
    /// 1 + λ² + (1 − λ)².
    pub white: f64,
    /// T₁ T₂/(T₁ + T₂), s.
    pub walk: f64,
    /// Whether it is independent of other such ones, and driving is as steady from the pose before
    /// it to the pose after it: a late stamp at its ends then hides no change of speed.
    pub is_clean: bool,
}

/// How variances are found: to a hundredth of themselves.
const CLIMB: Climb = Climb { max_steps: 60, min_gain: 0.01, max_step: 1.5, difference: 1e-3 };

/// Variances by their logarithms: R and q of forward, lateral and yaw, and s².
type Logarithms = SVector<f64, 7>;

/// Place of s².
const STAMP: usize = 6;

/// Noise along the axes and standard deviation of the stamps, s; none where the stamps show no
/// error. `start` is the noise without it.
pub(super) fn stamps(
    triples: &[Triple],
    start: [Component; 3],
    settings: &Settings,
) -> Option<([Component; 3], f64)> {
    let triples: Vec<&Triple> = triples.iter().filter(|triple| triple.is_clean).collect();
    let stride = triples.len().div_ceil(settings.max_stamp_triples).max(1);
    let triples: Vec<&Triple> = triples.into_iter().step_by(stride).collect();
    let mean_square = |of: &dyn Fn(&Triple) -> f64| {
        triples.iter().map(|triple| of(triple).powi(2)).sum::<f64>() / real(triples.len().max(1))
    };
    let fastest = mean_square(&|triple| triple.twist[0]);
    if fastest <= 0.0 {
        return None;
    }
    let terms = |at: &Logarithms| -> Vec<f64> {
        let variances = at.map(f64::exp);
        let term = |triple: &&Triple| {
            let white = whitened(triple, &variances);
            white.map_or(f64::NEG_INFINITY, |(ln_determinant, square)| {
                heavy_tailed(ln_determinant, square, 3, settings.tails)
            })
        };
        triples.iter().map(term).collect()
    };
    // A variance of zero has no slope: start from a share of what is seen at least.
    let seen = [0, 1, 2].map(|axis| mean_square(&|triple| triple.off[axis]));
    let floor = |variance: f64, axis: usize| variance.max(1e-4 * seen[axis]).max(1e-18).ln();
    let mut without = Logarithms::repeat(f64::NEG_INFINITY);
    for axis in 0..3 {
        without[axis] = floor(start[axis].white.powi(2), axis);
        without[3 + axis] = floor(start[axis].walk.powi(2), axis);
    }
    let none = Logarithms::zeros();
    without[STAMP] = LN_ZERO;
    let (without, plain) = CLIMB.from(without, &none, terms);
    let mut with = without;
    with[STAMP] = (seen[0] / fastest).max(1e-18).ln();
    let (with, value) = CLIMB.from(with, &none, terms);
    // Heavy tails take a part of the noise for outliers: the median sets the level.
    let variances = with.map(f64::exp);
    let white = triples.iter().filter_map(|triple| whitened(triple, &variances));
    let mut squares: Vec<f64> = white.map(|(_, square)| square).collect();
    let level = median(&mut squares)? / MEDIAN_OF_CHI_SQUARE_3;
    let deviation = |k: usize| (level * variances[k]).sqrt();
    let noise =
        [0, 1, 2].map(|axis| Component { white: deviation(axis), walk: deviation(3 + axis) });
    (value > plain + settings.min_stamp_gain).then(|| (noise, deviation(STAMP)))
}

/// ln det L⁻¹ and |L⁻¹ e|² of the e of a triple, whose covariance is W (R + s² u uᵀ) + T q = L Lᵀ;
/// none where that has no factor.
fn whitened(triple: &Triple, variances: &Logarithms) -> Option<(f64, f64)> {
    let Triple { off, twist, white, walk, .. } = triple;
    let own: Vector3<f64> = variances.fixed_rows::<3>(0).into();
    let drift: Vector3<f64> = variances.fixed_rows::<3>(3).into();
    let of_pose = Matrix3::from_diagonal(&own) + twist * twist.transpose() * variances[STAMP];
    let factor = (of_pose * *white + Matrix3::from_diagonal(&drift) * *walk).cholesky()?;
    let factor = factor.l_dirty();
    let ln_determinant = -factor.diagonal().product().ln();
    Some((ln_determinant, factor.solve_lower_triangular(off)?.norm_squared()))
}

#[cfg(test)]
mod tests {
    use crate::identification::{Options, icrs_alone};
    use crate::noise::{Settings, noise};
    use crate::synthetic::{Synthetic, random_steps};
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};
    use trackdyn_recording::{PoseSample, Recording, Run};

    /// True distance of the ICRs, m.
    const GAP: f64 = 0.832;

    /// Two drives of a minute with poses every 0.09 s that were taken later than their stamps say,
    /// by a standard deviation of `jitter` (s).
    fn jittered(jitter: f64, seed: u64) -> Recording {
        const LATE_PERIOD: usize = 90;
        let synthetic = Synthetic {
            schedules: [0, 100].map(|k| random_steps(33, 1.8, 0.8, seed + k)).to_vec(),
            pose_interval: 1e-3,
            position_noise: 0.002,
            yaw_noise: 0.002,
            encoder_noise: 0.002,
            seed,
            ..Synthetic::default()
        };
        let dense = synthetic.recording().expect("long enough");
        let mut random = ChaCha8Rng::seed_from_u64(seed + 7);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let runs = dense.runs().iter().map(|run| {
            let mut rows = run.clone().into_rows();
            let poses = &rows.poses.samples;
            let taken = |pose: &PoseSample| {
                let later = pose.t + jitter * normal();
                let index = poses.partition_point(|other| other.t < later);
                PoseSample { pose: poses[index.min(poses.len() - 1)].pose, ..*pose }
            };
            rows.poses.samples = poses.iter().step_by(LATE_PERIOD).map(taken).collect();
            Run::new(rows, &mut Vec::new())
        });
        dense.with_runs(runs.collect())
    }

    #[test]
    fn errors_of_stamps_are_told_from_white_noise() {
        let found = |jitter: f64, seed: u64| {
            let found = noise(&jittered(jitter, seed), 0.0, &Settings::default());
            found.moving.expect("it moves steadily")
        };
        for seed in [1, 2, 3] {
            assert_eq!(found(0.0, seed).stamp, 0.0, "{seed}");
            let with = found(0.02, seed);
            // some 300 independent triples: a standard deviation to 4 %
            assert!((with.stamp / 0.02).ln().abs() < 0.2, "{seed}: {with:?}");
            for (axis, white) in [("forward", with.forward.white), ("yaw", with.yaw.white)] {
                assert!(white < 0.004, "{seed}: {axis} {white}");
            }
        }
    }

    #[test]
    fn the_distance_of_the_icrs_keeps_its_interval_beside_errors_of_stamps() {
        const DRIVES: u32 = 24;
        let mut squares = 0.0;
        for seed in 0..DRIVES {
            let recording = jittered(0.04, 10 + u64::from(seed));
            let gap = icrs_alone(&recording, &Options::new(0.42)).expect("it turns").gap();
            squares += ((gap.value - GAP) / gap.deviation).powi(2) / f64::from(DRIVES);
            assert!(gap.deviation < 0.01 * GAP, "{seed}: {}", gap.deviation);
        }
        // A mean square of 24 normal deviates lies below 1.9 but once in a hundred times.
        assert!(squares < 1.9, "mean square of errors over their deviations: {squares}");
    }
}

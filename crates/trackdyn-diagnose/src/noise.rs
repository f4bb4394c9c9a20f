//! Noise estimation from the residuals that driving cannot explain.
//!
//! # Law
//! All that driving could explain is fitted away: the base (constant ICRs, encoders, pose sensor);
//! the contrasts of [`locate`](crate::locate), by which ICRs vary with speed, direction, manoeuvre,
//! side, heading, place, time and change of speed; ICRs that vary with the speed of turning; the
//! response to acceleration; and, with inertia, where the masses are. The remaining residual r is
//! noise ([`SegmentNoise`]): white noise R of each pose, shared by neighbouring segments, errors of
//! its stamp, which displace it along the motion, a random walk q within each segment, and a
//! wandering heading of the sensor that turns all later segments of a run.
//! [`restricted_likelihood`](trackdyn_estimate::restricted_likelihood) finds its variances. They
//! are corrected for the degrees of freedom of the fit, ½ ln det(Xᵀ V⁻¹ X), X the fitted columns:
//! without that a walk, which is slow, would vanish into slow contrasts. The correction is taken as
//! linear in the log variances.
//!
//! Physics that contrasts cannot represent is at first taken for a walk. Where a hypothesis
//! explains more, noise is estimated again beside it, and accepted if the variance summed over a
//! run falls along one axis: a walk that is negligible in a sample may still hide slow changes.
//!
//! The search starts from noise measured without a model ([`trackdyn_estimate::noise`]). Poses
//! alone cannot separate ripple of the drive, which the encoders see, from a walk of the pose; nor
//! can encoders alone separate their own errors from slip.

mod flexible;

use crate::evidence::{between_places, run_ranges};
use crate::fit::Fit;
use crate::progress::{Cancelled, Watch};
use crate::weighted::Weighted;
use flexible::Flexible;
use nalgebra::Vector3;
use std::ops::Range;
use trackdyn_core::{Pose, real};
use trackdyn_estimate::restricted_likelihood::{mean_squares, taken};
use trackdyn_estimate::weighting::SegmentNoise;

/// The evidence with noise estimated from the residuals of a fit. Tables of steady points keep
/// theirs.
///
/// # Errors
/// [`Cancelled`], by the observer of the watch.
pub fn with_remaining_noise(
    evidence: &Weighted,
    fit: &Fit,
    watch: &Watch,
) -> Result<Weighted, Cancelled> {
    let Some(&measured) = evidence.noise() else { return Ok(evidence.clone()) };
    watch.go_on()?;
    remaining(evidence, measured, &Flexible::new(evidence, fit), watch)
}

/// The evidence with noise estimated beside all flexible columns, starting from `measured`.
fn remaining(
    evidence: &Weighted,
    measured: SegmentNoise,
    flexible: &Flexible,
    watch: &Watch,
) -> Result<Weighted, Cancelled> {
    let settings = &evidence.settings().noise;
    let samples = evidence.samples().iter().zip(&flexible.residual);
    let predicted: Vec<_> = samples.map(|(sample, left)| sample.motion - left).collect();
    let regular = settings.search().regular(&measured);
    let first = evidence.with_all_in(regular).moving_as(&predicted);
    (0..settings.rounds).try_fold(first, |evidence, _| {
        watch.go_on()?;
        Ok(estimated_again(&evidence, flexible))
    })
}

/// One round: the noise estimated from what the columns leave at the present noise, and without the
/// samples at poses that are outliers by the new one.
fn estimated_again(evidence: &Weighted, flexible: &Flexible) -> Weighted {
    let Some(&noise) = evidence.noise() else { return evidence.clone() };
    let settings = &evidence.settings().noise;
    let (left, motions) = (flexible.left(evidence), evidence.motions());
    let transposed = |column: &mut [Vector3<f64>]| evidence.whiten_transposed(column);
    let taken = taken(&noise, &motions, &left.white, transposed);
    let likely = settings.search().most_likely(&motions, &left.residual, noise, &taken);
    let found = likely.at_least(settings.min_deviations);
    let renewed = evidence.with_noise(found);
    renewed.without(&outliers(&renewed, &found, &left.residual))
}

/// The evidence without samples at outlying poses, judged beside a fit with the present noise.
pub fn without_outliers(evidence: &Weighted, fit: &Fit) -> Weighted {
    match evidence.noise() {
        Some(noise) => {
            let flexible = Flexible::new(evidence, fit);
            // Outliers mask others, which are judged once the former are gone.
            let without_more = |evidence: &Weighted| {
                let lost = outliers(evidence, noise, &flexible.left(evidence).residual);
                (!lost.is_empty()).then(|| evidence.without(&lost))
            };
            let rounds = std::iter::successors(Some(evidence.clone()), without_more);
            rounds.last().unwrap_or_else(|| evidence.clone())
        }
        None => evidence.clone(),
    }
}

/// The noise in words: error of each pose, and what is added per second.
pub fn sentence(noise: &SegmentNoise) -> String {
    let [forward, left, yaw] = noise.walk;
    let walk = [forward, left, yaw + noise.heading];
    let of = |[forward, left, yaw]: [f64; 3]| {
        let [forward, left] = [forward, left].map(|variance| 1e3 * variance.sqrt());
        let yaw = yaw.sqrt().to_degrees();
        format!("{forward:.1} mm forward, {left:.1} mm left, {yaw:.2} deg")
    };
    let stamps = match noise.stamp.sqrt() {
        0.0 => String::new(),
        seconds => format!(", and its stamp {:.1} ms", 1e3 * seconds),
    };
    format!("each pose {}{stamps}; more in a second {}", of(noise.pose), of(walk))
}

/// The evidence with noise estimated beside a hypothesis that explains more than contrasts; none
/// where no axis has less noise.
///
/// # Errors
/// [`Cancelled`], by the observer of the watch.
pub fn sharper(
    evidence: &Weighted,
    fit: &Fit,
    watch: &Watch,
) -> Result<Option<Weighted>, Cancelled> {
    let again = with_remaining_noise(evidence, fit, watch)?;
    Ok(is_quieter(evidence, &again).unwrap_or(false).then_some(again))
}

/// Whether the noise of evidence, summed over a run, fell along an axis; none without a noise.
fn is_quieter(evidence: &Weighted, again: &Weighted) -> Option<bool> {
    let (before, after) = (evidence.noise()?, again.noise()?);
    let time = run_time(evidence)?;
    let squares = mean_squares(&evidence.motions());
    // A walk in yaw and a wandering heading look alike in a sample, but not over a run.
    let added = |noise: &SegmentNoise| {
        let of_pose = |axis: usize| noise.pose[axis] + noise.stamp * squares[axis];
        let ([forward, left, yaw], [x, y, turn]) = ([0, 1, 2].map(of_pose), noise.walk);
        let pairs = [(forward, x), (left, y), (yaw, turn), (yaw, noise.heading)];
        pairs.map(|(white, walk)| white + walk * time)
    };
    let ratio = evidence.settings().noise.min_variance_ratio;
    Some(added(before).iter().zip(added(after)).any(|(before, after)| *before > ratio * after))
}

/// Mean duration of a run with samples, s; none without samples.
fn run_time(evidence: &Weighted) -> Option<f64> {
    let samples = evidence.samples();
    let runs = run_ranges(samples).count();
    let time: f64 = samples.iter().map(|sample| sample.duration).sum();
    (runs > 0).then(|| time / real(runs))
}

/// Samples that share an outlying pose: the sample that ends there has a large residual, but both
/// samples joined have a small one. Samples are also joined across a pose whose place was not
/// measured.
fn outliers(evidence: &Weighted, noise: &SegmentNoise, left: &[Vector3<f64>]) -> Vec<usize> {
    let mut white = left.to_vec();
    evidence.whiten(&mut white);
    let settings = &evidence.settings().noise;
    let samples = evidence.samples();
    let pose = |motion: Vector3<f64>| Pose::new(motion[0], motion[1], motion[2]);
    let motions = evidence.motions();
    let joined: Vec<Range<usize>> = between_places(samples).collect();
    let mut lost: Vec<usize> = Vec::new();
    let mut outlier: Option<usize> = None;
    for (index, pair) in joined.windows(2).enumerate() {
        let [before, after] = [&pair[0], &pair[1]];
        // Samples conditioned on an outlying pose are wrong too, and are judged in the next round.
        if outlier.is_some_and(|outlier| index <= outlier + settings.outlier_distance) {
            continue;
        }
        let is_far = white[before.end - 1].norm_squared() >= settings.min_outlier_square;
        if !samples[after.start].follows || !is_far {
            continue;
        }
        let both = before.start..after.end;
        let composed = |of: &dyn Fn(usize) -> Vector3<f64>| {
            both.clone().fold(Pose::default(), |at, k| at.compose(&pose(of(k))))
        };
        let observed = composed(&|k| samples[k].motion);
        let expected = composed(&|k| samples[k].motion - left[k]);
        let off = expected.relative(&observed);
        let duration: f64 = samples[both.clone()].iter().map(|sample| sample.duration).sum();
        let ([first, _], [_, last]) = (motions[both.start].twists, motions[both.end - 1].twists);
        let reach = observed.x.hypot(observed.y).powi(2);
        // poses at both ends, the walk between them, and the first yaw error times the distance
        let variance = |k: usize| {
            let turned = if k < 2 { noise.pose[2] * reach } else { noise.heading * duration };
            let stamps = (first[(k, k)] + last[(k, k)]) * noise.stamp;
            2.0 * noise.pose[k] + stamps + noise.walk[k] * duration + turned
        };
        let together = off.x.powi(2) / variance(0)
            + off.y.powi(2) / variance(1)
            + off.yaw.powi(2) / variance(2);
        if together < settings.max_pair_square {
            outlier = Some(index);
            lost.extend(both);
        }
    }
    lost
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::planned::{PlannedRun, READINGS};
    use crate::evidence::{Evidence, Sample};
    use crate::settings::Settings;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use trackdyn_estimate::restricted_likelihood::{Variances, variances_of};
    use trackdyn_recording::TrackSample;

    const TRUE_NOISE: SegmentNoise = SegmentNoise {
        pose: [9e-6, 4e-6, 4e-6],
        walk: [1e-6, 4e-6, 2.5e-7],
        heading: 2.5e-7,
        stamp: 0.0,
    };

    /// A winding drive of 1500 segments with these errors added to its motion.
    fn drive(errors: &[Vector3<f64>]) -> Evidence {
        let tracks: Vec<TrackSample> = (0..=1500 * READINGS)
            .map(|k| {
                let t = 0.03 * f64::from(u32::try_from(k).expect("small"));
                TrackSample {
                    t,
                    v_left: 0.4 + 0.4 * (0.3 * t).sin(),
                    v_right: 0.5 * (0.17 * t).cos(),
                }
            })
            .collect();
        let run = PlannedRun { pose: Pose::default(), tracks, blocks: vec![0] };
        Evidence::planned(&[run], TRUE_NOISE, 0.0, &Settings::default(), |evidence| {
            let turn = |s: &crate::evidence::Sample| s.speeds.right - s.speeds.left;
            let ahead = |s: &crate::evidence::Sample| f64::midpoint(s.speeds.left, s.speeds.right);
            let samples = evidence.samples().iter();
            let none = std::iter::repeat(const { &Vector3::new(0.0, 0.0, 0.0) });
            let errors = errors.iter().chain(none);
            samples
                .zip(errors)
                .map(|(s, error)| Vector3::new(ahead(s), 0.0, turn(s)) * s.duration + error)
                .collect()
        })
    }

    /// Noise with the true covariance: coloured white numbers.
    fn noisy(evidence: &Weighted, seed: u64) -> Vec<Vector3<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        // A sum of twelve uniform numbers is nearly normal with variance one.
        let mut normal = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
        let mut residual: Vec<_> =
            evidence.samples().iter().map(|_| Vector3::from_fn(|_, _| normal())).collect();
        evidence.colour(&mut residual);
        residual
    }

    fn most_likely(
        evidence: &Weighted,
        residual: &[Vector3<f64>],
        start: SegmentNoise,
        taken: &Variances,
    ) -> SegmentNoise {
        let search = evidence.settings().noise.search();
        search.most_likely(&evidence.motions(), residual, start, taken)
    }

    fn found(evidence: &Weighted, residual: &[Vector3<f64>]) -> SegmentNoise {
        let wrong = SegmentNoise {
            pose: [4e-5, 1e-6, 1e-5],
            walk: [0.0, 1e-4, 1e-5],
            heading: 0.0,
            stamp: 0.0,
        };
        most_likely(evidence, residual, wrong, &Variances::zeros())
    }

    #[test]
    fn a_start_without_white_noise_is_left() {
        let evidence = Weighted::new(drive(&[]));
        let residual = noisy(&evidence, 4);
        let start = SegmentNoise { pose: [1e-12; 3], walk: [3e-5; 3], heading: 0.0, stamp: 0.0 };
        let noise = most_likely(&evidence, &residual, start, &Variances::zeros());
        for k in 0..3 {
            assert!((noise.pose[k] / TRUE_NOISE.pose[k]).ln().abs() < 0.2, "{k}: {noise:?}");
        }
    }

    #[test]
    fn colour_undoes_whitening() {
        let evidence = Weighted::new(drive(&[]));
        let residual = noisy(&evidence, 1);
        let mut there = residual.clone();
        evidence.whiten(&mut there);
        evidence.colour(&mut there);
        for (a, b) in residual.iter().zip(&there) {
            assert!((a - b).norm() < 1e-12 * (1e-3 + a.norm()), "{a} {b}");
        }
    }

    #[test]
    fn white_noise_walk_and_heading_are_found_from_a_wrong_start() {
        let evidence = Weighted::new(drive(&[]));
        for seed in 1..6 {
            let noise = found(&evidence, &noisy(&evidence, seed));
            // A variance is known to √(2/n) of itself from n independent numbers: 1500 for a pose.
            // A walk shows against poses of 2 to 4 mm over a dozen segments or more, 100 times in
            // the drive: 16 %; in yaw, the smallest, over fifty segments: 27 %.
            let close = |found: f64, truth: f64, deviation: f64| {
                assert!((found / truth).ln().abs() < 4.0 * deviation, "{seed}: {noise:?}");
            };
            for k in 0..3 {
                close(noise.pose[k], TRUE_NOISE.pose[k], 0.05);
            }
            for (k, deviation) in [0.16, 0.16, 0.27].into_iter().enumerate() {
                close(noise.walk[k], TRUE_NOISE.walk[k], deviation);
            }
            // as strong as the walk in yaw, and it shows to the side as well
            close(noise.heading, TRUE_NOISE.heading, 0.27);
        }
    }

    /// Sixty slow functions of time, from one period per drive upwards: where a walk has its power.
    #[test]
    fn a_walk_is_found_beside_what_takes_all_that_is_slow() {
        const COLUMNS: usize = 60;
        const SEEDS: u32 = 6;
        let evidence = Weighted::new(drive(&[]));
        let samples = evidence.samples();
        let span = samples.last().map_or(1.0, |last| last.start + last.duration);
        let column = |k: usize| -> Vec<Vector3<f64>> {
            let phase = std::f64::consts::TAU * real(1 + k / 6) / span;
            let wave =
                |t: f64| if k.is_multiple_of(2) { (phase * t).sin() } else { (phase * t).cos() };
            let along = |sample: &Sample| {
                Vector3::from_fn(|c, _| if c == k / 2 % 3 { wave(sample.start) } else { 0.0 })
            };
            samples.iter().map(along).collect()
        };
        let columns: Vec<_> = (0..COLUMNS).map(column).collect();
        // No forward pose noise and no walk, as a measurement without a model may give.
        let measured =
            SegmentNoise { pose: [0.0, 4e-6, 4e-6], walk: [0.0; 3], heading: 0.0, stamp: 0.0 };
        let mut logarithms = [[0.0; SegmentNoise::COUNT]; 2];
        for seed in 0..SEEDS {
            let residual = noisy(&evidence, seed.into());
            let flexible = Flexible { residual, columns: columns.clone(), own: COLUMNS };
            let left = flexible.left(&evidence);
            let scaled = flexible.left(&evidence.with_scale([2.0; 3]));
            assert_eq!(left.residual, scaled.residual, "noise is looked for whatever its scale");
            let transposed = |column: &mut [Vector3<f64>]| evidence.whiten_transposed(column);
            let taken = taken(&TRUE_NOISE, &evidence.motions(), &left.white, transposed);
            assert!((taken.sum() - real(COLUMNS)).abs() < 1e-6 * real(COLUMNS), "{taken}");
            let unaware = most_likely(&evidence, &left.residual, TRUE_NOISE, &Variances::zeros());
            let aware = remaining(&evidence, measured, &flexible, &Watch::none());
            let aware = *aware.expect("not cancelled").noise().expect("one");
            for (sums, found) in logarithms.iter_mut().zip([unaware, aware]) {
                let off = variances_of(&found) - variances_of(&TRUE_NOISE);
                for (sum, off) in sums.iter_mut().zip(off.iter()) {
                    *sum += off / f64::from(SEEDS);
                }
            }
        }
        let [unaware, aware] = logarithms;
        assert!(unaware[3].min(unaware[5]) < -0.5, "it matters: {unaware:.3?}");
        // as accurate as without columns: within four standard errors of the mean
        for (off, deviation) in aware.into_iter().zip([0.05, 0.05, 0.05, 0.16, 0.16, 0.27, 0.27]) {
            assert!(off.abs() < 4.0 * deviation / f64::from(SEEDS).sqrt(), "{aware:.3?}");
        }
    }

    #[test]
    fn poses_far_off_are_lost_and_change_nothing_else() {
        let evidence = Weighted::new(drive(&[]));
        let clean = noisy(&evidence, 7);
        let mut residual = clean.clone();
        let far: Vec<usize> = (20..1480).step_by(40).collect();
        for (&index, size) in far.iter().zip([0.05, -0.08, 0.12].into_iter().cycle()) {
            // A pose displaced by `size` m forward and half to the left, and turned: the end of one
            // sample and the start of the next.
            let samples = evidence.samples();
            let sample = |k: usize| {
                let motion = samples[k].motion;
                Pose::new(motion[0], motion[1], motion[2])
            };
            let error = Pose::new(size, 0.5 * size, 0.4 * size);
            let first = sample(index).compose(&error);
            let second = error.relative(&sample(index + 1));
            for (k, wrong) in [(index, first), (index + 1, second)] {
                let motion = samples[k].motion;
                residual[k] += Vector3::new(wrong.x, wrong.y, wrong.yaw) - motion;
            }
        }
        let seen = Weighted::new(drive(&residual));
        let noise = found(&seen, &residual);
        let lost = outliers(&seen.with_noise(noise), &noise, &residual);
        let expected: Vec<usize> = far.iter().flat_map(|&index| [index, index + 1]).collect();
        assert_eq!(lost, expected);
        let after = found(&seen.without(&lost), &residual);
        let without = found(&evidence, &clean);
        for k in 0..3 {
            assert!((after.pose[k] / without.pose[k]).ln().abs() < 0.1, "{after:?} {without:?}");
        }
    }
}

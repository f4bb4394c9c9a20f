//! Drift of dead reckoning: how far a vehicle file leads astray for the way that is driven, and for
//! the angle that is turned.
//!
//! # Law
//! Runs are cut into pieces of one length L, one after the other. A piece ends where the robot has
//! travelled Σ |V_l + V_r|/2 Δt ≥ L, or turned Σ |Δψ| ≥ L, at a pose whose place was seen. Then
//!
//! drift = Σ |error of a piece| / Σ length of a piece
//!
//! # Assumes
//! Poses are those of the recording: their noise is part of every error. What it makes alone is
//! given beside, for independent Gaussian errors of the first and the last pose of a piece.

use crate::evidence::{Origin, Sample};
use crate::replay;
use crate::weighted::Weighted;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::Range;
use trackdyn_core::Pose;
use trackdyn_estimate::odometry::Estimate;
use trackdyn_estimate::odometry::intervals::{Sums, size};
use trackdyn_model::VehicleFile;

/// Share of a length at which it counts as reached, for rounding.
const ROUNDING: f64 = 1.0 - 1e-9;

/// Drift with a vehicle as filed and as corrected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// Error of place for the distance travelled, 1; none where too little was driven.
    pub place: Option<Compared>,
    /// Error of yaw for the angle turned, 1; none where too little was turned.
    pub yaw: Option<Compared>,
}

/// A drift before and after, over the same pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compared {
    /// With the vehicle as filed.
    pub before: Estimate,
    /// With the corrected vehicle.
    pub after: Estimate,
    /// What the noise of the poses alone would make of it.
    pub pose_noise: f64,
    /// Number of pieces.
    pub pieces: usize,
    /// Length of a piece at least, m or rad.
    pub length: f64,
}

impl Drift {
    /// Drift over all runs of evidence with two vehicle files, as filed and as corrected; none of a
    /// table of steady points, or where one has no motion in time.
    ///
    /// A piece crosses no gap, and no sample that is lost or has no motion. Pieces are as long as
    /// possible while there are enough of them.
    pub fn of(evidence: &Weighted, files: [&VehicleFile; 2]) -> Self {
        if matches!(evidence.origin(), Origin::SteadyPoints(_)) {
            return Self::default();
        }
        let [before, after] = files.map(|file| replay::motions(evidence, file));
        let (Some(before), Some(after)) = (before, after) else { return Self::default() };
        let motions = [before, after];
        let samples = evidence.samples();
        let travelled = |sample: &Sample, _| {
            f64::midpoint(sample.speeds.left, sample.speeds.right).abs() * sample.duration
        };
        // noise of the poses would turn a robot that drives straight ahead
        let turned = |_: &Sample, index: usize| motions[1][index].yaw.abs();
        let stretches = stretches(evidence, &motions);
        let settings = &evidence.settings().drift;
        let min_pieces = settings.min_pieces;
        let replayed = Replayed { samples, motions: &motions, stretches, min_pieces };
        let angles = settings.angles.map(|turns| turns * TAU);
        let [forward, left, yaw] = evidence.noise().map_or([0.0; 3], |noise| noise.pose);
        let place_noise = |observed: &Pose| place_noise([forward, left, yaw], observed);
        // E|e| = √(2/π) σ of the difference of two yaws, σ² = 2 σ_yaw²
        let yaw_noise = |_: &Pose| (2.0 / PI * 2.0 * yaw).sqrt();
        let apart = |predicted: &Pose, observed: &Pose| {
            (predicted.x - observed.x).hypot(predicted.y - observed.y)
        };
        let turned_apart = |predicted: &Pose, observed: &Pose| (predicted.yaw - observed.yaw).abs();
        Self {
            place: replayed.compared(&settings.distances, travelled, apart, place_noise),
            yaw: replayed.compared(&angles, turned, turned_apart, yaw_noise),
        }
    }
}

/// Mean distance by which errors of both poses displace the end of a piece, m, from the variances
/// of a pose.
///
/// σ_x² = 2 σ_forward², σ_y² = 2 σ_left² + (σ_yaw d)², d the distance of the poses;
/// E|e| ≈ √(π/2) √((σ_x² + σ_y²)/2), exact where both are equal
fn place_noise([forward, left, yaw]: [f64; 3], observed: &Pose) -> f64 {
    let across = 2.0 * left + yaw * (observed.x.powi(2) + observed.y.powi(2));
    (FRAC_PI_2 * f64::midpoint(2.0 * forward, across)).sqrt()
}

/// Samples in a row, without gaps, lost ones, and ones in which a vehicle has no motion.
fn stretches(evidence: &Weighted, motions: &[Vec<Pose>; 2]) -> Vec<Range<usize>> {
    let samples = evidence.samples();
    let moves = |index: usize| {
        let all = motions.iter().map(|motions| motions[index]);
        all.flat_map(|of| [of.x, of.y, of.yaw]).all(f64::is_finite)
    };
    let mut stretches: Vec<Range<usize>> = Vec::new();
    for (index, seen) in evidence.motions().iter().enumerate() {
        if seen.is_lost || !moves(index) {
            continue;
        }
        match stretches.last_mut() {
            Some(last) if last.end == index && samples[index].follows => last.end = index + 1,
            _ => stretches.push(index..index + 1),
        }
    }
    stretches
}

/// Samples with the motions that two vehicles predict.
struct Replayed<'a> {
    samples: &'a [Sample],
    motions: &'a [Vec<Pose>; 2],
    stretches: Vec<Range<usize>>,
    /// Fewest pieces for a drift.
    min_pieces: usize,
}

impl Replayed<'_> {
    /// Both drifts over the longest pieces of which there are enough.
    fn compared(
        &self,
        lengths: &[f64],
        way: impl Fn(&Sample, usize) -> f64,
        error: impl Fn(&Pose, &Pose) -> f64,
        noise: impl Fn(&Pose) -> f64,
    ) -> Option<Compared> {
        let length_of = |index: usize| way(&self.samples[index], index);
        let (length, pieces) = lengths.iter().find_map(|&length| {
            let pieces = self.pieces(length, length_of);
            (pieces.len() >= self.min_pieces).then_some((length, pieces))
        })?;
        let blocks = self.samples.iter().map(|sample| sample.block + 1).max().unwrap_or(0);
        let mut sums: Vec<Sums<4>> = vec![[0.0; 4]; blocks];
        for piece in &pieces {
            let observed = self.samples[piece.clone()].iter().map(|one| replay::pose(&one.motion));
            let observed = chained(observed);
            let [before, after] = self
                .motions
                .each_ref()
                .map(|motions| error(&chained(motions[piece.clone()].iter().copied()), &observed));
            let way: f64 = piece.clone().map(length_of).sum();
            let block = &mut sums[self.samples[piece.start].block];
            for (sum, term) in block.iter_mut().zip([before, after, noise(&observed), way]) {
                *sum += term;
            }
        }
        sums.retain(|[.., way]| *way > 0.0);
        // drift = Σ |error| / Σ length
        Some(Compared {
            before: size(&sums, |[before, .., way]| before / way),
            after: size(&sums, |[_, after, _, way]| after / way),
            pose_noise: size(&sums, |[.., noise, way]| noise / way).value,
            pieces: pieces.len(),
            length,
        })
    }

    /// Pieces of at least this length; what is left of a stretch is too short and dropped.
    fn pieces(&self, length: f64, of: impl Fn(usize) -> f64) -> Vec<Range<usize>> {
        let mut pieces = Vec::new();
        for stretch in &self.stretches {
            let begin = stretch.clone().find(|&index| self.samples[index].has_place[0]);
            let Some(begin) = begin else { continue };
            let (mut first, mut way) = (begin, 0.0);
            for index in begin..stretch.end {
                way += of(index);
                if way >= length * ROUNDING && self.samples[index].has_place[1] {
                    pieces.push(first..index + 1);
                    (first, way) = (index + 1, 0.0);
                }
            }
        }
        pieces
    }
}

/// Motions one after the other; the yaw is not wrapped.
fn chained(motions: impl Iterator<Item = Pose>) -> Pose {
    motions.fold(Pose::default(), |at, motion| at.compose(&motion))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings;
    use nalgebra::Vector3;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};
    use trackdyn_core::{PerSide, real};

    /// A circle of radius 1 m at 0.5 m/s in steps of half a second, in two runs.
    fn circle(count: usize) -> Vec<Sample> {
        let sample = |index: usize| Sample {
            run: index / (count / 2),
            block: index / (count / 8),
            start: 0.5 * real(index % (count / 2)),
            duration: 0.5,
            motion: Vector3::new(0.25, 0.0, 0.25),
            pose: Pose::default(),
            speeds: PerSide::new(0.4, 0.6),
            acceleration: PerSide::default(),
            follows: !index.is_multiple_of(count / 2),
            has_place: [true; 2],
        };
        (0..count).map(sample).collect()
    }

    fn drift(samples: &[Sample], yaw: f64) -> [Option<Compared>; 2] {
        let right: Vec<Pose> = samples.iter().map(|one| replay::pose(&one.motion)).collect();
        let wrong = right.iter().map(|of| Pose::new(of.x, of.y, yaw * of.yaw)).collect();
        let motions = [wrong, right];
        let half = samples.len() / 2;
        let stretches = vec![0..half, half..samples.len()];
        let settings = settings::Drift::default();
        let min_pieces = settings.min_pieces;
        let replayed = Replayed { samples, motions: &motions, stretches, min_pieces };
        let angles = settings.angles.map(|turns| turns * TAU);
        let turned = |_: &Sample, index: usize| motions[1][index].yaw.abs();
        let way = |sample: &Sample, _| 0.5 * sample.duration;
        [
            replayed.compared(&angles, turned, |a, b| (a.yaw - b.yaw).abs(), |_| 0.01),
            replayed.compared(
                &settings.distances,
                way,
                |a, b| (a.x - b.x).hypot(a.y - b.y),
                |_| 0.0,
            ),
        ]
    }

    #[test]
    fn a_yaw_that_is_a_tenth_too_large_drifts_by_a_tenth_of_a_turn() {
        // 26 samples are a turn: 2 runs of 400 hold 30 turns
        let [yaw, place] = drift(&circle(800), 1.1).map(|one| one.expect("enough pieces"));
        assert!((yaw.before.value - 0.1).abs() < 1e-12 && yaw.after.value < 1e-12, "{yaw:?}");
        assert_eq!((yaw.pieces, yaw.length), (30, TAU));
        // Every piece errs alike
        assert!(yaw.before.half_width.expect("enough blocks") < 1e-9);
        // 26 samples turn by 6.5 rad
        assert!((yaw.pose_noise - 0.01 / 6.5).abs() < 1e-12, "{yaw:?}");
        assert_eq!((place.pieces, place.length), (10, 20.0));
        assert!(place.before.value > 0.05 && place.after.value < 1e-12, "{place:?}");
    }

    #[test]
    fn what_was_driven_too_little_has_no_drift() {
        // 16 samples of 0.25 m and 0.25 rad: 4 m, less than a turn
        assert_eq!(drift(&circle(16), 1.1), [None, None]);
        // 40 samples: 10 m, a turn and a half
        let [yaw, place] = drift(&circle(40), 1.1);
        assert!(yaw.is_none());
        assert_eq!(place.map(|place| place.length), Some(1.0));
    }

    #[test]
    fn noise_of_the_poses_displaces_ends_of_pieces() {
        let (mut random, sd) = (ChaCha8Rng::seed_from_u64(1), [0.02, 0.01, 0.004]);
        let end = Pose::new(3.0, 4.0, 1.0);
        let mut noisy = |pose: &Pose| {
            let [x, y, yaw] = sd.map(|sd| {
                let error: f64 = StandardNormal.sample(&mut random);
                sd * error
            });
            pose.compose(&Pose::new(x, y, yaw))
        };
        let count = 20_000;
        let error = |seen: Pose| (seen.x - end.x).hypot(seen.y - end.y);
        let errors: f64 =
            (0..count).map(|_| error(noisy(&Pose::default()).relative(&noisy(&end)))).sum();
        let mean = errors / real(count);
        let expected = place_noise(sd.map(|sd| sd * sd), &end);
        // The axes differ by a third, which the formula neglects
        assert!((expected / mean - 1.0).abs() < 0.05, "{expected} {mean}");
    }
}

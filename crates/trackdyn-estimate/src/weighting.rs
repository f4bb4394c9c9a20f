//! How much a residual counts.

use crate::noise::Noise;
use crate::observations::{Observation, Observations};
use nalgebra::{Matrix3, Matrix3x4, Matrix4, RowVector3, Vector3};
use trackdyn_core::Side;
use trackdyn_recording::StatedNoise;

/// The metric in which residuals are summed.
#[derive(Clone, Debug)]
pub enum Weighting {
    /// The cost (17): squared distances, with yaw errors turned into distances by a lever (m).
    /// Segments have equal weights and count as independent.
    Distance {
        /// The lever, m.
        lever: f64,
    },
    /// The noise of the recording: white noise of each pose, which neighbouring segments share, and
    /// a random walk within each segment.
    Noise(SegmentNoise),
}

impl Weighting {
    /// The noise of the recording; none where segments count alike.
    pub fn noise(&self) -> Option<&SegmentNoise> {
        match self {
            Self::Distance { .. } => None,
            Self::Noise(noise) => Some(noise),
        }
    }
}

/// Noise along the axes of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentNoise {
    /// Variance of each pose: forward (m²), left (m²), yaw (rad²).
    pub pose: [f64; 3],
    /// Variance per second that a segment adds, in the same units per s.
    pub walk: [f64; 3],
    /// Variance per second of a random walk of the sensor's heading, rad²/s. It turns all later
    /// segments as the sensor sees them, and not the motion within one.
    pub heading: f64,
    /// Variance of the error of each pose's stamp, s². A pose that was taken e later than it says
    /// lies e times the body's twist further.
    pub stamp: f64,
}

/// Smallest standard deviation of a pose that is assumed, m and rad: poses of a simulator have no
/// noise, and a covariance without noise has no inverse.
pub const MIN_POSE_NOISE: f64 = 1e-4;

impl SegmentNoise {
    /// From the noise that the maker of the recording states for its poses.
    pub fn stated(stated: StatedNoise) -> Self {
        let pose =
            [stated.position, stated.position, stated.yaw].map(|deviation| deviation.powi(2));
        Self { pose, walk: [0.0; 3], heading: 0.0, stamp: 0.0 }.at_least([MIN_POSE_NOISE, 0.0])
    }

    /// The noise with at least these standard deviations of a pose (m and rad) and of the walk in a
    /// second.
    pub fn at_least(self, [of_pose, of_walk]: [f64; 2]) -> Self {
        let pose = self.pose.map(|variance| variance.max(of_pose * of_pose));
        let walk = self.walk.map(|variance| variance.max(of_walk * of_walk));
        Self { pose, walk, ..self }
    }

    /// From the noise that was measured without a model: that of the poses while moving, or at
    /// stand-still where no other is known, and that of the encoders at a distance `gap` (m)
    /// between the ICRs. None where the recording does not show it.
    pub fn measured(noise: &Noise, gap: f64) -> Option<Self> {
        let poses = noise.moving.as_ref().or(noise.standing.as_ref())?;
        let components = [poses.forward, poses.lateral, poses.yaw];
        // A reading that is wrong by σ moves a track by σ u, u its time; that many readings a
        // second.
        let encoder = |side: Side| {
            noise.encoders[side].map_or(0.0, |e| e.deviation.powi(2) * e.update_interval)
        };
        let both = encoder(Side::Left) + encoder(Side::Right);
        let encoders = [both / 4.0, 0.0, both / gap.powi(2)];
        let mut walk = components.map(|component| component.walk.powi(2));
        walk.iter_mut().zip(encoders).for_each(|(walk, encoder)| *walk += encoder);
        let pose = components.map(|component| component.white.powi(2));
        Some(
            Self { pose, walk, heading: 0.0, stamp: poses.stamp.powi(2) }
                .at_least([MIN_POSE_NOISE, 0.0]),
        )
    }
}

/// What the noise of a segment depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Motion over the segment from its first pose: forward (m), left (m), yaw (rad).
    pub motion: [f64; 3],
    /// Its length, s.
    pub duration: f64,
    /// Index of its run.
    pub run: usize,
    /// Whether its first pose is the last one of the segment before it.
    pub follows: bool,
    /// Mean of u uᵀ about its first and about its last pose ([`about_poses`]), u the twist of the
    /// body along its axes there: forward (m/s), left (m/s), yaw (rad/s). Not the observed one: an
    /// error of a stamp that enters its own weight biases what is fitted.
    pub twists: [Matrix3<f64>; 2],
    /// Whether the places of its first and last pose were measured: if not, only their yaw was.
    pub has_place: [bool; 2],
    /// Whether it carries no information.
    pub is_lost: bool,
}

/// Variance of a place that nobody saw, m²: large enough to tell nothing, small enough that
/// rounding keeps the noise of a pose beside it.
const UNKNOWN_PLACE: f64 = 1e4;

impl Seen {
    /// Numbers that it measures: forward and left only with a place at its end.
    pub fn numbers(&self) -> usize {
        match (self.is_lost, self.has_place[1]) {
            (true, _) => 0,
            (false, true) => 3,
            (false, false) => 1,
        }
    }

    /// The segments that were observed.
    pub fn all(segments: &[Observation]) -> Vec<Self> {
        let stretch =
            |segment: &Observation| Stretch { twists: segment.twists, follows: segment.follows };
        let twists = about_poses(&segments.iter().map(stretch).collect::<Vec<_>>());
        let seen = segments.iter().zip(twists).map(|(segment, twists)| {
            let Observation { motion, duration, run, follows, .. } = *segment;
            let has_place = [true; 2];
            Self { motion, duration, run, follows, twists, has_place, is_lost: false }
        });
        seen.collect()
    }
}

/// How the body moves in a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Its twist after the first and before the last pose: forward (m/s), left (m/s), yaw (rad/s).
    pub twists: [[f64; 3]; 2],
    /// Whether its first pose is the last one of the segment before it.
    pub follows: bool,
}

/// Mean of u uᵀ about the first and the last pose of each segment: a pose that was taken early has
/// moved by the twist before it, one that was taken late by the twist after it.
pub fn about_poses(segments: &[Stretch]) -> Vec<[Matrix3<f64>; 2]> {
    let both = segments.iter().enumerate().map(|(index, segment)| {
        let [first, last] = segment.twists;
        let before = if segment.follows { segments[index - 1].twists[1] } else { first };
        let after = segments.get(index + 1).filter(|next| next.follows);
        [about(before, first), about(last, after.map_or(last, |next| next.twists[0]))]
    });
    both.collect()
}

/// Mean of u uᵀ of two twists.
fn about(before: [f64; 3], after: [f64; 3]) -> Matrix3<f64> {
    let square = |twist: [f64; 3]| {
        let twist = Vector3::from(twist);
        twist * twist.transpose()
    };
    (square(before) + square(after)) / 2.0
}

/// Residuals and their derivatives, three rows per segment, made white: unit variance, no
/// correlation.
pub struct Whitener {
    blocks: Vec<Block>,
}

/// How a segment's residual r is made white: z = L⁻¹ (r − K z_before − c e), then e grows by k·z.
#[derive(Clone)]
struct Block {
    /// L⁻¹; zero where the segment is lost.
    inverse: Matrix3<f64>,
    /// K: gain of the segment before on the pose that both share.
    gain: Matrix3<f64>,
    /// c: derivative of the residual by the error e of the heading.
    turned: Vector3<f64>,
    /// k: gain of the whitened residual on the error e.
    tells: RowVector3<f64>,
    /// Whether the error e is still exactly zero, at the beginning of a run.
    begins: bool,
}

/// What is known of the pose between two segments and of the heading there: the covariance of the
/// pose's noise, along the body's axes, and of the error e of the heading.
#[derive(Clone, Copy)]
struct Known {
    covariance: Matrix4<f64>,
    /// Gain of a whitened residual on the pose.
    tells: Matrix3<f64>,
}

impl Whitener {
    /// The whitener for these observations.
    pub fn new(weighting: &Weighting, observations: &Observations) -> Self {
        Self::of_motions(weighting, Seen::all(observations.segments()).into_iter())
    }

    /// The whitener for motions that were not observed but are expected.
    ///
    /// A pose that two segments share enters the first as its end and the second as its start, and
    /// an error of the heading all segments after it: a Kalman filter of both finds what of a
    /// residual is new.
    pub fn of_motions(weighting: &Weighting, motions: impl Iterator<Item = Seen>) -> Self {
        let noise = match weighting {
            Weighting::Distance { lever } => {
                let diagonal = Vector3::new(1.0, 1.0, *lever);
                let block = Block {
                    inverse: Matrix3::from_diagonal(&diagonal),
                    gain: Matrix3::zeros(),
                    turned: Vector3::zeros(),
                    tells: RowVector3::zeros(),
                    begins: true,
                };
                return Self { blocks: motions.map(|_| block.clone()).collect() };
            }
            Weighting::Noise(noise) => noise,
        };
        let mut before: Option<(Seen, Known)> = None;
        let blocks = motions.map(|segment| {
            let previous = before.filter(|(before, _)| before.run == segment.run);
            let (block, known) = noise.block(&segment, previous.map(|(_, known)| known));
            before = Some((segment, known));
            block
        });
        Self { blocks: blocks.collect() }
    }

    /// Logarithm of the determinant of each segment's whitening, given the segments before it; −∞
    /// of a segment that is lost.
    pub fn ln_determinants(&self) -> impl Iterator<Item = f64> + '_ {
        self.blocks.iter().map(|block| block.inverse.determinant().ln())
    }

    /// Colours a white column with the correlations of the noise, in place: the inverse of
    /// [`Whitener::whiten`].
    pub fn colour(&self, column: &mut [Vector3<f64>]) {
        let (mut before, mut heading) = (Vector3::zeros(), 0.0);
        for (value, block) in column.iter_mut().zip(&self.blocks) {
            heading = if block.begins { 0.0 } else { heading };
            // r = L z + K z_before + c e
            let white = *value;
            let factor = block.inverse.try_inverse().unwrap_or(Matrix3::identity());
            *value = factor * white + block.gain * before + block.turned * heading;
            heading += block.tells.tr_dot(&white);
            before = white;
        }
    }

    /// Whitens a column of three rows per segment, in place.
    pub fn whiten(&self, column: &mut [Vector3<f64>]) {
        let (mut before, mut heading) = (Vector3::zeros(), 0.0);
        for (value, block) in column.iter_mut().zip(&self.blocks) {
            heading = if block.begins { 0.0 } else { heading };
            // z = L⁻¹ (r − K z_before − c e)
            *value = block.inverse * (*value - block.gain * before - block.turned * heading);
            heading += block.tells.tr_dot(value);
            before = *value;
        }
    }

    /// Multiplies a column by L⁻ᵀ, the transpose of [`Whitener::whiten`], in place.
    pub fn whiten_transposed(&self, column: &mut [Vector3<f64>]) {
        let (mut after, mut heading) = (Vector3::zeros(), 0.0);
        for (value, block) in column.iter_mut().zip(&self.blocks).rev() {
            // z enters the residual after it, and the heading
            let white = *value + after + block.tells.transpose() * heading;
            *value = block.inverse.tr_mul(&white);
            after = -block.gain.tr_mul(value);
            heading = if block.begins { 0.0 } else { heading - block.turned.dot(value) };
        }
    }
}

impl SegmentNoise {
    /// Number of variances: three of the pose, three of its walk, one of the heading, one of the
    /// stamps.
    pub const COUNT: usize = 8;

    /// All variances, in the order of the fields.
    pub fn variances(&self) -> [f64; Self::COUNT] {
        let Self { pose: [x, y, turn], walk: [by_x, by_y, by_turn], heading, stamp } = *self;
        [x, y, turn, by_x, by_y, by_turn, heading, stamp]
    }

    /// Squares of a column u by the variances, uᵀ ∂V/∂v u, in the order of the fields: each error
    /// changes some residuals by a, and adds (aᵀ u)². V is the covariance of the segments that are
    /// not lost; u is zero where they are.
    pub fn squares(segments: &[Seen], u: &[Vector3<f64>]) -> [f64; Self::COUNT] {
        let (mut pose, mut walk, mut heading, mut stamp) = ([0.0; 3], [0.0; 3], 0.0, 0.0);
        let mut of_pose = |by: Vector3<f64>, twists: &Matrix3<f64>| {
            for (sum, part) in pose.iter_mut().zip(by.iter()) {
                *sum += part * part;
            }
            stamp += by.dot(&(twists * by));
        };
        // aᵀ u of the heading over all later segments of the run
        let mut later = 0.0;
        for (k, segment) in segments.iter().enumerate().rev() {
            let next = segments.get(k + 1);
            if next.is_some_and(|next| next.run != segment.run) {
                later = 0.0;
            }
            let mut last = rotation(-segment.motion[2]) * u[k];
            if let Some(next) = next.filter(|next| next.follows) {
                last += Self::by_start(next).tr_mul(&u[k + 1]);
            }
            of_pose(last, &segment.twists[1]);
            if !segment.follows {
                of_pose(Self::by_start(segment).tr_mul(&u[k]), &segment.twists[0]);
            }
            for (sum, part) in walk.iter_mut().zip(u[k].iter()) {
                *sum += segment.duration * part * part;
            }
            heading += segment.duration * (u[k][2] + later).powi(2);
            let [forward, left, _] = segment.motion;
            later += Vector3::new(left, -forward, 0.0).dot(&u[k]);
        }
        Self { pose, walk, heading, stamp }.variances()
    }

    /// The whitening of a segment, given what is known from its run before it, and what is known
    /// after it.
    fn block(&self, segment: &Seen, before: Option<Known>) -> (Block, Known) {
        let [first, last] = [0, 1].map(|end| {
            let unknown = if segment.has_place[end] { 0.0 } else { UNKNOWN_PLACE };
            let unknown = Matrix3::from_diagonal(&Vector3::new(unknown, unknown, 0.0));
            self.of_pose(&segment.twists[end]) + unknown
        });
        let heading = before.map_or(0.0, |known| known.covariance[(3, 3)]);
        let wanders = self.heading * segment.duration;
        // P, the covariance of the first pose and of the heading there
        let mut known = Matrix4::from_diagonal_element(heading);
        known.fixed_view_mut::<3, 3>(0, 0).copy_from(&first);
        let shared = before.filter(|_| segment.follows);
        if let Some(shared) = shared {
            known = shared.covariance;
        }
        let start = Self::by_start(segment);
        let [forward, left, _] = segment.motion;
        let turned = Vector3::new(left, -forward, 0.0);
        // H = (B c)
        let mut by_known = Matrix3x4::zeros();
        by_known.fixed_view_mut::<3, 3>(0, 0).copy_from(&start);
        by_known.set_column(3, &turned);
        // The noise of the last pose lies along the body's axes there: E R Eᵀ.
        let turn = rotation(-segment.motion[2]);
        let mut walk = Vector3::from(self.walk) * segment.duration;
        walk[2] += wanders;
        let own = turn.transpose() * last * turn + Matrix3::from_diagonal(&walk);
        // S = H P Hᵀ + E R Eᵀ + q T = L Lᵀ
        let innovation = by_known * known * by_known.transpose() + own;
        let factor = innovation.cholesky().map_or(Matrix3::identity(), |cholesky| cholesky.l());
        let inverse = factor.try_inverse().unwrap_or(Matrix3::identity());
        // The covariance G of the last pose and of the heading there with the residual, G L⁻ᵀ of it
        // made white.
        let mut with = known.row(3) * by_known.transpose();
        with[2] += wanders;
        let [of_pose, of_heading] = if segment.is_lost {
            [Matrix3::zeros(), Matrix3::zeros()]
        } else {
            let with = Matrix3::from_rows(&[with, RowVector3::zeros(), RowVector3::zeros()]);
            [last * turn, with].map(|with| with * inverse.transpose())
        };
        let tells: RowVector3<f64> = of_heading.row(0).into_owned();
        let mut after = Matrix4::zeros();
        after.fixed_view_mut::<3, 3>(0, 0).copy_from(&(last - of_pose * of_pose.transpose()));
        let between = -of_pose * tells.transpose();
        after.fixed_view_mut::<3, 1>(0, 3).copy_from(&between);
        after.fixed_view_mut::<1, 3>(3, 0).copy_from(&between.transpose());
        after[(3, 3)] = heading + wanders - tells.norm_squared();
        let block = Block {
            inverse: if segment.is_lost { Matrix3::zeros() } else { inverse },
            gain: shared.map_or(Matrix3::zeros(), |shared| start * shared.tells),
            turned,
            tells,
            begins: before.is_none(),
        };
        (block, Known { covariance: after, tells: of_pose })
    }

    /// Covariance of a pose's noise along the body's axes: R + s² u uᵀ.
    fn of_pose(&self, twists: &Matrix3<f64>) -> Matrix3<f64> {
        Matrix3::from_diagonal(&Vector3::from(self.pose)) + twists * self.stamp
    }

    /// What noise of the first pose, along its axes, does to the observed motion: it is subtracted,
    /// and its yaw turns the motion.
    fn by_start(segment: &Seen) -> Matrix3<f64> {
        let [forward, left, _] = segment.motion;
        -Matrix3::new(1.0, 0.0, -left, 0.0, 1.0, forward, 0.0, 0.0, 1.0)
    }
}

/// Turns forward and left by an angle.
fn rotation(angle: f64) -> Matrix3<f64> {
    let (sin, cos) = angle.sin_cos();
    Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;
    use trackdyn_core::real;

    const NOISE: SegmentNoise = SegmentNoise {
        pose: [9e-6, 4e-6, 3e-6],
        walk: [1e-6, 4e-6, 2.5e-7],
        heading: 4e-6,
        stamp: 1e-4,
    };

    /// Two runs of winding driving, the first with a gap and with a segment that is lost.
    fn segments() -> Vec<Seen> {
        let segment = |k: usize| {
            let turn = 0.3 + 0.1 * real(k);
            // the twist at a pose does not depend on which of its segments is looked at
            let twist = |k: usize| [0.7, 0.1 - 0.02 * real(k), real(k % 5) - 2.0];
            let about = |k: usize| about(twist(k), twist(k));
            Seen {
                twists: [about(k), about(k + 1)],
                motion: [0.2 * turn.cos(), 0.05 * turn.sin(), 0.6 * turn.sin()],
                duration: 0.3,
                run: k / 8,
                follows: !matches!(k, 0 | 3 | 6 | 8),
                has_place: [true; 2],
                is_lost: k == 5,
            }
        };
        (0..14).map(segment).collect()
    }

    /// These, but nobody saw the places of poses 2, 10 and 11.
    fn partly_seen() -> Vec<Seen> {
        let mut segments = segments();
        for (k, segment) in segments.iter_mut().enumerate() {
            segment.has_place = [k, k + 1].map(|pose| !matches!(pose, 2 | 10 | 11));
        }
        segments
    }

    /// Segments 9 to 11 lead from a place that was seen to the next; those of poses 10 and 11 were
    /// not.
    #[test]
    fn places_that_nobody_saw_change_nothing() {
        let segments = partly_seen();
        let whitener = Whitener::of_motions(&Weighting::Noise(NOISE), segments.iter().copied());
        let squares = |residual: &[Vector3<f64>]| -> f64 {
            let mut white = residual.to_vec();
            whitener.whiten(&mut white);
            white.iter().map(Vector3::norm_squared).sum()
        };
        let residual: Vec<_> = column(&segments, 0.3).iter().map(|one| 3e-3 * one).collect();
        let mut moved = residual.clone();
        for (k, by) in [(9, Vector3::new(0.2, -0.1, 0.0)), (10, Vector3::new(-0.3, 0.05, 0.0))] {
            // It ends one segment, and begins the next.
            moved[k] += rotation(segments[k].motion[2]) * by;
            moved[k + 1] += SegmentNoise::by_start(&segments[k + 1]) * by;
        }
        let [before, after] = [squares(&residual), squares(&moved)];
        assert!((after / before - 1.0).abs() < 1e-4, "{before} {after}");
        // A place that was seen tells.
        let mut wrong = residual;
        wrong[8] += Vector3::new(0.2, 0.0, 0.0);
        assert!(squares(&wrong) > 10.0 * before);
    }

    /// The covariance of all residuals, from what each independent error does to each of them.
    fn covariance(segments: &[Seen], noise: &SegmentNoise) -> DMatrix<f64> {
        let rows = 3 * segments.len();
        let mut sum = DMatrix::zeros(rows, rows);
        let mut add = |variance: f64, of: &dyn Fn(usize) -> Vector3<f64>| {
            let column: Vec<f64> =
                (0..segments.len()).flat_map(|k| <[f64; 3]>::from(of(k))).collect();
            let column = DMatrix::from_vec(rows, 1, column);
            sum += &column * column.transpose() * variance;
        };
        let unit = |axis: usize| Vector3::from_fn(|k, _| if k == axis { 1.0 } else { 0.0 });
        for (k, segment) in segments.iter().enumerate() {
            let start = SegmentNoise::by_start(segment);
            for axis in 0..3 {
                add(noise.walk[axis] * segment.duration, &|at| {
                    if at == k { unit(axis) } else { Vector3::zeros() }
                });
            }
            // errors of a pose: along each axis, and along the twist by its stamp
            let errors = |end: usize| {
                let unknown = if segment.has_place[end] { 0.0 } else { UNKNOWN_PLACE };
                let own =
                    move |axis: usize| noise.pose[axis] + if axis < 2 { unknown } else { 0.0 };
                let axes = (0..3).map(move |axis| (own(axis), unit(axis)));
                let twists = segment.twists[end];
                let along = twists.column(0) / twists[(0, 0)].sqrt();
                axes.chain([(noise.stamp, along)])
            };
            for (variance, error) in errors(1) {
                // the last pose, which may be the first of the next one
                add(variance, &|at| match at {
                    _ if at == k => rotation(segment.motion[2]) * error,
                    _ if at == k + 1 && segments[at].follows => {
                        SegmentNoise::by_start(&segments[at]) * error
                    }
                    _ => Vector3::zeros(),
                });
            }
            for (variance, error) in errors(0).filter(|_| !segment.follows) {
                add(variance, &|at| if at == k { start * error } else { Vector3::zeros() });
            }
            // the heading, which stays wrong until the end of the run
            add(noise.heading * segment.duration, &|at| {
                let [forward, left, _] = segments[at].motion;
                match at {
                    _ if at == k => unit(2),
                    _ if at > k && segments[at].run == segment.run => {
                        Vector3::new(left, -forward, 0.0)
                    }
                    _ => Vector3::zeros(),
                }
            });
        }
        sum
    }

    #[test]
    fn all_errors_of_poses_and_headings_come_out_white() {
        come_out_white(&segments(), 1e-10);
        // beside variances of 1e4 m² those of 1e-6 m² are rounded
        come_out_white(&partly_seen(), 1e-6);
    }

    fn come_out_white(segments: &[Seen], rounding: f64) {
        let whitener = Whitener::of_motions(&Weighting::Noise(NOISE), segments.iter().copied());
        let factor = covariance(segments, &NOISE).cholesky().expect("positive definite").l();
        let mut white = factor.clone();
        for mut column in white.column_iter_mut() {
            let mut values: Vec<Vector3<f64>> =
                (0..segments.len()).map(|k| column.fixed_rows::<3>(3 * k).into_owned()).collect();
            whitener.whiten(&mut values);
            for (k, value) in values.iter().enumerate() {
                column.fixed_rows_mut::<3>(3 * k).copy_from(value);
            }
        }
        // W C Wᵀ = 1, but for what is lost
        let found = &white * white.transpose();
        for a in 0..found.nrows() {
            for b in 0..found.ncols() {
                let is_lost = segments[a / 3].is_lost || segments[b / 3].is_lost;
                let expected = if a == b && !is_lost { 1.0 } else { 0.0 };
                assert!((found[(a, b)] - expected).abs() < rounding, "{a} {b}: {}", found[(a, b)]);
            }
        }
        let determinant: f64 = whitener.ln_determinants().filter(|ln| ln.is_finite()).sum();
        let known: Vec<usize> = (0..found.nrows()).filter(|a| !segments[a / 3].is_lost).collect();
        let covariance = covariance(segments, &NOISE).select_rows(&known).select_columns(&known);
        let expected =
            -covariance.cholesky().expect("positive definite").l().diagonal().map(f64::ln).sum();
        assert!((determinant - expected).abs() < 100.0 * rounding, "{determinant} {expected}");
    }

    /// A column that is zero where segments are lost.
    fn column(segments: &[Seen], seed: f64) -> Vec<Vector3<f64>> {
        let value = |(k, segment): (usize, &Seen)| {
            let values = Vector3::from_fn(|axis, _| (seed * real(3 * k + axis + 1)).sin());
            if segment.is_lost { Vector3::zeros() } else { values }
        };
        segments.iter().enumerate().map(value).collect()
    }

    fn product(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
    }

    #[test]
    fn the_transpose_of_whitening_is_its_transpose() {
        let segments = segments();
        let whitener = Whitener::of_motions(&Weighting::Noise(NOISE), segments.iter().copied());
        for (a, b) in [(1.3, 0.7), (2.1, 5.9), (0.2, 3.3)] {
            let [a, b] = [a, b].map(|seed| column(&segments, seed));
            let (mut white, mut transposed) = (a.clone(), b.clone());
            whitener.whiten(&mut white);
            whitener.whiten_transposed(&mut transposed);
            let [there, back] = [product(&white, &b), product(&a, &transposed)];
            assert!((there - back).abs() < 1e-9 * there.abs(), "{there} {back}");
        }
    }

    /// Of each variance alone, against the covariance of all errors.
    #[test]
    fn squares_are_what_each_variance_adds_to_the_covariance() {
        let segments = segments();
        let u = column(&segments, 1.7);
        let dense = nalgebra::DVector::from_iterator(3 * u.len(), u.iter().flatten().copied());
        let none = SegmentNoise { pose: [0.0; 3], walk: [0.0; 3], heading: 0.0, stamp: 0.0 };
        let alone = |k: usize| {
            let mut one = none;
            match k {
                0..3 => one.pose[k] = 1.0,
                3..6 => one.walk[k - 3] = 1.0,
                6 => one.heading = 1.0,
                _ => one.stamp = 1.0,
            }
            one
        };
        for (k, square) in SegmentNoise::squares(&segments, &u).into_iter().enumerate() {
            let expected = dense.dot(&(covariance(&segments, &alone(k)) * &dense));
            assert!((square - expected).abs() < 1e-9 * expected, "{k}: {square} {expected}");
        }
    }
}

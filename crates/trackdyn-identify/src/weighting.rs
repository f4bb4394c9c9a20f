//! How much a residual counts.

use crate::observations::{Observation, Observations};
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::Side;
use trackdyn_recording::noise::Noise;

/// The metric in which residuals are summed.
#[derive(Clone, Debug)]
pub enum Weighting {
    /// The cost (17): squared distances, with yaw errors turned into distances by a lever (m). Segments
    /// count alike and apart from each other.
    Distance {
        /// The lever, m.
        lever: f64,
    },
    /// The noise of the recording: white noise of each pose, which neighbouring segments share, and a
    /// random walk within each segment.
    Noise(SegmentNoise),
}

/// Noise along the axes of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentNoise {
    /// Variance of each pose: forward (m²), left (m²), yaw (rad²).
    pub pose: [f64; 3],
    /// Variance per second that a segment adds, in the same units per s.
    pub walk: [f64; 3],
}

impl SegmentNoise {
    /// From the noise that was measured without a model: that of the poses while moving, or at
    /// stand-still where no other is known, and that of the encoders at a distance `gap` (m) between
    /// the ICRs. None where the recording does not show it.
    pub fn measured(noise: &Noise, gap: f64) -> Option<Self> {
        let poses = noise.moving.as_ref().or(noise.standing.as_ref())?;
        let components = [poses.forward, poses.lateral, poses.yaw];
        // A reading that is wrong by σ moves a track by σ u, u its time; that many readings a second.
        let encoder = |side: Side| {
            noise.encoders[side].map_or(0.0, |e| e.deviation.powi(2) * e.update_interval)
        };
        let both = encoder(Side::Left) + encoder(Side::Right);
        let encoders = [both / 4.0, 0.0, both / gap.powi(2)];
        let mut walk = components.map(|component| component.walk.powi(2));
        walk.iter_mut().zip(encoders).for_each(|(walk, encoder)| *walk += encoder);
        Some(Self { pose: components.map(|component| component.white.powi(2)), walk })
    }
}

/// What of a segment its noise depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Motion over the segment from its first pose: forward (m), left (m), yaw (rad).
    pub motion: [f64; 3],
    /// Its length, s.
    pub duration: f64,
    /// Whether its first pose is the last one of the segment before it.
    pub follows: bool,
}

impl Seen {
    fn of(segment: &Observation) -> Self {
        let Observation { motion, duration, follows, .. } = *segment;
        Self { motion, duration, follows }
    }
}

/// Residuals and their derivatives, three rows per segment, made white: unit variance, no correlation.
pub struct Whitener {
    /// Per segment: the inverse of the diagonal block of the Cholesky factor, and the block that takes
    /// away what the segment before tells.
    blocks: Vec<(Matrix3<f64>, Matrix3<f64>)>,
}

impl Whitener {
    /// The whitener for these observations.
    ///
    /// The covariance of the residuals is block-tridiagonal: a pose that two segments share enters the
    /// first as its end and the second as its start. Its Cholesky factor is block-bidiagonal and is
    /// found in one pass.
    pub fn new(weighting: &Weighting, observations: &Observations) -> Self {
        Self::of_motions(weighting, observations.segments().iter().map(Seen::of))
    }

    /// The whitener for motions that were not observed but are expected.
    pub fn of_motions(weighting: &Weighting, motions: impl Iterator<Item = Seen>) -> Self {
        let mut blocks: Vec<(Matrix3<f64>, Matrix3<f64>)> = Vec::new();
        let mut before: Option<Seen> = None;
        for segment in motions {
            let (own, shared) = match weighting {
                Weighting::Distance { lever } => {
                    let diagonal = Vector3::new(1.0, 1.0, lever.powi(-2));
                    (Matrix3::from_diagonal(&diagonal), Matrix3::zeros())
                }
                Weighting::Noise(noise) => {
                    let previous = before.filter(|_| segment.follows);
                    (
                        noise.own(&segment),
                        previous.map_or(Matrix3::zeros(), |b| noise.shared(&b, &segment)),
                    )
                }
            };
            // S = C − K Kᵀ with K = shared · L⁻ᵀ of the segment before
            let gain =
                blocks.last().map_or(Matrix3::zeros(), |(inverse, _)| shared * inverse.transpose());
            let remaining = own - gain * gain.transpose();
            let factor = remaining.cholesky().map_or(Matrix3::identity(), |cholesky| cholesky.l());
            let inverse = factor.try_inverse().unwrap_or(Matrix3::identity());
            blocks.push((inverse, gain));
            before = Some(segment);
        }
        Self { blocks }
    }

    /// Logarithm of the determinant of what whitens each segment, given those before it.
    pub fn ln_determinants(&self) -> impl Iterator<Item = f64> + '_ {
        self.blocks.iter().map(|(inverse, _)| inverse.determinant().ln())
    }

    /// Gives a white column the noise's correlations, in place: the inverse of [`Whitener::whiten`].
    pub fn colour(&self, column: &mut [Vector3<f64>]) {
        let mut before = Vector3::zeros();
        for (value, (inverse, gain)) in column.iter_mut().zip(&self.blocks) {
            // r = L z + K z_before
            let white = *value;
            let factor = inverse.try_inverse().unwrap_or(Matrix3::identity());
            *value = factor * white + gain * before;
            before = white;
        }
    }

    /// Whitens a column of three rows per segment, in place.
    pub fn whiten(&self, column: &mut [Vector3<f64>]) {
        let mut before = Vector3::zeros();
        for (value, (inverse, gain)) in column.iter_mut().zip(&self.blocks) {
            // z = L⁻¹ (r − K z_before)
            *value = inverse * (*value - gain * before);
            before = *value;
        }
    }
}

impl SegmentNoise {
    /// Covariance of the residual of a segment.
    fn own(&self, segment: &Seen) -> Matrix3<f64> {
        let pose = Matrix3::from_diagonal(&Vector3::from(self.pose));
        let start = Self::by_start(segment);
        let turn = rotation(-segment.motion[2]);
        let walk = Vector3::from(self.walk) * segment.duration;
        // The end pose's noise lies along the body's axes there.
        start * pose * start.transpose()
            + turn.transpose() * pose * turn
            + Matrix3::from_diagonal(&walk)
    }

    /// Covariance of the residual of a segment with that of the one before.
    fn shared(&self, before: &Seen, segment: &Seen) -> Matrix3<f64> {
        let pose = Matrix3::from_diagonal(&Vector3::from(self.pose));
        // The noise of the shared pose, along the body's axes there, is the start of this one and the
        // end of that one.
        Self::by_start(segment) * pose * rotation(-before.motion[2])
    }

    /// What noise of the first pose, along its axes, does to the observed motion: it is subtracted, and
    /// its yaw turns the motion.
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

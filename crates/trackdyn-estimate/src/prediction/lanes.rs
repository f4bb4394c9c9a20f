//! Predictions and derivatives of many segments, side by side.
//!
//! # Law
//! With a = α_l/(x_r − x_l), b = α_r/(x_r − x_l) and the distances L and R that the tracks have
//! run, the heading is ψ = b R − a L. Forward and left motion, as a complex number, is
//!
//!   p = α_l P − (x_l + i y) E,  P = ∫ V_l e^{iψ} dt,  E = ∫ ω e^{iψ} dt = sin Ψ + i (1 − cos Ψ),
//!
//! so that ∂P/∂a = −i ∫ V_l L e^{iψ} dt and ∂P/∂b = i ∫ V_l R e^{iψ} dt are all that pieces are
//! needed for; the derivatives by the parameters follow once per segment.

use super::batch::{Batch, LANES};
use super::series::{arc, moment};
use super::{Prediction, predict};
use crate::observations::{Observation, Observations};
use crate::parameters::{COUNT, Parameters};
use rayon::prelude::*;

/// Batches that one thread takes at least: fewer cost more to hand over than to compute.
const MIN_BATCHES_PER_THREAD: usize = 64;

/// Angle of a piece, rad, up to which the series are exact to rounding.
const MAX_EXACT_ANGLE: f64 = 0.8;

/// The segments of a recording, to be predicted again and again.
pub struct Lanes<'a> {
    observations: &'a Observations,
    batches: Vec<Batch>,
}

impl<'a> Lanes<'a> {
    /// The segments of these observations.
    pub fn new(observations: &'a Observations) -> Self {
        Self { observations, batches: Batch::all(observations) }
    }

    /// The observations whose segments these are.
    pub fn observations(&self) -> &'a Observations {
        self.observations
    }

    /// The predictions of all segments, in their order.
    pub fn predict(&self, parameters: &Parameters) -> Vec<Prediction> {
        let batches: Vec<[Prediction; LANES]> = self
            .batches
            .par_iter()
            .zip(self.observations.segments().par_chunks(LANES))
            .with_min_len(MIN_BATCHES_PER_THREAD)
            .map(|(batch, segments)| predicted(batch, segments, parameters, self.observations))
            .collect();
        let mut predictions = batches.into_flattened();
        predictions.truncate(self.observations.len());
        predictions
    }
}

/// The predictions of a batch, whose segments are these.
fn predicted(
    batch: &Batch,
    segments: &[Observation],
    parameters: &Parameters,
    observations: &Observations,
) -> [Prediction; LANES] {
    let [x_l, x_r, y, alpha_l, alpha_r] = parameters.0;
    let per_gap = 1.0 / (x_r - x_l);
    let (a, b) = (alpha_l * per_gap, alpha_r * per_gap);
    let mut steepest = [0.0_f64; LANES];
    // Real and imaginary parts of P, ∫ V_l L e^{iψ} dt, ∫ V_l R e^{iψ} dt
    let mut sums = [[0.0; LANES]; 6];
    let (mut left, mut right) = ([0.0; LANES], [0.0; LANES]);
    let (mut cos, mut sin) = ([1.0; LANES], [0.0; LANES]);
    for [step_left, step_right] in &batch.pieces {
        for lane in 0..LANES {
            let (l, r) = (step_left[lane], step_right[lane]);
            let angle = b * r - a * l;
            steepest[lane] =
                if angle.abs() > steepest[lane] { angle.abs() } else { steepest[lane] };
            let (s, c) = arc(angle);
            let (u, v) = moment(angle);
            let (re, im) = (cos[lane], sin[lane]);
            let (p, p_i) = (l * (re * s - im * c), l * (re * c + im * s));
            let (m, m_i) = (l * (re * u - im * v), l * (re * v + im * u));
            sums[0][lane] += p;
            sums[1][lane] += p_i;
            sums[2][lane] += left[lane] * p + l * m;
            sums[3][lane] += left[lane] * p_i + l * m_i;
            sums[4][lane] += right[lane] * p + r * m;
            sums[5][lane] += right[lane] * p_i + r * m_i;
            left[lane] += l;
            right[lane] += r;
            let (sin_a, cos_a) = (s * angle, 1.0 - c * angle);
            cos[lane] = re * cos_a - im * sin_a;
            sin[lane] = im * cos_a + re * sin_a;
        }
    }
    if steepest.iter().any(|angle| *angle > MAX_EXACT_ANGLE) {
        return std::array::from_fn(|lane| {
            let segment = segments.get(lane);
            predict(parameters, segment.map_or(&[], |s| observations.pieces(s)))
        });
    }
    std::array::from_fn(|lane| {
        let [p, p_i, pl, pl_i, pr, pr_i] = sums.map(|sum| sum[lane]);
        let (l, r, re, im) = (left[lane], right[lane], cos[lane], sin[lane]);
        let (e, e_i) = (im, 1.0 - re);
        // (x_l + i y) e^{iΨ}
        let (z, z_i) = (x_l * re - y * im, x_l * im + y * re);
        // ∂p/∂a and ∂p/∂b
        let (pa, pa_i) = (alpha_l * pl_i + z * l, z_i * l - alpha_l * pl);
        let (pb, pb_i) = (-alpha_l * pr_i - z * r, alpha_l * pr - z_i * r);
        // what a change of x_r − x_l does
        let angle = b * r - a * l;
        let gap = [a * pa + b * pb, a * pa_i + b * pb_i, angle].map(|by| by * per_gap);
        let sensitivity: [[f64; 3]; COUNT] = [
            [gap[0] - e, gap[1] - e_i, gap[2]],
            gap.map(|by| -by),
            [e_i, -e, 0.0],
            [p + per_gap * pa, p_i + per_gap * pa_i, -l * per_gap],
            [per_gap * pb, per_gap * pb_i, r * per_gap],
        ];
        let forward = alpha_l * p - x_l * e + y * e_i;
        let leftward = alpha_l * p_i - x_l * e_i - y * e;
        Prediction { motion: [forward, leftward, angle], sensitivity }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SegmentOptions;
    use crate::synthetic::{Synthetic, random_steps};

    #[test]
    fn lanes_are_the_single_segments() {
        // readings of 0.05 s, and of 0.6 s, in which a piece turns by more than the series reach
        for track_interval in [0.05, 0.6] {
            let synthetic = Synthetic {
                schedules: vec![random_steps(7, 4.1, 1.5, 1)],
                track_interval,
                ..Synthetic::default()
            };
            let recording = synthetic.recording().expect("long enough");
            let observations = Observations::new(&recording, &SegmentOptions::default());
            assert_ne!(observations.len() % LANES, 0, "{track_interval}: the last batch is full");
            let lanes = Lanes::new(&observations);
            for at in [[-0.3, 0.5, 0.1, 0.9, 1.1], [-0.2, 0.2, 0.0, 1.0, 1.0]].map(Parameters) {
                let found = lanes.predict(&at);
                assert_eq!(found.len(), observations.len());
                for (found, segment) in found.iter().zip(observations.segments()) {
                    let single = predict(&at, observations.pieces(segment));
                    let pairs = found.motion.iter().zip(&single.motion);
                    let by = found.sensitivity.iter().zip(&single.sensitivity);
                    let pairs = pairs.chain(by.flat_map(|(a, b)| a.iter().zip(b)));
                    // motions of a metre, derivatives up to ten: rounding
                    for (found, single) in pairs {
                        assert!((found - single).abs() < 1e-13, "{found} {single}");
                    }
                }
            }
        }
    }
}

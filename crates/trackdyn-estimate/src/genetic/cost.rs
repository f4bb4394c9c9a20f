//! The cost (17), computed fast: a genetic algorithm spends its time there.

use crate::observations::Observations;
use crate::parameters::Parameters;
use crate::prediction::batch::{Batch, LANES};
use crate::prediction::{any_arc, arc};

/// Cost (17) over fixed observations: the squared distance between observed and predicted
/// positions, with yaw errors turned into distances by a lever, summed over the segments, m².
pub struct Cost {
    lever: f64,
    batches: Vec<Batch>,
}

impl Cost {
    /// The cost over these observations with a lever, m.
    pub fn new(observations: &Observations, lever: f64) -> Self {
        Self { lever, batches: Batch::all(observations) }
    }

    /// The cost at these parameters, m².
    pub fn at(&self, parameters: &Parameters) -> f64 {
        let turn = parameters.turns();
        let of = |batch: &Batch| {
            if batch.is_within_series(turn) {
                cost(batch, parameters, self.lever, arc)
            } else {
                cost(batch, parameters, self.lever, any_arc)
            }
        };
        self.batches.iter().map(of).sum()
    }
}

/// What the segments of a batch add to the cost, m².
fn cost(
    batch: &Batch,
    parameters: &Parameters,
    lever: f64,
    arc: impl Fn(f64) -> (f64, f64),
) -> f64 {
    let [x_l, x_r, y, alpha_l, alpha_r] = parameters.0;
    let per_gap = 1.0 / (x_r - x_l);
    let (mut forward, mut left, mut yaw) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    let (mut cos, mut sin) = ([1.0; LANES], [0.0; LANES]);
    for [left_way, right_way] in &batch.pieces {
        for lane in 0..LANES {
            let way = alpha_l * left_way[lane];
            // eqs (7)-(9) times the duration, to the left in place of right
            let angle = (alpha_r * right_way[lane] - way) * per_gap;
            let (ahead, aside) = (way - angle * x_l, -angle * y);
            let (s, c) = arc(angle);
            // The chord in the axes at the start of the piece, turned by yaw
            let (along, across) = (s * ahead - c * aside, c * ahead + s * aside);
            forward[lane] += cos[lane] * along - sin[lane] * across;
            left[lane] += sin[lane] * along + cos[lane] * across;
            yaw[lane] += angle;
            let (sin_a, cos_a) = (s * angle, 1.0 - c * angle);
            (cos[lane], sin[lane]) =
                (cos[lane] * cos_a - sin[lane] * sin_a, sin[lane] * cos_a + cos[lane] * sin_a);
        }
    }
    (0..LANES)
        .map(|lane| {
            let x = batch.observed[0][lane] - forward[lane];
            let y = batch.observed[1][lane] - left[lane];
            let turn = lever * (batch.observed[2][lane] - yaw[lane]);
            x * x + y * y + turn * turn
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SegmentOptions;
    use crate::prediction::predict;
    use crate::synthetic::{Synthetic, random_steps};

    #[test]
    fn fast_cost_equals_the_plain_sum() {
        equals_the_plain_sum(0.05, 1.0, true);
        // a piece turns by more than the series reach
        equals_the_plain_sum(1.5, 4.0, false);
    }

    fn equals_the_plain_sum(track_interval: f64, speed: f64, is_within_series: bool) {
        let noisy = Synthetic {
            schedules: vec![random_steps(7, 2.9, speed, 1)],
            track_interval,
            position_noise: 0.01,
            yaw_noise: 0.01,
            ..Synthetic::default()
        };
        let recording = noisy.recording().expect("long enough");
        let observations = Observations::new(&recording, &SegmentOptions::default());
        assert_ne!(observations.len() % LANES, 0, "the last batch has room");
        for parameters in [[-0.3, 0.5, 0.1, 0.9, 1.1], [-0.2, 0.2, 0.0, 1.0, 1.0]].map(Parameters) {
            let plain: f64 = observations
                .segments()
                .iter()
                .map(|segment| {
                    let predicted = predict(&parameters, observations.pieces(segment)).motion;
                    let [x, y, yaw] = [0, 1, 2].map(|k| segment.motion[k] - predicted[k]);
                    x * x + y * y + (0.2 * yaw).powi(2)
                })
                .sum();
            let cost = Cost::new(&observations, 0.2);
            let within =
                cost.batches.iter().all(|batch| batch.is_within_series(parameters.turns()));
            assert_eq!(within, is_within_series);
            let fast = cost.at(&parameters);
            assert!((fast / plain - 1.0).abs() < 1e-9, "{fast} {plain}");
        }
    }
}

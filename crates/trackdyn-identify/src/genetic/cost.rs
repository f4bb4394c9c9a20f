//! The cost (17), fast: a genetic algorithm asks for little else.

use crate::observations::{Observations, Piece};
use crate::parameters::Parameters;
use crate::prediction::arc;

/// Segments that are computed side by side, for the compiler to put into vector registers.
pub(super) const LANES: usize = 4;

/// One number per segment of a batch.
pub(super) type Lane = [f64; LANES];

/// Cost (17) over fixed observations: the squared distance between observed and predicted positions, with
/// yaw errors turned into distances by a lever, summed over the segments, m².
pub struct Cost {
    lever: f64,
    batches: Vec<Batch>,
}

/// Segments side by side; the shorter ones are filled up with pieces of no duration.
struct Batch {
    pieces: Vec<[Lane; 3]>,
    observed: [Lane; 3],
    /// 1 for a segment, 0 for a place that none fills.
    weight: Lane,
}

impl Cost {
    /// The cost over these observations with a lever, m.
    pub fn new(observations: &Observations, lever: f64) -> Self {
        let batches = observations.segments().chunks(LANES).map(|segments| {
            let pieces =
                |lane: usize| segments.get(lane).map_or(&[][..], |s| observations.pieces(s));
            let longest = (0..LANES).map(|lane| pieces(lane).len()).max().unwrap_or(0);
            let column = |k: usize, of: fn(&Piece) -> f64| -> Lane {
                std::array::from_fn(|lane| pieces(lane).get(k).map_or(0.0, of))
            };
            let of = |k: usize| {
                [column(k, |p| p.duration), column(k, |p| p.v_left), column(k, |p| p.v_right)]
            };
            let observed = |channel: usize| {
                std::array::from_fn(|lane| segments.get(lane).map_or(0.0, |s| s.motion[channel]))
            };
            Batch {
                pieces: (0..longest).map(of).collect(),
                observed: [observed(0), observed(1), observed(2)],
                weight: std::array::from_fn(|lane| f64::from(u8::from(lane < segments.len()))),
            }
        });
        Self { lever, batches: batches.collect() }
    }

    /// The cost at these parameters, m².
    pub fn at(&self, parameters: &Parameters) -> f64 {
        self.batches.iter().map(|batch| batch.cost(parameters, self.lever)).sum()
    }
}

impl Batch {
    fn cost(&self, parameters: &Parameters, lever: f64) -> f64 {
        let [x_l, x_r, y, alpha_l, alpha_r] = parameters.0;
        let per_gap = 1.0 / (x_r - x_l);
        let (mut forward, mut left, mut yaw) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let (mut cos, mut sin) = ([1.0; LANES], [0.0; LANES]);
        for [duration, v_left, v_right] in &self.pieces {
            for lane in 0..LANES {
                let v_l = alpha_l * v_left[lane];
                // eqs (7)-(9), to the left in place of right
                let w = (alpha_r * v_right[lane] - v_l) * per_gap;
                let (ahead, aside) = (v_l - w * x_l, -w * y);
                let angle = w * duration[lane];
                let (s, c) = arc(angle);
                // The chord in the axes at the start of the piece, times the duration, turned by yaw
                let along = duration[lane] * (s * ahead - c * aside);
                let across = duration[lane] * (c * ahead + s * aside);
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
                let x = self.observed[0][lane] - forward[lane];
                let y = self.observed[1][lane] - left[lane];
                let turn = lever * (self.observed[2][lane] - yaw[lane]);
                self.weight[lane] * (x * x + y * y + turn * turn)
            })
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prediction::motion;
    use trackdyn_recording::SegmentOptions;
    use trackdyn_recording::synthetic::{Synthetic, random_steps};

    #[test]
    fn fast_cost_equals_the_plain_sum() {
        let noisy = Synthetic {
            schedules: vec![random_steps(7, 1.3, 1.0, 1)],
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
                    let predicted = motion(&parameters, observations.pieces(segment));
                    let [x, y, yaw] = [0, 1, 2].map(|k| segment.motion[k] - predicted[k]);
                    x * x + y * y + (0.2 * yaw).powi(2)
                })
                .sum();
            let fast = Cost::new(&observations, 0.2).at(&parameters);
            assert!((fast / plain - 1.0).abs() < 1e-9, "{fast} {plain}");
        }
    }
}

//! The cost (17) as a quadratic form.
//!
//! # Law
//! With a = α_l/(x_r − x_l) and b = α_r/(x_r − x_l) the heading in a segment is ψ = b R − a L,
//! where L and R are the distances that the tracks have run: it knows nothing of the other
//! parameters. Forward and left motion, as a complex number, is
//!
//!   p = α_l P − (x_l + i y) E,  P = ∫ V_l e^{iψ} dt,  E = ∫ ω e^{iψ} dt = sin Ψ + i (1 − cos Ψ),
//!
//! with Ψ at the segment's end. The sum of |observed − p|² over the segments is therefore quadratic
//! in α_l, x_l and y, and its seven factors are sums of waves in a and b that run through no more
//! than 2 L and 2 R radians per unit. They are computed at a few hundred places and are known
//! everywhere else, to rounding.

use super::chebyshev::{Axis, Surface, places};
use crate::observations::{Observation, Observations, Piece};
use crate::parameters::{COUNT, Free, Parameters};
use crate::prediction::batch::{Batch, LANES, Lane};
use crate::prediction::{any_arc, arc};
use rayon::prelude::*;

/// Σ|P|², Σ|E|², Re Σ ō P, Σ ō E and Σ P̄ E, with the observed position o; the last two have two
/// parts each.
const FACTORS: usize = 7;

/// The cost (17) within ranges of the parameters.
pub(super) struct Form {
    free: Free,
    factors: Surface<FACTORS>,
    /// Σ|o|², m².
    observed: f64,
    yaw: Yaw,
}

/// Σ (observed yaw − b R + a L)², times the square of the lever, m².
struct Yaw {
    /// Σ of the products of observed yaw, R and L.
    products: [[f64; 3]; 3],
    lever: f64,
}

impl Form {
    /// The form, from at most `most` places; none where it would take more.
    pub(super) fn new(
        observations: &Observations,
        lever: f64,
        free: Free,
        ranges: &[[f64; 2]; COUNT],
        most: usize,
    ) -> Option<Self> {
        let axes = axes(observations, free, ranges)?;
        let places = places(&axes);
        if places.len() > most {
            return None;
        }
        let batches = Batch::all(observations);
        let values: Vec<[f64; FACTORS]> = places
            .into_par_iter()
            .map(|place| {
                let turn = turn(free, place);
                let mut sums = [[0.0; LANES]; FACTORS];
                for batch in &batches {
                    if batch.is_within_series(turn) {
                        add(batch, turn, &mut sums, arc);
                    } else {
                        add(batch, turn, &mut sums, any_arc);
                    }
                }
                sums.map(|lanes| lanes.iter().sum())
            })
            .collect();
        let positions =
            observations.segments().iter().map(|s| s.motion[0].powi(2) + s.motion[1].powi(2));
        Some(Self {
            free,
            factors: Surface::new(axes, &values),
            observed: positions.sum(),
            yaw: Yaw::new(observations, lever),
        })
    }

    /// The cost at parameters within the ranges, m².
    pub(super) fn at(&self, parameters: &Parameters) -> f64 {
        let [x_l, _, y, alpha_l, _] = parameters.0;
        let turn = parameters.turns();
        let place = if self.free == Free::Icrs { [turn[0], 0.0] } else { turn };
        let [p, e, op, oe, oe_i, pe, pe_i] = self.factors.at(place);
        // |o − α_l P + z E|², z = x_l + i y
        let squares = self.observed + alpha_l * alpha_l * p + (x_l * x_l + y * y) * e;
        let products = x_l * oe - y * oe_i - alpha_l * (op + x_l * pe - y * pe_i);
        let cost = squares + 2.0 * products + self.yaw.at(turn);
        // Rounding may take a perfect fit below zero.
        if cost < 0.0 { 0.0 } else { cost }
    }
}

/// a and b at a place: without α both are the same.
fn turn(free: Free, [first, second]: [f64; 2]) -> [f64; 2] {
    match free {
        Free::Icrs => [first, first],
        Free::IcrsAndAlphas => [first, second],
    }
}

/// The ranges of a and b; none where the functions wave too fast.
fn axes(observations: &Observations, free: Free, ranges: &[[f64; 2]; COUNT]) -> Option<[Axis; 2]> {
    let [x_l, x_r, _, alpha_l, alpha_r] = *ranges;
    let (least, most) = (1.0 / (x_r[1] - x_l[0]), 1.0 / (x_r[0] - x_l[1]));
    let longest = |speed: fn(&Piece) -> f64| {
        let way = |segment: &Observation| -> f64 {
            observations.pieces(segment).iter().map(|p| p.duration * speed(p).abs()).sum()
        };
        observations.segments().iter().map(way).fold(0.0, f64::max)
    };
    let (left, right) = (longest(|p| p.v_left), longest(|p| p.v_right));
    // Squares wave twice as fast.
    match free {
        Free::Icrs => Some([Axis::new([least, most], 2.0 * (left + right))?, Axis::point()]),
        Free::IcrsAndAlphas => {
            let axis =
                |[low, high]: [f64; 2], way: f64| Axis::new([low * least, high * most], 2.0 * way);
            Some([axis(alpha_l, left)?, axis(alpha_r, right)?])
        }
    }
}

/// Adds what the segments of a batch contribute to the factors.
fn add(
    batch: &Batch,
    [a, b]: [f64; 2],
    sums: &mut [Lane; FACTORS],
    arc: impl Fn(f64) -> (f64, f64),
) {
    let (mut ahead, mut aside) = ([0.0; LANES], [0.0; LANES]);
    let (mut cos, mut sin) = ([1.0; LANES], [0.0; LANES]);
    for [left, right] in &batch.pieces {
        for lane in 0..LANES {
            let angle = b * right[lane] - a * left[lane];
            let (s, c) = arc(angle);
            // P of the piece: V_l dt e^{iψ} (s + i c), with ψ at its start
            ahead[lane] += left[lane] * (cos[lane] * s - sin[lane] * c);
            aside[lane] += left[lane] * (sin[lane] * s + cos[lane] * c);
            let (sin_a, cos_a) = (s * angle, 1.0 - c * angle);
            (cos[lane], sin[lane]) =
                (cos[lane] * cos_a - sin[lane] * sin_a, sin[lane] * cos_a + cos[lane] * sin_a);
        }
    }
    let [forward, leftward, _] = &batch.observed;
    for lane in 0..LANES {
        let (p, p_i) = (ahead[lane], aside[lane]);
        let (e, e_i) = (sin[lane], 1.0 - cos[lane]);
        let (o, o_i) = (forward[lane], leftward[lane]);
        let products = [
            p * p + p_i * p_i,
            e * e + e_i * e_i,
            o * p + o_i * p_i,
            o * e + o_i * e_i,
            o * e_i - o_i * e,
            p * e + p_i * e_i,
            p * e_i - p_i * e,
        ];
        for (sum, product) in sums.iter_mut().zip(products) {
            sum[lane] += product;
        }
    }
}

impl Yaw {
    fn new(observations: &Observations, lever: f64) -> Self {
        let mut products = [[0.0; 3]; 3];
        for segment in observations.segments() {
            let travelled = observations.travelled(segment);
            let terms = [segment.motion[2], travelled.right, travelled.left];
            for (row, first) in products.iter_mut().zip(terms) {
                for (product, second) in row.iter_mut().zip(terms) {
                    *product += first * second;
                }
            }
        }
        Self { products, lever }
    }

    fn at(&self, [a, b]: [f64; 2]) -> f64 {
        let factors = [1.0, -b, a];
        let rows = self.products.iter().zip(factors).map(|(row, first)| {
            let products = row.iter().zip(factors).map(|(product, second)| product * second);
            first * products.sum::<f64>()
        });
        self.lever * self.lever * rows.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Cost, ranges};
    use super::*;
    use crate::SegmentOptions;
    use crate::synthetic::{Synthetic, random_steps};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    fn observations(pose_interval: f64) -> Observations {
        let noisy = Synthetic {
            schedules: vec![random_steps(9, 4.3, 1.0, 1)],
            track_interval: 0.03,
            pose_interval,
            encoder_noise: 0.02,
            position_noise: 0.01,
            yaw_noise: 0.01,
            ..Synthetic::default()
        };
        let recording = noisy.recording().expect("long enough");
        Observations::new(&recording, &SegmentOptions::default())
    }

    /// Largest relative difference to the plain cost over the ranges, and the places it took.
    fn difference(observations: &Observations, free: Free) -> f64 {
        let (gauge, lever) = (0.42, 0.21);
        let ranges = ranges(gauge);
        let form = Form::new(observations, lever, free, &ranges, 10_000).expect("smooth");
        let plain = Cost::new(observations, lever);
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut worst = 0.0_f64;
        for _ in 0..500 {
            let mut parameters = [0.0, 0.0, 0.0, 1.0, 1.0];
            for (parameter, [low, high]) in parameters.iter_mut().zip(ranges).take(free.count()) {
                // the ends of the ranges too
                *parameter =
                    low + (high - low) * (1.2 * random.random::<f64>() - 0.1).clamp(0.0, 1.0);
            }
            let parameters = Parameters(parameters);
            worst = worst.max((form.at(&parameters) / plain.at(&parameters) - 1.0).abs());
        }
        worst
    }

    #[test]
    fn the_form_is_the_cost_over_all_of_the_ranges() {
        for free in [Free::Icrs, Free::IcrsAndAlphas] {
            let usual = difference(&observations(0.27), free);
            assert!(usual < 1e-11, "{free:?}: {usual:e}");
            // a second between poses: up to five radians in a segment
            let sparse = difference(&observations(0.99), free);
            assert!(sparse < 1e-10, "{free:?}: {sparse:e}");
        }
    }

    #[test]
    fn what_would_take_more_places_than_it_saves_is_left() {
        let observations = observations(0.27);
        let of = |most| Form::new(&observations, 0.2, Free::IcrsAndAlphas, &ranges(0.42), most);
        assert!(of(100).is_none() && of(400).is_some());
    }
}

//! A driver's hand on a joystick.
//!
//! The paper identifies from nine paths of about 20 m driven by hand and validates on two (Martinez
//! et al. 2005, section 5.3); it does not print the speeds. Here the hand has an intention (cruise,
//! curve, tight turn, reverse) for one and a half to four seconds, the stick follows it as two lags
//! of a quarter second, and never rests quite: a wander of 2 % with a memory of one second.
//! Throttle and steering mix to V_l = throttle − steer, V_r = throttle + steer.

use super::ScheduleOptions;
use super::ramp::Ramp;
use crate::random::{Purpose, normal, stream};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::ops::Range;
use trackdyn_core::{PerSide, Schedule};

/// Length of a path, m.
const PATH_LENGTH: f64 = 20.0;
/// Standing before and after, s.
const REST_DURATION: f64 = 1.0;
/// Time constant of each of the two lags of the hand, s.
const HAND_TIME_CONSTANT: f64 = 0.25;
/// Standard deviation of the wander, per full deflection.
const WANDER_DEVIATION: f64 = 0.02;
/// Memory of the wander, s.
const WANDER_TIME_CONSTANT: f64 = 1.0;
/// Time of an intention, s.
const INTENTION_DURATION: Range<f64> = 1.5..4.0;

/// What the driver means to do, as deflections of the stick.
struct Intention {
    /// How often, against the others.
    weight: u32,
    throttle: Range<f64>,
    /// Size of the steering, to either side.
    steer: Range<f64>,
}

const INTENTIONS: [Intention; 4] = [
    Intention { weight: 3, throttle: 0.5..0.9, steer: 0.0..0.08 },
    Intention { weight: 5, throttle: 0.35..0.8, steer: 0.1..0.35 },
    Intention { weight: 2, throttle: 0.08..0.3, steer: 0.25..0.45 },
    Intention { weight: 1, throttle: -0.5..-0.25, steer: 0.0..0.25 },
];

/// The path of one run.
pub(super) fn schedule(options: &ScheduleOptions, run: i64) -> Schedule {
    let mut hand = Hand::new(stream(options.seed, run, Purpose::Hand), options.interval);
    let mut ramp = Ramp::new(options);
    ramp.hold(PerSide::default(), REST_DURATION);
    let mut length = 0.0;
    loop {
        let PerSide { left, right } = ramp.now();
        let speed = f64::midpoint(left, right).abs();
        length += speed * options.interval;
        let braking = speed * speed / (2.0 * options.acceleration);
        let arrived = match options.duration {
            Some(duration) => {
                let fastest = left.abs().max(right.abs());
                ramp.time() + fastest / options.acceleration + REST_DURATION >= duration
            }
            None => length + braking >= PATH_LENGTH,
        };
        if arrived {
            break;
        }
        let [throttle, steer] = hand.next();
        let mixed = PerSide::new(throttle - steer, throttle + steer);
        // both sides by the same factor: the curve stays
        let size = mixed.left.abs().max(mixed.right.abs()).max(1.0);
        ramp.towards(mixed.map(|deflection| options.fastest * deflection / size));
    }
    ramp.hold(PerSide::default(), REST_DURATION);
    ramp.finish()
}

/// The stick and the hand on it: throttle and steering, from −1 to 1.
struct Hand {
    random: ChaCha8Rng,
    interval: f64,
    left_of_intention: f64,
    intended: [f64; 2],
    /// Output of the first and the second lag.
    lags: [[f64; 2]; 2],
    wander: [f64; 2],
}

impl Hand {
    fn new(random: ChaCha8Rng, interval: f64) -> Self {
        let zero = [0.0; 2];
        Self {
            random,
            interval,
            left_of_intention: 0.0,
            intended: zero,
            lags: [zero; 2],
            wander: zero,
        }
    }

    /// Throttle and steering after another interval.
    fn next(&mut self) -> [f64; 2] {
        self.left_of_intention -= self.interval;
        if self.left_of_intention <= 0.0 {
            self.intend();
        }
        let follow = 1.0 - (-self.interval / HAND_TIME_CONSTANT).exp();
        let forget = (-self.interval / WANDER_TIME_CONSTANT).exp();
        let kick = WANDER_DEVIATION * (1.0 - forget * forget).sqrt();
        std::array::from_fn(|k| {
            self.wander[k] = forget * self.wander[k] + kick * normal(&mut self.random);
            let aim = self.intended[k] + self.wander[k];
            self.lags[0][k] += follow * (aim - self.lags[0][k]);
            self.lags[1][k] += follow * (self.lags[0][k] - self.lags[1][k]);
            self.lags[1][k]
        })
    }

    fn intend(&mut self) {
        let total: u32 = INTENTIONS.iter().map(|intention| intention.weight).sum();
        let mut drawn = self.random.random_range(0..total);
        let chosen = INTENTIONS.iter().find(|intention| {
            let hit = drawn < intention.weight;
            drawn = drawn.saturating_sub(intention.weight);
            hit
        });
        let Some(Intention { throttle, steer, .. }) = chosen else { return };
        let side = if self.random.random::<bool>() { 1.0 } else { -1.0 };
        self.intended = [
            self.random.random_range(throttle.clone()),
            side * self.random.random_range(steer.clone()),
        ];
        self.left_of_intention = self.random.random_range(INTENTION_DURATION);
    }
}

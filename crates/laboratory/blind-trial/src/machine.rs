//! Robots as their owners have them, and what owners take them for.

use crate::random::{happens, log_uniform, normal, uniform};
use rand_chacha::ChaCha8Rng;
use trackdyn_core::STANDARD_GRAVITY;
use trackdyn_core::rounding::Digits;
use trackdyn_model::contact::Friction;
use trackdyn_model::{RunningGear, Vehicle};

/// Share of owners whose friction ratio is off.
const WRONG_RATIO_SHARE: f64 = 0.6;
/// Share of owners whose centre of gravity is off.
const WRONG_COG_SHARE: f64 = 0.5;

/// Digits of the numbers of a data sheet.
const DIGITS: Digits = Digits::Decimals(4);

/// A robot.
#[derive(Clone, Debug)]
pub struct Machine {
    /// The robot as it is, without effects.
    pub vehicle: Vehicle,
    /// Radius of gyration about the vertical, m.
    pub gyration: f64,
}

impl Machine {
    /// A robot within what owners have: gauge 0.3 to 1.2 m, 20 to 500 kg, tracks or wheels.
    pub(crate) fn draw(random: &mut ChaCha8Rng) -> Self {
        let gauge = log_uniform(random, 0.3, 1.2);
        let mass = (400.0 * gauge.powf(1.5) * (0.5 * normal(random)).exp()).clamp(20.0, 500.0);
        let running_gear =
            if happens(random, 0.6) { track(gauge, random) } else { wheels(gauge, random) };
        let length = length(&running_gear);
        let along = uniform(random, 0.35, 0.85);
        let across = along * uniform(random, 0.85, 1.45);
        let cog = [gauge * uniform(random, -0.05, 0.05), length * uniform(random, -0.06, 0.06)];
        let hull = [1.1 * length, 1.25 * gauge];
        let gyration = (hull[0].hypot(hull[1]) / 12.0_f64.sqrt()) * uniform(random, 0.85, 1.15);
        let friction = Friction { across: DIGITS.round(across), along: DIGITS.round(along) };
        let vehicle = Vehicle {
            name: "robot".to_owned(),
            mass: DIGITS.round(mass),
            gauge: DIGITS.round(gauge),
            cog: cog.map(|value| DIGITS.round(value)),
            running_gear,
            uncertainty: trackdyn_model::vehicle::Uncertainty::default(),
            friction,
        };
        Self { vehicle, gyration: DIGITS.round(gyration) }
    }

    /// Weight, N.
    pub fn weight(&self) -> f64 {
        self.vehicle.mass * STANDARD_GRAVITY
    }

    /// From the rear to the front end of the contact, m.
    pub fn length(&self) -> f64 {
        length(&self.vehicle.running_gear)
    }

    /// Mean pressure on the ground, Pa.
    pub(crate) fn pressure(&self) -> f64 {
        let area = match &self.vehicle.running_gear {
            RunningGear::Track { contact_length, belt_width } => 2.0 * contact_length * belt_width,
            RunningGear::Wheels { contact_length, width, axles } => {
                axles.iter().map(|_| 2.0 * contact_length * width).sum()
            }
        };
        self.weight() / area
    }

    /// The vehicle as its owner knows it: geometry and mass right, and √(μ_x μ_y) with them; the
    /// ratio of friction and the centre of gravity sometimes off.
    pub(crate) fn as_owned(&self, random: &mut ChaCha8Rng) -> Vehicle {
        let mut vehicle = self.vehicle.clone();
        let (ratio, [x, y]) = (0.08 * normal(random), [normal(random), normal(random)]);
        if happens(random, WRONG_RATIO_SHARE) {
            let factor = (ratio / 2.0).clamp(-0.1, 0.1).exp();
            vehicle.friction.across = DIGITS.round(vehicle.friction.across * factor);
            vehicle.friction.along = DIGITS.round(vehicle.friction.along / factor);
        }
        if happens(random, WRONG_COG_SHARE) {
            vehicle.cog[0] =
                DIGITS.round(vehicle.cog[0] + 0.012 * self.vehicle.gauge * x.clamp(-2.0, 2.0));
            vehicle.cog[1] =
                DIGITS.round(vehicle.cog[1] + 0.015 * self.length() * y.clamp(-2.0, 2.0));
        }
        vehicle
    }
}

fn track(gauge: f64, random: &mut ChaCha8Rng) -> RunningGear {
    RunningGear::Track {
        contact_length: DIGITS.round(gauge * uniform(random, 0.9, 1.8)),
        belt_width: DIGITS.round(gauge * uniform(random, 0.15, 0.35)),
    }
}

fn wheels(gauge: f64, random: &mut ChaCha8Rng) -> RunningGear {
    let half = gauge * uniform(random, 0.35, 0.55);
    let axles = if happens(random, 0.75) { vec![half, -half] } else { vec![half, 0.0, -half] };
    RunningGear::Wheels {
        contact_length: DIGITS.round(gauge * uniform(random, 0.1, 0.2)),
        width: DIGITS.round(gauge * uniform(random, 0.15, 0.28)),
        axles: axles.into_iter().map(|value| DIGITS.round(value)).collect(),
    }
}

fn length(gear: &RunningGear) -> f64 {
    match gear {
        RunningGear::Track { contact_length, .. } => *contact_length,
        RunningGear::Wheels { contact_length, axles, .. } => {
            let (low, high) = axles
                .iter()
                .fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(*y), high.max(*y)));
            high - low + contact_length
        }
    }
}

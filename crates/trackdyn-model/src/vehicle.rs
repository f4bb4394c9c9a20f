//! The vehicle: mass, running gear, centre of gravity and the friction it stands on.

use crate::contact::{Friction, Patch};
use trackdyn_core::{STANDARD_GRAVITY, Side};

mod check;
mod uncertainty;

pub use check::VehicleError;
pub use uncertainty::{FrictionUncertainty, Uncertainty};

/// A tracked or skid-steer vehicle on its ground.
///
/// [`VehicleFile`](crate::VehicleFile) checks the values on the way in; whoever changes one calls
/// [`Vehicle::check`].
#[derive(Clone, Debug, PartialEq)]
pub struct Vehicle {
    /// Name for titles and outputs.
    pub name: String,
    /// Mass, kg.
    pub mass: f64,
    /// Distance between the centre-lines of the two sides, L, m.
    pub gauge: f64,
    /// Centre of gravity (x_c, y_c) in the paper's frame, m.
    pub cog: [f64; 2],
    /// What touches the ground on each side.
    pub running_gear: RunningGear,
    /// Friction coefficients.
    pub friction: Friction,
    /// How well these values are known.
    pub uncertainty: Uncertainty,
}

/// What touches the ground on one side.
#[derive(Clone, Debug, PartialEq)]
pub enum RunningGear {
    /// One belt.
    Track {
        /// Contact length l, m.
        contact_length: f64,
        /// Width of the belt b, m.
        belt_width: f64,
    },
    /// Wheels that turn together.
    Wheels {
        /// Contact length of one tyre, m.
        contact_length: f64,
        /// Width of one tyre, m.
        width: f64,
        /// y of the axles, m.
        axles: Vec<f64>,
    },
}

impl Vehicle {
    /// Weight on level ground, N.
    pub fn weight(&self) -> f64 {
        self.mass * STANDARD_GRAVITY
    }

    /// Contact patches of one side.
    pub fn patches(&self, side: Side) -> Vec<Patch> {
        let x = side.sign() * self.gauge / 2.0;
        match &self.running_gear {
            RunningGear::Track { contact_length, belt_width } => {
                vec![Patch::centred([x, 0.0], *belt_width, *contact_length)]
            }
            RunningGear::Wheels { contact_length, width, axles } => {
                axles.iter().map(|&y| Patch::centred([x, y], *width, *contact_length)).collect()
            }
        }
    }
}

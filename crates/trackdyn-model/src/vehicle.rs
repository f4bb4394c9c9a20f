//! The vehicle: mass, running gear, centre of gravity and friction.

use crate::contact::{Friction, Patch};
use trackdyn_core::{STANDARD_GRAVITY, Side};

mod check;
mod uncertainty;

pub use check::VehicleError;
pub use uncertainty::{FrictionUncertainty, Uncertainty};

/// A tracked or skid-steer vehicle, and its friction on the ground.
///
/// [`VehicleFile`](crate::VehicleFile) checks the values it reads; after a change, call
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
    /// Running gear of each side.
    pub running_gear: RunningGear,
    /// Friction coefficients.
    pub friction: Friction,
    /// Measurement uncertainties of these values.
    pub uncertainty: Uncertainty,
}

/// Running gear of one side.
#[derive(Clone, Debug, PartialEq)]
pub enum RunningGear {
    /// One belt.
    Track {
        /// Contact length l, m.
        contact_length: f64,
        /// Width of the belt b, m.
        belt_width: f64,
    },
    /// A row of wheels that turn together.
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

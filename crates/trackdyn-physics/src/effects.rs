//! The catalogue: one file per effect, one line per file.

#[macro_use]
mod dispatch;
mod active;
#[cfg(test)]
mod conformance;
mod error;

pub use active::{ActiveEffect, Effects};
pub use error::EffectError;

use crate::effect::{Card, Effect};
use crate::model::{Circumstance, Ground, Site, Situation};
use trackdyn_core::{PerSide, Scalar, Wrench};

catalogue! {
    friction_split::FrictionSplit,
    centripetal::Centripetal,
    load_transfer::LoadTransfer,
    viscous_friction::ViscousFriction,
    motion_resistance::MotionResistance,
    resistance_split::ResistanceSplit,
    shear_displacement::ShearDisplacement,
    slope::Slope,
}

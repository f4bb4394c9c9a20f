//! What pushes a tracked robot: vehicle, contact with the ground, effects, and the balance of forces.
//!
//! - [`vehicle`]: mass, running gear, centre of gravity, friction.
//! - [`contact`]: friction of a patch, in closed form or by quadrature.
//! - [`effect`]: what an effect is; [`effects`]: the catalogue, one file each.
//! - [`model`]: the pipeline that turns a motion into the balance of forces.
//!
//! All of it is written over one scalar type, so every law has exact derivatives. Nothing here
//! iterates: finding the motion that balances the forces is the business of `trackdyn-motion`.
//! The paper's frame holds throughout: x right, y forward.

pub mod contact;
pub mod effect;
pub mod effects;
pub mod model;
pub mod vehicle;

pub use effects::{ActiveEffect, CATALOGUE, EffectError, Effects};
pub use model::{Balance, Circumstance, Drive, Ground, Model, Motion, Sensor};
pub use vehicle::{RunningGear, Uncertainty, Vehicle, VehicleError, VehicleFile};

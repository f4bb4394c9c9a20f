//! Laws of a user: effects beside the catalogue, as functions.
//!
//! ```
//! use trackdyn::law::{Argument, CustomLaw, Declared};
//! use trackdyn::{SimulateSettings, Vehicle, simulate};
//!
//! let strength = Declared::size("strength", "N s2/m2", 20.0).within([0.0, 1e4]);
//! let drag = CustomLaw::force("my-drag", "Drag of water", &[strength], |at, values, adds| {
//!     let speed = at.column(Argument::ForwardSpeed);
//!     for (force, v) in adds.column(0).iter_mut().zip(speed) {
//!         *force = -values[0] * v * v.abs();
//!     }
//!     Ok(())
//! })?;
//! trackdyn::law::register(drag)?;
//! let robot = Vehicle::auriga_alpha().with_effect("my-drag:strength=30")?;
//! # let settings = SimulateSettings { runs: Some(1), duration: Some(3.0), ..Default::default() };
//! let log = simulate(&robot, &settings)?.recording;
//! # assert!(log.motion().is_some());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::Error;
use trackdyn_model::EffectId;
pub use trackdyn_model::custom::{
    Argument, Batch, Cause, CustomLaw, Declared, DefinitionError, Failure, Kind, Outcome, Results,
};

/// Registers a law for the rest of the process: its id can be used like one of the catalogue. A
/// vehicle that has a law of the same id keeps it; others get this one.
///
/// # Errors
/// [`Error::Definition`] for a name of the catalogue, [`Error::Law`] where the law fails at typical
/// values.
pub fn register(law: CustomLaw) -> Result<EffectId, Error> {
    let law = law.measured().map_err(Box::new)?;
    Ok(EffectId::register(law)?)
}

/// Does work in which a law of a user may fail.
pub(crate) fn guarded<T>(work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    trackdyn_model::custom::guarded(work)?
}

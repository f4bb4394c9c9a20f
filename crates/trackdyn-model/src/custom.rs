//! Laws of a user: effects beside the catalogue, defined while a program runs.
//!
//! # Law
//! A law is a function of columns: what it [sees](Argument) at many states at once, and what it
//! [adds](Kind) there. Its derivatives are differences: the function is called once for a batch of
//! states and their neighbours.
//!
//! # Failure
//! Hooks of an effect cannot fail, but a function of a user can. It then unwinds the stack, without
//! a message, up to [`guarded`], which gives the [`Failure`].
//!
//! ```
//! use trackdyn_model::custom::{Argument, CustomLaw, Declared};
//! use trackdyn_model::{ActiveEffect, EffectId};
//!
//! let strength = Declared::size("strength", "N s2/m2", 20.0).within([0.0, 1e4]);
//! let law = CustomLaw::force("water-drag", "Drag of water", &[strength], |at, values, adds| {
//!     let speed = at.column(Argument::ForwardSpeed);
//!     for (force, v) in adds.column(0).iter_mut().zip(speed) {
//!         *force = -values[0] * v * v.abs();
//!     }
//!     Ok(())
//! })?;
//! EffectId::register(law)?;
//! let drag = ActiveEffect::new("water-drag", &[("strength", 30.0)])?;
//! assert_eq!(drag.to_string(), "water-drag:strength=30");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod active;
mod argument;
mod batch;
mod declared;
mod differences;
mod failure;
mod law;
mod symmetries;
mod together;

pub use active::ActiveLaw;
pub(crate) use active::seen_at;
pub use argument::{Argument, Kind};
pub use batch::{Batch, Results};
pub use declared::{Declared, DefinitionError};
pub use failure::{Cause, Failure, guarded};
pub use law::{CustomLaw, Outcome};
pub use together::together;

use std::sync::{PoisonError, RwLock};

/// All laws that were registered, in order.
///
/// A global registry, which nothing else of the models has: an [`EffectId`](crate::EffectId) is a
/// number that is copied into models, files and threads, and its card is found by it from anywhere.
/// A law is never freed, for an effect may outlive whoever defined it.
static REGISTERED_LAWS: RwLock<Vec<&'static CustomLaw>> = RwLock::new(Vec::new());

/// Registers a law for the rest of the process; its number.
pub(crate) fn register(law: CustomLaw) -> usize {
    let mut all = REGISTERED_LAWS.write().unwrap_or_else(PoisonError::into_inner);
    all.push(Box::leak(Box::new(law)));
    all.len() - 1
}

/// The law of this number, if there is one.
pub(crate) fn numbered(number: usize) -> Option<&'static CustomLaw> {
    REGISTERED_LAWS.read().unwrap_or_else(PoisonError::into_inner).get(number).copied()
}

/// The number of the last law of this name; none where there is no such law.
pub(crate) fn named(id: &str) -> Option<usize> {
    let all = REGISTERED_LAWS.read().unwrap_or_else(PoisonError::into_inner);
    all.iter().rposition(|law| law.card().id == id)
}

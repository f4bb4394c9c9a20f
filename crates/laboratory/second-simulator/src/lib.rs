//! An independent simulator of tracked robots in time, on which the diagnosis has to prove itself.
//!
//! A diagnosis that is tried on data of its own simulator proves that it can undo itself. So this
//! crate shares no law and no solver with `trackdyn-model`. It takes from it the description of a
//! vehicle and the names of symmetries. No crate that diagnoses may depend on it; a conformance
//! test reads the manifests.
//!
//! - [`Robot`]: Newton's law for a rigid body whose tracks stand on the ground with shoes that
//!   stick, deflect and slip; a [`Plant`](trackdyn_core::Plant).
//! - [`mechanism`]: what a mechanism can touch; [`mechanisms`]: all of them, one file each, with
//!   other functional forms than the catalogue's where there are any, and some that no catalogue
//!   has.
//! - [`form`]: which member of its family a law is.
//! - [`gear`]: belts as moving shoes, and what each of them carries.
//!
//! Bodies are described in the paper's frame (x right, y forward), the world in REP-103.

pub mod error;
pub mod form;
pub mod gear;
pub mod mechanism;
pub mod mechanisms;
mod page;
pub mod robot;
pub mod sheet;

pub use error::Error;
pub use form::Form;
pub use mechanisms::{ActiveMechanism, MECHANISMS, sheet_of};
pub use page::page;
pub use robot::{Robot, Setup};
pub use sheet::{Family, Origin, Parameter, Sheet, Symmetry};

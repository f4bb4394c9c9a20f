//! The sealed trial: the proof that a diagnosis finds what was concealed from it.
//!
//! - [`mod@plan`]: which cases there are: nulls, singles, pairs, equivalence cases, laws outside
//!   the catalogue.
//! - [`case`]: one case: a robot that nobody has seen, driven on the independent ground with
//!   something concealed, and its recording.
//! - [`difficulty`]: what is wrong in a case that conceals nothing.
//! - [`oracle`]: what could be found of it: z_det and z_iso.
//! - [`answer`]: what was concealed.
//! - [`draft`]: a trial in the making, which can be interrupted.
//! - [`key`]: keys, and what comes of one.
//! - [`seal`]: the commitment to the answers.
//! - [`entry`]: the programs that are put to it; [`room`]: where a process of one runs.
//! - [`sitting`], [`shard`]: the cases that a program is to diagnose.
//! - [`diagnosis`], [`score`]: what came back, and what it is worth.
//! - [`opened`]: trials whose answers are open, scored by themselves or together.
//! - [`revisit`]: a case once more, driven by another schedule; [`visit`]: by the one that is
//!   planned for its diagnosis.
//! - [`folder`]: the folder of a trial, in which nothing but the recordings tells cases apart.
//!
//! The diagnosis is not part of this crate: it is a program that gets a recording and a vehicle
//! file.

mod alternatives;
pub mod answer;
pub mod case;
pub mod diagnosis;
pub mod difficulty;
mod dose;
pub mod draft;
pub mod driving;
pub mod entry;
pub mod error;
pub mod failure;
pub mod folder;
pub mod forms;
mod ground;
mod instruments;
pub mod key;
mod machine;
mod old_seal;
pub mod opened;
pub mod oracle;
pub mod order;
pub mod plan;
mod random;
mod recorded;
pub mod revisit;
pub mod room;
pub mod score;
pub mod seal;
pub mod shard;
mod signature;
pub mod sitting;
mod subspace;
pub mod visit;

pub use answer::{Answer, Answers};
pub use case::Case;
pub use diagnosis::Diagnosis;
pub use difficulty::Difficulty;
pub use draft::Draft;
pub use entry::Entry;
pub use error::Error;
pub use failure::Failure;
pub use forms::Forms;
pub use key::{Key, Root};
pub use opened::Opened;
pub use order::Order;
pub use plan::{PlannedCase, Stratum, plan};
pub use room::{Program, Room};
pub use score::Score;
pub use shard::Shard;
pub use sitting::Sitting;
pub use visit::Visits;

//! What the crates promise, one module each.
//!
//! A test that needs private items stands in the file that it tests. All others stand here, those
//! of the program in `cli`, and the long ones of the diagnosis in `diagnosis`.

mod comparisons;
mod conformance;
mod diagnoses;
mod driving;
mod figures;
mod golden;
mod library;
mod odometry;
mod properties;
mod recording;
mod recovery;
mod second_simulator;
mod validation;
mod viewers;

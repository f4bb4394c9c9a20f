//! What the crates promise, one module each.
//!
//! What a module does by itself is tested with it. Tests of the program stand in `cli`, and the
//! long ones of the diagnosis in `diagnosis`.

mod comparisons;
mod conformance;
mod diagnoses;
mod driving;
mod figures;
mod golden;
mod library;
mod localisation;
mod odometry;
mod properties;
mod recording;
mod recovery;
mod second_simulator;
mod settings;
mod trial_scores;
mod validation;
mod viewers;

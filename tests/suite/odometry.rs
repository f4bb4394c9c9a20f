//! Dead reckoning and pose errors, against known truth and another program.

mod evo;
mod known_truth;

//! Whole matches and whole paths against known truth.

mod accuracy;
mod course;
mod degenerate;
mod drift;
mod robustness;

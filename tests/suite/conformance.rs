//! What the project promises of its own structure and catalogue.

mod arrows;
mod circles;
mod crates;
mod packages;
mod parity;
mod words;

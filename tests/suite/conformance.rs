//! What the project promises of its own structure and catalogue.

mod adding_an_effect;
mod arrows;
mod circles;
mod compiled_once;
mod constants;
mod crates;
mod licences;
mod literals;
mod packages;
mod pages;
mod parity;
mod scores;
mod words;

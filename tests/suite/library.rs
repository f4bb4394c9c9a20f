//! The library as a program that is built on it meets it.

mod advice;
mod custom_laws;
mod examples;
mod exports;
mod observer;
mod physics;
mod recordings;
mod settings;

use trackdyn::{SimulateSettings, Simulation, Vehicle, simulate};

/// Auriga-alpha, driven by hand for a number of runs of 20 s.
fn driven(runs: usize) -> Simulation {
    let settings =
        SimulateSettings { runs: Some(runs), duration: Some(20.0), ..SimulateSettings::default() };
    simulate(&Vehicle::auriga_alpha(), &settings).expect("it drives")
}

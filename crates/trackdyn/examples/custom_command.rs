//! A new command in thirty lines: how far does each log say that this robot slips in turns?
//!
//! `cargo run --release -p trackdyn --example custom_command -- VEHICLE RECORDING...`

use std::error::Error;
use trackdyn::{Identification, IdentifySettings, ReadOptions, Recording, Vehicle, identify};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    print!("{}", run(&arguments)?);
    Ok(())
}

/// A table: one line for each recording.
pub(crate) fn run(arguments: &[String]) -> Result<String, Box<dyn Error>> {
    let [vehicle, recordings @ ..] = arguments else {
        return Err("usage: custom_command VEHICLE RECORDING...".into());
    };
    let vehicle = Vehicle::open(vehicle)?;
    let mut table = String::from("steering efficiency  95 % interval    recording\n");
    for path in recordings {
        let recording = Recording::open(path, &ReadOptions::default())?;
        let found = identify(&recording, &vehicle, &IdentifySettings::default())?;
        let Identification::Motion(fit) = &found else { continue };
        let row = match &fit.found.fits[0].least_squares {
            Ok(estimate) if found.parameters().is_some() => {
                let chi = estimate.steering_efficiency(vehicle.gauge());
                format!("{:19.3}  {:.3} to {:.3}   {path}\n", chi.value, chi.low, chi.high)
            }
            _ => format!("{:>19}  {:16} {path}\n", "-", "not determined"),
        };
        table.push_str(&row);
    }
    Ok(table)
}

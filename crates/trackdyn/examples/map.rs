//! The ICR map of a robot with a high centre of gravity, with and without the load that it shifts.
//!
//! `cargo run --release -p trackdyn --example map`

use std::error::Error;
use std::path::Path;
use trackdyn::{MapSettings, Provenance, Vehicle, icr_map};

fn main() -> Result<(), Box<dyn Error>> {
    run(Path::new("out/example-map"))
}

/// Solves both maps, prints where the robot turns about, and writes the second one.
pub(crate) fn run(out: &Path) -> Result<(), Box<dyn Error>> {
    let rigid = Vehicle::auriga_alpha();
    let tall = rigid.clone().with_effect("load-transfer:cog_height_m=0.3")?;
    for (name, vehicle) in [("on the ground", &rigid), ("0.3 m high", &tall)] {
        let map = icr_map(vehicle, &MapSettings::default());
        let statistics = map.statistics().ok_or("it never turns")?;
        println!(
            "centre of gravity {name}: x_r - x_l = {:.4} m, steering efficiency {:.3}",
            statistics.mean.x_right - statistics.mean.x_left,
            statistics.steering_efficiency
        );
    }
    let map = icr_map(&tall, &MapSettings::default());
    for change in map.write(out, &Provenance::new("example map"))? {
        println!("{}", change.path().display());
    }
    Ok(())
}

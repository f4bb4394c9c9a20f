//! From a log to odometry that is right in turns: identify on some runs, replay others.
//!
//! `cargo run --release -p trackdyn --example log_to_odometry`

use std::error::Error;
use std::path::Path;
use trackdyn::export::Ros2Settings;
use trackdyn::{
    Export, IdentifySettings, OdometrySettings, Part, Provenance, ReadOptions, Recording,
    SimulateSettings, Vehicle, identify, odometry, simulate,
};

fn main() -> Result<(), Box<dyn Error>> {
    run(Path::new("out/example-odometry"))
}

/// Records a robot in simulation, identifies its parameters and writes what its odometry needs.
pub(crate) fn run(out: &Path) -> Result<(), Box<dyn Error>> {
    // A log, where there is no robot at hand: three runs driven by hand, seen by sensors of a
    // laboratory.
    let provenance = Provenance::new("example log_to_odometry");
    let settings = SimulateSettings { runs: Some(3), ..SimulateSettings::default() };
    let log = out.join("drive");
    simulate(&Vehicle::auriga_alpha(), &settings)?.write(&log, &provenance)?;

    let recording = Recording::open(&log, &ReadOptions::default())?;
    let vehicle = Vehicle::open(log.join("vehicle.toml"))?;
    let runs = |list: &str| Ok::<_, String>(Part { runs: Some(list.parse()?), time: None });
    let fitted = recording.part(&runs("0-1")?)?;
    let found = identify(&fitted, &vehicle, &IdentifySettings::default())?;
    let parameters = found.parameters().ok_or("two runs do not determine the ICRs")?;

    let settings = OdometrySettings { part: runs("2")?, ..OdometrySettings::default() };
    let replay = odometry(&recording, &vehicle, std::slice::from_ref(&parameters), &settings)?;
    for (index, set) in replay.comparison.sets.iter().enumerate() {
        let [place, yaw] = replay.error_at_end(index);
        println!("{:12} {place:.3} m, {:.2} deg off at the end", set.name(), yaw.to_degrees());
    }

    let sprocket_radius = 0.1;
    let files = Export::new(&parameters, &provenance)?.ros2(&Ros2Settings::new(sprocket_radius))?;
    for change in trackdyn::export::write(&files, out)? {
        println!("{}", change.path().display());
    }
    Ok(())
}

//! What does my model lack? A robot whose lugs grip better one way than its model knows is
//! recorded, diagnosed, and corrected; the diagnosis can be stopped with an observer.
//!
//! `cargo run --release -p trackdyn --example diagnose`

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;
use trackdyn::diagnose::Prepared;
use trackdyn::{
    DiagnoseSettings, Progress, Provenance, SimulateSettings, Vehicle, prepare_folder, simulate,
};

fn main() -> Result<(), Box<dyn Error>> {
    run(Path::new("out/example-diagnosis"))
}

/// Diagnoses a simulated log and writes the report and the corrected vehicle.
pub(crate) fn run(out: &Path) -> Result<(), Box<dyn Error>> {
    prepare_folder(out)?;
    // The model knows the robot's inertia, but not that its lugs grip better one way.
    let model = Vehicle::auriga_alpha().with_inertia(true);
    let robot = model.clone().with_effect("directional-lugs")?;
    let settings =
        SimulateSettings { runs: Some(2), duration: Some(30.0), ..SimulateSettings::default() };
    let log = simulate(&robot, &settings)?.recording;

    let prepared = Prepared::new(&[log], &model, &DiagnoseSettings::default())?;
    println!("{} segments of driving", prepared.evidence().samples().len());
    let diagnosis = prepared.run(&|Progress { stage, done, total, .. }| {
        println!("{done} of {total}: {stage}");
        ControlFlow::Continue(())
    })?;

    println!("{}", diagnosis.status().name());
    for claim in diagnosis.claims() {
        println!("missing: {}", claim.one_of().join(" or "));
        for size in claim.sizes() {
            println!("  {} = {:.3} [{:.3}, {:.3}]", size.key, size.value, size.low, size.high);
        }
    }
    for change in diagnosis.write(out, &Provenance::new("example diagnose"))? {
        println!("{}", change.path().display());
    }
    Ok(())
}

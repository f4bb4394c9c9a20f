//! A law of a user as a suspect in a diagnosis. The tests in Python have more of them.

use trackdyn::crates::drive::sensors::Preset;
use trackdyn::law::{Argument, CustomLaw, Declared, register};
use trackdyn::{DiagnoseSettings, HeldOut, SimulateSettings, Status, Vehicle, diagnose, simulate};

/// F = −c v at the centre of gravity: a hull that ploughs through snow. The catalogue has no such
/// law.
#[test]
fn a_suspect_that_the_catalogue_does_not_have_is_named() {
    let size = Declared::size("drag_kg_per_s", "kg/s", 200.0).within([0.0, 1e4]);
    let law = CustomLaw::force("my-hull", "Drag of the hull", &[size], |at, values, adds| {
        let speeds = [Argument::ForwardSpeed, Argument::LateralSpeed];
        for (place, argument) in speeds.into_iter().enumerate() {
            for (force, v) in adds.column(place).iter_mut().zip(at.column(argument)) {
                *force = -values[0] * v;
            }
        }
        Ok(())
    });
    let reads = [Argument::ForwardSpeed, Argument::LateralSpeed];
    let law = law.expect("it can be defined").reading(&reads);
    let laws = vec![register(law).expect("registered")];
    let model = Vehicle::auriga_alpha().with_inertia(true);
    let snow = model.clone().with_effect("my-hull:drag_kg_per_s=400").expect("registered");
    let driving = SimulateSettings {
        runs: Some(1),
        duration: Some(25.0),
        sensors: Preset::Laboratory.sensors(),
        seed: 3,
        ..SimulateSettings::default()
    };
    let log = simulate(&snow, &driving).expect("it drives").recording;
    let settings = DiagnoseSettings { held_out: HeldOut::None, laws, ..Default::default() };
    let found = diagnose(&[log], &model, &settings).expect("it can be diagnosed");
    let claims: Vec<_> = found.claims().collect();
    let named: Vec<_> = claims.iter().map(trackdyn::Claim::one_of).collect();
    // Poses of a laboratory are late, too: by a clock, or behind a slow drivetrain.
    let hull = claims.iter().find(|claim| claim.one_of() == ["my-hull"]);
    let hull = hull.unwrap_or_else(|| panic!("{named:?}"));
    assert!(claims.len() <= 2 && found.status() != Status::Unexplained, "{named:?}");
    let size = hull.sizes()[0];
    assert!(size.low < 400.0 && 400.0 < size.high, "{size:?}");
}

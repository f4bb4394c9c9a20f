//! A law of a user as a suspect in a diagnosis.

use std::sync::OnceLock;
use trackdyn::law::{Argument, CustomLaw, Declared, register};
use trackdyn::{
    DiagnoseSettings, Diagnosis, EffectId, HeldOut, Recording, SimulateSettings, Status, Vehicle,
    diagnose, simulate,
};

/// F = −c v at the centre of gravity: a hull that ploughs through snow. The catalogue has no such
/// law.
fn hull_drag() -> EffectId {
    static LAW: OnceLock<EffectId> = OnceLock::new();
    *LAW.get_or_init(|| {
        let size = Declared::size("drag_kg_per_s", "kg/s", 200.0).within([0.0, 1e4]);
        let law = CustomLaw::force("my-hull", "Drag of the hull", [size], |at, values, adds| {
            let speeds = [Argument::ForwardSpeed, Argument::LateralSpeed];
            for (place, argument) in speeds.into_iter().enumerate() {
                for (force, v) in adds.column(place).iter_mut().zip(at.column(argument)) {
                    *force = -values[0] * v;
                }
            }
            Ok(())
        });
        let reads = [Argument::ForwardSpeed, Argument::LateralSpeed];
        register(law.expect("it can be defined").reading(&reads)).expect("registered")
    })
}

fn log(robot: &Vehicle) -> Recording {
    let settings =
        SimulateSettings { runs: Some(4), duration: Some(40.0), ..SimulateSettings::default() };
    simulate(robot, &settings).expect("it drives").recording
}

fn diagnosed(log: Recording, laws: Vec<EffectId>) -> Diagnosis {
    let settings = DiagnoseSettings { held_out: HeldOut::None, laws, ..Default::default() };
    let model = Vehicle::auriga_alpha().with_inertia(true);
    diagnose(&[log], &model, &settings).expect("it can be diagnosed")
}

#[test]
fn it_is_named_where_it_acts_and_not_where_it_does_not() {
    let law = hull_drag();
    let model = Vehicle::auriga_alpha().with_inertia(true);
    let snow = model.clone().with_effect("my-hull:drag_kg_per_s=300").expect("registered");
    let found = diagnosed(log(&snow), vec![law]);
    let claims: Vec<_> = found.claims().collect();
    let named: Vec<_> = claims.iter().map(trackdyn::Claim::one_of).collect();
    assert_eq!(found.status(), Status::Explained, "{named:?}");
    assert!(named.len() == 1 && named[0] == ["my-hull"], "{named:?}");
    let size = &claims[0].sizes()[0];
    println!("{size:?}");
    assert!(format!("{:?}", found.corrected_vehicle().effects()).contains("my-hull"));

    let found = diagnosed(log(&model), vec![law]);
    let named: Vec<_> = found.claims().map(|claim| claim.one_of()).collect();
    assert!(named.iter().flatten().all(|id| *id != "my-hull"), "{named:?}");
}

/// Laws that are not asked about play no part, whoever registered them.
#[test]
fn a_law_that_is_no_suspect_is_not_looked_for() {
    let law = hull_drag();
    let snow = Vehicle::auriga_alpha().with_inertia(true);
    let snow = snow.with_effect("my-hull:drag_kg_per_s=300").expect("registered");
    let found = diagnosed(log(&snow), Vec::new());
    let search = found.claims().flat_map(|claim| claim.one_of());
    assert!(search.into_iter().all(|id| id != law.name()));
}

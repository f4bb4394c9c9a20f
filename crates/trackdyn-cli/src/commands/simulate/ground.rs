//! The two simulators.

use super::Options;
use trackdyn::crates::core::{Plant, Schedule, Trajectory};
use trackdyn::crates::model::Transient;
use trackdyn::crates::model::{ActiveEffect, Model, VehicleFile};
use trackdyn_second_simulator::{ActiveMechanism, Robot, Setup, sheet_of};

/// The motion of the hull, and the path that the pose sensor takes it to be.
type Motion = (Trajectory, Trajectory);

/// Moves the robot by the laws of the catalogue.
pub fn own(model: &Model, schedule: &Schedule, options: &Options) -> Result<Motion, String> {
    let [start_time, _] = schedule.span();
    let mut robot =
        Transient::at_rest(model, start_time, options.place.pose()).with_step(options.step);
    let path = robot.follow(schedule).map_err(|stopped| stopped.to_string())?;
    let reported = model.sensor().reported_path(&path);
    Ok((path, reported))
}

/// Moves the robot by the independent mechanisms of the same names, and those outside the catalogue.
pub fn independent(
    file: &VehicleFile,
    schedule: &Schedule,
    options: &Options,
) -> Result<Motion, String> {
    let mut mechanisms = options.mechanisms.clone();
    for effect in &file.effects {
        mechanisms.push(mechanism_of(effect)?);
    }
    let [start_time, _] = schedule.span();
    let setup = Setup {
        seed: options.seed,
        start: options.place.pose(),
        start_time,
        longest_step: options.step,
        shortest_step: Setup::default().shortest_step.min(options.step),
        ..Setup::default()
    };
    let mut robot =
        Robot::new(&file.vehicle, &mechanisms, &setup).map_err(|error| error.to_string())?;
    let path = robot.follow(schedule).map_err(|stopped| stopped.to_string())?;
    let reported = robot.report(&path);
    Ok((path, reported))
}

/// The mechanism of an effect's name. Its law has constants where the effect's has parameters: these are then to be left as
/// they are.
fn mechanism_of(effect: &ActiveEffect) -> Result<ActiveMechanism, String> {
    let card = effect.card();
    let sheet = sheet_of(card.id);
    let has = |key: &str| {
        sheet.is_none_or(|sheet| sheet.parameters.iter().any(|parameter| parameter.key == key))
    };
    let mut settings = Vec::new();
    for (parameter, &value) in card.parameters.iter().zip(effect.values()) {
        if has(parameter.key) {
            settings.push((parameter.key, value));
        } else if value != card.default_of(parameter) {
            return Err(format!(
                "--effect {}:{} = {value}: expected it left out on the independent ground, whose law has no such \
                 parameter",
                card.id, parameter.key
            ));
        }
    }
    ActiveMechanism::new(card.id, &settings).map_err(|error| error.to_string())
}

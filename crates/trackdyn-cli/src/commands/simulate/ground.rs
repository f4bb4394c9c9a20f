//! The independent simulator as a ground to drive on.

use trackdyn::crates::core::{Plant, Pose, Schedule};
use trackdyn::simulate::{Ground, Motion};
use trackdyn::{ActiveEffect, SimulateSettings, Vehicle};
use trackdyn_second_simulator::{ActiveMechanism, Error, Robot, Setup};

/// The independent mechanisms of the names of the vehicle's effects, and those outside the
/// catalogue.
pub struct Independent<'a> {
    vehicle: &'a Vehicle,
    mechanisms: &'a [ActiveMechanism],
    seed: u64,
    start: Pose,
    longest_step: f64,
}

impl<'a> Independent<'a> {
    /// The ground of a vehicle.
    pub fn new(
        vehicle: &'a Vehicle,
        settings: &SimulateSettings,
        mechanisms: &'a [ActiveMechanism],
    ) -> Self {
        let SimulateSettings { seed, start, longest_step, .. } = *settings;
        Self { vehicle, mechanisms, seed, start, longest_step }
    }
}

impl Ground for Independent<'_> {
    fn name(&self) -> String {
        "independent".to_owned()
    }

    fn mechanisms(&self) -> Vec<String> {
        self.mechanisms.iter().map(ToString::to_string).collect()
    }

    fn drive(
        &self,
        schedule: &Schedule,
    ) -> Result<Motion, Box<dyn std::error::Error + Send + Sync>> {
        let mut mechanisms = self.mechanisms.to_vec();
        for effect in self.vehicle.effects() {
            mechanisms.push(mechanism_of(effect)?);
        }
        let [start_time, _] = schedule.span();
        let setup = Setup {
            seed: self.seed,
            start: self.start,
            start_time,
            longest_step: self.longest_step,
            shortest_step: Setup::default().shortest_step.min(self.longest_step),
            ..Setup::default()
        };
        let mut robot = Robot::new(&self.vehicle.file().vehicle, &mechanisms, &setup)?;
        let body = robot.follow(schedule)?;
        let reported = robot.report(&body);
        Ok(Motion { body, reported })
    }
}

/// The mechanism of an effect's name.
fn mechanism_of(effect: &ActiveEffect) -> Result<ActiveMechanism, String> {
    let card = effect.card();
    let values = card.parameters.iter().zip(effect.values());
    let values =
        values.map(|(parameter, &value)| (parameter.key, value, card.default_of(parameter)));
    ActiveMechanism::of_effect(card.id, values).map_err(|error| match error {
        // begins with the option
        Error::Constant { .. } => format!("--{error}"),
        error => error.to_string(),
    })
}

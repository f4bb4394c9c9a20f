//! What moves the robot.

use super::SimulateSettings;
use crate::Vehicle;
use trackdyn_core::{Plant, Pose, Schedule, Trajectory};
use trackdyn_model::{Model as Forces, Transient};

/// How a robot moved in a run.
#[derive(Clone, Debug)]
pub struct Motion {
    /// The motion of its body.
    pub body: Trajectory,
    /// The path that its pose sensor takes it for, before noise.
    pub reported: Trajectory,
}

/// What moves a robot by the speeds of its tracks: a simulator.
pub trait Ground: Sync {
    /// Its name in files.
    fn name(&self) -> String;

    /// What acts there beside the effects of the vehicle, for files.
    fn mechanisms(&self) -> Vec<String> {
        Vec::new()
    }

    /// Drives a schedule from its start to its end.
    ///
    /// # Errors
    /// Why the motion cannot go on.
    fn drive(
        &self,
        schedule: &Schedule,
    ) -> Result<Motion, Box<dyn std::error::Error + Send + Sync>>;
}

/// The ground of this project's own model: the effects of the vehicle.
pub struct Model {
    forces: Forces,
    start: Pose,
    longest_step: f64,
}

impl Model {
    /// The ground of a vehicle.
    pub fn new(vehicle: &Vehicle, settings: &SimulateSettings) -> Self {
        let SimulateSettings { start, longest_step, .. } = *settings;
        Self { forces: vehicle.model(), start, longest_step }
    }
}

impl Ground for Model {
    fn name(&self) -> String {
        "own".to_owned()
    }

    fn drive(
        &self,
        schedule: &Schedule,
    ) -> Result<Motion, Box<dyn std::error::Error + Send + Sync>> {
        let [start_time, _] = schedule.span();
        let mut robot =
            Transient::at_rest(&self.forces, start_time, self.start).with_step(self.longest_step);
        let body = robot.follow(schedule)?;
        let reported = self.forces.sensor().reported_path(&body);
        Ok(Motion { body, reported })
    }
}

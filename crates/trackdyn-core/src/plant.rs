//! A robot that takes speed commands and moves.

use crate::{Moment, PerSide, Schedule, Trajectory};

/// What a driver or a schedule drives: a simulated robot, whatever its physics.
pub trait Plant {
    /// Where the robot is and how it moves.
    fn moment(&self) -> Moment;

    /// Holds track speeds, as the encoders show them (m/s), until a time (s), and appends the
    /// moments after the present one, the last of them at `until`.
    ///
    /// # Errors
    /// [`Stopped`] when the motion cannot go on; the moments up to there are appended.
    fn drive(
        &mut self,
        speeds: PerSide<f64>,
        until: f64,
        trajectory: &mut Trajectory,
    ) -> Result<(), Stopped>;

    /// Drives a schedule from its start to its end.
    ///
    /// # Errors
    /// As [`Plant::drive`].
    fn follow(&mut self, schedule: &Schedule) -> Result<Trajectory, Stopped>
    where
        Self: Sized,
    {
        let mut trajectory = Trajectory::default();
        trajectory.push(self.moment());
        for (_, until, speeds) in schedule.stretches() {
            self.drive(speeds, until, &mut trajectory)?;
        }
        Ok(trajectory)
    }
}

/// Why a motion cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the simulation stops at {t:.3} s: {reason}")]
pub struct Stopped {
    /// When, s.
    pub t: f64,
    /// What happened, and what would help.
    pub reason: String,
}

//! What the tracks are told to do, and when.

use crate::PerSide;

/// A speed command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// When it is given, s.
    pub t: f64,
    /// Track speeds, forward positive, m/s.
    pub speeds: PerSide<f64>,
}

/// Speed commands of one run: each holds until the next, as a robot's driver holds them.
///
/// The last command ends the schedule; its speeds are not driven any more.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    commands: Vec<Command>,
}

/// A schedule that cannot be driven.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScheduleError {
    /// Fewer than two commands.
    #[error("a schedule needs a command to start with and one to end with, and this has {0}")]
    TooShort(usize),
    /// A number that is none.
    #[error("command {index} holds a number that is not finite")]
    NotFinite {
        /// Place in the schedule, from 0.
        index: usize,
    },
    /// Times do not increase.
    #[error("command {index} at {t} s does not come after the one before it, at {before} s")]
    Unsorted {
        /// Place in the schedule, from 0.
        index: usize,
        /// Its time, s.
        t: f64,
        /// The time before it, s.
        before: f64,
    },
}

impl Schedule {
    /// Checks the commands.
    ///
    /// # Errors
    /// [`ScheduleError`] for fewer than two commands, numbers that are not finite and times that do
    /// not increase.
    pub fn new(commands: Vec<Command>) -> Result<Self, ScheduleError> {
        if commands.len() < 2 {
            return Err(ScheduleError::TooShort(commands.len()));
        }
        for (index, Command { t, speeds }) in commands.iter().enumerate() {
            if !(t.is_finite() && speeds.left.is_finite() && speeds.right.is_finite()) {
                return Err(ScheduleError::NotFinite { index });
            }
            if index > 0 && *t <= commands[index - 1].t {
                let before = commands[index - 1].t;
                return Err(ScheduleError::Unsorted { index, t: *t, before });
            }
        }
        Ok(Self { commands })
    }

    /// The commands, in time order.
    pub fn commands(&self) -> &[Command] {
        &self.commands
    }

    /// First and last time, s.
    pub fn span(&self) -> [f64; 2] {
        [self.commands[0].t, self.commands[self.commands.len() - 1].t]
    }

    /// Time from the first to the last command, s.
    pub fn duration(&self) -> f64 {
        let [start, end] = self.span();
        end - start
    }

    /// Speeds that hold at a time; the first ones before the start, the last ones at the end and
    /// after.
    pub fn at(&self, t: f64) -> PerSide<f64> {
        let after = self.commands.partition_point(|command| command.t <= t);
        self.commands[after.saturating_sub(1)].speeds
    }

    /// The schedule with all its times shifted, s.
    pub fn later(mut self, by: f64) -> Self {
        self.commands.iter_mut().for_each(|command| command.t += by);
        self
    }

    /// The stretches of constant speed: (start, end, speeds).
    pub fn stretches(&self) -> impl Iterator<Item = (f64, f64, PerSide<f64>)> + '_ {
        self.commands.windows(2).map(|pair| (pair[0].t, pair[1].t, pair[0].speeds))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn command(t: f64, left: f64, right: f64) -> Command {
        Command { t, speeds: PerSide::new(left, right) }
    }

    #[test]
    fn a_command_holds_until_the_next() {
        let schedule = Schedule::new(vec![
            command(1.0, 0.1, 0.2),
            command(2.0, 0.3, 0.4),
            command(4.0, 0.0, 0.0),
        ])
        .expect("a schedule");
        assert_eq!(schedule.at(0.0), PerSide::new(0.1, 0.2));
        assert_eq!(schedule.at(1.999), PerSide::new(0.1, 0.2));
        assert_eq!(schedule.at(2.0), PerSide::new(0.3, 0.4));
        assert_eq!(schedule.at(9.0), PerSide::new(0.0, 0.0));
        assert_eq!(schedule.duration(), 3.0);
        assert_eq!(schedule.stretches().count(), 2);
    }

    #[test]
    fn what_cannot_be_driven_is_refused() {
        let refused = |commands| Schedule::new(commands).expect_err("a refusal");
        assert_eq!(refused(vec![command(0.0, 0.0, 0.0)]), ScheduleError::TooShort(1));
        let nan = vec![command(0.0, 0.0, 0.0), command(1.0, f64::NAN, 0.0)];
        assert_eq!(refused(nan), ScheduleError::NotFinite { index: 1 });
        let twice = vec![command(0.0, 0.0, 0.0), command(0.0, 0.1, 0.0)];
        assert_eq!(refused(twice), ScheduleError::Unsorted { index: 1, t: 0.0, before: 0.0 });
    }
}

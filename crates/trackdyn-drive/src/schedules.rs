//! Schedules of track speeds: what a driver's hand, a plan or a file tells the tracks to do.

mod designed;
mod file;
mod manual;
mod options;
mod ramp;
mod square;

pub use file::{read, text, write};
use options::MAX_COMMANDS;
pub use options::ScheduleOptions;

use crate::Error;
use std::path::Path;
use std::str::FromStr;
use trackdyn_core::{Moment, Schedule, Trajectory};

/// The schedule of one run.
#[derive(Clone, Debug, PartialEq)]
pub struct ScheduledRun {
    /// Number of the run.
    pub id: i64,
    /// What the tracks do.
    pub schedule: Schedule,
}

/// A driven path with the commanded speeds in place of those of the belts: what encoders on the
/// sprockets see. A step of the command stays a step, whatever the steps of the simulation.
pub fn as_commanded(schedule: &Schedule, path: &Trajectory) -> Trajectory {
    /// Time from a command to its effect, s: far below what any sensor resolves.
    const COMMAND_DELAY: f64 = 1e-6;
    let mut commanded = Trajectory::default();
    let mut moments = path.moments().iter().peekable();
    for (start, end, belt_speed) in schedule.stretches() {
        while let Some(moment) = moments.next_if(|moment| moment.t <= start) {
            if commanded.span().is_none() {
                commanded.push(Moment { belt_speed, ..*moment });
            }
        }
        let t = start + COMMAND_DELAY;
        if commanded.span().is_some_and(|[_, last]| t > last) {
            let (pose, twist) = (path.pose_at(t), path.twist_at(t));
            commanded.push(Moment { t, pose, twist, belt_speed });
        }
        while let Some(moment) = moments.next_if(|moment| moment.t <= end) {
            if moment.t > t {
                commanded.push(Moment { belt_speed, ..*moment });
            }
        }
    }
    commanded
}

/// Time between two runs that are generated, s.
const PAUSE: f64 = 5.0;

/// Schedules that can be generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ScheduleKind {
    /// Driven by hand over 20 m, as the nine paths from which the paper identifies.
    Manual,
    /// Two further paths of the same hand, for validation.
    Validation,
    /// Spins, arcs and straight runs at several speeds, with rests between.
    Designed,
    /// Squares with turns on the spot, by dead reckoning.
    Square,
}

impl ScheduleKind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Manual, Self::Validation, Self::Designed, Self::Square];

    /// Its name on command lines.
    pub fn name(self) -> &'static str {
        match self {
            Self::Manual => "manual",
            Self::Validation => "validation",
            Self::Designed => "designed",
            Self::Square => "square",
        }
    }

    /// What it is, in a few words.
    pub fn about(self) -> &'static str {
        match self {
            Self::Manual => "paths of 20 m driven by hand: curves, tight turns, some reversing",
            Self::Validation => "two further paths of the same hand",
            Self::Designed => "spins, arcs and straight runs at several speeds, with rests",
            Self::Square => "squares with turns on the spot, left and right by turns",
        }
    }

    /// Runs where none are asked for.
    pub fn usual_runs(self) -> usize {
        match self {
            Self::Manual => 9,
            Self::Validation | Self::Square => 2,
            Self::Designed => 3,
        }
    }

    /// The schedules, run by run, one after the other by one clock; each depends on the options and
    /// its own number only, but for the time at which it begins.
    ///
    /// # Errors
    /// [`Error::Option`].
    pub fn generate(self, options: &ScheduleOptions) -> Result<Vec<ScheduledRun>, Error> {
        options.check()?;
        if self == Self::Square {
            options.check_square()?;
        }
        let first: i64 = match self {
            // the hand goes on where the nine paths end
            Self::Validation => 9,
            _ => 0,
        };
        let runs = i64::try_from(options.runs.unwrap_or(self.usual_runs())).unwrap_or(i64::MAX);
        let run = |id| {
            let schedule = match self {
                Self::Manual | Self::Validation => manual::schedule(options, id),
                Self::Designed => designed::schedule(options, id),
                Self::Square => square::schedule(options, id),
            };
            ScheduledRun { id, schedule }
        };
        let mut generated = Vec::new();
        let (mut commands, mut begin) = (0, 0.0);
        for id in first..first.saturating_add(runs) {
            let ScheduledRun { id, schedule } = run(id);
            commands += schedule.commands().len();
            if commands > MAX_COMMANDS {
                let expected = format!(
                    "runs of {MAX_COMMANDS} commands together, which memory holds; run {id} goes \
                     beyond"
                );
                return Err(Error::option("runs", &runs, expected));
            }
            let schedule = schedule.later(begin);
            begin = schedule.span()[1] + PAUSE;
            generated.push(ScheduledRun { id, schedule });
        }
        Ok(generated)
    }
}

impl FromStr for ScheduleKind {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        Self::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            Error::option("schedule", &name, format!("{names} or a CSV file t,v_left,v_right"))
        })
    }
}

/// The schedules that a name or a file stands for; the options count for names.
///
/// # Errors
/// Those of [`ScheduleKind::generate`] and [`read`]; [`Error::Option`] for what is neither.
pub fn load(choice: &str, options: &ScheduleOptions) -> Result<Vec<ScheduledRun>, Error> {
    let file = Path::new(choice);
    match choice.parse::<ScheduleKind>() {
        Ok(kind) => kind.generate(options),
        Err(_) if file.exists() || file.extension().is_some() => read(file),
        Err(unknown) => Err(unknown),
    }
}

//! What was found in the rows of a recording.

use crate::sample::Stream;
use std::fmt;
use trackdyn_core::Side;
use trackdyn_core::lines::counted;

/// One kind of finding in one series, gathered over the runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cleaning {
    /// The series.
    pub stream: Stream,
    /// What was found.
    pub finding: Finding,
    /// Rows or intervals it was found in.
    pub count: usize,
    /// Runs it was found in.
    pub runs: usize,
    /// The first of these runs.
    pub run: i64,
    /// Stamp of the first place in that run, s.
    pub t: f64,
}

/// What can be wrong with rows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// An empty cell, NaN or an infinity: the row is dropped.
    NotFinite,
    /// A stamp before the one above it: the rows are sorted.
    Unsorted,
    /// A stamp that is far from all others, as before a clock was set: the row is dropped.
    Far,
    /// A stamp that stands there already: the first row is kept.
    Repeated,
    /// Stamps closer than a tenth of the median interval: both stay, but one of them is likely
    /// wrong.
    Crowded,
    /// An interval of more than five times the median one, and of 0.1 s.
    Gap {
        /// The longest, s.
        longest: f64,
    },
    /// A jump of yaw by more than half a turn: whole turns are added from there on.
    YawUnwrapped,
    /// Speeds that jump away from their neighbours and back: the line between these replaces a few
    /// in a row, more are dropped.
    Spike {
        /// Size of the largest, m/s.
        largest: f64,
    },
    /// Readings of a side that stay at zero, or at one speed, while the poses show that its track
    /// moves otherwise: a few in a row are replaced by the line between their neighbours, more are
    /// dropped.
    Dead {
        /// The longest time, s.
        longest: f64,
    },
    /// Poses that repeat the one before while the tracks move: they are dropped.
    Frozen {
        /// The longest time, s.
        longest: f64,
    },
    /// Stamps of poses by a clock that gains on that of the tracks: they are set back.
    ClockRate {
        /// What it gains in a second, s.
        rate: f64,
        /// What it gains in the run, s.
        gained: f64,
    },
    /// Yaw rates of the IMU that stay the same while the poses turn otherwise: they are dropped.
    StuckGyroscope {
        /// The longest time, s.
        longest: f64,
    },
    /// Readings of a side at its largest speed while the poses show that its track runs faster:
    /// they are dropped.
    Saturated {
        /// The speed, m/s.
        limit: f64,
    },
    /// Readings of a side that are off by one speed all the time, also at rest: it is taken off.
    Biased {
        /// The side.
        side: Side,
        /// The speed, m/s.
        speed: f64,
    },
    /// Readings of a side that are cut off to whole steps, towards zero: half a step is added to
    /// those that are not zero.
    CutOff {
        /// The side.
        side: Side,
        /// The step, m/s.
        step: f64,
    },
}

impl Finding {
    /// Whether rows were dropped or moved because of it.
    pub(crate) fn changes_rows(self) -> bool {
        matches!(
            self,
            Self::NotFinite
                | Self::Unsorted
                | Self::Far
                | Self::Repeated
                | Self::Dead { .. }
                | Self::Frozen { .. }
                | Self::ClockRate { .. }
                | Self::StuckGyroscope { .. }
                | Self::Saturated { .. }
                | Self::Biased { .. }
                | Self::CutOff { .. }
        )
    }
}

impl Finding {
    /// Whether another one is gathered with it: of one kind, and of one side where it has one.
    fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Biased { side, .. }, Self::Biased { side: other, .. })
            | (Self::CutOff { side, .. }, Self::CutOff { side: other, .. }) => side == other,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }
}

/// Gathers findings of the same kind in the same series; the first place stands for all.
pub(super) fn gather(cleanings: Vec<Cleaning>) -> Vec<Cleaning> {
    let mut gathered: Vec<Cleaning> = Vec::new();
    for next in cleanings {
        let same = gathered
            .iter_mut()
            .find(|sum| sum.stream == next.stream && sum.finding.is_like(&next.finding));
        let Some(sum) = same else {
            gathered.push(next);
            continue;
        };
        sum.count += next.count;
        sum.runs += next.runs;
        match (&mut sum.finding, next.finding) {
            (Finding::Gap { longest: most }, Finding::Gap { longest: other })
            | (Finding::Dead { longest: most }, Finding::Dead { longest: other })
            | (Finding::Frozen { longest: most }, Finding::Frozen { longest: other })
            | (
                Finding::StuckGyroscope { longest: most },
                Finding::StuckGyroscope { longest: other },
            )
            | (Finding::Saturated { limit: most }, Finding::Saturated { limit: other })
            | (Finding::Spike { largest: most }, Finding::Spike { largest: other }) => {
                *most = most.max(other);
            }
            (Finding::ClockRate { gained: most, .. }, Finding::ClockRate { gained, .. })
                if gained.abs() > most.abs() =>
            {
                *most = gained;
            }
            _ => {}
        }
    }
    gathered.sort_by_key(|cleaning| cleaning.stream);
    gathered
}

impl fmt::Display for Cleaning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, runs, run, t, .. } = self;
        write!(f, "{}: {count} ", self.stream.name())?;
        match self.finding {
            Finding::NotFinite => write!(f, "rows with an empty cell, NaN or infinity dropped")?,
            Finding::Unsorted => write!(f, "steps back in time, rows sorted")?,
            Finding::Far => write!(f, "rows whose stamp is far from all others dropped")?,
            Finding::Repeated => write!(f, "rows with a repeated stamp dropped, the first kept")?,
            Finding::Crowded => {
                write!(f, "intervals below a tenth of the median: stamps may be wrong")?;
            }
            Finding::Gap { longest } => write!(f, "gaps, the longest {longest:.3} s")?,
            Finding::YawUnwrapped => write!(f, "jumps of yaw unwrapped")?,
            Finding::Spike { largest } => write!(
                f,
                "speeds that jump away from their neighbours and back, up to {largest:.1} m/s \
                 (glitch, restart or wrap of an encoder), replaced by the line between them where \
                 short and else left out"
            )?,
            Finding::Dead { longest } => write!(
                f,
                "readings of a side at zero or at one speed, for up to {longest:.3} s, while the \
                 poses show that its track moves otherwise (a dead encoder), bridged where short \
                 and else left out"
            )?,
            Finding::Frozen { longest } => write!(
                f,
                "rows repeat the one before, for up to {longest:.3} s, while the tracks drive (a \
                 tracker that is stuck, or poses that are sent again), left out"
            )?,
            Finding::ClockRate { rate, gained } => write!(
                f,
                "stamps by a clock that gains {:.2} ms a second on that of the tracks ({:.2} s in \
                 the longest run), set back",
                1e3 * rate,
                gained
            )?,
            Finding::StuckGyroscope { longest } => write!(
                f,
                "readings of the gyroscope stay the same, for up to {longest:.3} s, while the \
                 poses turn otherwise (stuck, or at the end of its range), left out"
            )?,
            Finding::Saturated { limit } => write!(
                f,
                "readings stand at the largest speed of their side, {limit:.3} m/s, while the \
                 poses show that its track runs faster (a limit of the encoder or of a message), \
                 left out"
            )?,
            Finding::Biased { side, speed } => write!(
                f,
                "readings of the {} side are {speed:+.3} m/s off all the time, also at rest, by \
                 what the poses show (a bias), which is taken off",
                side.name()
            )?,
            Finding::CutOff { side, step } => write!(
                f,
                "readings of the {} side are cut off to multiples of {step:.4} m/s, towards zero, \
                 by what the poses show (a speed as an integer): half a step is added to those \
                 that are not zero; odometry that reads them needs the same",
                side.name()
            )?,
        }
        write!(f, " ({}, first at t = {t:.3} s of run {run})", counted(*runs, "run"))
    }
}

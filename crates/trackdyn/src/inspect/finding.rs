//! What looks wrong with a recording.

use super::Driving;
use std::f64::consts::TAU;
use std::fmt;
use trackdyn_estimate::Contradiction;
use trackdyn_recording::Warning;
use trackdyn_recording::recording::Finding as Row;

/// Something that looks wrong.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// What reading found, and did about it.
    Reading(Warning),
    /// What reading refused, and the options mend with which to go on.
    Mended(String),
    /// Why it cannot be read.
    Unread(String),
    /// Clocks of tracks and poses.
    Clock(trackdyn_estimate::Error),
    /// What contradicts the parameters that it leads to.
    Fit(Contradiction),
    /// Poses that turn so far, rad, where the tracks say hardly any turning.
    Turning(f64),
    /// Points of a table that turn less than others that are driven less: how many.
    Lagging(usize),
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reading(warning) => warning.fmt(f),
            Self::Mended(reason) => write!(f, "mended in the commands below: {reason}"),
            Self::Unread(reason) => f.write_str(reason),
            Self::Clock(error) => error.fmt(f),
            Self::Fit(contradiction) => contradiction.fmt(f),
            Self::Turning(turned) => write!(
                f,
                "the poses turn {:.1} times, and the tracks say hardly any turning: are the speeds \
                 of both sides the same one, or those of something else? Expected the speed of \
                 each side",
                turned / TAU
            ),
            Self::Lagging(count) => write!(
                f,
                "{count} points turn less than one that is driven less: a track did not run at its \
                 speed"
            ),
        }
    }
}

/// What reading chose or dated, and what it found wrong.
pub(super) fn of_warnings(warnings: &[Warning]) -> (Vec<String>, Vec<Finding>) {
    let is_choice = |warning: &&Warning| match warning {
        Warning::Chosen { .. } | Warning::LogTime { .. } | Warning::TurnsAdded { .. } => true,
        Warning::Cleaned(cleaning) => cleaning.finding == Row::YawUnwrapped,
        _ => false,
    };
    let (choices, wrong): (Vec<&Warning>, Vec<&Warning>) = warnings.iter().partition(is_choice);
    let choices = choices.into_iter().map(ToString::to_string).collect();
    (choices, wrong.into_iter().cloned().map(Finding::Reading).collect())
}

/// Least turning of the poses, rad, that tracks have to show.
const MIN_TURN: f64 = TAU;

/// Least part of it that they show.
const MIN_SHOWN_SHARE: f64 = 0.1;

/// Poses that turn where the tracks say hardly any turning.
pub(super) fn of_turning(driving: &Driving) -> Option<Finding> {
    let turned = driving.turned_by_poses;
    let shown = driving.turned.left + driving.turned.right;
    (turned >= MIN_TURN && shown < MIN_SHOWN_SHARE * turned).then_some(Finding::Turning(turned))
}

//! What looks wrong with a recording.

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
    /// Points of a table that turn less than others that are driven less: how many.
    Lagging(usize),
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reading(warning) => warning.fmt(f),
            Self::Mended(reason) => write!(f, "{reason} (the commands below do so)"),
            Self::Unread(reason) => f.write_str(reason),
            Self::Clock(error) => error.fmt(f),
            Self::Fit(contradiction) => contradiction.fmt(f),
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

//! Which runs are held out.

use crate::{Error, MethodSettings};
use std::str::FromStr;
use trackdyn_recording::{Recording as Motion, RunList};

/// Runs that nothing is fitted or chosen on.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum HeldOut {
    /// [Every fourth](every_fourth) where there are enough, of a table every fourth point; as the
    /// group `held_out` of [`MethodSettings`] says.
    #[default]
    ByRule,
    /// None: the result is judged on what it was fitted to.
    None,
    /// These.
    Runs(RunList),
}

/// Reads `none`, or a list of runs such as `9-11`.
impl FromStr for HeldOut {
    type Err = <RunList as FromStr>::Err;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text == "none" { Ok(Self::None) } else { text.parse().map(Self::Runs) }
    }
}

impl HeldOut {
    /// Indices of the runs of a recording.
    pub(super) fn of_motion(
        &self,
        motion: &Motion,
        method: &MethodSettings,
    ) -> Result<Vec<usize>, Error> {
        let count = motion.runs().len();
        let held_out = match self {
            Self::ByRule => method.held_out.of(count),
            Self::None => Vec::new(),
            Self::Runs(list) => motion
                .indices_of(list)
                .map_err(|cause| Error::HeldOut { runs: list.clone(), cause })?,
        };
        if held_out.len() == count {
            return Err(Error::AllHeldOut);
        }
        Ok(held_out)
    }

    /// Indices of so many points of a table.
    pub(super) fn of_points(&self, count: usize, method: &MethodSettings) -> Vec<usize> {
        match self {
            Self::ByRule => method.held_out.of(count),
            Self::None | Self::Runs(_) => Vec::new(),
        }
    }

    /// Refuses runs, where a table of steady operating points has none.
    pub(super) fn refuse_runs(&self) -> Result<(), Error> {
        match self {
            Self::Runs(list) => Err(Error::NoRunsToHoldOut { runs: list.clone() }),
            Self::ByRule | Self::None => Ok(()),
        }
    }
}

/// The rule by which runs are held out unless settings say otherwise: indices of every fourth of so
/// many runs, or points of a table, where there are eight or more.
///
/// ```
/// assert_eq!(trackdyn::diagnose::every_fourth(9), [3, 7]);
/// assert!(trackdyn::diagnose::every_fourth(7).is_empty());
/// ```
pub fn every_fourth(runs: usize) -> Vec<usize> {
    MethodSettings::default().held_out.of(runs)
}

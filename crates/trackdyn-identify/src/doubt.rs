//! Reasons not to believe a parameter.

use crate::parameters::Parameters;

/// Why a recording does not determine a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// The interval is too wide to drive with.
    Wide {
        /// Index in [`Parameters::NAMES`].
        parameter: usize,
        /// Standard deviation, m or 1.
        deviation: f64,
        /// The largest that would do.
        limit: f64,
    },
    /// The tracks run alike: the robot hardly turns, and no ICR shows.
    NoTurning,
    /// The tracks run at one ratio of speeds, as in a spin or on one arc: ICRs and α cannot be told apart.
    OneRatio,
}

impl std::fmt::Display for Doubt {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Self::Wide { parameter, deviation, limit } => {
                let name = Parameters::NAMES[parameter];
                let unit = if parameter < 3 { " m" } else { "" };
                write!(
                    f,
                    "{name} is open by {deviation:.2}{unit} (one standard deviation; {limit:.2}{unit} \
                     would do): drive more turns of different kinds"
                )
            }
            Self::NoTurning => f.write_str(
                "the tracks run alike all the time, so no ICR shows: drive turns, both ways",
            ),
            Self::OneRatio => f.write_str(
                "the tracks run at one ratio of speeds all the time, so ICRs and alphas cannot be told \
                 apart: drive straight as well as turns, or fit without alphas",
            ),
        }
    }
}

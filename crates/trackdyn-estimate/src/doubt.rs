//! Reasons not to believe a parameter.

use crate::parameters::Parameters;
use crate::sensor::Nuisance;

/// Largest standard deviation that a message states: a larger one says no more.
const MAX_SHOWN_DEVIATION: f64 = 100.0;

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
    /// Poses and tracks do not turn alike.
    Unlike {
        /// Their best correlation, at any clock offset.
        correlation: f64,
    },
    /// The interval of a property of the sensor is too wide to be of use.
    WideNuisance {
        /// Which property.
        nuisance: Nuisance,
        /// Standard deviation, in its unit.
        deviation: f64,
    },
    /// A lever arm of the sensor moves the ICRs and nothing else.
    LeverArm,
    /// The robot drives on one circle, or turns on the spot: ICRs that are turned about the sensor
    /// pass for a sensor that is turned.
    NoTranslation,
    /// The track speeds hardly change: an offset of the clocks moves nothing.
    NoChange,
    /// No point of a table has a lateral speed.
    NoLateralSpeed,
    /// The tracks run alike: the robot hardly turns, and no ICR shows.
    NoTurning,
    /// The tracks run at one ratio of speeds, as in a spin or on one arc: ICRs and α cannot be told
    /// apart.
    OneRatio,
}

impl std::fmt::Display for Doubt {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Self::Wide { parameter, deviation, limit } => {
                let name = Parameters::NAMES[parameter];
                let unit = if parameter < 3 { " m" } else { "" };
                let by = if deviation < MAX_SHOWN_DEVIATION {
                    format!("{deviation:.2}{unit}")
                } else {
                    format!("more than {MAX_SHOWN_DEVIATION}{unit}")
                };
                write!(
                    f,
                    "{name} is open by {by} (one standard deviation; {limit:.2}{unit} would do): \
                     drive more turns of different kinds"
                )
            }
            Self::Unlike { correlation } => write!(
                f,
                "the poses do not turn as the tracks do (correlation {correlation:.2}): they may \
                 be those of another robot, their yaw no heading, or what was taken for the tracks \
                 something else: check topics, joints, columns and units"
            ),
            Self::WideNuisance { nuisance, deviation } => {
                let (limit, unit) = (nuisance.limit(), nuisance.unit());
                write!(
                    f,
                    "{nuisance} is open by {deviation:.3} {unit} (one standard deviation; \
                     {limit:.3} {unit} would do)"
                )
            }
            Self::LeverArm => f.write_str(
                "lever-arm cannot be told from the ICRs, which it moves as a whole, by poses and \
                 track speeds of any kind: measure the mount",
            ),
            Self::NoTranslation => write!(
                f,
                "{} shows only where the robot drives ahead as well as turns: drive straight, or \
                 on circles of different size",
                Nuisance::SensorYaw
            ),
            Self::NoChange => write!(
                f,
                "{} shows only where track speeds change, and here they change by less than their \
                 noise: speed up, slow down, begin and end turns",
                Nuisance::TimeOffset
            ),
            Self::NoLateralSpeed => f.write_str(
                "y shows in the lateral speed only, of which the table has none: measure v_lateral",
            ),
            Self::NoTurning => f.write_str(
                "the tracks run alike all the time, so no ICR shows: drive turns, both ways",
            ),
            Self::OneRatio => f.write_str(
                "the tracks run at one ratio of speeds all the time, so ICRs and alphas cannot be \
                 told apart: drive straight as well as turns, or fit without alphas",
            ),
        }
    }
}

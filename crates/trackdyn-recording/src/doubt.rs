//! What can contradict what in a recording.

use std::fmt;
use trackdyn_core::Side;

/// What contradicts what in a recording.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// Travel of the tracks and of the poses differs by a factor that no slip explains.
    Travel {
        /// Travel of the tracks per travel of the poses.
        ratio: f64,
        /// The units that have this ratio; none where no usual ones do.
        units: Option<&'static str>,
    },
    /// Stamps in a fraction of a second.
    Stamps {
        /// Median interval of the poses, in what should be s.
        interval: f64,
        /// The unit that explains them, where there is one.
        unit: Option<&'static str>,
    },
    /// Yaw in degrees.
    YawInDegrees,
    /// Poses whose orientation never changes while the tracks turn the robot.
    ConstantOrientation {
        /// Way that one track ran more than the other, m.
        turning: f64,
    },
    /// Poses that are tilted by more than a robot can be.
    OutOfPlane {
        /// How many.
        count: u64,
    },
    /// The joints or the speed of a side count backwards.
    Reversed(Side),
    /// Both sides count backwards.
    BothReversed,
    /// Tracks and poses turn in opposite senses: sides are swapped, or the z axis points down.
    Swapped,
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Travel { ratio, units } => {
                let (more, less, factor) = match *ratio {
                    ratio if ratio > 1.0 => ("tracks", "poses", ratio),
                    ratio => ("poses", "tracks", 1.0 / ratio),
                };
                write!(f, "the {more} travel {factor:.1} times as far as the {less}")?;
                match units {
                    Some(units) => write!(f, ", the ratio of {units}"),
                    None => write!(f, ", which no slip explains"),
                }
            }
            Self::Stamps { interval, unit } => {
                write!(f, "by the stamps there is a pose every {interval:.3} s")?;
                match unit {
                    Some(unit) => write!(f, ", and the motion says that they are {unit}"),
                    None => write!(f, ", and poses and tracks cover other times"),
                }
            }
            Self::YawInDegrees => {
                write!(f, "yaw follows the path of the poses in degrees, and not in radians")
            }
            Self::ConstantOrientation { turning } => write!(
                f,
                "the orientation never changes, while one track runs {turning:.1} m more than the \
                 other: poses of a GNSS receiver or a filter without a heading"
            ),
            Self::OutOfPlane { count } => write!(
                f,
                "{count} poses are tilted by more than 60°: axes of a camera, or a z axis that \
                 points down"
            ),
            Self::Reversed(side) => {
                let side = if *side == Side::Left { "left" } else { "right" };
                write!(f, "the {side} side counts backwards: the poses drive where tracks turn")
            }
            Self::BothReversed => {
                write!(f, "both sides count backwards: tracks and poses move in opposite senses")
            }
            Self::Swapped => write!(
                f,
                "tracks and poses turn in opposite senses: left and right are swapped, or the z \
                 axis of the poses points down"
            ),
        }
    }
}

impl Doubt {
    /// What a user can do, where the reader does not know more.
    pub(crate) fn remedy(&self) -> String {
        match self {
            Self::Travel { .. } => {
                "expected m, s and rad; for joints, --wheel-radius in m per radian with any gear, \
                 so for joints in degrees, metres per degree"
            }
            Self::Stamps { .. } => "expected seconds in both tables",
            Self::YawInDegrees => "expected yaw in rad",
            Self::ConstantOrientation { .. } => {
                "expected poses with a yaw; of a bag, --pose-topic chooses others"
            }
            Self::OutOfPlane { .. } => {
                "expected poses of the body (x forward, z up) in a frame whose z axis points up; \
                 of a bag, --parent-frame and --child-frame choose them"
            }
            Self::Reversed(Side::Left) => "expected v_left positive where the robot moves forward",
            Self::Reversed(Side::Right) => {
                "expected v_right positive where the robot moves forward"
            }
            Self::BothReversed => "expected speeds that are positive where the robot moves forward",
            Self::Swapped => {
                "expected x forward, y left, yaw counter-clockwise, and v_right > v_left there"
            }
        }
        .to_owned()
    }
}

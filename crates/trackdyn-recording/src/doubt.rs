//! What can contradict what in a recording.

use crate::sample::Stream;
use crate::unit;
use std::fmt;
use std::str::FromStr;
use trackdyn_core::Side;
use trackdyn_core::named::by_name;

/// A kind of doubt, by the name with which a user who knows better accepts it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DoubtKind {
    /// [`Doubt::Travel`], [`Doubt::Jumps`], [`Doubt::Positions`].
    Travel,
    /// [`Doubt::Stamps`], [`Doubt::CoarseStamps`].
    Stamps,
    /// [`Doubt::YawInDegrees`], [`Doubt::YawOfCompass`], [`Doubt::TurnInDegrees`].
    YawUnit,
    /// [`Doubt::ConstantOrientation`].
    Orientation,
    /// [`Doubt::OutOfPlane`].
    OutOfPlane,
    /// [`Doubt::Reversed`], [`Doubt::BothReversed`], [`Doubt::Swapped`], [`Doubt::Backwards`],
    /// [`Doubt::NotSides`], [`Doubt::Unsigned`].
    Signs,
    /// [`Doubt::DeadEncoder`], [`Doubt::StoodStill`].
    DeadEncoder,
    /// [`Doubt::StuckPoses`].
    StuckPoses,
    /// [`Doubt::SaturatedGyroscope`].
    GyroRange,
}

impl DoubtKind {
    /// All kinds.
    pub const ALL: [Self; 9] = [
        Self::Travel,
        Self::Stamps,
        Self::YawUnit,
        Self::Orientation,
        Self::OutOfPlane,
        Self::Signs,
        Self::DeadEncoder,
        Self::StuckPoses,
        Self::GyroRange,
    ];

    /// Its name, as the option takes it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Travel => "travel",
            Self::Stamps => "stamps",
            Self::YawUnit => "yaw-unit",
            Self::Orientation => "orientation",
            Self::OutOfPlane => "out-of-plane",
            Self::Signs => "signs",
            Self::DeadEncoder => "dead-encoder",
            Self::StuckPoses => "stuck-poses",
            Self::GyroRange => "gyro-range",
        }
    }
}

impl FromStr for DoubtKind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        by_name(&Self::ALL, Self::name, text)
    }
}

/// Axes that are not those of a robot (x forward, z up).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// Those of a camera: z forward, y down.
    Camera,
    /// A z axis that points down.
    Down,
}

/// What is shown of speeds in the other direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backwards {
    /// Their size.
    AsForwards,
    /// Zero.
    AsZero,
}

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
    /// Speeds that no track has, too often to be cut as spikes.
    Jumps {
        /// Their share in the readings.
        share: f64,
        /// Size of the largest, m/s.
        largest: f64,
    },
    /// Positions in place of speeds, as the ticks of an encoder: their changes follow the poses.
    Positions {
        /// The side; none for both.
        side: Option<Side>,
        /// Parts of the squares that the poses do not explain: of the numbers as speeds, and of
        /// their changes. Of both sides, the larger.
        unexplained: [f64; 2],
    },
    /// Stamps in a fraction of a second.
    Stamps {
        /// Median interval of the poses, in what should be s.
        interval: f64,
        /// The unit that explains them, where there is one.
        unit: Option<&'static str>,
    },
    /// Stamps that most rows share with others.
    CoarseStamps {
        /// The rows.
        stream: Stream,
        /// How many share the stamp of the row before and are not its copies.
        shared: usize,
        /// All rows of the run.
        of: usize,
    },
    /// Yaw in degrees.
    YawInDegrees,
    /// Yaw as a compass shows it: clockwise from the y axis, which is north.
    YawOfCompass,
    /// Poses whose orientation never changes while the tracks turn the robot.
    ConstantOrientation {
        /// Way that one track ran more than the other, m.
        turning: f64,
    },
    /// Poses that are tilted by more than a robot can be, or turn about another axis than z.
    OutOfPlane {
        /// How many.
        count: u64,
        /// Which axes explain them.
        axes: Axes,
    },
    /// Yaw that turns too much for radians, where it is all that poses have.
    TurnInDegrees {
        /// Turn of the poses per way that one track ran more than the other, in what should be
        /// rad/m.
        per_metre: f64,
    },
    /// The joints or the speed of a side count backwards.
    Reversed(Side),
    /// Both sides count backwards.
    BothReversed,
    /// Tracks and poses turn in opposite senses: sides are swapped, or the z axis points down.
    Swapped,
    /// Tracks and poses turn alike and drive in opposite senses: a sensor that faces backwards, or
    /// sides that are swapped and count backwards.
    Backwards,
    /// One column moves the robot and the other one turns it: speed and yaw rate, or mean and
    /// difference of both sides.
    NotSides {
        /// The side for which the column was taken that moves the robot.
        moving: Side,
        /// Turn of the poses per unit of way of the other one, rad.
        per_unit: f64,
    },
    /// The speed of a side never changes its sign while the poses move as if it did: of an encoder
    /// that does not tell the direction, or shows one direction alone.
    Unsigned {
        /// What is shown of a speed in the other direction.
        shown: Backwards,
        /// The side; none for both.
        side: Option<Side>,
        /// Part of the way of its track that ran the other way by the poses; of both, the larger.
        share: f64,
        /// Parts of the squares of its ways that the poses do not explain: of the readings as they
        /// are, and with the signs that the poses tell. Of both, the larger.
        unexplained: [f64; 2],
    },
    /// The speed of a side never changes while the poses move as if it did.
    DeadEncoder {
        /// The side; none for both.
        side: Option<Side>,
        /// The speed that it shows, m/s.
        speed: f64,
    },
    /// Tracks that never move, and poses whose only motion is noise.
    StoodStill {
        /// Time of all runs, s.
        duration: f64,
    },
    /// Yaw rates that stay at a limit while the tracks turn the robot faster.
    SaturatedGyroscope {
        /// The limit, rad/s.
        limit: f64,
        /// Yaw rate by the tracks beyond it, rad/s.
        fastest: f64,
        /// Part of the time in which the tracks turn the robot faster.
        share: f64,
    },
    /// Poses that stay where they are while the tracks drive.
    StuckPoses {
        /// Way of the tracks, the mean of both sides, m.
        travelled: f64,
        /// Size of the box around all positions, m.
        extent: f64,
    },
}

impl fmt::Display for Doubt {
    #[expect(clippy::too_many_lines, reason = "one arm for each doubt")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Travel { ratio, units } => {
                let (more, less, factor) = match *ratio {
                    ratio if ratio > 1.0 => ("tracks", "poses", ratio),
                    ratio => ("poses", "tracks", 1.0 / ratio),
                };
                write!(f, "the {more} travel {factor:.1} times as far as the {less}")?;
                match units {
                    Some(units) => write!(f, ", about the ratio of {units}"),
                    None => write!(f, ", which no slip explains"),
                }
            }
            Self::Jumps { share, largest } => write!(
                f,
                "{:.0} % of the track speeds jump to what no track has and back, up to \
                 {largest:.1} m/s, too many to be spikes",
                100.0 * share
            ),
            Self::Positions { side, unexplained } => positions(f, *side, *unexplained),
            Self::Stamps { interval, unit } => {
                write!(f, "by the stamps there is a pose every {interval:.3} s")?;
                match unit {
                    Some(unit) => write!(f, ", and the motion says that they are {unit}"),
                    None => write!(f, ", and poses and tracks cover other times"),
                }
            }
            Self::CoarseStamps { stream, shared, of } => write!(
                f,
                "{}: {shared} of {of} rows share the stamp of the row before and are not its \
                 copies: stamps of whole seconds, or rounded",
                stream.name()
            ),
            Self::YawInDegrees => {
                write!(f, "yaw follows the path of the poses in degrees, and not in radians")
            }
            Self::YawOfCompass => write!(
                f,
                "yaw follows the path of the poses clockwise from the y axis: the heading of a \
                 compass, with x east and y north"
            ),
            Self::ConstantOrientation { turning } => write!(
                f,
                "the orientation never changes, while one track runs {turning:.1} m more than the \
                 other: poses of a GNSS receiver or a filter without a heading"
            ),
            Self::OutOfPlane { count, axes: Axes::Camera } => write!(
                f,
                "{count} poses are tilted by more than 60°, or turn about their y axis: axes of a \
                 camera (its optical frame: z forward, y down), by which a robot drives out of the \
                 x-y plane"
            ),
            Self::OutOfPlane { count, axes: Axes::Down } => write!(
                f,
                "{count} poses are upside down: the z axis of the body or of the world points down"
            ),
            Self::TurnInDegrees { per_metre } => write!(
                f,
                "yaw turns by {per_metre:.1} for each metre that one track runs more than the \
                 other, more than radians can: degrees, or a gyroscope in degrees per second"
            ),
            Self::Reversed(side) => {
                let side = side.name();
                write!(f, "the {side} side counts backwards: the poses drive where tracks turn")
            }
            Self::BothReversed => {
                write!(f, "both sides count backwards: tracks and poses move in opposite senses")
            }
            Self::Swapped => write!(
                f,
                "tracks and poses turn in opposite senses: left and right are swapped, or the z \
                 axis of the poses, or of their gyroscope, points down"
            ),
            Self::Backwards => write!(
                f,
                "tracks and poses turn alike and drive in opposite senses: the sensor faces \
                 backwards, or the sides are swapped and count backwards"
            ),
            Self::NotSides { moving, per_unit } => not_sides(f, *moving, *per_unit),
            Self::Unsigned { shown, side, share, unexplained } => {
                unsigned(f, *shown, *side, *share, *unexplained)
            }
            Self::DeadEncoder { side, speed } => {
                let which = match side {
                    Some(Side::Left) => "the left side never changes",
                    Some(Side::Right) => "the right side never changes",
                    None => "both sides never changes",
                };
                write!(
                    f,
                    "the speed of {which} ({speed:.3} m/s all the time), while the poses move as \
                     if it did: a dead encoder, or a number that is no measured speed"
                )
            }
            Self::StoodStill { duration } => write!(
                f,
                "the robot only stands still, for {duration:.0} s: both tracks are at 0 m/s all \
                 the time, and the poses show nothing but noise"
            ),
            Self::SaturatedGyroscope { limit, fastest, share } => write!(
                f,
                "the yaw rate stays at {limit:.2} rad/s while by the tracks the robot turns at up \
                 to {fastest:.2} rad/s, in {:.0} % of the time: a gyroscope at the end of its \
                 range",
                100.0 * share
            ),
            Self::StuckPoses { travelled, extent } => write!(
                f,
                "the poses stay within {extent:.3} m and do not turn, while the tracks run \
                 {travelled:.1} m: a tracker that is stuck, or poses of another thing"
            ),
        }
    }
}

/// What is said of columns that are no speeds of sides.
fn not_sides(f: &mut fmt::Formatter<'_>, moving: Side, per_unit: f64) -> fmt::Result {
    let [ahead, around] = match moving {
        Side::Left => ["v_left", "v_right"],
        Side::Right => ["v_right", "v_left"],
    };
    write!(
        f,
        "{ahead} alone moves the robot forward and {around} alone turns it, by {per_unit:.2} rad \
         per unit of its way: they hold speed and yaw rate, or mean and difference of both sides, \
         and not the speeds of the sides"
    )
}

/// What is said of positions that were taken for speeds.
fn positions(
    f: &mut fmt::Formatter<'_>,
    side: Option<Side>,
    [as_speeds, as_positions]: [f64; 2],
) -> fmt::Result {
    let whose = match side {
        Some(Side::Left) => "numbers of the left side",
        Some(Side::Right) => "numbers of the right side",
        None => "numbers of both sides",
    };
    write!(
        f,
        "the {whose} are no speeds but positions, such as ticks of an encoder: their changes \
         follow the poses (which leave {:.1} % of these unexplained, {:.0} % of them as speeds)",
        100.0 * as_positions,
        100.0 * as_speeds
    )
}

/// What is said of speeds without a sign.
fn unsigned(
    f: &mut fmt::Formatter<'_>,
    shown: Backwards,
    side: Option<Side>,
    share: f64,
    [as_read, with_signs]: [f64; 2],
) -> fmt::Result {
    let (whose, track) = match side {
        Some(Side::Left) => ("the speed of the left side never changes its", "this track"),
        Some(Side::Right) => ("the speed of the right side never changes its", "this track"),
        None => ("the speeds of both sides never change their", "a track"),
    };
    let why = match shown {
        Backwards::AsForwards => {
            "absolute values, as of an encoder that does not tell the direction"
        }
        Backwards::AsZero => "zero in its place, as of an encoder that counts one way alone",
    };
    write!(
        f,
        "{whose} sign, while by the poses {track} ran the other way for {:.0} % of its way: {why} \
         (the motion leaves {:.0} % of them unexplained, and {:.1} % read so)",
        100.0 * share,
        100.0 * as_read,
        100.0 * with_signs
    )
}

impl Doubt {
    /// Its kind.
    pub fn kind(&self) -> DoubtKind {
        match self {
            Self::Travel { .. } | Self::Jumps { .. } | Self::Positions { .. } => DoubtKind::Travel,
            Self::Stamps { .. } | Self::CoarseStamps { .. } => DoubtKind::Stamps,
            Self::YawInDegrees | Self::YawOfCompass | Self::TurnInDegrees { .. } => {
                DoubtKind::YawUnit
            }
            Self::ConstantOrientation { .. } => DoubtKind::Orientation,
            Self::OutOfPlane { .. } => DoubtKind::OutOfPlane,
            Self::Reversed(_)
            | Self::BothReversed
            | Self::Swapped
            | Self::Backwards
            | Self::NotSides { .. }
            | Self::Unsigned { .. } => DoubtKind::Signs,
            Self::DeadEncoder { .. } | Self::StoodStill { .. } => DoubtKind::DeadEncoder,
            Self::StuckPoses { .. } => DoubtKind::StuckPoses,
            Self::SaturatedGyroscope { .. } => DoubtKind::GyroRange,
        }
    }

    /// What a user can do, where the reader does not know more.
    pub(crate) fn remedy(&self) -> String {
        match self {
            Self::Travel { ratio, .. } => return unit::remedy(*ratio),
            Self::Jumps { .. } => {
                "expected speeds of the tracks, with few wrong readings; of a bag, --joint-signal \
                 and --tracks-topic choose others"
            }
            Self::Positions { .. } => {
                "expected speeds; of a bag, --joint-signal position takes numbers and joints as \
                 positions, with --wheel-radius in m per unit of them (per tick, the circumference \
                 by the ticks of a turn); of a table, the change per time of such a column is a \
                 speed"
            }
            Self::Stamps { .. } => {
                "expected seconds; of one table with both, --columns t=COLUMN:ms (or us, ns) reads \
                 others"
            }
            Self::CoarseStamps { .. } => {
                "expected a stamp for each row; of a bag, --dated-by log takes the times of logging"
            }
            Self::YawInDegrees => {
                "expected yaw in rad; of one table, --columns yaw=COLUMN:deg reads degrees"
            }
            Self::YawOfCompass => {
                "expected yaw in rad, counter-clockwise from the x axis; of one table, --columns \
                 yaw=COLUMN:compass reads degrees of a compass, and --pose-axes ned reads yaw in \
                 rad that counts clockwise from north"
            }
            Self::TurnInDegrees { .. } => {
                "expected yaw in rad; --gyro-unit deg/s reads a gyroscope in degrees per second"
            }
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
                "expected x forward, y left, yaw counter-clockwise, and v_right > v_left there: \
                 swap the sides, or where y points right and yaw counts clockwise, as \
                 north-east-down does, --pose-axes ned reads such poses"
            }
            Self::Backwards => {
                "expected poses whose x axis points forward (--mount-yaw 180 turns those of a \
                 sensor that faces backwards), and speeds of each side, positive forward"
            }
            Self::NotSides { .. } => {
                "expected the speeds of both sides: of mean and difference, left is mean - \
                 difference/2 and right is mean + difference/2; speed and yaw rate of a bag are \
                 read by --twist-topic and --separation"
            }
            Self::Unsigned { .. } => {
                "expected speeds that are negative where a track runs backwards, which no option \
                 can tell: another column, topic or signal has them, or the signs of the commands \
                 have to be given to these before they are read"
            }
            Self::DeadEncoder { .. } => {
                "expected measured speeds of both sides; of a bag, --left-joint, --right-joint and \
                 --joint-signal choose others"
            }
            Self::StoodStill { .. } => {
                "expected a log of driving: turns on the spot, two each way, slowly and fast, \
                 curves both ways, and 10 m straight, forward and back"
            }
            Self::SaturatedGyroscope { .. } => {
                "expected a gyroscope with a wider range, slower turns (--time takes a part), or \
                 poses with a yaw of another source"
            }
            Self::StuckPoses { .. } => {
                "expected poses of the robot while it drives; of a bag, --pose-topic or \
                 --child-frame choose others"
            }
        }
        .to_owned()
    }
}

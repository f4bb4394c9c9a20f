//! What a law of a user sees, and what it adds.

/// What a law adds to the balance of forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A force at the centre of gravity, forward and to the left (N), and a moment,
    /// counter-clockwise (N·m).
    Force,
    /// Factors on the friction at a point of the contact, along and across the track (1).
    Friction,
}

/// What a law sees of a state. Axes are those of REP-103: x forward, y left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// Speed of the centre of gravity forward, m/s.
    ForwardSpeed,
    /// Speed of the centre of gravity to the left, m/s.
    LateralSpeed,
    /// Yaw rate, counter-clockwise, rad/s.
    YawRate,
    /// Speed of the left belt over the hull, m/s.
    LeftBelt,
    /// Speed of the right belt over the hull, m/s.
    RightBelt,
    /// Place of the robot's origin in the world, x in m.
    X,
    /// Place of the robot's origin in the world, y in m.
    Y,
    /// Heading, counter-clockwise from the world's x axis, rad.
    Heading,
    /// Time since the start of the recording, s.
    Time,
    /// Weight on the left side, N. For a force.
    LeftLoad,
    /// Weight on the right side, N. For a force.
    RightLoad,
    /// Slip velocity of the belt over the ground forward, m/s. For friction.
    SlipForward,
    /// Slip velocity of the belt over the ground to the left, m/s. For friction.
    SlipLateral,
    /// Size of the slip velocity, m/s. For friction.
    SlipSpeed,
    /// Normal pressure, Pa. For friction.
    Pressure,
    /// Speed of the belt over the hull, m/s. For friction.
    Belt,
    /// Place of the point, m forward of the robot's origin. For friction.
    PointForward,
    /// Place of the point, m to the left of the robot's origin. For friction.
    PointLateral,
    /// Place of the point in the world, x in m. For friction.
    PointX,
    /// Place of the point in the world, y in m. For friction.
    PointY,
}

/// Number of arguments of a force.
pub const FORCE_COUNT: usize = MOTION.len() + 2;

/// Number of arguments of friction.
pub const FRICTION_COUNT: usize = MOTION.len() + 9;

/// What all laws see.
const MOTION: [Argument; 9] = [
    Argument::ForwardSpeed,
    Argument::LateralSpeed,
    Argument::YawRate,
    Argument::LeftBelt,
    Argument::RightBelt,
    Argument::X,
    Argument::Y,
    Argument::Heading,
    Argument::Time,
];

const FORCE: [Argument; FORCE_COUNT] = beside_motion([Argument::LeftLoad, Argument::RightLoad]);

const FRICTION: [Argument; FRICTION_COUNT] = beside_motion([
    Argument::SlipForward,
    Argument::SlipLateral,
    Argument::SlipSpeed,
    Argument::Pressure,
    Argument::Belt,
    Argument::PointForward,
    Argument::PointLateral,
    Argument::PointX,
    Argument::PointY,
]);

/// What all laws see, then what one kind sees beside it.
const fn beside_motion<const K: usize, const N: usize>(own: [Argument; K]) -> [Argument; N] {
    let mut all = [Argument::Time; N];
    let mut place = 0;
    while place < N {
        all[place] = match place.checked_sub(MOTION.len()) {
            Some(of_own) => own[of_own],
            None => MOTION[place],
        };
        place += 1;
    }
    all
}

impl Kind {
    /// What a law of this kind sees, in the order of its columns.
    pub fn arguments(self) -> &'static [Argument] {
        match self {
            Self::Force => &FORCE,
            Self::Friction => &FRICTION,
        }
    }

    /// Names of what a law of this kind adds, in the order of its columns.
    pub fn results(self) -> &'static [&'static str] {
        match self {
            Self::Force => &["forward force", "lateral force", "moment"],
            Self::Friction => &["factor along the track", "factor across the track"],
        }
    }

    /// What a law adds that does nothing.
    pub(super) fn nothing(self) -> f64 {
        match self {
            Self::Force => 0.0,
            Self::Friction => 1.0,
        }
    }
}

impl Argument {
    /// Its name in messages and in Python.
    pub fn name(self) -> &'static str {
        match self {
            Self::ForwardSpeed => "v_forward",
            Self::LateralSpeed => "v_lateral",
            Self::YawRate => "yaw_rate",
            Self::LeftBelt => "v_left",
            Self::RightBelt => "v_right",
            Self::X => "x",
            Self::Y => "y",
            Self::Heading => "heading",
            Self::Time => "time",
            Self::LeftLoad => "load_left",
            Self::RightLoad => "load_right",
            Self::SlipForward => "slip_forward",
            Self::SlipLateral => "slip_lateral",
            Self::SlipSpeed => "slip_speed",
            Self::Pressure => "pressure",
            Self::Belt => "belt_speed",
            Self::PointForward => "point_forward",
            Self::PointLateral => "point_lateral",
            Self::PointX => "point_x",
            Self::PointY => "point_y",
        }
    }

    /// Whether it changes with the motion that a solver seeks. Place, heading and time are given.
    pub(super) fn is_sought(self) -> bool {
        !matches!(self, Self::X | Self::Y | Self::Heading | Self::Time)
    }

    /// Size below which it counts as small, in its unit: the unit of a step.
    pub(super) fn scale(self) -> f64 {
        match self {
            Self::LeftLoad | Self::RightLoad => 100.0,
            Self::Pressure => 1000.0,
            // speeds and places
            _ => 0.1,
        }
    }
}

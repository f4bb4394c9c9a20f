//! How a blind trial draws the value of a parameter.

/// The draw of a parameter's value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw {
    /// What the parameter does in the law.
    pub role: Role,
    /// Property of the machine that the numbers of the role are counted in.
    pub scale: Scale,
    /// Whether the sign is drawn; of a factor, whether it is the factor or its inverse.
    pub is_signed: bool,
}

/// What a parameter does in a law, with the numbers of its draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// A size in proportion to the strength of the mechanism: the value at strength 1.
    Size(f64),
    /// A factor that is 1 where there is no effect: the value at strength 1, to the power of the
    /// strength.
    Factor(f64),
    /// A constant of the law, uniform within limits.
    Shape {
        /// Limits.
        between: [f64; 2],
        /// Whether its logarithm is uniform instead.
        is_logarithmic: bool,
        /// Values at which the mechanism is compared with another one.
        compared_at: &'static [f64],
    },
    /// A direction in the world, degrees.
    Direction,
    /// A coordinate of a place in the world, m.
    Place {
        /// Axis of the world: 0 for x, 1 for y.
        axis: usize,
        /// Where the place lies.
        anchor: Anchor,
    },
    /// A reading of an instrument.
    Reading {
        /// Value without an error.
        exact: f64,
        /// Standard deviation of small errors.
        small: f64,
        /// Limits of large errors.
        large: [f64; 2],
    },
}

/// Where a place in the world lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    /// Between two distances from the origin, m, in any direction.
    Around([f64; 2]),
    /// On the path of the robot.
    OnPath,
}

/// A property of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// None: numbers are in the unit of the parameter.
    Unit,
    /// Weight, N.
    Weight,
    /// Distance between the centre-lines of the tracks, m.
    Gauge,
    /// Distance from the rear to the front end of the contact, m.
    ContactLength,
    /// Mean pressure on the ground, Pa.
    NormalPressure,
    /// Radius of gyration about the vertical, m.
    GyrationRadius,
}

impl Draw {
    const fn of(role: Role) -> Self {
        Self { role, scale: Scale::Unit, is_signed: false }
    }

    /// A size with its value at strength 1.
    pub const fn size(at_strength_one: f64) -> Self {
        Self::of(Role::Size(at_strength_one))
    }

    /// A factor with its value at strength 1.
    pub const fn factor(at_strength_one: f64) -> Self {
        Self::of(Role::Factor(at_strength_one))
    }

    /// A constant of the law between two values, which a comparison sets to some others.
    pub const fn shape(low: f64, high: f64, compared_at: &'static [f64]) -> Self {
        let between = [low, high];
        Self::of(Role::Shape { between, is_logarithmic: false, compared_at })
    }

    /// A constant of the law between two values, of which the logarithm is uniform.
    pub const fn log_shape(low: f64, high: f64, compared_at: &'static [f64]) -> Self {
        let between = [low, high];
        Self::of(Role::Shape { between, is_logarithmic: true, compared_at })
    }

    /// A constant of the law that is not drawn.
    pub const fn fixed(value: f64) -> Self {
        Self::shape(value, value, &[])
    }

    /// A direction in the world.
    pub const fn direction() -> Self {
        Self::of(Role::Direction)
    }

    /// A coordinate of a place in the world.
    pub const fn place(axis: usize, anchor: Anchor) -> Self {
        Self::of(Role::Place { axis, anchor })
    }

    /// A reading of an instrument: the value without an error, the standard deviation of small
    /// errors, and the limits of large ones, which have either sign.
    pub const fn reading(exact: f64, small: f64, large: [f64; 2]) -> Self {
        Self::of(Role::Reading { exact, small, large })
    }

    /// With numbers that count in a property of the machine.
    pub const fn times(self, scale: Scale) -> Self {
        Self { scale, ..self }
    }

    /// With a sign that is drawn.
    pub const fn signed(self) -> Self {
        Self { is_signed: true, ..self }
    }
}

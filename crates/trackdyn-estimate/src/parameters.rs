//! The parameters of the kinematic model as a vector.

use trackdyn_core::PerSide;
use trackdyn_model::{Icrs, Kinematics};

/// Number of parameters of the model.
pub const COUNT: usize = 5;

/// The parameter vector θ = (x_l, x_r, y, α_l, α_r), paper's frame, m and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters(pub [f64; COUNT]);

impl Parameters {
    /// Names in tables and messages.
    pub const NAMES: [&'static str; COUNT] = ["x_l", "x_r", "y", "alpha_l", "alpha_r"];

    /// Units in tables and messages.
    pub const UNITS: [&'static str; COUNT] = ["m", "m", "m", "1", "1"];

    /// The parameters of a kinematic model.
    pub fn of(kinematics: &Kinematics) -> Self {
        let Icrs { x_left, x_right, y } = kinematics.icrs;
        Self([x_left, x_right, y, kinematics.alpha.left, kinematics.alpha.right])
    }

    /// Angles by which a metre of the left and of the right track turns the robot, α/(x_r − x_l),
    /// rad/m.
    pub(crate) fn turns(&self) -> [f64; 2] {
        let [x_l, x_r, _, alpha_l, alpha_r] = self.0;
        [alpha_l, alpha_r].map(|alpha| alpha / (x_r - x_l))
    }

    /// The kinematic model with these parameters.
    pub fn kinematics(&self) -> Kinematics {
        let [x_left, x_right, y, left, right] = self.0;
        Kinematics { icrs: Icrs { x_left, x_right, y }, alpha: PerSide::new(left, right) }
    }
}

/// Which parameters are fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Free {
    /// The ICRs; track speeds count as measured.
    Icrs,
    /// The ICRs and the factors α_l, α_r on the track speeds, eqs (20)-(21).
    IcrsAndAlphas,
}

impl Free {
    /// Number of fitted parameters, the first ones of the vector.
    pub fn count(self) -> usize {
        match self {
            Self::Icrs => 3,
            Self::IcrsAndAlphas => COUNT,
        }
    }
}

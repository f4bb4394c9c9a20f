//! What turns track speeds into motion.

use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_core::{PerSide, Twist};
use trackdyn_model::Kinematics;
use trackdyn_model::kinematics::KinematicsFile;

/// The parameters of a replay, under a name.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterSet {
    name: String,
    parameters: Parameters,
}

#[derive(Clone, Debug, PartialEq)]
enum Parameters {
    Constant(Kinematics),
    File(Box<KinematicsFile>),
}

impl ParameterSet {
    /// Name of the ideal differential drive.
    pub const IDEAL: &'static str = "ideal";

    /// Constant parameters.
    pub fn new(name: impl Into<String>, kinematics: Kinematics) -> Self {
        Self { name: name.into(), parameters: Parameters::Constant(kinematics) }
    }

    /// The ideal differential drive of this gauge, m: ICRs on the track centre-lines.
    pub fn ideal(gauge: f64) -> Self {
        Self::new(Self::IDEAL, Kinematics::ideal(gauge))
    }

    /// The parameters of a file: by sector where its map is piecewise.
    pub fn of_file(name: impl Into<String>, file: &KinematicsFile) -> Self {
        Self { name: name.into(), parameters: Parameters::File(Box::new(file.clone())) }
    }

    /// The set with its ICRs and α = 1; none where α is 1 already.
    pub fn without_alpha(&self) -> Option<Self> {
        let ones = PerSide::new(1.0, 1.0);
        if self.kinematics().alpha == ones {
            return None;
        }
        let parameters = match &self.parameters {
            Parameters::Constant(kinematics) => {
                Parameters::Constant(Kinematics { alpha: ones, ..*kinematics })
            }
            Parameters::File(file) => {
                let mut file = file.clone();
                (file.alpha_left, file.alpha_right) = (None, None);
                Parameters::File(file)
            }
        };
        Some(Self { name: format!("{}-no-alpha", self.name), parameters })
    }

    /// Its name in tables, figures and file names.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The parameters of the whole map.
    pub fn kinematics(&self) -> Kinematics {
        match &self.parameters {
            Parameters::Constant(kinematics) => *kinematics,
            Parameters::File(file) => file.kinematics(),
        }
    }

    /// The parameters at measured track speeds, m/s: those of their sector.
    pub fn kinematics_at(&self, measured: PerSide<f64>) -> Kinematics {
        match &self.parameters {
            Parameters::Constant(kinematics) => *kinematics,
            Parameters::File(file) => file.kinematics_at(measured),
        }
    }

    /// Twist in ROS axes at measured track speeds, m/s.
    pub fn twist(&self, measured: PerSide<f64>) -> Twist {
        ros_twist_from_paper(&self.kinematics_at(measured).twist(measured))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_model::Icrs;

    #[test]
    fn forward_is_along_x_and_left_is_y() {
        let ideal = ParameterSet::ideal(0.5);
        let Twist { v_x, v_y, w } = ideal.twist(PerSide::new(0.4, 0.6));
        assert!((v_x - 0.5).abs() < 1e-15 && v_y == 0.0 && (w - 0.4).abs() < 1e-15);
        assert_eq!(ideal.without_alpha(), None);
    }

    #[test]
    fn alpha_can_be_left_out() {
        let icrs = Icrs { x_left: -0.4, x_right: 0.5, y: 0.1 };
        let alpha = PerSide::new(0.9, 1.1);
        let set = ParameterSet::new("fit", Kinematics { icrs, alpha });
        let without = set.without_alpha().expect("it has alphas");
        assert_eq!(without.kinematics(), Kinematics::new(icrs));
        assert_eq!(without.name(), "fit-no-alpha");
    }
}

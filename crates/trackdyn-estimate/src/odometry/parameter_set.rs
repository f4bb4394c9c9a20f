//! What turns track speeds into motion.

use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_core::{PerSide, Twist};
use trackdyn_model::kinematics::KinematicsFile;
use trackdyn_model::{Circumstance, Icrs, Kinematics, Stationary, VehicleFile};

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
    Vehicle(Box<Forces>),
}

/// The forces on a vehicle, as a replay takes them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Forces {
    pub(super) file: VehicleFile,
    /// Delay of the poses, s.
    pub(super) delay: f64,
}

impl ParameterSet {
    /// Name of the ideal differential drive.
    pub const IDEAL_NAME: &'static str = "ideal";

    /// Name of the forces on a vehicle.
    pub const PHYSICS_NAME: &'static str = "physics";

    /// Constant parameters.
    pub fn new(name: impl Into<String>, kinematics: Kinematics) -> Self {
        Self { name: name.into(), parameters: Parameters::Constant(kinematics) }
    }

    /// The ideal differential drive of this gauge, m: ICRs on the track centre-lines.
    pub fn ideal(gauge: f64) -> Self {
        Self::new(Self::IDEAL_NAME, Kinematics::ideal(gauge))
    }

    /// The parameters of a file: by sector where its map is piecewise.
    pub fn of_file(name: impl Into<String>, file: &KinematicsFile) -> Self {
        Self { name: name.into(), parameters: Parameters::File(Box::new(file.clone())) }
    }

    /// The forces on a vehicle, which move it in time, for poses that come late by
    /// [`delay`](crate::odometry::in_time::delay), s.
    pub fn of_vehicle(name: impl Into<String>, file: &VehicleFile, delay: f64) -> Self {
        let forces = Forces { file: file.clone(), delay };
        Self { name: name.into(), parameters: Parameters::Vehicle(Box::new(forces)) }
    }

    /// The set with its ICRs and α = 1; none where α is 1 already, and of forces.
    pub fn without_alpha(&self) -> Option<Self> {
        let ones = PerSide::new(1.0, 1.0);
        if self.kinematics()?.alpha == ones {
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
            Parameters::Vehicle(_) => return None,
        };
        Some(Self { name: format!("{}-no-alpha", self.name), parameters })
    }

    /// Its name in tables, figures and file names.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The vehicle whose forces it is; none of constant parameters.
    pub fn vehicle(&self) -> Option<&VehicleFile> {
        self.forces().map(|forces| &forces.file)
    }

    pub(super) fn forces(&self) -> Option<&Forces> {
        match &self.parameters {
            Parameters::Vehicle(forces) => Some(forces),
            Parameters::Constant(_) | Parameters::File(_) => None,
        }
    }

    /// The parameters of the whole map; none of forces, whose ICRs depend on the motion.
    pub fn kinematics(&self) -> Option<Kinematics> {
        match &self.parameters {
            Parameters::Constant(kinematics) => Some(*kinematics),
            Parameters::File(file) => Some(file.kinematics()),
            Parameters::Vehicle(_) => None,
        }
    }

    /// ICRs and twist (ROS axes) of steady driving at measured track speeds, m/s: of parameters
    /// those of their sector. ICRs are none of forces that do not turn the robot.
    pub fn steady(&self, measured: PerSide<f64>) -> (Option<Icrs>, Twist) {
        let kinematics = match &self.parameters {
            Parameters::Constant(kinematics) => *kinematics,
            Parameters::File(file) => file.kinematics_at(measured),
            Parameters::Vehicle(forces) => return by_forces(&forces.file, measured),
        };
        (Some(kinematics.icrs), ros_twist_from_paper(&kinematics.twist(measured)))
    }
}

/// ICRs and twist (ROS axes, of the pose sensor) of a vehicle's stationary motion.
fn by_forces(file: &VehicleFile, measured: PerSide<f64>) -> (Option<Icrs>, Twist) {
    let model = file.model();
    let found = Stationary::new(&model, &Circumstance::default()).solve(measured);
    (found.icrs, ros_twist_from_paper(&model.sensor().reported(&found.twist)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_model::Icrs;

    #[test]
    fn forward_is_along_x_and_left_is_y() {
        let ideal = ParameterSet::ideal(0.5);
        let (_, Twist { v_x, v_y, w }) = ideal.steady(PerSide::new(0.4, 0.6));
        assert!((v_x - 0.5).abs() < 1e-15 && v_y == 0.0 && (w - 0.4).abs() < 1e-15);
        assert_eq!(ideal.without_alpha(), None);
    }

    #[test]
    fn alpha_can_be_left_out() {
        let icrs = Icrs { x_left: -0.4, x_right: 0.5, y: 0.1 };
        let alpha = PerSide::new(0.9, 1.1);
        let set = ParameterSet::new("fit", Kinematics { icrs, alpha });
        let without = set.without_alpha().expect("it has alphas");
        assert_eq!(without.kinematics(), Some(Kinematics::new(icrs)));
        assert_eq!(without.name(), "fit-no-alpha");
    }

    #[test]
    fn forces_have_icrs_where_they_turn_the_robot() {
        let file = VehicleFile::auriga_alpha();
        let forces = ParameterSet::of_vehicle(ParameterSet::PHYSICS_NAME, &file, 0.0);
        let (icrs, twist) = forces.steady(PerSide::new(0.4, 0.6));
        let icrs = icrs.expect("it turns");
        assert!((0.2 / (icrs.x_right - icrs.x_left) - twist.w).abs() < 1e-9);
        assert!(forces.kinematics().is_none() && forces.without_alpha().is_none());
    }
}

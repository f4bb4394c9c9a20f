//! What the log that parameters come from calls the parts of the robot.

use super::{Export, FrameSettings};
use crate::Error;
use trackdyn_core::{PerSide, Side};
use trackdyn_export::Name;
use trackdyn_model::kinematics::BagSource;

/// What is chosen of the wheels of a robot; what is left open is taken from the log, or is usual.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WheelChoices {
    /// Wheel joints of each side.
    pub joints: PerSide<Vec<Name>>,
    /// Belt travel per radian of these, m.
    pub wheel_radius: Option<f64>,
}

/// The wheels of a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotWheels {
    /// Wheel joints of each side.
    pub joints: PerSide<Vec<Name>>,
    /// Belt travel per radian of these, m.
    pub wheel_radius: f64,
    /// What of it is from the log, in words.
    pub from_log: Vec<String>,
    /// What of it is only the usual name, because the parameters come from a log that names no
    /// wheel joints, in words.
    pub usual: Vec<String>,
}

/// The root link of a robot's URDF.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseFrame {
    /// Its name.
    pub name: Name,
    /// The frame whose poses the log has, where the parameters come from one that names it: that
    /// of the ICRs.
    pub of_log: Option<String>,
}

impl Export {
    /// The wheels of the robot: as chosen, else as the log calls them that the parameters come
    /// from, else by their usual names.
    ///
    /// # Errors
    /// [`Error::NoWheelRadius`]; [`Error::LogName`] for a name of the log that exports cannot have;
    /// [`Error::ReversedJoint`].
    pub fn wheels(&self, choices: &WheelChoices) -> Result<RobotWheels, Error> {
        let log = self.bag.clone().unwrap_or_default();
        let (mut from_log, mut usual) = (Vec::new(), Vec::new());
        let mut joints = choices.joints.clone();
        for side in Side::BOTH {
            if !joints[side].is_empty() {
                continue;
            }
            let (names, setting) = of_side(&log, side);
            let named = names.iter().map(|name| joint(name, setting));
            joints[side] = named.collect::<Result<_, _>>()?;
            if names.is_empty() {
                joints[side] = vec![super::usual_joint(side)];
                if self.bag.is_some() {
                    let option = setting.replace('_', " ");
                    usual.push(format!("{option} {}", super::usual_joint(side)));
                }
            } else {
                from_log.push(format!("{} {}", setting.replace('_', " "), names.join(", ")));
            }
        }
        let of_log = log.wheel_radius_m.filter(|_| choices.wheel_radius.is_none());
        from_log.extend(of_log.map(|radius| format!("wheel radius {radius} m")));
        let none = || Error::NoWheelRadius { file: self.name().to_owned() };
        let wheel_radius = choices.wheel_radius.or(of_log).ok_or_else(none)?;
        Ok(RobotWheels { joints, wheel_radius, from_log, usual })
    }

    /// The root link of the robot's URDF: as chosen, else the frame whose poses the log has that
    /// the parameters come from, else `base_link`.
    ///
    /// # Errors
    /// [`Error::LogName`] for a name of the log that exports cannot have.
    pub fn base_frame(&self, choice: Option<&Name>) -> Result<BaseFrame, Error> {
        let child = self.bag.as_ref().and_then(|log| log.child_frame.as_deref());
        let of_log = child.map(|child| child.trim_start_matches('/'));
        let name = match (choice, of_log) {
            (Some(chosen), _) => chosen.clone(),
            (None, Some(child)) => name(child, "base_frame")?,
            (None, None) => FrameSettings::default().base,
        };
        Ok(BaseFrame { name, of_log: of_log.map(str::to_owned) })
    }
}

/// The joints of a side in the log, and the setting that chooses them.
fn of_side(log: &BagSource, side: Side) -> (&[String], &'static str) {
    match side {
        Side::Left => (&log.left_joints, "left_joints"),
        Side::Right => (&log.right_joints, "right_joints"),
    }
}

fn name(text: &str, setting: &'static str) -> Result<Name, Error> {
    let refused = |cause: trackdyn_export::Error| Error::LogName {
        setting,
        name: text.to_owned(),
        reason: cause.to_string(),
    };
    text.parse().map_err(refused)
}

/// A joint of the log: drivers of ROS 2 reverse none.
fn joint(text: &str, setting: &'static str) -> Result<Name, Error> {
    match text.strip_prefix('-') {
        Some(bare) => Err(Error::ReversedJoint { setting, name: bare.to_owned() }),
        None => name(text, setting),
    }
}

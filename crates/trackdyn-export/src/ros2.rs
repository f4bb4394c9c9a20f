//! ROS 2: parameters of `diff_drive_controller` and a launch file with the static transform.

mod controller;
mod launch;

use crate::{EquivalentDrive, Error, Frames, Name, Provenance, TextFile};

/// What a kinematics file does not know of the robot's drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Wheels {
    radius: f64,
    left: Vec<Name>,
    right: Vec<Name>,
}

impl Wheels {
    /// Travel of the belt per radian of the wheel joint, m (for a track the pitch radius of its sprocket),
    /// and names of the wheel joints.
    ///
    /// # Errors
    /// [`Error::WheelRadius`], [`Error::WheelCount`].
    pub fn new(radius: f64, left: Vec<Name>, right: Vec<Name>) -> Result<Self, Error> {
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::WheelRadius { value: radius });
        }
        if left.len() != right.len() || left.is_empty() {
            return Err(Error::WheelCount { left: left.len(), right: right.len() });
        }
        Ok(Self { radius, left, right })
    }
}

/// The parameters of a controller of this name, and the launch file.
pub fn files(
    drive: &EquivalentDrive,
    frames: &Frames,
    wheels: &Wheels,
    controller: &Name,
    provenance: &Provenance,
) -> Vec<TextFile> {
    vec![
        controller::parameters(drive, frames, wheels, controller, provenance),
        launch::launch_file(drive, frames, provenance),
    ]
}

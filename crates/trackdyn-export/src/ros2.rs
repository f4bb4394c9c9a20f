//! ROS 2: parameters of `diff_drive_controller` and a launch file with the static transform.

mod controller;
mod launch;

use crate::number::MAX_LENGTH;
use crate::{EquivalentDrive, Error, Frames, Name, NodeName, Provenance, Residuals, TextFile};

/// What a kinematics file does not know of the robot's drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Wheels {
    radius: f64,
    left: Vec<Name>,
    right: Vec<Name>,
}

impl Wheels {
    /// Travel of the belt per radian of the wheel joint, m (for a track the pitch radius of its
    /// sprocket), and names of the wheel joints.
    ///
    /// # Errors
    /// [`Error::WheelRadius`], [`Error::WheelCount`], [`Error::Repeated`].
    pub fn new(radius: f64, left: Vec<Name>, right: Vec<Name>) -> Result<Self, Error> {
        if !(1e-6..=MAX_LENGTH).contains(&radius) {
            return Err(Error::WheelRadius { value: radius });
        }
        if left.len() != right.len() || left.is_empty() {
            return Err(Error::WheelCount { left: left.len(), right: right.len() });
        }
        Name::all_differ("left-joint, --right-joint", &left, &right)?;
        Ok(Self { radius, left, right })
    }
}

/// Residuals of the odometry, and the rate at which the controller publishes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Published {
    residuals: Residuals,
    rate: f64,
}

impl Published {
    /// The rate the controller has where none is set, Hz.
    pub const DEFAULT_RATE: f64 = 50.0;

    /// Residuals and a rate, Hz.
    ///
    /// # Errors
    /// [`Error::PublishRate`].
    pub fn new(residuals: Residuals, rate: f64) -> Result<Self, Error> {
        if !(rate > 0.0 && rate.is_finite()) {
            return Err(Error::PublishRate { value: rate });
        }
        Ok(Self { residuals, rate })
    }
}

/// The parameters of a controller of this name, with covariances where residuals are known, and the
/// launch file.
pub fn files(
    drive: &EquivalentDrive,
    frames: &Frames,
    wheels: &Wheels,
    controller: &NodeName,
    published: Option<&Published>,
    provenance: &Provenance,
) -> Vec<TextFile> {
    vec![
        controller::parameters(drive, frames, wheels, controller, published, provenance),
        launch::launch_file(drive, frames, provenance),
    ]
}

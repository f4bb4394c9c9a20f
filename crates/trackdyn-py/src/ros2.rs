//! Kinematic parameters as files of ROS 2.

use crate::errors::raised;
use crate::files::written;
use crate::options::parsed;
use crate::parameters::Parameters;
use pyo3::prelude::*;
use std::path::PathBuf;
use trackdyn::crates::core::PerSide;
use trackdyn::crates::core::document::Document;
use trackdyn::export::{FrameSettings, Ros2Settings, WheelChoices, write};
use trackdyn::{Error, Export, Provenance};

/// The keywords of an export to ROS 2, as a dict of all of them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Keywords {
    wheel_radius: Option<f64>,
    left_joints: Vec<String>,
    right_joints: Vec<String>,
    odom_frame: Option<String>,
    icr_frame: Option<String>,
    base_frame: Option<String>,
    contact_centre: [f64; 2],
    controller: Option<String>,
    /// The name and the text of an odometry file.
    residuals: Option<(String, String)>,
    publish_rate: Option<f64>,
}

/// Names, each of which the setting is to blame for.
fn names<T: std::str::FromStr<Err: std::fmt::Display>>(
    setting: &str,
    texts: impl IntoIterator<Item = String>,
) -> PyResult<Vec<T>> {
    texts.into_iter().map(|text| parsed(setting, &text)).collect()
}

impl Keywords {
    /// The settings of the library, and whether the residuals are of driving that the parameters
    /// were fitted to.
    fn settings(self, export: &Export) -> PyResult<(Ros2Settings, bool)> {
        let choices = WheelChoices {
            joints: PerSide::new(
                names("left_joints", self.left_joints)?,
                names("right_joints", self.right_joints)?,
            ),
            wheel_radius: self.wheel_radius,
        };
        let base = names("base_frame", self.base_frame)?;
        let wheels = export.wheels(&choices).map_err(raised)?;
        let usual = FrameSettings::default();
        let frames = FrameSettings {
            odom: names("odom_frame", self.odom_frame)?.pop().unwrap_or(usual.odom),
            icr: names("icr_frame", self.icr_frame)?.pop().unwrap_or(usual.icr),
            base: export.base_frame(base.first()).map_err(raised)?.name,
            contact_centre: self.contact_centre,
        };
        let residuals = self
            .residuals
            .map(|(name, text)| export.residuals(&Document::new(name, text)).map_err(raised));
        let residuals = residuals.transpose()?;
        let are_fitted = residuals.as_ref().is_some_and(|residuals| !residuals.held_out);
        let usual = Ros2Settings::new(wheels.wheel_radius);
        let settings = Ros2Settings {
            frames,
            left_wheels: wheels.joints.left,
            right_wheels: wheels.joints.right,
            controller: names("controller", self.controller)?.pop().unwrap_or(usual.controller),
            residuals,
            publish_rate: self.publish_rate.unwrap_or(usual.publish_rate),
            wheel_radius: usual.wheel_radius,
        };
        Ok((settings, are_fitted))
    }
}

/// Writes the parameters of a `diff_drive_controller` and a launch file into a folder: those that
/// were written, and whether the residuals are of driving that was fitted to.
#[pyfunction]
#[pyo3(signature = (parameters, folder, keywords, command))]
pub fn write_ros2(
    parameters: &Parameters,
    folder: PathBuf,
    keywords: Keywords,
    command: &str,
) -> PyResult<(Vec<PathBuf>, bool)> {
    let export = Export::new(&parameters.inner, &Provenance::new(command)).map_err(raised)?;
    let (settings, are_fitted) = keywords.settings(&export)?;
    let files = export.ros2(&settings).map_err(|error: Error| raised(error))?;
    Ok((written(write(&files, folder))?, are_fitted))
}

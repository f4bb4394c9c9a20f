//! What goes wrong, raised by kind in the words of the library.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use trackdyn::Error;
use trackdyn::law::Cause;

/// The module with the classes of errors.
const MODULE: &str = "trackdyn._errors";

/// The class of an error in that module.
fn class(error: &Error) -> &'static str {
    match error {
        Error::Document(_) => "DocumentError",
        Error::Output(_)
        | Error::Figure(_)
        | Error::NotRemoved { .. }
        | Error::NotSimulated { .. }
        | Error::OtherOrigin { .. } => "OutputError",
        Error::Unreadable { .. }
        | Error::Recording(_)
        | Error::NotABag { .. }
        | Error::NoTracks { .. }
        | Error::TracksNotNeeded { .. }
        | Error::MotionOnly { .. }
        | Error::NoMotion { .. }
        | Error::NoPositions { .. }
        | Error::NoReference { .. }
        | Error::Runs(_)
        | Error::Time(_)
        | Error::NoRecording
        | Error::RecordingTwice { .. }
        | Error::ComparedWithItself { .. }
        | Error::PointsNotAlone => "RecordingError",
        Error::HeldOut { .. } | Error::AllHeldOut | Error::NoRunsToHoldOut { .. } => "HeldOutError",
        Error::Effect(_) | Error::EffectTwice { .. } | Error::Definition(_) | Error::Law(_) => {
            "EffectError"
        }
        Error::CentreOfGravity(_)
        | Error::NoVehicle { .. }
        | Error::Vehicle(_)
        | Error::Gauge { .. } => "VehicleError",
        Error::SeparationAlone { .. } | Error::TooLarge { .. } | Error::IcrTooFar { .. } => {
            "ParametersError"
        }
        Error::Driving(_) | Error::NoSensors { .. } | Error::GeneratedOnly { .. } => "DrivingError",
        Error::TooFast { .. }
        | Error::FastestSpeed { .. }
        | Error::OutOfLimits { .. }
        | Error::Export(_)
        | Error::LogName { .. }
        | Error::ReversedJoint { .. }
        | Error::NoWheelRadius { .. } => "SettingError",
        Error::Case { .. } | Error::Residuals(_) => "InputError",
        Error::Identify { .. } => "IdentifyError",
        Error::Odometry { .. } => "OdometryError",
        Error::Diagnose { .. } => "DiagnoseError",
        Error::Plan { .. } => "PlanError",
        Error::Run { .. } => "SimulateError",
        _ => "Error",
    }
}

/// The exception of an error of the library; of a law in Python that raised one, that one.
pub fn raised(error: impl Into<Error>) -> PyErr {
    let error = error.into();
    if let Error::Law(failure) = &error
        && let Cause::Raised(cause) = &failure.cause
        && let Some(exception) = cause.downcast_ref::<PyErr>()
    {
        return Python::attach(|py| exception.clone_ref(py));
    }
    with_class(class(&error), &error.to_string(), error.setting())
}

/// The exception of a setting that a use case cannot have, by its name, its value and what was
/// expected.
pub fn refused(setting: &str, value: impl std::fmt::Display, expected: &str) -> PyErr {
    said(setting, &format!("{setting} {value}: {expected}"))
}

/// The exception of a setting that a use case cannot have, by a message that begins with its name.
pub fn said(setting: &str, message: &str) -> PyErr {
    with_class("SettingError", message, Some(setting))
}

fn with_class(class: &str, message: &str, setting: Option<&str>) -> PyErr {
    Python::attach(|py| {
        let made = py
            .import(MODULE)
            .and_then(|module| module.getattr(class))
            .and_then(|class| class.call1((message, setting)));
        made.map_or_else(|_| PyRuntimeError::new_err(message.to_owned()), PyErr::from_value)
    })
}

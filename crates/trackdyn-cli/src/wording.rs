//! Errors of the library in the words of the command line: settings are options here.

use std::error::Error as StdError;
use trackdyn::Error;
use trackdyn::crates::drive;

/// The message of an error.
pub fn message(error: &(dyn StdError + 'static)) -> String {
    error.downcast_ref::<Error>().map_or_else(|| error.to_string(), of_library)
}

/// The message of an error of the library.
fn of_library(error: &Error) -> String {
    match error {
        Error::Driving(drive::Error::Option { name, value, expected }) => {
            let name = if *name == "runs" { "run_count" } else { name };
            format!("{} {value}: expected {expected}", option(name))
        }
        Error::GeneratedOnly { setting: "runs", .. } => {
            error.to_string().replacen("runs", "--run-count", 1)
        }
        // errors of exports begin with the option
        Error::Export(error) => format!("--{error}"),
        Error::NoTracks { path } => {
            let name = path.display();
            format!("{name}: a trajectory has no track speeds: give them with --tracks")
        }
        error => {
            let text = error.to_string();
            let rest = error.setting().and_then(|setting| text.strip_prefix(setting));
            match (error.setting(), rest) {
                (Some(setting), Some(rest)) => option(setting) + rest,
                _ => text,
            }
        }
    }
}

/// The option of a setting.
pub fn option(setting: &str) -> String {
    let name = match setting {
        "accepted" => "accept",
        "left_joints" => "left-joint",
        "right_joints" => "right-joint",
        "left_signals" => "left-signal",
        "right_signals" => "right-signal",
        "nuisances" => "fit",
        other => return format!("--{}", other.replace('_', "-")),
    };
    format!("--{name}")
}

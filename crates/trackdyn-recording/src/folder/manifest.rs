//! `recording.toml`, schema `trackdyn.recording/1`.

use crate::Error;
use crate::recording::{PoseFrame, StatedNoise};
use serde::{Deserialize, Serialize};
use std::path::Path;
use toml::Spanned;
use trackdyn_core::document::Document;

const SCHEMA: &str = "trackdyn.recording/1";
const FRAME: &str = "ros";

/// What stands beside the tables of a recording.
pub(super) struct Manifest {
    pub(super) name: String,
    pub(super) robot: String,
    pub(super) noise: Option<StatedNoise>,
    pub(super) pose_frame: Option<PoseFrame>,
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    schema: Spanned<String>,
    name: String,
    robot: String,
    frame: Spanned<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pose_frame: Option<PoseFrame>,
    #[serde(skip_serializing_if = "Option::is_none")]
    noise: Option<Spanned<StatedNoise>>,
}

impl Manifest {
    pub(super) fn read(path: &Path) -> Result<Self, Error> {
        let document = Document::read(path)?;
        let keys: Keys = document.parse_as(SCHEMA)?;
        if keys.frame.get_ref() != FRAME {
            let expected = format!("\"{FRAME}\"");
            return Err(document.value_error(keys.frame.span(), "frame", expected).into());
        }
        if let Some(noise) = &keys.noise {
            let StatedNoise { position, yaw } = *noise.get_ref();
            if !(position > 0.0 && position.is_finite() && yaw > 0.0 && yaw.is_finite()) {
                let expected = "standard deviations above 0";
                return Err(document.value_error(noise.span(), "noise", expected).into());
            }
        }
        let noise = keys.noise.map(Spanned::into_inner);
        Ok(Self { name: keys.name, robot: keys.robot, noise, pose_frame: keys.pose_frame })
    }

    pub(super) fn to_toml(&self) -> String {
        let unplaced = |text: &str| Spanned::new(0..0, text.to_owned());
        let keys = Keys {
            schema: unplaced(SCHEMA),
            name: self.name.clone(),
            robot: self.robot.clone(),
            frame: unplaced(FRAME),
            pose_frame: self.pose_frame,
            noise: self.noise.map(|noise| Spanned::new(0..0, noise)),
        };
        toml::to_string(&keys).expect("numbers, texts and tables are TOML")
    }
}

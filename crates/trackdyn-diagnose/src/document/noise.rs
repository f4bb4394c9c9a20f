//! The noise of the poses, as a diagnosis measured it.

use super::DIGITS;
use serde::{Deserialize, Serialize};
use toml::Spanned;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_estimate::weighting::SegmentNoise;

/// Standard deviations: of each pose, and of what a second adds.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct NoiseTable {
    /// Of each pose, forward, m.
    pub pose_forward_m: f64,
    /// Of each pose, left, m.
    pub pose_left_m: f64,
    /// Of each pose, rad.
    pub pose_yaw_rad: f64,
    /// What a second adds, forward, m.
    pub walk_forward_m: f64,
    /// What a second adds, left, m.
    pub walk_left_m: f64,
    /// What a second adds to the yaw, rad.
    pub walk_yaw_rad: f64,
    /// What a second adds to the heading of the sensor, rad.
    pub walk_heading_rad: f64,
    /// Of the stamp of each pose, s; zero where stamps show no error.
    #[serde(default, skip_serializing_if = "is_none")]
    pub stamp_s: f64,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde asks")]
fn is_none(deviation: &f64) -> bool {
    *deviation == 0.0
}

/// Smallest and largest standard deviation that a reader accepts, m or rad.
const LIMITS: [f64; 2] = [0.0, 1e3];

impl NoiseTable {
    /// The table of noise whose variances these are.
    pub(crate) fn of(noise: &SegmentNoise) -> Self {
        let deviation = |variance: f64| DIGITS.round(variance.max(0.0).sqrt());
        let [pose_forward_m, pose_left_m, pose_yaw_rad] = noise.pose.map(deviation);
        let [walk_forward_m, walk_left_m, walk_yaw_rad] = noise.walk.map(deviation);
        let walk_heading_rad = deviation(noise.heading);
        Self {
            pose_forward_m,
            pose_left_m,
            pose_yaw_rad,
            walk_forward_m,
            walk_left_m,
            walk_yaw_rad,
            walk_heading_rad,
            stamp_s: deviation(noise.stamp),
        }
    }

    /// The noise.
    pub fn noise(&self) -> SegmentNoise {
        let square = |deviation: f64| deviation * deviation;
        SegmentNoise {
            pose: [self.pose_forward_m, self.pose_left_m, self.pose_yaw_rad].map(square),
            walk: [self.walk_forward_m, self.walk_left_m, self.walk_yaw_rad].map(square),
            heading: square(self.walk_heading_rad),
            stamp: square(self.stamp_s),
        }
    }

    /// Refuses what is no standard deviation, with its line.
    pub(super) fn check(document: &Document) -> Result<(), DocumentError> {
        #[derive(Deserialize)]
        struct Head {
            noise: Option<std::collections::BTreeMap<String, Spanned<f64>>>,
        }
        let [least, most] = LIMITS;
        for (key, value) in document.parse::<Head>()?.noise.iter().flatten() {
            let is_pose = key.starts_with("pose");
            let is_deviation = (least..=most).contains(value.get_ref());
            if !is_deviation || (is_pose && *value.get_ref() == 0.0) {
                let expected = format!("a standard deviation above 0, up to {most}");
                return Err(document.value_error(value.span(), format!("noise.{key}"), expected));
            }
        }
        Ok(())
    }
}

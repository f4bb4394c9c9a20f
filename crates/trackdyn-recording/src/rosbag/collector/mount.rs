//! Poses of a sensor that is mounted on the robot, as poses of the robot.
//!
//! # Law
//! world_from_body = world_from_sensor · (body_from_sensor)⁻¹, with body_from_sensor by the
//! transforms that hold at all times (`/tf_static`).
//!
//! # Assumes
//! The sensor stands upright on the robot. Poses of a tilted one are left as they are, and said.

use super::{PoseKey, Rows};
use crate::recording::Warning;
use crate::rosbag::frames::{Frames, Hop, Link, is_body};
use crate::rosbag::message::planar;
use nalgebra::{Isometry3, Vector3};
use std::collections::BTreeMap;
use trackdyn_core::Pose;

/// Largest tilt of an upright sensor, rad: 3 degrees.
const MAX_TILT: f64 = 0.05;

/// Smallest distance and yaw of a mount that are used, m and rad.
const MIN_MOUNT: f64 = 1e-4;

/// Turns poses of the world in the body, as transforms from a body to a map are, into poses of the
/// body in the world.
pub(super) fn invert(key: &PoseKey, poses: &mut Rows, warnings: &mut Vec<Warning>) {
    for pose in poses {
        let [x, y, yaw] = pose.value;
        let Pose { x, y, yaw } = Pose::new(x, y, yaw).inverse();
        pose.value = [x, y, yaw];
    }
    let taken = format!("those of {} in {}, inverted", key.child, key.parent);
    warnings.push(Warning::Chosen { what: "poses", taken });
}

/// Transforms that hold at all times.
pub(super) type Mounts = BTreeMap<Link, Isometry3<f64>>;

/// Moves the poses of a sensor to the body that it is mounted on, where that is known.
pub(super) fn move_to_body(
    key: &PoseKey,
    poses: &mut Rows,
    frames: &Frames,
    mounts: &Mounts,
    warnings: &mut Vec<Warning>,
) {
    let Some((body, mount)) = mount(&key.child, frames, mounts) else { return };
    let [x, y, yaw] = planar(&mount);
    let up = mount.rotation * Vector3::z();
    let tilt = up.angle(&Vector3::z());
    let child = &key.child;
    let mut say = |taken: String| warnings.push(Warning::Chosen { what: "poses", taken });
    if tilt > MAX_TILT {
        say(format!(
            "those of {child}, which is tilted by {:.0}° on {body}: as they are",
            tilt.to_degrees()
        ));
        return;
    }
    if x.hypot(y) < MIN_MOUNT && yaw.abs() < MIN_MOUNT {
        return;
    }
    for pose in poses {
        let [x_sensor, y_sensor, yaw_sensor] = pose.value;
        let yaw_body = yaw_sensor - yaw;
        let (sin, cos) = yaw_body.sin_cos();
        pose.value = [x_sensor - cos * x + sin * y, y_sensor - sin * x - cos * y, yaw_body];
    }
    say(format!(
        "those of {child} moved to {body}, on which it is mounted at x = {x:.3} m, y = {y:.3} m, \
         yaw = {:.1}° (the transforms that hold at all times)",
        yaw.to_degrees()
    ));
}

/// The body that a frame is mounted on, and where; none where the frame is one itself.
fn mount<'a>(
    child: &str,
    frames: &'a Frames,
    mounts: &Mounts,
) -> Option<(&'a str, Isometry3<f64>)> {
    if child.is_empty() || is_body(child) {
        return None;
    }
    let body = frames.body()?;
    let hops = frames.way(body, child)?;
    let transform = |Hop { link, inverse }: &Hop| {
        let known = mounts.get(link)?;
        Some(if *inverse { known.inverse() } else { *known })
    };
    let steps: Option<Vec<Isometry3<f64>>> = hops.iter().map(transform).collect();
    Some((body, steps?.iter().fold(Isometry3::identity(), |before, next| before * next)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rosbag::date::Received;

    #[test]
    fn an_inverted_pose_leads_back() {
        let pose = [1.5, -0.4, 2.1];
        let [topic, parent, child] = ["/tf", "base_link", "map"].map(str::to_owned);
        let mut inverted = vec![Received { stamp_ns: None, log_ns: 0, value: pose }];
        invert(&PoseKey { topic, parent, child }, &mut inverted, &mut Vec::new());
        let [there, back] = [pose, inverted[0].value].map(|[x, y, yaw]| Pose::new(x, y, yaw));
        let both = there.compose(&back);
        assert!(both.x.hypot(both.y) < 1e-12 && both.yaw.abs() < 1e-12, "{both:?}");
    }
}

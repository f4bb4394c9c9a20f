//! Poses from `nav_msgs/Path`: the trajectory that a robot has driven so far, sent again and again.

use super::date::Received;
use super::message::{header, oriented_pose};
use super::payload::Payload;
use crate::attitude::Attitude;
use std::collections::BTreeMap;

/// Poses (x, y, yaw) with their stamps, ns.
type Poses = Vec<(i64, [f64; 3])>;

/// The union of the messages of a topic by the stamps of the poses; later messages replace what
/// earlier ones say of a stamp, as a map that was corrected does.
#[derive(Default)]
pub(super) struct Trajectory {
    poses: BTreeMap<i64, Received<[f64; 3]>>,
}

/// Reads a message: its frame, and the stamps of its poses with (x, y, yaw); notes how upright they
/// are.
///
/// # Errors
/// A message that cannot be decoded, or whose poses are those of a plan: they have no stamps that
/// grow, or none before that of the message.
pub(super) fn read<'a>(
    payload: &mut Payload<'a>,
    attitude: &mut Attitude,
) -> Result<(&'a str, Poses), String> {
    let decode = |error: super::payload::PayloadError| error.to_string();
    let of_path = header(payload).map_err(decode)?;
    let count = payload.length().map_err(decode)?;
    let mut poses: Poses = Vec::new();
    for _ in 0..count {
        let stamp = header(payload).map_err(decode)?.stamp_ns.unwrap_or_default();
        if stamp == 0 || poses.last().is_some_and(|(before, _)| stamp <= *before) {
            return Err("its poses have no stamps that grow, as those of a plan".to_owned());
        }
        let (value, quaternion) = oriented_pose(payload).map_err(decode)?;
        attitude.note(quaternion);
        poses.push((stamp, value));
    }
    let begins = poses.first().map(|(stamp, _)| *stamp);
    if let (Some(begins), Some(sent)) = (begins, of_path.stamp_ns)
        && poses.len() > 1
        && begins >= sent
    {
        return Err("its poses stand at or after its own stamp, as those of a plan".to_owned());
    }
    Ok((of_path.frame, poses))
}

impl Trajectory {
    /// Adds the poses of a message. One pose alone may be a goal, and is told again.
    pub(super) fn add(&mut self, poses: Poses, log_ns: i64) {
        if poses.len() < 2 {
            return;
        }
        for (stamp, value) in poses {
            let new = Received { stamp_ns: Some(stamp), log_ns, value };
            self.poses.entry(stamp).or_insert(new).value = value;
        }
    }

    /// All poses in the order of time.
    pub(super) fn into_poses(self) -> Vec<Received<[f64; 3]>> {
        self.poses.into_values().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rosbag::payload::Encoding;

    /// A message of ROS 1 with poses at these seconds on a line.
    fn message(sent: u32, seconds: &[u32], y: f64) -> Vec<u8> {
        let mut bytes = Vec::new();
        let header = |bytes: &mut Vec<u8>, seconds: u32| {
            for number in [0, seconds, 0, 1] {
                bytes.extend(number.to_le_bytes());
            }
            bytes.push(b'm');
        };
        header(&mut bytes, sent);
        bytes.extend(u32::try_from(seconds.len()).expect("few").to_le_bytes());
        for &second in seconds {
            header(&mut bytes, second);
            let pose = [f64::from(second), y, 0.0, 0.0, 0.0, 0.0, 1.0];
            bytes.extend(pose.into_iter().flat_map(f64::to_le_bytes));
        }
        bytes
    }

    fn parse(bytes: &[u8]) -> Result<Poses, String> {
        let mut payload = Payload::of(Encoding::Ros1, bytes).expect("a payload");
        let (frame, poses) = read(&mut payload, &mut Attitude::default())?;
        assert_eq!(frame, "m");
        Ok(poses)
    }

    #[test]
    fn growing_and_sliding_paths_are_joined_and_corrections_replace() {
        let mut all = Trajectory::default();
        all.add(parse(&message(2, &[1, 2], 0.0)).expect("a path"), 20);
        all.add(parse(&message(4, &[2, 3, 4], 5.0)).expect("a path"), 40);
        let poses = all.into_poses();
        let ys: Vec<f64> = poses.iter().map(|pose| pose.value[1]).collect();
        let logs: Vec<i64> = poses.iter().map(|pose| pose.log_ns).collect();
        assert_eq!((ys, logs), (vec![0.0, 5.0, 5.0, 5.0], vec![20, 20, 40, 40]));
        assert_eq!(poses[3].stamp_ns, Some(4_000_000_000));
    }

    #[test]
    fn plans_are_no_trajectories() {
        for plan in [message(5, &[0, 0], 0.0), message(5, &[5, 5], 0.0), message(5, &[3, 2], 0.0)] {
            assert!(parse(&plan).expect_err("a plan").contains("no stamps that grow"));
        }
        let ahead = parse(&message(5, &[5, 6, 7], 0.0)).expect_err("a plan");
        assert!(ahead.contains("at or after its own stamp"));
    }
}

//! Readers of recordings, with the options that let them go furthest.

use crate::drive::RADIUS;
use arbitrary::Arbitrary;
use std::path::Path;
use trackdyn_recording::rosbag::{self, Dating, JointSignal, RosbagOptions};
use trackdyn_recording::{DoubtKind, Error, Recording, TableOptions};

/// What a user asks of a bag.
#[derive(Arbitrary, Clone, Copy, Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "switches of a user")]
pub struct Wanted {
    has_radius: bool,
    by_log: bool,
    by_position: bool,
    of_twist: bool,
    of_signals: bool,
    has_frames: bool,
    mount_yaw: Option<f64>,
}

impl Wanted {
    fn options(self) -> RosbagOptions {
        let some = |is_wanted: bool, text: &str| is_wanted.then(|| text.to_owned());
        let many = |text: &str| some(self.of_signals, text).into_iter().collect();
        RosbagOptions {
            wheel_radius: (self.has_radius || !self.of_twist).then_some(RADIUS),
            joint_signal: if self.by_position { JointSignal::Position } else { JointSignal::Any },
            dated_by: if self.by_log { Dating::Log } else { Dating::Any },
            twist_topic: some(self.of_twist, "/topic1"),
            separation: self.of_twist.then_some(0.8),
            left_signals: many("/joints:left"),
            right_signals: many("/joints:right"),
            parent_frame: some(self.has_frames, "map"),
            child_frame: some(self.has_frames, "base"),
            mount_yaw: self.mount_yaw,
            ..RosbagOptions::default()
        }
    }
}

/// Reads a bag: it is inspected, read by what was suggested, and by what is wanted.
pub fn bag(path: &Path, wanted: Wanted) {
    if let Ok(found) = rosbag::inspect(path) {
        let wheel_radius = Some(RADIUS);
        let suggested = RosbagOptions { wheel_radius, ..found.suggested };
        recording(|accepted| rosbag::read(path, &RosbagOptions { accepted, ..suggested.clone() }));
    }
    let options = wanted.options();
    recording(|accepted| rosbag::read(path, &RosbagOptions { accepted, ..options.clone() }));
}

/// Reads a table by default options.
pub fn table(read: impl Fn(&TableOptions) -> Result<Recording, Error>) {
    recording(|accepted| read(&TableOptions { accepted, ..TableOptions::default() }));
}

/// Reads a recording; where it contradicts itself, again without regard to that. The error is
/// printed as for a user.
fn recording(read: impl Fn(Vec<DoubtKind>) -> Result<Recording, Error>) {
    let mut found = read(Vec::new());
    if let Err(Error::Contradiction { .. }) = found {
        found = read(DoubtKind::ALL.to_vec());
    }
    match found {
        Ok(recording) => {
            for warning in recording.warnings() {
                let _ = warning.to_string();
            }
            assert!(!recording.fingerprint().is_empty());
        }
        Err(error) => {
            let _ = error.to_string();
        }
    }
}

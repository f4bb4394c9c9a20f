//! Poses as messages hold them.

use super::{Collector, PoseKey};
use crate::rosbag::date::Received;
use crate::rosbag::frames::{Link, same_frame};
use crate::rosbag::message::{header, oriented_pose, rigid};
use crate::rosbag::payload::{Payload, PayloadError};
use crate::rosbag::topic::{Layout, Topic};

impl Collector<'_> {
    /// Whether poses in these frames are wanted.
    pub(super) fn fits(&self, [parent, child]: [&str; 2]) -> bool {
        let fits = |wanted: &Option<String>, frame: &str| {
            wanted.as_deref().is_none_or(|name| same_frame(name, frame))
        };
        fits(&self.options.parent_frame, parent) && fits(&self.options.child_frame, child)
    }

    /// Keeps a pose where it is wanted.
    pub(super) fn keep_pose(
        &mut self,
        topic: &Topic,
        frames: [&str; 2],
        received: Received<[f64; 3]>,
        quaternion: [f64; 4],
    ) {
        if !self.fits(frames) {
            return;
        }
        let key = PoseKey::new(topic, frames);
        self.attitudes.entry(key.clone()).or_default().note(quaternion);
        self.poses.entry(key).or_default().push(received);
    }

    /// Takes a pose after the beginning of its message.
    pub(super) fn take_pose(
        &mut self,
        topic: &Topic,
        has_child: bool,
        log_ns: i64,
        payload: &mut Payload,
    ) -> Result<(), PayloadError> {
        let header = header(payload)?;
        let child = if has_child { payload.text()? } else { "" };
        if topic.is_static()
            && let Some(transform) = rigid(&mut payload.clone())?
        {
            self.mounts.insert(Link::new(header.frame, child), transform);
        }
        let (value, quaternion) = oriented_pose(payload)?;
        if topic.layout() == Some(Layout::Transforms) {
            self.frames.note(header.frame, child);
        }
        if topic.is_static() {
            // It holds at all times, and shows no motion.
            return Ok(());
        }
        let received = Received { stamp_ns: header.stamp_ns, log_ns, value };
        self.keep_pose(topic, [header.frame, child], received, quaternion);
        Ok(())
    }
}

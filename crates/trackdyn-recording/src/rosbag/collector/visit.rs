//! What is taken from each message.

use super::upright::Inertial;
use super::{Collector, push};
use crate::rosbag::date::Received;
use crate::rosbag::dynamic_joints::{self, DynamicJoints};
use crate::rosbag::message::{header, imu};
use crate::rosbag::options::JointSignal;
use crate::rosbag::payload::PayloadError;
use crate::rosbag::signals::Read;
use crate::rosbag::topic::{Layout, Role, Topic};
use crate::rosbag::visitor::Visitor;

impl Collector<'_> {
    /// Whether messages of this layout are wanted of a topic.
    fn is_wanted(&self, topic: &Topic, layout: Layout) -> bool {
        let is_twist = self.options.twist_topic.as_ref() == Some(&topic.name);
        let named = match layout.role() {
            Role::Poses => return is_twist || self.options.may_hold_poses(&topic.name),
            Role::Twist => return is_twist,
            Role::Tracks if self.signals.are_wanted() => return false,
            Role::Tracks => &self.options.tracks_topic,
            Role::Imu if self.options.pose_topic.as_ref() == Some(&topic.name) => return true,
            Role::Imu => &self.options.imu_topic,
        };
        named.as_ref().is_none_or(|name| *name == topic.name)
    }

    /// Takes the numbers that the options name as the velocities of joints, or their positions.
    fn take_signals(&mut self, topic: &Topic, log_ns: i64, payload: &[u8]) -> Result<(), String> {
        if let Some(Read { stamp_ns, names, numbers }) = self.signals.read(topic, payload)? {
            let received = Received { stamp_ns, log_ns, value: () };
            let signals = match self.options.joint_signal {
                JointSignal::Position => [&numbers[..], &[]],
                JointSignal::Any | JointSignal::Velocity => [&[], &numbers[..]],
            };
            self.joints.take_signals(&topic.name, received, &names, signals);
        }
        Ok(())
    }

    fn take(
        &mut self,
        topic: &Topic,
        layout: Layout,
        log_ns: i64,
        payload: &[u8],
    ) -> Result<(), String> {
        let decode = |error: PayloadError| error.to_string();
        let mut payload = topic.payload(payload).map_err(decode)?;
        if self.options.twist_topic.as_ref() == Some(&topic.name) {
            self.take_twist(topic, layout, log_ns, payload.clone())?;
            if self.options.pose_topic.as_ref() != Some(&topic.name) {
                return Ok(());
            }
        }
        if layout == Layout::Transforms {
            let count = payload.length().map_err(decode)?;
            for _ in 0..count {
                self.take_pose(topic, true, log_ns, &mut payload).map_err(decode)?;
            }
            return Ok(());
        }
        match layout {
            Layout::JointState => {
                let stamp_ns = header(&mut payload).map_err(decode)?.stamp_ns;
                let received = Received { stamp_ns, log_ns, value: () };
                self.joints.take(&topic.name, received, &mut payload).map_err(decode)?;
            }
            Layout::DynamicJointState => {
                let stamp_ns = header(&mut payload).map_err(decode)?.stamp_ns;
                let received = Received { stamp_ns, log_ns, value: () };
                let DynamicJoints { names, signals } =
                    dynamic_joints::read(&mut payload).map_err(decode)?;
                let signals = signals.each_ref().map(Vec::as_slice);
                self.dynamic_joints.take_signals(&topic.name, received, &names, signals);
            }
            Layout::Imu => {
                let stamp_ns = header(&mut payload).map_err(decode)?.stamp_ns;
                let ([mut rate, force], yaw) = imu(&mut payload).map_err(decode)?;
                if self.options.gyro_in_degrees {
                    rate = rate.map(f64::to_radians);
                }
                if let Some(value) = yaw {
                    push(&mut self.yaws, &topic.name, Received { stamp_ns, log_ns, value });
                }
                let value = Inertial { rate, force };
                push(&mut self.imu, &topic.name, Received { stamp_ns, log_ns, value });
            }
            Layout::Path | Layout::PoseArray | Layout::BarePose | Layout::Fix => {
                self.take_other_pose(topic, layout, log_ns, &mut payload)?;
            }
            // Of use only where it is the topic of the options.
            Layout::Twist | Layout::TwistStamped => {}
            Layout::Pose | Layout::PoseOfChild | Layout::Transforms => {
                let has_child = layout == Layout::PoseOfChild;
                self.take_pose(topic, has_child, log_ns, &mut payload).map_err(decode)?;
            }
        }
        Ok(())
    }
}

impl Visitor for Collector<'_> {
    fn defines(&mut self, kind: &str, text: &str) {
        self.signals.define(kind, text);
    }

    fn wants(&mut self, topic: &Topic) -> bool {
        if !self.seen.contains(topic) {
            self.seen.push(topic.clone());
        }
        self.signals.prepare(topic);
        self.signals.are_of(topic)
            || topic.layout().is_some_and(|layout| self.is_wanted(topic, layout))
    }

    fn message(&mut self, topic: &Topic, log_ns: i64, payload: &[u8]) {
        let mut found = Ok(());
        let mut layout = topic.layout();
        if self.signals.are_of(topic) {
            found = self.take_signals(topic, log_ns, payload);
            layout = layout.filter(|layout| self.is_wanted(topic, *layout));
        }
        if let Some(layout) = layout {
            found = found.and(self.take(topic, layout, log_ns, payload));
        }
        if let Err(reason) = found {
            self.skipped.entry(topic.name.clone()).or_insert((0, reason)).0 += 1;
        }
    }
}

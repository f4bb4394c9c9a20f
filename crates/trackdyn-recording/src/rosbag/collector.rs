//! From messages to a run.

use super::chain;
use super::clock::{By, Clock, decide};
use super::date::{Received, Stamped};
use super::fixes::{Fix, Yaw};
use super::frames::{Frames, same_frame};
use super::joints::Joints;
use super::message::{header, imu, oriented_pose};
use super::options::RosbagOptions;
use super::path::Trajectory;
use super::payload::{Payload, PayloadError};
use super::topic::{Layout, Role, Topic};
use super::visitor::Visitor;
use crate::Error;
use crate::attitude::Attitude;
use crate::doubt::Doubt;
use crate::recording::{UncheckedRun, Warning};
use std::collections::BTreeMap;
use std::path::Path;
use trackdyn_core::PerSide;

mod alike;
mod choice;
mod gyro;
mod joint;
mod merge;
mod others;
mod publishers;
mod signal;
mod speeds;
mod tracks;
mod turns;

use choice::Sources;
use speeds::Streams;

/// What the messages of a bag say, kept by source until it is clear which one to use.
pub(super) struct Collector<'a> {
    options: &'a RosbagOptions,
    joints: Joints,
    seen: Vec<Topic>,
    poses: BTreeMap<PoseKey, Rows>,
    /// How upright they are.
    attitudes: BTreeMap<PoseKey, Attitude>,
    imu: BTreeMap<String, Rows>,
    /// Yaw of the orientations of IMUs, by topic.
    yaws: BTreeMap<String, Vec<Yaw>>,
    /// Fixes of satellite navigation, by topic.
    fixes: BTreeMap<String, Vec<Fix>>,
    /// What messages of `nav_msgs/Path` tell, by topic and frame.
    paths: BTreeMap<PoseKey, Trajectory>,
    /// What the transforms of all topics link.
    frames: Frames,
    /// Per topic: messages that were skipped, and why the first was.
    skipped: BTreeMap<String, (u64, String)>,
}

/// Poses (x, y, yaw) or readings of an IMU (yaw rate, acceleration forward and to the left).
type Rows = Vec<Received<[f64; 3]>>;

/// Topic, frame and child frame of poses.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct PoseKey {
    topic: String,
    parent: String,
    child: String,
}

impl PoseKey {
    fn new(topic: &Topic, [parent, child]: [&str; 2]) -> Self {
        Self { topic: topic.name.clone(), parent: parent.to_owned(), child: child.to_owned() }
    }
}

/// Runs and how they came about.
pub(super) struct Collected {
    /// The rows; t = 0 at `epoch_ns`.
    pub(super) runs: Vec<UncheckedRun>,
    /// Unix time of t = 0, ns.
    pub(super) epoch_ns: i64,
    /// Joints of each side as they were taken, with a `-` where they are reversed.
    pub(super) joints: PerSide<Vec<String>>,
    /// What was chosen, dated or skipped.
    pub(super) warnings: Vec<Warning>,
}

impl<'a> Collector<'a> {
    pub(super) fn new(options: &'a RosbagOptions) -> Self {
        Self {
            options,
            joints: Joints::new(options),
            seen: Vec::new(),
            poses: BTreeMap::new(),
            attitudes: BTreeMap::new(),
            imu: BTreeMap::new(),
            yaws: BTreeMap::new(),
            fixes: BTreeMap::new(),
            paths: BTreeMap::new(),
            frames: Frames::default(),
            skipped: BTreeMap::new(),
        }
    }

    /// Chooses among the sources and makes the runs.
    pub(super) fn finish(mut self, path: &Path) -> Result<Collected, Error> {
        let mut warnings = Vec::new();
        self.add_other_poses(path, &mut warnings)?;
        for (topic, (count, reason)) in &self.skipped {
            let (topic, reason) = (topic.clone(), reason.clone());
            warnings.push(Warning::MessagesSkipped { topic, count: *count, reason });
        }
        let sources = Sources { path, options: self.options, seen: &self.seen };
        let chosen = sources.tracks(self.joints.into_sources(), &self.skipped, &mut warnings)?;
        let (imu_topic, imu) = sources.imu(self.imu, &mut warnings)?;
        let is_free = !self.options.names_poses();
        let (poses, pose_topic, chained) = match (self.options.frames(), self.poses.is_empty()) {
            (Some(ends), true) if !self.frames.is_empty() => {
                let chain = chain::read(path, self.options, &self.frames, ends)?;
                warnings.extend(chain.warnings);
                (Vec::new(), String::new(), Some(chain.poses))
            }
            _ if self.poses.is_empty() && is_free && !imu.is_empty() => {
                let taken = format!("the yaw of the gyroscope {imu_topic}, without positions");
                warnings.push(Warning::Chosen { what: "poses", taken });
                (gyro::headings(&imu), imu_topic.clone(), None)
            }
            _ => {
                let (key, poses) = sources.poses(self.poses, &mut warnings)?;
                if let Some(count) = self.attitudes.get(&key).and_then(Attitude::tilted) {
                    return Err(Error::contradiction(path, Doubt::OutOfPlane { count }));
                }
                (poses, key.topic, None)
            }
        };
        // Clocks of the tracks come first: others are compared with them.
        let mut clocks: Vec<Clock> = Vec::new();
        for joint in &chosen.joints {
            if clocks.iter().all(|clock| clock.topic != joint.topic) {
                let of_topic = chosen.joints.iter().filter(|other| other.topic == joint.topic);
                let most = of_topic.map(|joint| &joint.signals).max_by_key(|all| all.len());
                clocks.extend(most.map(|all| Clock::of(&joint.topic, all)));
            }
        }
        clocks.push(Clock::of(&pose_topic, &poses));
        clocks.push(Clock::of(&imu_topic, &imu));
        let (by, told) = if chained.is_some() {
            // Poses of a chain stand at the stamps of its links.
            (By::Header, Vec::new())
        } else {
            decide(&clocks, self.options.dated_by)
        };
        warnings.extend(told);
        warnings.extend(clocks.iter().flat_map(|clock| clock.warnings(by)));
        let streams = Streams { chosen, poses, pose_topic, chained, imu, imu_topic };
        speeds::runs(path, self.options, &clocks, by, streams, warnings)
    }

    /// Whether poses in these frames are wanted.
    fn fits(&self, [parent, child]: [&str; 2]) -> bool {
        let fits = |wanted: &Option<String>, frame: &str| {
            wanted.as_deref().is_none_or(|name| same_frame(name, frame))
        };
        fits(&self.options.parent_frame, parent) && fits(&self.options.child_frame, child)
    }

    fn keep_pose(
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
            Layout::Imu => {
                let stamp_ns = header(&mut payload).map_err(decode)?.stamp_ns;
                let (value, yaw) = imu(&mut payload).map_err(decode)?;
                if let Some(value) = yaw {
                    push(&mut self.yaws, &topic.name, Received { stamp_ns, log_ns, value });
                }
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

    fn take_pose(
        &mut self,
        topic: &Topic,
        has_child: bool,
        log_ns: i64,
        payload: &mut Payload,
    ) -> Result<(), PayloadError> {
        let header = header(payload)?;
        let child = if has_child { payload.text()? } else { "" };
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

/// Appends without making a new key where there is one.
fn push<T>(series: &mut BTreeMap<String, Vec<T>>, name: &str, value: T) {
    if let Some(values) = series.get_mut(name) {
        values.push(value);
    } else {
        series.insert(name.to_owned(), vec![value]);
    }
}

impl Visitor for Collector<'_> {
    fn wants(&mut self, topic: &Topic) -> bool {
        let is_twist = self.options.twist_topic.as_ref() == Some(&topic.name);
        if !self.seen.contains(topic) {
            self.seen.push(topic.clone());
        }
        let Some(layout) = topic.layout() else { return false };
        let named = match layout.role() {
            Role::Poses => return is_twist || self.options.may_hold_poses(&topic.name),
            Role::Twist => return is_twist,
            Role::Tracks => &self.options.tracks_topic,
            Role::Imu => &self.options.imu_topic,
        };
        named.as_ref().is_none_or(|name| *name == topic.name)
    }

    fn message(&mut self, topic: &Topic, log_ns: i64, payload: &[u8]) {
        let Some(layout) = topic.layout() else { return };
        if let Err(reason) = self.take(topic, layout, log_ns, payload) {
            self.skipped.entry(topic.name.clone()).or_insert((0, reason)).0 += 1;
        }
    }
}

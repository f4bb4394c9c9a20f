//! From messages to a run.

use super::chain;
use super::clock::{Clock, decide, share_rate};
use super::date::{Received, Stamped};
use super::fixes::{Fix, Yaw};
use super::frames::{Frames, Hop, is_body, is_of_odometry};
use super::joints::Joints;
use super::options::RosbagOptions;
use super::path::Trajectory;
use super::signals::Signals;
use super::topic::{Layout, Topic, list};
use crate::Error;
use crate::attitude::Attitude;
use crate::doubt::{Doubt, DoubtKind};
use crate::recording::{BagNames, UncheckedRun, Warning};
use std::collections::BTreeMap;
use std::path::Path;

mod agreement;
mod alike;
mod choice;
mod copies;
mod gyro;
mod joint;
mod merge;
mod mount;
mod others;
mod poses;
mod publishers;
mod signal;
mod speeds;
mod tracks;
mod turns;
mod upright;
mod visit;

use choice::Sources;
use mount::{Mounts, invert, move_to_body};
use speeds::Streams;
use upright::{Inertial, upright};

/// What the messages of a bag say, kept by source until it is clear which one to use.
pub(super) struct Collector<'a> {
    options: &'a RosbagOptions,
    joints: Joints,
    /// Of `control_msgs/DynamicJointState`, which often repeats joints of other messages.
    dynamic_joints: Joints,
    signals: Signals,
    seen: Vec<Topic>,
    poses: BTreeMap<PoseKey, Rows>,
    /// How upright they are.
    attitudes: BTreeMap<PoseKey, Attitude>,
    imu: BTreeMap<String, Vec<Received<Inertial>>>,
    /// Yaw of the orientations of IMUs, by topic.
    yaws: BTreeMap<String, Vec<Yaw>>,
    /// Fixes of satellite navigation, by topic.
    fixes: BTreeMap<String, Vec<Fix>>,
    /// What messages of `nav_msgs/Path` tell, by topic and frame.
    paths: BTreeMap<PoseKey, Trajectory>,
    /// What the transforms of all topics link.
    frames: Frames,
    /// Those that hold at all times.
    mounts: Mounts,
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
    /// What was taken; all joints, and no radius.
    pub(super) names: BagNames,
    /// What was chosen, dated or skipped.
    pub(super) warnings: Vec<Warning>,
}

impl<'a> Collector<'a> {
    pub(super) fn new(options: &'a RosbagOptions, signals: Signals) -> Self {
        Self {
            options,
            joints: Joints::new(options),
            dynamic_joints: Joints::new(options),
            signals,
            seen: Vec::new(),
            poses: BTreeMap::new(),
            attitudes: BTreeMap::new(),
            imu: BTreeMap::new(),
            yaws: BTreeMap::new(),
            fixes: BTreeMap::new(),
            paths: BTreeMap::new(),
            frames: Frames::default(),
            mounts: Mounts::new(),
            skipped: BTreeMap::new(),
        }
    }

    /// Chooses among the sources and makes the runs.
    pub(super) fn finish(mut self, path: &Path) -> Result<Collected, Error> {
        let mut warnings = Vec::new();
        if let Some(problem) = self.signals.problem(&self.seen) {
            let (what, available) = ("track speeds", list(self.seen.iter()));
            return Err(Error::Topic { path: path.to_owned(), what, problem, available });
        }
        self.add_other_poses(path, &mut warnings)?;
        for (topic, (count, reason)) in &self.skipped {
            let (topic, reason) = (topic.clone(), reason.clone());
            warnings.push(Warning::MessagesSkipped { topic, count: *count, reason });
        }
        let signals = &self.signals;
        let sources = Sources { path, options: self.options, seen: &self.seen, signals };
        let usual_chain = self.usual_chain();
        let is_dynamic = self.takes_dynamic_joints(&mut warnings);
        let joints = if is_dynamic { self.dynamic_joints } else { self.joints };
        let chosen = sources.tracks(joints.into_sources(), &self.skipped, &mut warnings)?;
        let gyroscopes: Vec<String> = self.imu.keys().cloned().collect();
        let (imu_topic, imu) = sources.imu(self.imu, &mut warnings)?;
        let is_gyroscope = self.options.pose_topic.as_ref() == Some(&imu_topic);
        let imu = upright(&imu_topic, imu, &mut warnings);
        let is_free = !self.options.names_poses();
        let named = |frame: &str| Some(frame.to_owned()).filter(|frame| !frame.is_empty());
        let given = self.options.frames().filter(|_| self.poses.is_empty());
        let usual = usual_chain.as_ref().map(|ends| ends.each_ref().map(String::as_str));
        let ends = given.or(usual).filter(|_| !self.frames.is_empty());
        let mut frames =
            self.options.frames().or(ends).map_or([None, None], |both| both.map(named));
        // Clocks of the tracks come first: others are compared with them.
        let mut clocks: Vec<Clock> = Vec::new();
        for joint in &chosen.joints {
            if clocks.iter().all(|clock| clock.topic != joint.topic) {
                let of_topic = chosen.joints.iter().filter(|other| other.topic == joint.topic);
                let most = of_topic.map(|joint| &joint.signals).max_by_key(|all| all.len());
                clocks.extend(most.map(|all| Clock::of(&joint.topic, all)));
            }
        }
        let mut attitude = None;
        let mut chain_by = None;
        let (poses, pose_topic, chained) = match ends {
            Some(ends) => {
                let chain = chain::read(path, self.options, &self.frames, ends, &clocks)?;
                warnings.extend(chain.warnings);
                (attitude, chain_by) = (Some(chain.attitude), Some(chain.by));
                (Vec::new(), String::new(), Some(chain.poses))
            }
            _ if self.poses.is_empty() && (is_free || is_gyroscope) && !imu.is_empty() => {
                warnings.push(Warning::YawOfGyroscope { gyroscope: imu_topic.clone() });
                (gyro::headings(&imu), imu_topic.clone(), None)
            }
            _ => {
                let (key, mut poses) =
                    sources.poses(self.poses, &gyroscopes, &self.skipped, &mut warnings)?;
                attitude = self.attitudes.get(&key).copied();
                let mut topics = self.seen.iter().filter(|topic| topic.name == key.topic);
                let are_transforms = topics.any(|topic| topic.layout() == Some(Layout::Transforms));
                if are_transforms && is_body(&key.parent) {
                    invert(&key, &mut poses, &mut warnings);
                    frames = [named(&key.child), named(&key.parent)];
                } else {
                    move_to_body(&key, &mut poses, &self.frames, &self.mounts, &mut warnings);
                    frames = [named(&key.parent), named(&key.child)];
                }
                (poses, key.topic, None)
            }
        };
        if let Some((count, axes)) = attitude.as_ref().and_then(Attitude::out_of_plane) {
            let doubt = Doubt::OutOfPlane { count, axes };
            if !self.options.accepted.contains(&DoubtKind::OutOfPlane) {
                return Err(Error::contradiction(path, doubt));
            }
            warnings.push(Warning::Accepted(doubt));
        }
        clocks.push(Clock::of(&pose_topic, &poses));
        clocks.push(Clock::of(&imu_topic, &imu));
        share_rate(&mut clocks);
        // Poses of a chain are dated already, by the clocks of its links.
        let (by, told) = match chain_by {
            Some(by) => (by, Vec::new()),
            None => decide(&clocks, self.options.dated_by),
        };
        warnings.extend(told);
        warnings.extend(clocks.iter().flat_map(|clock| clock.warnings(by)));
        let streams = Streams { chosen, poses, pose_topic, frames, chained, imu, imu_topic };
        speeds::runs(path, self.options, &clocks, by, streams, warnings)
    }
}

impl Collector<'_> {
    /// The ends of the usual chain of transforms from a map over odometry to the body, where poses
    /// are needed and all that there are belong to it.
    fn usual_chain(&self) -> Option<[String; 2]> {
        if self.options.parent_frame.is_some() || self.options.child_frame.is_some() {
            return None;
        }
        let body = self.frames.body()?;
        let root = self.frames.root_of(body);
        let is_transform = |key: &PoseKey| {
            let mut topics = self.seen.iter().filter(|topic| topic.name == key.topic);
            topics.any(|topic| topic.layout() == Some(Layout::Transforms))
        };
        let moves = |hop: &Hop| {
            let mut keys = self.poses.keys().filter(|key| is_transform(key));
            keys.any(|key| hop.link.is(&key.parent, &key.child))
        };
        let hops = self.frames.way(root, body)?;
        let moving = hops.iter().filter(|hop| moves(hop)).count();
        let are_of_it =
            self.poses.keys().all(|key| is_transform(key) || is_of_odometry(&key.parent));
        let is_chain = moving >= 2 && hops.first().is_some_and(moves) && !is_of_odometry(root);
        (is_chain && are_of_it).then(|| [root.to_owned(), body.to_owned()])
    }

    /// Whether the joints of `DynamicJointState` are taken: where other messages have no joints, or
    /// where their joints never move while these do.
    fn takes_dynamic_joints(&self, warnings: &mut Vec<Warning>) -> bool {
        if !self.dynamic_joints.has_any() || !self.joints.has_any() {
            return self.dynamic_joints.has_any();
        }
        let moves = |joints: &Joints| joints.columns().any(publishers::moves);
        let is_dynamic = moves(&self.dynamic_joints) && !moves(&self.joints);
        if is_dynamic {
            let idle = self.joints.messages_by_topic().into_iter();
            warnings.extend(idle.map(|(topic, count)| Warning::MessagesSkipped {
                topic,
                count,
                reason: "its joints never move, as those of DynamicJointState do".to_owned(),
            }));
        }
        is_dynamic
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

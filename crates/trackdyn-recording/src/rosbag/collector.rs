//! From messages to a run.

use super::chain;
use super::date::{Received, Stamped, dated};
use super::frames::{Frames, same_frame};
use super::joints::{Joints, Reading};
use super::message::{header, imu, planar_pose};
use super::options::RosbagOptions;
use super::payload::{Payload, PayloadError};
use super::topic::{Layout, Role, Topic};
use super::visitor::Visitor;
use crate::Error;
use crate::recording::{UncheckedRun, Warning};
use std::collections::BTreeMap;
use std::path::Path;

mod choice;
mod speeds;
mod turns;

use choice::Sources;

/// What the messages of a bag say, kept by source until it is clear which one to use.
pub(super) struct Collector<'a> {
    options: &'a RosbagOptions,
    joints: Joints,
    seen: Vec<Topic>,
    readings: BTreeMap<String, Vec<Received<Reading>>>,
    poses: BTreeMap<PoseKey, Vec<Received<[f64; 3]>>>,
    imu: BTreeMap<String, Vec<Received<[f64; 3]>>>,
    /// What the transforms of all topics link.
    frames: Frames,
    /// Per topic: messages that were skipped, and why the first was.
    skipped: BTreeMap<String, (u64, String)>,
}

/// Topic, frame and child frame of poses.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct PoseKey {
    topic: String,
    parent: String,
    child: String,
}

/// A run and how it came about.
pub(super) struct Collected {
    /// The rows; t = 0 at `epoch_ns`.
    pub(super) run: UncheckedRun,
    /// Unix time of t = 0, ns.
    pub(super) epoch_ns: i64,
    /// What was chosen, dated or skipped.
    pub(super) warnings: Vec<Warning>,
}

impl<'a> Collector<'a> {
    pub(super) fn new(options: &'a RosbagOptions) -> Self {
        Self {
            options,
            joints: Joints::new(options),
            seen: Vec::new(),
            readings: BTreeMap::new(),
            poses: BTreeMap::new(),
            imu: BTreeMap::new(),
            frames: Frames::default(),
            skipped: BTreeMap::new(),
        }
    }

    /// Chooses among the sources and makes the run.
    pub(super) fn finish(self, path: &Path) -> Result<Collected, Error> {
        let mut warnings = Vec::new();
        let readings = all_dated(self.readings, String::as_str, &mut warnings);
        let poses = all_dated(self.poses, |key| &key.topic, &mut warnings);
        let imu = all_dated(self.imu, String::as_str, &mut warnings);
        for (topic, (count, reason)) in &self.skipped {
            let (topic, reason) = (topic.clone(), reason.clone());
            warnings.push(Warning::MessagesSkipped { topic, count: *count, reason });
        }
        let sources = Sources { path, options: self.options, seen: &self.seen };
        let readings = sources.tracks(readings, &self.skipped, &mut warnings)?;
        let poses = match (self.options.frames(), poses.is_empty()) {
            (Some(ends), true) if !self.frames.is_empty() => {
                let chain = chain::read(path, self.options, &self.frames, ends)?;
                warnings.extend(chain.warnings);
                chain.poses
            }
            _ => sources.poses(poses, &mut warnings)?,
        };
        let imu = sources.imu(imu, &mut warnings)?;
        warnings.extend(self.joints.guessed());
        speeds::run(path, self.options, self.joints.met(), readings, poses, imu, warnings)
    }

    fn keep_pose(&mut self, topic: &Topic, frames: [&str; 2], received: Received<[f64; 3]>) {
        let fits = |wanted: &Option<String>, frame: &str| {
            wanted.as_deref().is_none_or(|name| same_frame(name, frame))
        };
        let [parent, child] = frames;
        if !fits(&self.options.parent_frame, parent) || !fits(&self.options.child_frame, child) {
            return;
        }
        let key = PoseKey {
            topic: topic.name.clone(),
            parent: parent.to_owned(),
            child: child.to_owned(),
        };
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
                let value = self.joints.reading(&mut payload).map_err(|error| error.to_string())?;
                push(&mut self.readings, &topic.name, Received { stamp_ns, log_ns, value });
            }
            Layout::Imu => {
                let stamp_ns = header(&mut payload).map_err(decode)?.stamp_ns;
                let value = imu(&mut payload).map_err(decode)?;
                push(&mut self.imu, &topic.name, Received { stamp_ns, log_ns, value });
            }
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
        let value = planar_pose(payload)?;
        if topic.layout() == Some(Layout::Transforms) {
            self.frames.note(header.frame, child);
        }
        if topic.is_static() {
            // It holds at all times, and shows no motion.
            return Ok(());
        }
        let received = Received { stamp_ns: header.stamp_ns, log_ns, value };
        self.keep_pose(topic, [header.frame, child], received);
        Ok(())
    }
}

/// All series with their dates; `topic` names the topic of a key.
fn all_dated<K: Ord, T>(
    series: BTreeMap<K, Vec<Received<T>>>,
    topic: impl Fn(&K) -> &str,
    warnings: &mut Vec<Warning>,
) -> BTreeMap<K, Vec<Stamped<T>>> {
    let dates = series.into_iter().map(|(key, received)| {
        let (dated, warning) = dated(topic(&key), received);
        warnings.extend(warning);
        (key, dated)
    });
    dates.collect()
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
        if !self.seen.contains(topic) {
            self.seen.push(topic.clone());
        }
        let Some(layout) = topic.layout() else { return false };
        let named = match layout.role() {
            Role::Poses => return self.options.may_hold_poses(&topic.name),
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

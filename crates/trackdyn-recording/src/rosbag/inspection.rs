//! What a bag holds, and which options would read it.

use super::definition::bare;
use super::dynamic_joints;
use super::frames::{Frames, is_transforms, may_be_odometry};
use super::joints;
use super::message::header;
use super::options::RosbagOptions;
use super::payload::{Payload, PayloadError};
use super::storage;
use super::topic::{Layout, Role, STATIC_SUFFIX, Topic};
use super::twist;
use super::visitor::Visitor;
use crate::Error;
use crate::recording::Warning;
use std::collections::BTreeMap;
use std::path::Path;
use trackdyn_core::{PerSide, Side};

/// Contents of a bag.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// The topics, in the order of their names.
    pub topics: Vec<TopicSummary>,
    /// Options that would read it; what the bag leaves open, and the wheel radius, are left open.
    pub suggested: RosbagOptions,
    /// Damage to the files, and poses that may be no reference.
    pub warnings: Vec<Warning>,
}

/// A topic and what was seen of it.
#[derive(Clone, Debug, PartialEq)]
pub struct TopicSummary {
    /// Its name.
    pub name: String,
    /// Its type.
    pub kind: String,
    /// What it can be used for.
    pub role: Option<Role>,
    /// Number of messages.
    pub messages: u64,
    /// Time from the first to the last logging, s.
    pub duration: f64,
    /// Joints in its first message, where they are joints.
    pub joints: Vec<String>,
    /// Signals of these joints.
    pub signals: Vec<&'static str>,
    /// Frames (parent, child) in its messages, where they are poses; the child may be empty.
    pub frames: Vec<(String, String)>,
}

/// Lists topics, types, counts and durations, and suggests options.
///
/// # Errors
/// [`Error::NotARecording`], [`Error::Bag`], [`Error::Unreadable`].
pub fn inspect(path: &Path) -> Result<Inspection, Error> {
    inspect_for(path, &RosbagOptions::default())
}

/// As [`inspect`], for a user who has given some options already: poses of a driver whose speeds
/// are taken are suggested only where there are no others, and those beside a twist not at all.
///
/// # Errors
/// Those of [`inspect`].
pub fn inspect_for(path: &Path, given: &RosbagOptions) -> Result<Inspection, Error> {
    let mut observer = Observer::default();
    let mut warnings = storage::scan(path, &mut observer)?;
    let mut topics: Vec<TopicSummary> =
        observer.topics.into_iter().map(|(topic, seen)| seen.summary(topic)).collect();
    let suggested = suggest(&topics, given);
    for topic in &mut topics {
        let of_topic = Some(signal_of(topic));
        if of_topic.as_ref() == suggested.left_signals.first()
            || of_topic.as_ref() == suggested.right_signals.first()
        {
            topic.role = Some(Role::Tracks);
        }
    }
    let chosen = topics.iter().filter(|topic| Some(&topic.name) == suggested.pose_topic.as_ref());
    let odometry = chosen.filter(|topic| {
        may_be_odometry(&topic.kind, topic.frames.iter().map(|(parent, _)| &**parent))
    });
    warnings.extend(odometry.map(|topic| Warning::OwnOdometry { poses: topic.name.clone() }));
    Ok(Inspection { topics, suggested, warnings })
}

#[derive(Default)]
struct Observer {
    topics: BTreeMap<Topic, Seen>,
}

#[derive(Default)]
struct Seen {
    messages: u64,
    span_ns: Option<(i64, i64)>,
    joints: Vec<String>,
    signals: Vec<&'static str>,
    frames: Vec<(String, String)>,
}

impl Visitor for Observer {
    fn wants(&mut self, topic: &Topic) -> bool {
        self.topics.entry(topic.clone()).or_default();
        true
    }

    fn message(&mut self, topic: &Topic, log_ns: i64, payload: &[u8]) {
        let Some(seen) = self.topics.get_mut(topic) else { return };
        seen.messages += 1;
        let (first, last) = seen.span_ns.unwrap_or((log_ns, log_ns));
        seen.span_ns = Some((first.min(log_ns), last.max(log_ns)));
        if let Some(layout) = topic.layout() {
            // A message that cannot be decoded has no frames and no joints to show.
            let _ = topic.payload(payload).and_then(|payload| seen.look_into(layout, payload));
        }
    }
}

impl Seen {
    fn look_into(&mut self, layout: Layout, mut payload: Payload) -> Result<(), PayloadError> {
        match layout {
            Layout::JointState if self.joints.is_empty() => {
                header(&mut payload)?;
                let (names, positions, velocities) = joints::names(&mut payload)?;
                self.joints = names.into_iter().map(str::to_owned).collect();
                let signals = [(positions, "position"), (velocities, "velocity")];
                self.signals =
                    signals.into_iter().filter_map(|(has, name)| has.then_some(name)).collect();
            }
            Layout::DynamicJointState if self.joints.is_empty() => {
                header(&mut payload)?;
                let joints = dynamic_joints::read(&mut payload)?;
                self.joints = joints.names.into_iter().map(str::to_owned).collect();
                let signals = joints.signals.iter().zip(["position", "velocity"]);
                self.signals =
                    signals.filter_map(|(all, name)| (!all.is_empty()).then_some(name)).collect();
            }
            Layout::Pose | Layout::Path | Layout::PoseArray | Layout::Fix => {
                let frame = header(&mut payload)?.frame;
                self.note_frames(frame, "");
            }
            Layout::PoseOfChild => {
                let frame = header(&mut payload)?.frame;
                self.note_frames(frame, payload.text()?);
            }
            Layout::Transforms => {
                for _ in 0..payload.length()? {
                    let frame = header(&mut payload)?.frame;
                    self.note_frames(frame, payload.text()?);
                    // translation and rotation
                    payload.skip_f64s(7)?;
                }
            }
            Layout::JointState
            | Layout::DynamicJointState
            | Layout::Imu
            | Layout::BarePose
            | Layout::Twist
            | Layout::TwistStamped => {}
        }
        Ok(())
    }

    fn note_frames(&mut self, parent: &str, child: &str) {
        if !self.frames.iter().any(|(p, c)| p == parent && c == child) {
            self.frames.push((parent.to_owned(), child.to_owned()));
        }
    }

    #[expect(clippy::cast_precision_loss, reason = "recordings last less than 2⁵³ ns, 104 days")]
    fn summary(self, topic: Topic) -> TopicSummary {
        let (first, last) = self.span_ns.unwrap_or_default();
        TopicSummary {
            role: topic.layout().map(Layout::role),
            name: topic.name,
            kind: topic.kind,
            messages: self.messages,
            duration: last.saturating_sub(first) as f64 / 1e9,
            joints: self.joints,
            signals: self.signals,
            frames: self.frames,
        }
    }
}

/// The topics that are no second choice, where there are any.
fn first_choice(topics: Vec<&TopicSummary>) -> Vec<&TopicSummary> {
    let is_second =
        |topic: &&TopicSummary| Layout::of_kind(&topic.kind).is_some_and(Layout::is_second_choice);
    let (second, first): (Vec<_>, Vec<_>) = topics.into_iter().partition(is_second);
    if first.is_empty() { second } else { first }
}

/// The topic of the poses and their frames: the only Odometry or stamped pose, else the only topic
/// of transforms, whose chain from the root to the body of the robot is taken. None for fixes: left
/// open, they are taken where the yaw of an IMU goes with them, and its gyroscope alone otherwise.
fn suggest_poses(topics: Vec<&TopicSummary>) -> (Option<String>, Option<(String, String)>) {
    let topics = first_choice(topics);
    let is_tf = |topic: &&TopicSummary| is_transforms(&topic.kind);
    let (transforms, direct): (Vec<_>, Vec<_>) = topics.into_iter().partition(is_tf);
    let (stays, moves): (Vec<_>, Vec<_>) =
        transforms.into_iter().partition(|topic| topic.name.ends_with(STATIC_SUFFIX));
    let (([topic], _) | ([], [topic])) = (direct.as_slice(), moves.as_slice()) else {
        return (None, None);
    };
    if Layout::of_kind(&topic.kind) == Some(Layout::Fix) {
        return (None, None);
    }
    let ends = match topic.frames.as_slice() {
        [pair] => Some(pair.clone()),
        _ if direct.is_empty() => {
            let mut frames = Frames::default();
            for (parent, child) in stays.iter().chain(&moves).flat_map(|topic| &topic.frames) {
                frames.note(parent, child);
            }
            let body = frames.body();
            body.map(|body| (frames.root_of(body).to_owned(), body.to_owned()))
        }
        _ => None,
    };
    (Some(topic.name.clone()), ends)
}

/// Whether track speeds can be made of the speeds of the body in it.
fn has_twist(topic: &TopicSummary) -> bool {
    twist::is_offered(&topic.name, &topic.kind)
}

/// Types of one number, which may be the speed of a side.
const NUMBERS: [&str; 2] = ["std_msgs/Float32", "std_msgs/Float64"];

/// What names a side in a topic of its own, left and right.
const SIDES: [[&str; 2]; 4] = [["left", "right"], ["Left", "Right"], ["l", "r"], ["L", "R"]];

/// The number in a message that is nothing else.
fn signal_of(topic: &TopicSummary) -> String {
    format!("{}:data", topic.name)
}

/// The only two topics of a number each whose names differ in their side, and that are no commands.
fn numbers_of_sides(topics: &[TopicSummary]) -> Option<PerSide<String>> {
    let is_number = |topic: &&TopicSummary| {
        topic.messages > 0
            && NUMBERS.contains(&bare(&topic.kind).as_str())
            && !twist::is_command(&topic.name)
    };
    let numbers: Vec<&TopicSummary> = topics.iter().filter(is_number).collect();
    let of_right = |left: &TopicSummary| {
        let named = SIDES.iter().flat_map(|[of_left, of_right]| {
            let places = left.name.match_indices(of_left);
            places.map(|(at, _)| {
                let mut name = left.name.clone();
                name.replace_range(at..at + of_left.len(), of_right);
                name
            })
        });
        let named: Vec<String> = named.collect();
        numbers.iter().find(|right| right.kind == left.kind && named.contains(&right.name)).copied()
    };
    let mut pairs = numbers.iter().filter_map(|left| Some([*left, of_right(left)?]));
    match (pairs.next(), pairs.next()) {
        (Some([left, right]), None) => Some(PerSide::new(signal_of(left), signal_of(right))),
        _ => None,
    }
}

/// Names what the bag has one of; among several poses, an Odometry or stamped pose before tf.
fn suggest(topics: &[TopicSummary], given: &RosbagOptions) -> RosbagOptions {
    let of = |role| topics.iter().filter(move |t| t.role == Some(role) && t.messages > 0);
    let only = |candidates: Vec<&TopicSummary>| match candidates.as_slice() {
        [topic] => Some(topic.name.clone()),
        _ => None,
    };
    let tracks = only(first_choice(of(Role::Tracks).collect()));
    let side = |side: Side| {
        let named = topics.iter().find(|topic| Some(&topic.name) == tracks.as_ref());
        named.map(|topic| joints::of_side(&topic.joints, side)).unwrap_or_default()
    };
    // Where there are no joints: the only speeds of the body that are no commands.
    let mut twists = topics.iter().filter(|topic| topic.messages > 0 && has_twist(topic));
    let twist = match (tracks.is_none(), twists.next(), twists.next()) {
        (true, Some(topic), None) => Some(topic.name.clone()),
        _ => None,
    };
    let numbers = numbers_of_sides(topics).filter(|_| tracks.is_none() && twist.is_none());
    let numbers: Option<PerSide<Vec<String>>> = numbers.map(|of| of.map(|signal| vec![signal]));
    let numbers = numbers.unwrap_or_default();
    let imu = only(of(Role::Imu).collect());
    let is_of_signals = |topic: &&TopicSummary| given.takes_speeds_of(&topic.name);
    let of_twist = given.twist_topic.as_ref().or(twist.as_ref());
    // Poses beside a twist come from the tracks themselves.
    let poses = of(Role::Poses).filter(|topic| Some(&topic.name) != of_twist);
    let (of_signals, others): (Vec<_>, Vec<_>) = poses.partition(is_of_signals);
    let poses = if others.is_empty() { of_signals } else { others };
    let (pose, frames) = if poses.is_empty() && of_twist.is_some() {
        (imu.clone(), None)
    } else {
        suggest_poses(poses)
    };
    RosbagOptions {
        left_joints: side(Side::Left),
        right_joints: side(Side::Right),
        left_signals: numbers.left,
        right_signals: numbers.right,
        tracks_topic: tracks,
        twist_topic: twist,
        parent_frame: frames.as_ref().map(|(parent, _)| parent.clone()),
        child_frame: frames.map(|(_, child)| child).filter(|child| !child.is_empty()),
        pose_topic: pose,
        imu_topic: imu,
        ..RosbagOptions::default()
    }
}

//! Messages of a drive as robots send them, with what is wrong with some of them.

use crate::damage::Patch;
use crate::encoder::{Encoder, Ros};
use arbitrary::Arbitrary;

/// Unix time of the beginning, ns.
const EPOCH: u64 = 1_700_000_000_000_000_000;
/// Time of a step, ns.
const STEP: u64 = 100_000_000;
/// Half the distance of the tracks, m, and the radius of their wheels, m.
const HALF_GAUGE: f64 = 0.4;
/// Belt speed per joint speed, m.
pub const RADIUS: f64 = 0.1;

/// A drive.
#[derive(Arbitrary, Clone, Debug)]
pub struct Drive {
    /// How long it lasts.
    steps: u8,
    /// Topics beside those of joints and poses; the first three count.
    further: Vec<Kind>,
    /// The kinds of joints and of poses.
    joints: Joints,
    poses: Kind,
    /// What is wrong; the first 32 count.
    changes: Vec<Change>,
    /// The definition of `own/msg/Speeds`.
    definition: Option<String>,
}

/// How joints are sent.
#[derive(Arbitrary, Clone, Copy, Debug)]
enum Joints {
    Velocities,
    Positions,
    Dynamic,
    Signals,
    None,
}

/// What a topic holds.
#[derive(Arbitrary, Clone, Copy, Debug)]
enum Kind {
    Pose,
    PoseWithCovariance,
    Odometry,
    Transform,
    Transforms,
    StaticTransforms,
    Path,
    PoseArray,
    BarePose,
    Fix,
    Imu,
    Twist,
    TwistStamped,
}

/// What is wrong with a message.
#[derive(Arbitrary, Clone, Copy, Debug)]
struct Change {
    topic: u8,
    step: u8,
    what: What,
}

#[derive(Arbitrary, Clone, Copy, Debug)]
enum What {
    Missing,
    Twice,
    Empty,
    CutBy(u16),
    LoggedAt(u64),
    Later(i32),
    Patched(Patch),
}

/// A topic of a bag.
pub struct Topic {
    /// Its name.
    pub name: String,
    /// Its type without `msg`.
    pub kind: [&'static str; 2],
    /// The definition of its type.
    pub definition: String,
}

/// A message of a bag.
pub struct Sent {
    /// Which topic.
    pub topic: usize,
    /// When it was logged, ns.
    pub log: u64,
    /// Its bytes.
    pub payload: Vec<u8>,
}

impl Drive {
    /// Its topics and messages.
    pub fn messages(&self, ros: Ros) -> (Vec<Topic>, Vec<Sent>) {
        let kinds: Vec<Kind> =
            [self.poses].iter().chain(self.further.iter().take(3)).copied().collect();
        let mut topics = vec![self.topic_of_joints()];
        topics.extend(kinds.iter().enumerate().map(|(place, kind)| kind.topic(place)));
        let mut sent = Vec::new();
        let mut state = State::default();
        for step in 0..self.steps % 100 {
            state.advance(u64::from(step));
            for topic in 0..topics.len() {
                let payload = match topic.checked_sub(1) {
                    None => self.joints.message(ros, &state),
                    Some(kind) => kinds[kind].message(ros, &state),
                };
                sent.extend(self.changed([topic, usize::from(step)], state.ns, payload));
            }
        }
        (topics, sent)
    }

    fn topic_of_joints(&self) -> Topic {
        let kind = match self.joints {
            Joints::Velocities | Joints::Positions | Joints::None => ["sensor_msgs", "JointState"],
            Joints::Dynamic => ["control_msgs", "DynamicJointState"],
            Joints::Signals => ["own", "Speeds"],
        };
        let stated = "std_msgs/Header header\nfloat64 left\nfloat64 right\n".to_owned();
        let definition = self.definition.clone().unwrap_or(stated);
        Topic { name: "/joints".to_owned(), kind, definition }
    }

    /// A message with what is wrong with it.
    fn changed(&self, [topic, step]: [usize; 2], ns: u64, payload: Vec<u8>) -> Vec<Sent> {
        let mut sent = vec![Sent { topic, log: ns, payload }];
        let is_meant = |change: &&Change| {
            usize::from(change.topic) == topic && usize::from(change.step) == step
        };
        for change in self.changes.iter().take(32).filter(is_meant) {
            let Some(last) = sent.last_mut() else { break };
            match change.what {
                What::Missing => sent.clear(),
                What::Twice => {
                    let payload = last.payload.clone();
                    let log = last.log;
                    sent.push(Sent { topic, log, payload });
                }
                What::Empty => last.payload.clear(),
                What::CutBy(count) => {
                    let left = last.payload.len().saturating_sub(usize::from(count));
                    last.payload.truncate(left);
                }
                What::LoggedAt(ns) => last.log = ns,
                What::Later(ns) => last.log = last.log.wrapping_add_signed(i64::from(ns)),
                What::Patched(patch) => patch.apply(&mut last.payload),
            }
        }
        sent
    }
}

/// Where the robot is.
#[derive(Default)]
struct State {
    ns: u64,
    pose: [f64; 3],
    speeds: [f64; 2],
    angles: [f64; 2],
}

impl State {
    fn advance(&mut self, step: u64) {
        self.ns = EPOCH + step * STEP;
        let dt = 0.1;
        let [x, y, yaw] = self.pose;
        let [v, w] = self.speeds;
        self.pose = [x + dt * v * yaw.cos(), y + dt * v * yaw.sin(), yaw + dt * w];
        let wheels = self.wheels();
        for (angle, speed) in self.angles.iter_mut().zip(wheels) {
            *angle += dt * speed;
        }
        let phase = f64::from(u32::try_from(step).unwrap_or(0)) * 0.2;
        self.speeds = [0.6 + 0.3 * phase.cos(), 0.5 * phase.sin()];
    }

    /// Speeds of the wheels, rad/s.
    fn wheels(&self) -> [f64; 2] {
        let [v, w] = self.speeds;
        [(v - HALF_GAUGE * w) / RADIUS, (v + HALF_GAUGE * w) / RADIUS]
    }
}

impl Joints {
    fn message(self, ros: Ros, state: &State) -> Vec<u8> {
        let stamped = Encoder::stamped(ros, state.ns, "");
        let named = |encoder: Encoder| encoder.count(2).text("left").text("right");
        let message = match self {
            Self::Velocities => named(stamped).list(&[]).list(&state.wheels()).list(&[]),
            Self::Positions => named(stamped).list(&state.angles).list(&[]).list(&[]),
            Self::Dynamic => state.wheels().iter().fold(named(stamped).count(2), |all, speed| {
                all.count(1).text("velocity").list(&[*speed])
            }),
            Self::Signals => stamped.numbers(&state.wheels()),
            Self::None => stamped.count(0).list(&[]).list(&[]).list(&[]),
        };
        message.bytes()
    }
}

impl Kind {
    fn topic(self, place: usize) -> Topic {
        let kind = match self {
            Self::Pose => ["geometry_msgs", "PoseStamped"],
            Self::PoseWithCovariance => ["geometry_msgs", "PoseWithCovarianceStamped"],
            Self::Odometry => ["nav_msgs", "Odometry"],
            Self::Transform => ["geometry_msgs", "TransformStamped"],
            Self::Transforms | Self::StaticTransforms => ["tf2_msgs", "TFMessage"],
            Self::Path => ["nav_msgs", "Path"],
            Self::PoseArray => ["geometry_msgs", "PoseArray"],
            Self::BarePose => ["geometry_msgs", "Pose"],
            Self::Fix => ["sensor_msgs", "NavSatFix"],
            Self::Imu => ["sensor_msgs", "Imu"],
            Self::Twist => ["geometry_msgs", "Twist"],
            Self::TwistStamped => ["geometry_msgs", "TwistStamped"],
        };
        let ending = if matches!(self, Self::StaticTransforms) { "_static" } else { "" };
        Topic { name: format!("/topic{place}{ending}"), kind, definition: String::new() }
    }

    fn message(self, ros: Ros, state: &State) -> Vec<u8> {
        let (ns, pose, [v, w]) = (state.ns, state.pose, state.speeds);
        let [x, y, yaw] = pose;
        let twist = [v, 0.0, 0.0, 0.0, 0.0, w];
        let stamped = Encoder::stamped(ros, ns, "map");
        let message = match self {
            Self::Pose => stamped.pose(pose),
            Self::PoseWithCovariance => stamped.pose(pose).numbers(&[0.0; 36]),
            Self::Odometry => {
                let posed = stamped.text("base").pose(pose).numbers(&[0.0; 36]);
                posed.numbers(&twist).numbers(&[0.0; 36])
            }
            Self::Transform => stamped.text("base").pose(pose),
            Self::Transforms => {
                let first = Encoder::new(ros).count(2).header(ns, "map").text("odom");
                let second = first.pose([0.1, 0.2, 0.3]).header(ns, "odom");
                second.text("base").pose(pose)
            }
            Self::StaticTransforms => {
                let first = Encoder::new(ros).count(1).header(ns, "base");
                first.text("laser").pose([0.1, 0.0, 0.0])
            }
            Self::Path => {
                stamped.count(2).header(ns, "map").pose(pose).header(ns, "map").pose(pose)
            }
            Self::PoseArray => stamped.count(1).pose(pose),
            Self::BarePose => Encoder::new(ros).pose(pose),
            Self::Fix => {
                let fix = stamped.raw(&[0]).raw(if ros == Ros::Two { &[0] } else { &[] });
                let place = [45.0 + y / 111_131.75, 8.0 + x / 78_846.81, 200.0];
                fix.raw(&[1, 0]).numbers(&place).numbers(&[0.0; 9]).raw(&[0])
            }
            Self::Imu => {
                let (sin, cos) = (0.5 * yaw).sin_cos();
                let turned = stamped.numbers(&[0.0, 0.0, sin, cos]).numbers(&[0.01; 9]);
                let turning = turned.numbers(&[0.0, 0.0, w]).numbers(&[0.0; 9]);
                turning.numbers(&[0.1, v * w, 9.81]).numbers(&[0.0; 9])
            }
            Self::Twist => Encoder::new(ros).numbers(&twist),
            Self::TwistStamped => stamped.numbers(&twist),
        };
        message.bytes()
    }
}

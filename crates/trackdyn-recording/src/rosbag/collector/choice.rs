//! Which of several sources to use.

use super::tracks::{self, Chosen};
use super::upright::Inertial;
use super::{PoseKey, RosbagOptions, Rows};
use crate::Error;
use crate::recording::Warning;
use crate::rosbag::date::Received;
use crate::rosbag::frames::may_be_odometry;
use crate::rosbag::joints::Source;
use crate::rosbag::signals::Signals;
use crate::rosbag::topic::{Layout, Role, Topic, list};
use crate::rosbag::twist;
use std::collections::BTreeMap;
use std::path::Path;

/// What the choice is made by, and what its errors mention.
pub(super) struct Sources<'a> {
    pub(super) path: &'a Path,
    pub(super) options: &'a RosbagOptions,
    pub(super) seen: &'a [Topic],
    pub(super) signals: &'a Signals,
}

/// What is looked for.
struct Wanted<'a> {
    what: &'static str,
    /// What it would have to be.
    kind: &'a str,
    /// The topic that it has to be of.
    named: Option<&'a str>,
    /// By which options a user chooses.
    options: &'static str,
}

/// Whether messages of a type are positions without an orientation.
fn is_of_points(kind: &str) -> bool {
    matches!(kind.rsplit('/').next(), Some("PointStamped" | "Point" | "Point32"))
}

/// What is said of messages of joints that have no names, and the options that read them.
fn nameless(source: &Source) -> String {
    let topic = &source.topic;
    format!(
        "the joints of {topic} have no names: its numbers are read, where the first is that of the \
         left side, by --left-signal {topic}:velocity[0] --right-signal {topic}:velocity[1]"
    )
}

impl Sources<'_> {
    pub(super) fn tracks(
        &self,
        joints: Vec<Source>,
        skipped: &BTreeMap<String, (u64, String)>,
        warnings: &mut Vec<Warning>,
    ) -> Result<Chosen, Error> {
        let what = "track speeds";
        if joints.iter().all(|source| source.names.is_empty()) {
            let none = "no sensor_msgs/JointState or DynamicJointState with both sides";
            let mut kinds = vec![none.to_owned()];
            kinds.extend(skipped.iter().map(|(topic, (count, reason))| {
                format!("{topic}: {count} messages skipped, because {reason}")
            }));
            kinds.extend(joints.iter().find(|source| source.messages > 0).map(nameless));
            kinds.extend(twist::offer(self.seen));
            kinds.extend(self.signals.offer(self.seen));
            let named = self.options.tracks_topic.as_deref();
            let option = match self.options.twist_topic {
                Some(_) => "--twist-topic",
                None => "--tracks-topic",
            };
            return Err(self.none(what, &kinds.join("; "), named, option));
        }
        tracks::choose(joints, self.options, warnings).map_err(|problem| self.refuse(what, problem))
    }

    pub(super) fn poses(
        &self,
        poses: BTreeMap<PoseKey, Rows>,
        gyroscopes: &[String],
        skipped: &BTreeMap<String, (u64, String)>,
        warnings: &mut Vec<Warning>,
    ) -> Result<(PoseKey, Rows), Error> {
        let mut kinds = vec![
            "no Odometry, PoseStamped, PoseWithCovarianceStamped, TransformStamped or TFMessage of \
             these frames, and no Path, PoseArray, Pose or NavSatFix instead"
                .to_owned(),
        ];
        let of_poses = skipped.iter().filter(|(name, _)| {
            let mut topics = self.seen.iter().filter(|topic| topic.name == **name);
            topics.any(|topic| topic.layout().is_some_and(|of| of.role() == Role::Poses))
        });
        kinds.extend(of_poses.map(|(topic, (count, reason))| {
            format!("{topic}: {count} messages skipped, because {reason}")
        }));
        let points = self.seen.iter().filter(|topic| is_of_points(&topic.kind));
        kinds.extend(points.map(|topic| {
            format!(
                "{} has positions without a heading, which a robot turns about unseen: expected \
                 poses with a yaw, or the yaw of an IMU alone (--pose-topic of its topic), which \
                 tells x_r - x_l",
                topic.name
            )
        }));
        if gyroscopes.len() > 1 {
            kinds.push(format!(
                "the yaw of a gyroscope would do, but several could be it: {}; choose by \
                 --imu-topic",
                gyroscopes.join(", ")
            ));
        }
        let kind = kinds.join("; ");
        let wanted = Wanted {
            what: "poses",
            kind: &kind,
            named: self.options.pose_topic.as_deref(),
            options: "--pose-topic, --parent-frame or --child-frame",
        };
        let name = |key: &PoseKey| match key.child.as_str() {
            "" => format!("{} in {:?}", key.topic, key.parent),
            child => format!("{} of {child:?} in {:?}", key.topic, key.parent),
        };
        let odometry = poses.keys().find(|key| self.may_be_odometry(key)).map(name);
        let mut chosen = self.only(&wanted, poses, warnings, name)?;
        self.check_index(&chosen.0.topic)?;
        self.in_metres(&chosen.0.topic, &mut chosen.1);
        if let Some(poses) = odometry {
            warnings.extend(gyroscopes.first().map(|imu| Warning::Chosen {
                what: "poses",
                taken: format!("{poses}; --pose-topic {imu} takes the yaw of its gyroscope alone"),
            }));
            warnings.push(Warning::OwnOdometry { poses });
        }
        Ok(chosen)
    }

    /// Takes positions from the unit of the user; those of fixes are made in metres.
    fn in_metres(&self, topic: &str, poses: &mut Rows) {
        let is_fix = |of: &Topic| of.name == topic && of.layout() == Some(Layout::Fix);
        if self.seen.iter().any(is_fix) {
            return;
        }
        for pose in poses {
            let [x, y, _] = &mut pose.value;
            *x *= self.options.pose_unit.factor();
            *y *= self.options.pose_unit.factor();
        }
    }

    /// Refuses a number of a pose for messages that have one pose each.
    fn check_index(&self, topic: &str) -> Result<(), Error> {
        let is_array = |of: &&Topic| of.name == topic && of.layout() == Some(Layout::PoseArray);
        if self.options.pose_index.is_none() || self.seen.iter().any(|of| is_array(&of)) {
            return Ok(());
        }
        let problem = format!("--pose-index: {topic} is no PoseArray: expected without");
        Err(Error::Options { path: self.path.to_owned(), problem })
    }

    /// Whether poses may come from the tracks themselves.
    fn may_be_odometry(&self, key: &PoseKey) -> bool {
        let mut topics = self.seen.iter().filter(|topic| topic.name == key.topic);
        topics.any(|topic| may_be_odometry(&topic.kind, std::iter::once(&*key.parent)))
    }

    /// The IMU, which is optional. One that stands for the poses is taken. Otherwise none is taken
    /// where several could be the IMU of the robot.
    pub(super) fn imu(
        &self,
        mut imu: BTreeMap<String, Vec<Received<Inertial>>>,
        warnings: &mut Vec<Warning>,
    ) -> Result<(String, Vec<Received<Inertial>>), Error> {
        let of_poses = self.options.pose_topic.as_ref();
        if let Some(found) = of_poses.and_then(|topic| imu.remove_entry(topic)) {
            return Ok(found);
        }
        // A receiver with two antennas reports its heading as an Imu that never turns.
        let turns = |readings: &[Received<Inertial>]| {
            readings.iter().any(|reading| reading.value.rate != [0.0; 3])
        };
        if self.options.imu_topic.is_none() && imu.values().any(|readings| turns(readings)) {
            imu.retain(|_, readings| turns(readings));
        }
        match (&self.options.imu_topic, imu.len()) {
            (None, 0) => Ok((String::new(), Vec::new())),
            (None, 2..) => {
                let names: Vec<&str> = imu.keys().map(String::as_str).collect();
                let taken = format!(
                    "none of {}, each of which could be it; choose by --imu-topic",
                    names.join(", ")
                );
                warnings.push(Warning::Chosen { what: "imu", taken });
                Ok((String::new(), Vec::new()))
            }
            (named, _) => {
                let (kind, named) = ("no sensor_msgs/Imu", named.as_deref());
                let wanted = Wanted { what: "imu", kind, named, options: "--imu-topic" };
                self.only(&wanted, imu, warnings, Clone::clone)
            }
        }
    }

    /// The only source there is.
    fn only<K, V>(
        &self,
        wanted: &Wanted,
        sources: BTreeMap<K, V>,
        warnings: &mut Vec<Warning>,
        name: impl Fn(&K) -> String,
    ) -> Result<(K, V), Error> {
        let Wanted { what, kind, named, options } = *wanted;
        let names: Vec<String> = sources.keys().map(&name).collect();
        if names.len() > 1 {
            return Err(self
                .refuse(what, format!("several fit: {}; choose by {options}", names.join(", "))));
        }
        let Some((key, values)) = sources.into_iter().next() else {
            return Err(self.none(what, kind, named, options));
        };
        if named.is_none() {
            warnings.push(Warning::Chosen { what, taken: name(&key) });
        }
        Ok((key, values))
    }

    /// Why there is nothing: the topic that is named is not there, or has nothing of its kind.
    fn none(&self, what: &'static str, kind: &str, named: Option<&str>, options: &str) -> Error {
        let absent = named.filter(|name| !self.seen.iter().any(|topic| topic.name == **name));
        let absent = absent.map(|name| format!("{name} is not there; choose by {options}"));
        self.refuse(what, absent.unwrap_or_else(|| kind.to_owned()))
    }

    fn refuse(&self, what: &'static str, problem: String) -> Error {
        let available = list(self.seen.iter());
        Error::Topic { path: self.path.to_owned(), what, problem, available }
    }
}

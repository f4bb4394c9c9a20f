//! Which of several sources to use.

use super::{PoseKey, Reading, RosbagOptions, Stamped};
use crate::Error;
use crate::recording::Warning;
use crate::rosbag::frames::may_be_odometry;
use crate::rosbag::topic::{Topic, list};
use std::collections::BTreeMap;
use std::path::Path;

/// What the choice is made by, and what its errors mention.
pub(super) struct Sources<'a> {
    pub(super) path: &'a Path,
    pub(super) options: &'a RosbagOptions,
    pub(super) seen: &'a [Topic],
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

impl Sources<'_> {
    pub(super) fn tracks(
        &self,
        readings: BTreeMap<String, Vec<Stamped<Reading>>>,
        skipped: &BTreeMap<String, (u64, String)>,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<Stamped<Reading>>, Error> {
        let mut kinds = vec!["no sensor_msgs/JointState with both sides".to_owned()];
        kinds.extend(skipped.iter().map(|(topic, (count, reason))| {
            format!("{topic}: {count} messages skipped, because {reason}")
        }));
        let wanted = Wanted {
            what: "track speeds",
            kind: &kinds.join("; "),
            named: self.options.tracks_topic.as_deref(),
            options: "--tracks-topic",
        };
        self.only(&wanted, readings, warnings, Clone::clone)
    }

    pub(super) fn poses(
        &self,
        poses: BTreeMap<PoseKey, Vec<Stamped<[f64; 3]>>>,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<Stamped<[f64; 3]>>, Error> {
        let wanted = Wanted {
            what: "poses",
            kind: "no Odometry, PoseStamped, PoseWithCovarianceStamped, TransformStamped or \
                   TFMessage of these frames",
            named: self.options.pose_topic.as_deref(),
            options: "--pose-topic, --parent-frame or --child-frame",
        };
        let name = |key: &PoseKey| match key.child.as_str() {
            "" => format!("{} in {:?}", key.topic, key.parent),
            child => format!("{} of {child:?} in {:?}", key.topic, key.parent),
        };
        let odometry = poses.keys().find(|key| self.may_be_odometry(key)).map(name);
        let chosen = self.only(&wanted, poses, warnings, name)?;
        warnings.extend(odometry.map(|poses| Warning::OwnOdometry { poses }));
        Ok(chosen)
    }

    /// Whether poses may come from the tracks themselves.
    fn may_be_odometry(&self, key: &PoseKey) -> bool {
        let mut topics = self.seen.iter().filter(|topic| topic.name == key.topic);
        topics.any(|topic| may_be_odometry(&topic.kind, std::iter::once(&*key.parent)))
    }

    /// An IMU is welcome and not needed: where several could be it, none is taken.
    pub(super) fn imu(
        &self,
        imu: BTreeMap<String, Vec<Stamped<[f64; 3]>>>,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<Stamped<[f64; 3]>>, Error> {
        match (&self.options.imu_topic, imu.len()) {
            (None, 0) => Ok(Vec::new()),
            (None, 2..) => {
                let names: Vec<&str> = imu.keys().map(String::as_str).collect();
                let taken = format!("none of {}, each of which could be it", names.join(", "));
                warnings.push(Warning::Chosen { what: "imu", taken });
                Ok(Vec::new())
            }
            (named, _) => {
                let (kind, named) = ("no sensor_msgs/Imu", named.as_deref());
                let wanted = Wanted { what: "imu", kind, named, options: "imu_topic" };
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
    ) -> Result<V, Error> {
        let Wanted { what, kind, named, options } = *wanted;
        let refuse = |problem: String| Error::Topic {
            path: self.path.to_owned(),
            what,
            problem,
            available: list(self.seen.iter()),
        };
        let names: Vec<String> = sources.keys().map(&name).collect();
        if names.len() > 1 {
            return Err(refuse(format!("several fit: {}; choose by {options}", names.join(", "))));
        }
        let Some((key, values)) = sources.into_iter().next() else {
            let absent = named.filter(|name| !self.seen.iter().any(|topic| topic.name == **name));
            let absent = absent.map(|name| format!("{name} is not there; choose by {options}"));
            return Err(refuse(absent.unwrap_or_else(|| kind.to_owned())));
        };
        if named.is_none() {
            warnings.push(Warning::Chosen { what, taken: name(&key) });
        }
        Ok(values)
    }
}

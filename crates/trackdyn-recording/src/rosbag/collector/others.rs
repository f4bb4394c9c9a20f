//! Poses of second choice, and track speeds from those of the body.

use super::upright::{Inertial, upright};
use super::{Collector, PoseKey, gyro, push};
use crate::Error;
use crate::attitude::Attitude;
use crate::recording::{PoseAxes, Warning};
use crate::rosbag::clock::{By, Clock, decide};
use crate::rosbag::date::Received;
use crate::rosbag::fixes::{self, Fix, Yaw};
use crate::rosbag::message::{fix, header, oriented_pose};
use crate::rosbag::options::RosbagOptions;
use crate::rosbag::payload::{Payload, PayloadError};
use crate::rosbag::topic::{Layout, Topic, list};
use crate::rosbag::{path, twist};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

/// Fewest changes of a pose of second choice that is no goal: fewer make no recording.
const MIN_CHANGES: usize = 10;

/// The frame of positions from fixes.
const TANGENT_PLANE: &str = "east and north of the first fix";

impl Collector<'_> {
    /// Takes a pose of second choice.
    pub(super) fn take_other_pose(
        &mut self,
        topic: &Topic,
        layout: Layout,
        log_ns: i64,
        payload: &mut Payload,
    ) -> Result<(), String> {
        let decode = |error: PayloadError| error.to_string();
        if layout == Layout::Path {
            let mut attitude = Attitude::default();
            let (frame, poses) = path::read(payload, &mut attitude)?;
            if self.fits([frame, ""]) {
                let key = PoseKey::new(topic, [frame, ""]);
                // The last message tells all of a path that grows.
                self.attitudes.insert(key.clone(), attitude);
                self.paths.entry(key).or_default().add(poses, log_ns);
            }
            return Ok(());
        }
        if layout == Layout::BarePose {
            let (value, quaternion) = oriented_pose(payload).map_err(decode)?;
            let received = Received { stamp_ns: None, log_ns, value };
            self.keep_pose(topic, ["", ""], received, quaternion);
            return Ok(());
        }
        let header = header(payload).map_err(decode)?;
        let stamp_ns = header.stamp_ns;
        if layout == Layout::PoseArray {
            let count = payload.length().map_err(decode)?;
            let index = self.index_of(count)?;
            for _ in 0..index {
                oriented_pose(payload).map_err(decode)?;
            }
            let (value, quaternion) = oriented_pose(payload).map_err(decode)?;
            let received = Received { stamp_ns, log_ns, value };
            self.keep_pose(topic, [header.frame, ""], received, quaternion);
            return Ok(());
        }
        let value = fix(payload).map_err(decode)?;
        let value = value.ok_or("the receiver has no fix in it (its status is below zero)")?;
        push(&mut self.fixes, &topic.name, Received { stamp_ns, log_ns, value });
        Ok(())
    }

    /// Which of the poses of an array is that of the robot.
    fn index_of(&self, count: usize) -> Result<usize, String> {
        match (self.options.pose_index, count) {
            (_, 0) => Err("it has no poses".to_owned()),
            (None, 1) => Ok(0),
            (None, count) => Err(format!(
                "it has {count} poses: say which is that of the robot by --pose-index 0 to {}",
                count - 1
            )),
            (Some(index), count) if index < count => Ok(index),
            (Some(index), count) => Err(format!(
                "it has {count} poses, and none of --pose-index {index}: expected 0 to {}",
                count - 1
            )),
        }
    }

    /// Takes the speeds of the body as those of two joints.
    pub(super) fn take_twist(
        &mut self,
        topic: &Topic,
        layout: Layout,
        log_ns: i64,
        mut payload: Payload,
    ) -> Result<(), String> {
        let decode = |error: PayloadError| error.to_string();
        let stamp_ns = match layout {
            Layout::Twist => None,
            Layout::TwistStamped | Layout::PoseOfChild => {
                header(&mut payload).map_err(decode)?.stamp_ns
            }
            _ => return Err("its type has no speeds of the body".to_owned()),
        };
        let body = twist::body_speeds(layout, &mut payload).map_err(decode)?;
        let tracks = twist::track_speeds(body, self.options.separation.unwrap_or(f64::NAN));
        let received = Received { stamp_ns, log_ns, value: () };
        self.joints.take_signals(&topic.name, received, &twist::JOINTS, [&[], &tracks]);
        Ok(())
    }

    /// Adds poses that messages do not hold as they are; poses of second choice stay only where
    /// there are no others, or where their topic is named.
    ///
    /// # Errors
    /// Fixes without a yaw, where nothing else has poses.
    pub(super) fn add_other_poses(
        &mut self,
        path: &Path,
        warnings: &mut Vec<Warning>,
    ) -> Result<(), Error> {
        for (key, trajectory) in std::mem::take(&mut self.paths) {
            let poses = trajectory.into_poses();
            if !poses.is_empty() {
                self.poses.insert(key, poses);
            }
        }
        if self.options.pose_topic.is_none() {
            self.drop_goals(warnings);
            let seen = &self.seen;
            let is_second = |key: &PoseKey| {
                let mut kinds = seen.iter().filter(|topic| topic.name == key.topic);
                kinds.any(|topic| topic.layout().is_some_and(Layout::is_second_choice))
            };
            if self.poses.keys().any(|key| !is_second(key)) {
                self.poses.retain(|key, _| !is_second(key));
            }
            let options = self.options;
            if self.poses.keys().any(|key| !options.takes_speeds_of(&key.topic)) {
                self.poses.retain(|key, _| !options.takes_speeds_of(&key.topic));
            }
        }
        let is_named = |name: &str| self.options.pose_topic.as_deref() == Some(name);
        let frames_are_named =
            self.options.parent_frame.is_some() || self.options.child_frame.is_some();
        let receivers: Vec<String> = self.fixes.keys().cloned().collect();
        let gyroscopes: Vec<String> = self.imu.keys().cloned().collect();
        for (name, fixes) in std::mem::take(&mut self.fixes) {
            if !is_named(&name) && (!self.poses.is_empty() || frames_are_named) {
                continue;
            }
            let beside = Beside { receivers: &receivers, gyroscopes: &gyroscopes };
            let changes = self.yaws.values().any(|yaws| fixes::changes(yaws));
            let located = match self.gyroscope().filter(|_| !changes) {
                Some(gyroscope) => by_gyroscope(&name, &fixes, gyroscope, self.options, warnings),
                None => located(&name, &fixes, &self.yaws, &beside, self.options, warnings),
            };
            match located {
                Ok(poses) => {
                    let (parent, child) = (TANGENT_PLANE.to_owned(), String::new());
                    self.poses.insert(PoseKey { topic: name, parent, child }, poses);
                }
                Err(problem) if self.imu.is_empty() || is_named(&name) => {
                    return Err(Error::Topic {
                        path: path.to_owned(),
                        what: "poses",
                        problem,
                        available: list(self.seen.iter()),
                    });
                }
                Err(reason) => {
                    let count = fixes.len() as u64;
                    warnings.push(Warning::MessagesSkipped { topic: name, count, reason });
                }
            }
        }
        Ok(())
    }

    /// The IMU that is named, or the only one there is, with its readings.
    fn gyroscope(&self) -> Option<(&str, &[Received<Inertial>])> {
        let mut all = self.imu.iter();
        let (topic, readings) = match (&self.options.imu_topic, all.len()) {
            (Some(named), _) => all.find(|(topic, _)| *topic == named)?,
            (None, 1) => all.next()?,
            (None, _) => return None,
        };
        Some((topic, readings))
    }

    /// Leaves out poses of second choice that hardly ever change.
    fn drop_goals(&mut self, warnings: &mut Vec<Warning>) {
        let seen = &self.seen;
        self.poses.retain(|key, poses| {
            let mut kinds = seen.iter().filter(|topic| topic.name == key.topic);
            let is_second = kinds.any(|topic| topic.layout().is_some_and(Layout::is_second_choice));
            let changes = poses.windows(2).filter(|pair| pair[0].value != pair[1].value).count();
            let stays = !is_second || changes >= MIN_CHANGES;
            if !stays {
                let (topic, count) = (key.topic.clone(), poses.len() as u64);
                let reason = format!("its pose changes {changes} times in all, as that of a goal");
                warnings.push(Warning::MessagesSkipped { topic, count, reason });
            }
            stays
        });
    }
}

/// What a bag has beside the fixes of a topic.
struct Beside<'a> {
    /// Topics of fixes, this one among them.
    receivers: &'a [String],
    /// Topics of IMUs with yaw rates.
    gyroscopes: &'a [String],
}

impl Beside<'_> {
    /// What there is in place of a yaw, and what would do.
    fn instead(&self) -> String {
        let found = match (self.gyroscopes, self.receivers) {
            ([], [_, _, ..]) => format!(
                "there are several receivers, {}, whose direction from one to the other is not \
                 taken for a yaw",
                self.receivers.join(", ")
            ),
            ([], _) => "there is no sensor_msgs/Imu whose orientation changes".to_owned(),
            (gyroscopes, _) => {
                format!("{} has a yaw rate and no orientation that changes", gyroscopes.join(", "))
            }
        };
        let gyroscope = match self.gyroscopes {
            [] => String::new(),
            [first, ..] => format!("; --pose-topic {first} takes its yaw alone, for x_r - x_l"),
        };
        format!(
            "{found}: expected an orientation counted from east (REP-103), other poses \
             (--pose-topic), or a table of x, y and yaw beside the track speeds \
             (--columns){gyroscope}"
        )
    }
}

/// Poses at the fixes of a topic, with the yaw of the only IMU whose orientation changes.
fn located(
    topic: &str,
    fixes: &[Fix],
    yaws: &BTreeMap<String, Vec<Yaw>>,
    beside: &Beside,
    options: &RosbagOptions,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Received<[f64; 3]>>, String> {
    let changing: Vec<(&String, &Vec<Yaw>)> =
        yaws.iter().filter(|(_, yaws)| fixes::changes(yaws)).collect();
    let positions = format!("{topic} (NavSatFix) has positions without yaw");
    let (imu, yaws) = match changing.as_slice() {
        [(imu, yaws)] => (*imu, *yaws),
        [] => {
            return Err(format!("{positions}, and {}", beside.instead()));
        }
        several => {
            let names: Vec<&str> = several.iter().map(|(name, _)| name.as_str()).collect();
            let names = names.join(", ");
            return Err(format!(
                "{positions}, and several IMUs have one: {names}: expected one of them in the bag, \
                 or other poses (--pose-topic)"
            ));
        }
    };
    let clocks = [Clock::of(topic, fixes), Clock::of(imu, yaws)];
    let (by, told) = decide(&clocks, options.dated_by);
    warnings.extend(told);
    // Positions stand in metres east and north. With axes north and east, yaw counts from north
    // towards east.
    let is_ned = options.pose_axes == PoseAxes::NorthEastDown;
    let from_east = |yaw: f64| if is_ned { FRAC_PI_2 - yaw } else { yaw };
    let known = dated(&clocks[1], by, yaws, |yaw| from_east(yaw.value));
    let fixes = dated(&clocks[0], by, fixes, |fix| *fix);
    let mount = options.mount_yaw.unwrap_or_default();
    let found = fixes::poses(&fixes, &known, mount)
        .map_err(|problem| format!("{positions}; {imu}: {problem}"))?;
    let poses = taken(topic, imu, found, is_ned, warnings)?;
    warnings.push(Warning::FromFixes { topic: topic.to_owned(), imu: imu.clone() });
    Ok(poses)
}

/// Difference from half a turn that is one, rad.
const MAX_HALF_TURN_ERROR: f64 = 0.01;

/// Poses at the fixes of a topic, with the yaw of a gyroscope that is turned to their course.
fn by_gyroscope(
    topic: &str,
    fixes: &[Fix],
    (imu, readings): (&str, &[Received<Inertial>]),
    options: &RosbagOptions,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Received<[f64; 3]>>, String> {
    let readings = upright(imu, readings.to_vec(), &mut Vec::new());
    let clocks = [Clock::of(topic, fixes), Clock::of(imu, &readings)];
    let (by, told) = decide(&clocks, options.dated_by);
    let is_ned = options.pose_axes == PoseAxes::NorthEastDown;
    let from_east = |yaw: f64| if is_ned { -yaw } else { yaw };
    let turned = gyro::headings(&readings);
    let known = dated(&clocks[1], by, &turned, |reading| from_east(reading.value[2]));
    let fixes = dated(&clocks[0], by, fixes, |fix| *fix);
    let (found, left_out, course) =
        fixes::poses_by_gyroscope(&fixes, &known).map_err(|problem| {
            format!(
                "{topic} (NavSatFix) has positions without yaw; {imu}: {problem}; --pose-topic \
                 {imu} takes its yaw alone, for x_r - x_l"
            )
        })?;
    warnings.extend(told);
    let mut poses = taken(topic, imu, (found, left_out), is_ned, warnings)?;
    // The course tells where the robot looks, whatever the mount of the gyroscope, which is taken
    // off every pose later. Half a turn says that the robot drove backwards.
    let mount = options.mount_yaw.filter(|mount| (mount.abs() - PI).abs() > MAX_HALF_TURN_ERROR);
    for pose in &mut poses {
        pose.value[2] += mount.unwrap_or_default();
    }
    let (topic, imu) = (topic.to_owned(), imu.to_owned());
    warnings.push(Warning::FromCourse { topic, imu, course });
    Ok(poses)
}

/// What messages of a topic say, with the times at which it was measured, ns, in their order.
fn dated<T, U>(
    clock: &Clock,
    by: By,
    received: &[Received<T>],
    value: impl Fn(&Received<T>) -> U,
) -> Vec<(i64, U)> {
    let mut dated: Vec<(i64, U)> =
        received.iter().filter_map(|one| Some((clock.date(by, one)?, value(one)))).collect();
    dated.sort_by_key(|(time, _)| *time);
    dated
}

/// The poses at fixes, along the axes that are wanted; fixes without a yaw of the IMU, which are
/// counted, are told.
fn taken(
    topic: &str,
    imu: &str,
    (mut poses, left_out): (Vec<Received<[f64; 3]>>, u64),
    is_ned: bool,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Received<[f64; 3]>>, String> {
    if is_ned {
        for pose in &mut poses {
            let [east, north, yaw] = pose.value;
            pose.value = [north, east, FRAC_PI_2 - yaw];
        }
    }
    if left_out > 0 {
        let (topic, reason) = (topic.to_owned(), format!("{imu} has no yaw at its time"));
        warnings.push(Warning::MessagesSkipped { topic, count: left_out, reason });
    }
    if poses.is_empty() {
        return Err(format!(
            "{topic} (NavSatFix) has positions without yaw, and none has a yaw of {imu} at its time"
        ));
    }
    Ok(poses)
}

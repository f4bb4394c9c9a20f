//! Bags of ROS 2 (`.mcap`, `.db3`) and ROS 1 (`.bag`): files, packed by zstd or not, alone or in
//! the folder that `ros2 bag record` makes.
//!
//! Track speeds come from `sensor_msgs/JointState`, else from `control_msgs/DynamicJointState`;
//! poses from `nav_msgs/Odometry`, `geometry_msgs/PoseStamped`, `PoseWithCovarianceStamped`,
//! `TransformStamped` or `tf2_msgs/TFMessage`; readings of the IMU from `sensor_msgs/Imu`. Where
//! there are no such poses, they come from `nav_msgs/Path`, `geometry_msgs/PoseArray`, `Pose` or
//! `sensor_msgs/NavSatFix`; track speeds may be made of a twist. The layouts of these types are
//! known here: the message definitions in the bag matter only to numbers that are named by the path
//! of their field. All of a bag is one run, but for clocks that begin anew, as in a simulation:
//! each time begins a run.
//!
//! Positions of joints that wrap after a turn are unwrapped. Where both frames are named and no
//! topic has their poses, these are composed along a chain of transforms, such as map → odom →
//! base_link.

use crate::doubt::Doubt;
use crate::recording::{BagNames, PoseAxes, Recording, Source, UncheckedRun, turn_sensor};
use crate::{Error, Format};
use std::path::Path;
use trackdyn_core::{PerSide, Side};

mod chain;
mod clock;
mod collector;
mod compressed;
mod course;
mod date;
mod definition;
mod dynamic_joints;
mod fixes;
mod frames;
mod inspection;
mod joints;
mod mcap_chunk;
mod mcap_file;
mod message;
mod names;
mod offer;
mod options;
mod part;
mod path;
mod payload;
mod ros1_file;
mod ros1_record;
mod signals;
mod sqlite_file;
mod storage;
mod stream;
mod topic;
mod twist;
mod unpacked;
mod visitor;
mod words;

pub use inspection::{Inspection, TopicSummary, inspect, inspect_for};
pub(crate) use message::yaw_of_quaternion;
pub use options::{Dating, JointSignal, RosbagOptions};
pub(crate) use storage::is_bag;
pub use topic::Role;

/// Reads a bag.
///
/// Where the options name no topic and the bag has just one that fits, that one is taken, with a
/// warning. A damaged file gives what stands before the damage, with a warning.
///
/// # Errors
/// [`Error::Topic`] when nothing or several things fit, [`Error::Bag`], [`Error::Unreadable`].
pub fn read(path: &Path, options: &RosbagOptions) -> Result<Recording, Error> {
    // what stands in for joints has a radius of its own
    let radius = options.wheel_radius.filter(|_| options.counts_wheels());
    let options = twist::effective(path, options)?;
    let options = &*signals::effective(path, options)?;
    let signals = signals::Signals::new(path, options)?;
    let mut collector = collector::Collector::new(options, signals);
    let mut warnings = storage::scan(path, &mut collector)?;
    let mut collected = collector.finish(path)?;
    turn_sensor(&mut collected.runs, options.pose_axes, options.mount_yaw);
    warnings.extend(collected.warnings);
    warnings.extend(twist::warning(options));
    let name = storage::name(path);
    let source = Source {
        format: Format::Rosbag,
        path: Some(path.to_owned()),
        epoch_ns: Some(collected.epoch_ns),
        names: Some(Box::new(collected.names.of_robot(options, radius))),
    };
    let is_in_body = collected.names.parent_frame.as_deref().is_some_and(frames::is_body);
    let joints = collected.names.joints;
    let axes = options.pose_axes;
    let are_joints = options.twist_topic.is_none();
    let is_gyroscope = collected.runs.iter().all(is_yaw_alone);
    let kind = if options.left_signals.is_empty() { "joint" } else { "signal" };
    // Words of the names of joints tell the sides where no option does.
    let are_named =
        kind == "joint" && options.left_joints.is_empty() && options.right_joints.is_empty();
    Recording::accepting(name, "unknown", collected.runs, source, warnings, &options.accepted)
        .map_err(|error| {
            if are_joints {
                let told = Told { kind, is_gyroscope, is_in_body, are_named, axes };
                with_options(error.of_wheels(options.speed_unit, radius), &joints, &told)
            } else {
                error.of_twist()
            }
        })
}

/// Whether a run has no positions.
fn is_yaw_alone(run: &UncheckedRun) -> bool {
    run.poses.samples.iter().all(|sample| !sample.pose.x.is_finite())
}

impl BagNames {
    /// The names without those of what stands in for joints.
    fn of_robot(&self, options: &RosbagOptions, wheel_radius: Option<f64>) -> Self {
        let mut names = Self { wheel_radius, ..self.clone() };
        if options.twist_topic.is_some() || !options.left_signals.is_empty() {
            names.joints = PerSide::default();
        }
        names
    }
}

/// What is known of how a bag was read.
struct Told<'a> {
    /// What the sides are made of: joints or signals.
    kind: &'a str,
    /// Whether the poses are the yaw of a gyroscope alone.
    is_gyroscope: bool,
    /// Whether the poses are told in the frame of a body.
    is_in_body: bool,
    /// Whether joints were taken by the words of their names.
    are_named: bool,
    /// Axes in which poses were taken to be told.
    axes: PoseAxes,
}

/// An error with the options that help, by the joints of each side as they were taken.
fn with_options(error: Error, taken: &PerSide<Vec<String>>, told: &Told) -> Error {
    let Told { kind, is_gyroscope, is_in_body, are_named, axes } = *told;
    let Error::Contradiction { path, doubt, remedy, .. } = error else { return error };
    let reversed = |names: &[String]| -> Vec<String> {
        let of = |name: &String| match name.strip_prefix('-') {
            Some(bare) => bare.to_owned(),
            None => format!("-{name}"),
        };
        names.iter().map(of).collect()
    };
    let option = |side: Side, names: &[String]| {
        let word = side.name();
        let options = names.iter().map(|name| format!("--{word}-{kind} {name}"));
        options.collect::<Vec<_>>().join(" ")
    };
    let (joints, remedy) = match doubt {
        Doubt::Reversed(side) => {
            let mut joints = taken.clone();
            joints[side] = reversed(&taken[side]);
            let remedy = format!("reverse it by {}", option(side, &joints[side]));
            (Some(joints), remedy)
        }
        Doubt::BothReversed => {
            let joints = PerSide::new(reversed(&taken.left), reversed(&taken.right));
            let [left, right] = Side::BOTH.map(|side| option(side, &joints[side]));
            let remedy = format!(
                "reverse them by {left} {right}, or choose poses whose x axis points forward"
            );
            (Some(joints), remedy)
        }
        Doubt::Swapped => {
            let joints = PerSide::new(taken.right.clone(), taken.left.clone());
            let [left, right] = Side::BOTH.map(|side| option(side, &joints[side]));
            let remedy = if is_gyroscope {
                format!(
                    "the gyroscope is upside down, or the sides are swapped: either way, \
                     {left} {right} give the same distance of the ICRs"
                )
            } else if is_in_body {
                "the poses are told in the frame of the robot itself, as those of a map in the \
                 robot are, which turn against it: expected poses of the robot in a frame of the \
                 world (--pose-topic, or transforms by --parent-frame and --child-frame)"
                    .to_owned()
            } else if axes == PoseAxes::NorthEastDown {
                format!("leave out --pose-axes ned, or swap the sides by {left} {right}")
            } else if are_named {
                format!(
                    "the names of the joints tell left from right, so poses count yaw clockwise, \
                     as north-east-down does: --pose-axes ned reads them. Where the names are \
                     wrong, swap the sides by {left} {right}"
                )
            } else {
                format!(
                    "swap the sides by {left} {right}, or where poses count yaw clockwise, as \
                     north-east-down does, read them by --pose-axes ned"
                )
            };
            // Poses that are mirrored look like sides that are swapped: which it is, names tell.
            (((!are_named || is_gyroscope) && !is_in_body).then_some(joints), remedy)
        }
        Doubt::Backwards => {
            let joints = PerSide::new(reversed(&taken.right), reversed(&taken.left));
            let [left, right] = Side::BOTH.map(|side| option(side, &joints[side]));
            let remedy = format!(
                "turn the sensor by --mount-yaw 180, or where the sides are wrong, swap and \
                 reverse them by {left} {right}"
            );
            (None, remedy)
        }
        _ => (None, remedy),
    };
    Error::Contradiction { path, doubt, remedy, joints: joints.map(Box::new) }
}

//! Joint signals as track speeds, and stamps as seconds.

use super::joint::Joint;
use super::merge::{Merged, SideSignal, merge};
use super::signal::Signal;
use super::tracks::Chosen;
use super::{Collected, Received, RosbagOptions, Rows, Stamped, copies, turns};
use crate::Error;
use crate::recording::{BagNames, Cleaning, UncheckedRun, Warning, clean};
use crate::rosbag::clock::{By, Clock, segment};
use crate::rosbag::date::seconds;
use crate::sample::{ImuSample, PoseSample, Series, TrackSample};
use std::path::Path;
use trackdyn_core::{PerSide, Pose};

/// What was chosen, as it was received.
pub(super) struct Streams {
    pub(super) chosen: Chosen,
    pub(super) poses: Rows,
    pub(super) pose_topic: String,
    /// Frame that the poses are expressed in, and frame whose poses they are.
    pub(super) frames: [Option<String>; 2],
    /// Poses along a chain of transforms, in place of others.
    pub(super) chained: Option<Vec<Stamped<[f64; 3]>>>,
    pub(super) imu: Rows,
    pub(super) imu_topic: String,
}

/// What is said without a radius: of joints and speeds, and of numbers that are positions.
const RADIUS: &str =
    "joints turn in rad/s: expected the radius of wheel or sprocket, --wheel-radius METRES";
const WAY_PER_COUNT: &str = "the numbers are positions: expected the way of the track per unit of \
                             them, --wheel-radius METRES; per tick of an encoder it is the \
                             circumference by the ticks of a turn";

/// Values with their run and time.
type Dated<T> = Vec<(usize, Stamped<T>)>;

/// Dates messages and tells the runs that they belong to.
struct Dates<'a> {
    clocks: &'a [Clock],
    by: By,
    /// Loggings at which another run begins.
    resets: &'a [i64],
}

impl Dates<'_> {
    fn of<T: Copy>(&self, topic: &str, received: &[Received<T>]) -> Dated<T> {
        let Some(clock) = self.clocks.iter().find(|clock| clock.topic == topic) else {
            return Vec::new();
        };
        // A clock that begins anew as often does so at a message of its own.
        let own = clock.resets();
        let resets = if own.len() == self.resets.len() { own } else { self.resets };
        let dated = received.iter().filter_map(|one| {
            Some((segment(resets, one.log_ns), (clock.date(self.by, one)?, one.value)))
        });
        dated.collect()
    }
}

/// The runs of these streams; t = 0 at the earliest time.
pub(super) fn runs(
    path: &Path,
    options: &RosbagOptions,
    clocks: &[Clock],
    by: By,
    streams: Streams,
    mut warnings: Vec<Warning>,
) -> Result<Collected, Error> {
    let Streams { chosen, poses, pose_topic, frames, chained, imu, imu_topic } = streams;
    let refuse = |problem: &str| Error::Topic {
        path: path.to_owned(),
        what: "track speeds",
        problem: problem.to_owned(),
        available: format!(
            "{} readings of the joints",
            chosen.joints.iter().map(|joint| joint.signals.len()).max().unwrap_or_default()
        ),
    };
    let Some(radius) = options.wheel_radius else {
        let are_counts = !options.left_signals.is_empty() && chosen.signal == Signal::Position;
        return Err(refuse(if are_counts { WAY_PER_COUNT } else { RADIUS }));
    };
    let anew = clocks.iter().rev().max_by_key(|clock| clock.resets().len());
    let resets = anew.map(Clock::resets).unwrap_or_default();
    let count = resets.len() + 1;
    if let Some(clock) = anew.filter(|_| count > 1) {
        if chained.is_some() {
            return Err(refuse(
                "stamps step back, as after the reset of a simulation: poses along a chain of \
                 transforms need a bag without such steps; cut it there",
            ));
        }
        warnings.push(Warning::ClockReset { topic: clock.topic.clone(), runs: count });
    }
    let dates = Dates { clocks, by, resets };
    let poses = match chained {
        Some(chained) => chained.into_iter().map(|pose| (0, pose)).collect(),
        None => dates.of(&pose_topic, &poses),
    };
    let imu = dates.of(&imu_topic, &imu);
    let joints: Vec<Dated<f64>> = chosen
        .joints
        .iter()
        .map(|joint| values(&dates, joint, chosen.signal, &mut warnings))
        .collect();
    let times = joints.iter().flatten().map(|(_, (time, _))| *time);
    let times = times.chain(poses.iter().chain(&imu).map(|(_, (time, _))| *time));
    let epoch_ns = times.min().unwrap_or_default();

    let mut runs = Vec::with_capacity(count);
    for (run, id) in (0..count).zip(0_i64..) {
        let mut parts = Vec::with_capacity(joints.len());
        for (joint, values) in chosen.joints.iter().zip(&joints) {
            let mut values = of_run(values, run);
            if chosen.signal == Signal::Position {
                values.sort_by_key(|(time, _)| *time);
                let at = |stamp| seconds(epoch_ns, stamp);
                let told = turns::unwrap(&joint.name, &mut values, at);
                warnings.extend(told.map_err(|problem| refuse(&problem))?);
            }
            for (_, value) in &mut values {
                *value *= joint.sign;
            }
            parts.push(SideSignal { side: joint.side, values });
        }
        let Merged { sides, left_out } = merge(&parts);
        if left_out > 0 {
            let topic = chosen.joints.first().map(|joint| joint.topic.clone()).unwrap_or_default();
            let reason = "another joint has no reading there".to_owned();
            warnings.push(Warning::MessagesSkipped { topic, count: left_out as u64, reason });
        }
        let sample = |(time, sides): &Stamped<PerSide<f64>>| TrackSample {
            t: seconds(epoch_ns, *time),
            v_left: sides.left * radius,
            v_right: sides.right * radius,
        };
        let mut tracks: Series<TrackSample> = sides.iter().map(sample).collect::<Vec<_>>().into();
        if chosen.signal == Signal::Position {
            let mut cleanings: Vec<Cleaning> = Vec::new();
            clean(&mut tracks, id, &mut cleanings);
            cleanings.retain(|cleaning| cleaning.finding.changes_rows());
            warnings.extend(cleanings.into_iter().map(Warning::Cleaned));
            tracks = speeds_of_positions(&tracks.samples).into();
        }
        let poses = of_run(&poses, run).into_iter().map(|(time, [x, y, yaw])| PoseSample {
            t: seconds(epoch_ns, time),
            pose: Pose::new(x, y, yaw),
        });
        let imu = of_run(&imu, run).into_iter().map(|(time, [gyro_z, acc_x, acc_y])| ImuSample {
            t: seconds(epoch_ns, time),
            gyro_z,
            acc_x,
            acc_y,
        });
        let (poses, imu) = (poses.collect::<Vec<_>>().into(), imu.collect::<Vec<_>>().into());
        runs.push(UncheckedRun { id, tracks, poses, imu });
    }
    copies::leave_out(&mut runs, &mut warnings);
    let names = names(&chosen, pose_topic, frames);
    Ok(Collected { runs, epoch_ns, names, warnings })
}

/// What was taken, by the names of the bag.
fn names(chosen: &Chosen, pose_topic: String, frames: [Option<String>; 2]) -> BagNames {
    let joints = PerSide::from_fn(|side| {
        let of_side = chosen.joints.iter().filter(|joint| joint.side == side);
        let name = |joint: &Joint| match joint.sign {
            sign if sign < 0.0 => format!("-{}", joint.name),
            _ => joint.name.clone(),
        };
        of_side.map(name).collect()
    });
    let mut track_topics: Vec<String> =
        chosen.joints.iter().map(|joint| joint.topic.clone()).collect();
    track_topics.sort();
    track_topics.dedup();
    let pose_topic = Some(pose_topic).filter(|topic| !topic.is_empty());
    let ([parent_frame, child_frame], wheel_radius) = (frames, None);
    BagNames { joints, wheel_radius, track_topics, pose_topic, parent_frame, child_frame }
}

/// The values of a run.
fn of_run<T: Copy>(dated: &Dated<T>, run: usize) -> Vec<Stamped<T>> {
    dated.iter().filter(|(of, _)| *of == run).map(|(_, value)| *value).collect()
}

/// The finite values of a joint's signal.
fn values(dates: &Dates, joint: &Joint, signal: Signal, warnings: &mut Vec<Warning>) -> Dated<f64> {
    let place = usize::from(signal == Signal::Velocity);
    let values: Vec<Received<f64>> = joint
        .signals
        .iter()
        .map(|one| one.with(one.value[place]))
        .filter(|one| one.value.is_finite())
        .collect();
    let lost = joint.signals.len() - values.len();
    if lost > 0 {
        let (topic, count) = (joint.topic.clone(), lost as u64);
        let reason = format!("{} has no {} in it, as in others", joint.name, signal.name());
        warnings.push(Warning::MessagesSkipped { topic, count, reason });
    }
    dates.of(&joint.topic, &values)
}

/// The difference quotient up to the next position, from the earlier stamp on: held until then, it
/// adds up to the distance travelled. The last position gives no speed.
fn speeds_of_positions(positions: &[TrackSample]) -> Vec<TrackSample> {
    positions
        .windows(2)
        .map(|pair| {
            let interval = pair[1].t - pair[0].t;
            TrackSample {
                t: pair[0].t,
                v_left: (pair[1].v_left - pair[0].v_left) / interval,
                v_right: (pair[1].v_right - pair[0].v_right) / interval,
            }
        })
        .collect()
}

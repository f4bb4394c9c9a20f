//! The loop: look, decide, command.

use super::belief::{Belief, Estimate};
use super::journey::{CrossTrack, Ending, Journey};
use super::pursuit::{Pursuit, SetPoint, position};
use super::{Steering, Tracker};
use crate::Error;
use crate::path::{Path, distance};
use trackdyn_core::pose::wrap_angle;
use trackdyn_core::{Command, PerSide, Plant, Pose, Trajectory, real};

/// Time for which the tracks are held still at the end, s: the robot comes to rest within it.
const SETTLING_TIME: f64 = 0.3;

/// Longest time that a robot is waited for, s: 10 km at 0.5 m/s, and four times that time. Moments
/// and looks every 0.01 and 0.03 s take 800 MB then.
const MAX_PATIENCE: f64 = 8e4;

/// What a drive depends on beside robot, path, tracker and kinematics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveOptions {
    /// How the robot knows its pose.
    pub estimate: Estimate,
    /// Longest time, s; where absent, four times that of the path at full speed and 30 s per leg.
    pub time_limit: Option<f64>,
}

impl Default for DriveOptions {
    fn default() -> Self {
        Self { estimate: Estimate::Truth, time_limit: None }
    }
}

/// Drives a robot along a path in its world, from where it is. `progress` is told, at each command,
/// the share of the path that is behind.
///
/// # Errors
/// [`Error::Option`] for values that no tracker has, and for a look-ahead too short for a point
/// that far behind the ICRs. A robot that stops or strays is no error: the [ending](Ending) says
/// so.
pub fn drive(
    plant: &mut impl Plant,
    path: &Path,
    tracker: &Tracker,
    steering: &dyn Steering,
    options: &DriveOptions,
    progress: &dyn Fn(f64),
) -> Result<Journey, Error> {
    tracker.check()?;
    if let Some(limit) = options.time_limit.filter(|limit| !(*limit > 0.0 && *limit <= 1e6)) {
        return Err(Error::option("time limit", &limit, "a positive time in s, at most 1000000"));
    }
    let (_, constants) = steering.track_speeds(tracker.speed, 0.0);
    let shortest = 2.0 * (constants.icrs.y - tracker.point[0]);
    if tracker.look_ahead <= shortest {
        let expected = format!(
            "more than {shortest} m, twice the distance by which the tracked point lies behind the \
             ICRs"
        );
        return Err(Error::option("look-ahead", &tracker.look_ahead, expected));
    }
    let start = plant.moment();
    let mut pursuit = Pursuit::new(tracker, path);
    let patience = 4.0 * path.length() / tracker.speed + 30.0 * real(pursuit.legs());
    if options.time_limit.is_none() && patience > MAX_PATIENCE {
        let expected = format!(
            "at most {MAX_PATIENCE} s, which memory holds: a shorter path, one with fewer corners, \
             or a faster drive"
        );
        let time = format!("of {} m, which may take {patience} s", path.length());
        return Err(Error::option("path", &time, expected));
    }
    let end = start.t + options.time_limit.unwrap_or(patience);
    let mut belief = Belief::new(options.estimate, steering, start.pose);
    let mut watch = Watch { path, tracker, travelled: 0.0, before: None, cross_track: Vec::new() };
    let mut trajectory = Trajectory::default();
    trajectory.push(start);
    let (mut commands, mut believed) = (Vec::new(), Vec::new());
    let mut now = start.t;
    let mut ending = None;
    while ending.is_none() {
        let SetPoint { forward, yaw_rate } = pursuit.last();
        let (_, constants) = steering.track_speeds(forward, yaw_rate);
        let wanted = pursuit.next(&belief.pose(), constants.icrs.y);
        progress(pursuit.along() / path.length());
        believed.push(belief.pose());
        watch.look(now, &plant.moment().pose, pursuit.along());
        let until = start.t + real(commands.len() + 1) * tracker.interval;
        let (speeds, until) = match wanted {
            Some(SetPoint { forward, yaw_rate }) => {
                let (speeds, _) = steering.track_speeds(forward, yaw_rate);
                (limited(speeds, tracker.belt_speed), until)
            }
            None => (PerSide::default(), until + SETTLING_TIME),
        };
        if wanted.is_none() {
            ending = Some(Ending::Arrived);
        } else if until > end {
            ending = Some(Ending::OutOfTime);
        }
        commands.push(Command { t: now, speeds });
        let known = trajectory.moments().len() - 1;
        if let Err(stopped) = plant.drive(speeds, until, &mut trajectory) {
            ending = Some(Ending::Stopped(stopped));
        }
        belief.moved(&trajectory.moments()[known..], speeds);
        now = until;
    }
    believed.push(belief.pose());
    let last = plant.moment();
    watch.look(last.t, &last.pose, pursuit.along());
    let ending = ending.unwrap_or(Ending::Arrived);
    Ok(Journey { trajectory, commands, believed, cross_track: watch.cross_track, ending })
}

/// Both speeds by the factor that brings the faster one to the limit, m/s.
fn limited(speeds: PerSide<f64>, limit: f64) -> PerSide<f64> {
    let factor = (speeds.left.abs().max(speeds.right.abs()) / limit).max(1.0);
    speeds.map(|speed| speed / factor)
}

/// Someone who sees where the robot truly is.
struct Watch<'a> {
    path: &'a Path,
    tracker: &'a Tracker,
    travelled: f64,
    before: Option<[f64; 2]>,
    cross_track: Vec<CrossTrack>,
}

impl Watch<'_> {
    /// Notes where it is beside the path while the tracker is at a length along.
    fn look(&mut self, t: f64, pose: &Pose, along: f64) {
        let point = position(pose, self.tracker.point);
        let before = self.before.replace(point);
        self.travelled += before.map_or(0.0, |before| distance(before, point));
        let around = [along - self.tracker.look_ahead, along + self.tracker.look_ahead];
        let station = self.path.nearest(point, around);
        self.cross_track.push(CrossTrack {
            t,
            travelled: self.travelled,
            along: station.along,
            offset: station.offset,
            heading: wrap_angle(pose.yaw - station.direction),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_keeps_the_curvature() {
        let speeds = limited(PerSide::new(-0.5, 2.0), 1.0);
        assert_eq!(speeds, PerSide::new(-0.25, 1.0));
        assert_eq!(limited(PerSide::new(0.3, -0.9), 1.0), PerSide::new(0.3, -0.9));
    }
}

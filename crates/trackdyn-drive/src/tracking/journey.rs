//! What came of a drive.

use crate::path::{Path, distance};
use std::fmt::Write;
use trackdyn_core::{Command, Pose, Schedule, Stopped, Trajectory};

/// A drive along a path, to its end or not.
#[derive(Clone, Debug, PartialEq)]
pub struct Journey {
    /// The true motion.
    pub trajectory: Trajectory,
    /// Track speeds as commanded; each holds until the next, the last one until the end.
    pub commands: Vec<Command>,
    /// Where the robot took itself to be when it gave each command, and at the end.
    pub believed: Vec<Pose>,
    /// Where it was beside the path at the same moments.
    pub cross_track: Vec<CrossTrack>,
    /// How it ended.
    pub ending: Ending,
}

/// How a drive ends.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Ending {
    /// The robot takes itself to be at the end of the path.
    Arrived,
    /// The time was up.
    OutOfTime,
    /// The robot could not go on.
    Stopped(Stopped),
}

/// Where the tracked point was beside the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossTrack {
    /// Time, s.
    pub t: f64,
    /// Way that the point has gone, m.
    pub travelled: f64,
    /// Length along the path of the nearest place, m. Places within a look-ahead of where the
    /// tracker is count: a path may cross itself.
    pub along: f64,
    /// Distance to the path, left positive, m.
    pub offset: f64,
    /// Heading of the hull against the path's direction, rad.
    pub heading: f64,
}

/// A drive in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Root mean square of the cross-track error over the way that was gone, m.
    pub rms: f64,
    /// Its largest size, m.
    pub max: f64,
    /// Distance between the end of the path and that of the drive, m.
    pub end_distance: f64,
    /// Distance between believed and true pose at the end of the drive, m.
    pub end_belief: f64,
    /// Way that the tracked point has gone, m.
    pub travelled: f64,
    /// Time, s.
    pub duration: f64,
}

impl Journey {
    /// The drive in numbers; `point` is the tracked one, forward and left, m.
    ///
    /// # Panics
    /// Never for a journey that [`drive`](super::drive()) made: it has a moment.
    pub fn summary(&self, path: &Path, point: [f64; 2]) -> Summary {
        let errors = &self.cross_track;
        // ∫ e² ds/∫ ds: standing and turning on the spot do not weigh
        let (squares, way) = errors.windows(2).fold((0.0, 0.0), |(squares, way), pair| {
            let step = pair[1].travelled - pair[0].travelled;
            let mean = f64::midpoint(pair[0].offset.powi(2), pair[1].offset.powi(2));
            (squares + step * mean, way + step)
        });
        let [start, end] = self.trajectory.span().unwrap_or_default();
        let at = |pose: &Pose| super::pursuit::position(pose, point);
        let there = at(&self.trajectory.pose_at(end));
        let believed = self.believed.last().map_or(there, at);
        Summary {
            rms: if way > 0.0 { (squares / way).sqrt() } else { 0.0 },
            max: errors.iter().map(|error| error.offset.abs()).fold(0.0, f64::max),
            end_distance: distance(there, path.point_at(path.length())),
            end_belief: distance(there, believed),
            travelled: way,
            duration: end - start,
        }
    }

    /// The commands as a schedule that can be driven again; none of fewer than one.
    pub fn schedule(&self) -> Option<Schedule> {
        let last = self.commands.last()?;
        let [_, end] = self.trajectory.span()?;
        let mut commands = self.commands.clone();
        commands.push(Command { t: end, speeds: last.speeds });
        Schedule::new(commands).ok()
    }

    /// The cross-track errors as a table: `t,travelled,along,offset,heading`, s, m and rad.
    pub fn cross_track_csv(&self) -> String {
        let mut text = String::from("t,travelled,along,offset,heading\n");
        for CrossTrack { t, travelled, along, offset, heading } in &self.cross_track {
            let _ = writeln!(text, "{t},{travelled},{along},{offset},{heading}");
        }
        text
    }
}

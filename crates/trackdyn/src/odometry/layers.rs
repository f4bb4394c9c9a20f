//! A replay as layers of viewers.
//!
//! Curves of motion are means over segments, at their middle. Markers of the recorded drive are the
//! ICRs that the track speeds and the poses show over a second, where it turns.

mod icrs;
mod motion;

use super::Odometry;
use crate::viewer::{self, Actor, Timeline};
use crate::{Error, Provenance};
use trackdyn_core::Pose;
use trackdyn_estimate::SegmentOptions;
use trackdyn_estimate::odometry::comparison::Path;
use trackdyn_estimate::odometry::{ParameterSet, Span, Stretch, stretch};
use trackdyn_export::viewer::{JointLayer, Layers, PathLayer};
use trackdyn_recording::{Recording as Motion, Run};
use trackdyn_report::figure::entry_colour;

/// A set of parameters that is shown: not its variant without alpha.
struct Shown<'a> {
    /// Its place among the sets of the comparison.
    place: usize,
    set: &'a ParameterSet,
    actor: Actor,
}

/// A replay, with what its layers are made from.
struct Drive<'a> {
    odometry: &'a Odometry,
    /// The part of the recording that was replayed.
    motion: &'a Motion,
    timeline: Timeline,
    observed: Actor,
    /// Frame of the recorded poses.
    base_frame: String,
    shown: Vec<Shown<'a>>,
    segments: Vec<Stretch>,
}

/// The layers of a replay.
pub(super) fn of(odometry: &Odometry, provenance: &Provenance) -> Result<Layers, Error> {
    let part = odometry.recording.part(&odometry.part)?;
    let motion = part.expect_motion()?;
    let [fixed_frame, base_frame] = viewer::frames(motion);
    let comparison = &odometry.comparison;
    let is_given =
        |set: &ParameterSet| odometry.replayed.iter().any(|one| one.set.name() == set.name());
    let is_shown = |place: usize, set| place == 0 || is_given(set) || set.vehicle().is_some();
    let sets = comparison.sets.iter().enumerate();
    let sets: Vec<(usize, &ParameterSet)> =
        sets.filter(|(place, set)| is_shown(*place, set)).collect();
    let (observed, actors) =
        Actor::all(sets.iter().map(|(place, set)| (set.name(), entry_colour(*place))));
    let shown = sets.into_iter().zip(actors);
    let options = SegmentOptions { tau: comparison.tau, ..SegmentOptions::default() };
    let drive = Drive {
        odometry,
        motion,
        timeline: Timeline::new(odometry.recording.expect_motion()?),
        observed,
        base_frame,
        shown: shown.map(|((place, set), actor)| Shown { place, set, actor }).collect(),
        segments: stretch::of_segments(motion, &options),
    };
    let pieces = stretch::joined(&drive.segments, Span::Duration(viewer::PIECE));
    let tracks = drive.tracks();
    let mut tabs = motion::tabs(&drive, &tracks);
    tabs.push(icrs::tab(&drive, &pieces));
    Ok(Layers {
        notes: viewer::notes([
            ("command", provenance.command.clone()),
            ("version", provenance.version.clone()),
            ("recording", odometry.recording.name().to_owned()),
            ("fingerprint", odometry.recording.fingerprint().to_owned()),
            ("robot", motion.robot().to_owned()),
            ("vehicle", odometry.gauge.vehicle().to_owned()),
            ("gauge_m", odometry.gauge.metres().to_string()),
            ("clock_offset_s", format!("{:.9}", odometry.clock.tau())),
            ("runs_moved_in_time", drive.timeline.moved()),
        ]),
        fixed_frame,
        paths: drive.paths(),
        markers: icrs::layers(&drive, &pieces),
        joints: vec![tracks],
        texts: Vec::new(),
        tabs,
    })
}

impl Drive<'_> {
    /// A run of the part, by its index.
    fn run(&self, index: usize) -> &Run {
        &self.motion.runs()[index]
    }

    /// The stamp of a time of a run, by its index.
    fn stamp(&self, run: usize, t: f64) -> u64 {
        self.timeline.stamp(self.run(run).id(), t)
    }

    /// The stamp of the middle of a stretch.
    fn middle(&self, stretch: &Stretch) -> u64 {
        self.stamp(stretch.run, stretch.start + stretch.duration / 2.0)
    }

    fn paths(&self) -> Vec<PathLayer> {
        let observed = self.filled(self.observed.path(&self.base_frame), |path| &path.recorded);
        let replayed = self.shown.iter().map(|Shown { place, actor, .. }| {
            self.filled(actor.path(actor.frame()), |path| &path.trajectories[*place].poses)
        });
        std::iter::once(observed).chain(replayed).collect()
    }

    /// The layer with the poses of all runs.
    fn filled(&self, mut layer: PathLayer, poses: impl Fn(&Path) -> &Vec<Pose>) -> PathLayer {
        for path in &self.odometry.comparison.paths {
            layer.starts.push(layer.poses.len());
            layer.stamps.extend(path.stamps.iter().map(|t| self.stamp(path.index, *t)));
            layer.poses.extend(poses(path));
        }
        layer
    }

    /// Track speeds as measured, of the runs that were replayed.
    fn tracks(&self) -> JointLayer {
        let mut layer = viewer::tracks();
        for path in &self.odometry.comparison.paths {
            for sample in self.run(path.index).tracks() {
                layer.stamps.push(self.stamp(path.index, sample.t));
                layer.speeds.push(sample.speeds());
            }
        }
        layer
    }
}

//! ICRs over time, as curves and as markers.

use super::{Drive, Shown};
use crate::viewer::{COORDINATES, Moment, markers, places, plot};
use trackdyn_core::PerSide;
use trackdyn_estimate::odometry::Stretch;
use trackdyn_export::viewer::{MarkerLayer, Tab, Trace};
use trackdyn_recording::hold;

/// Least time between two markers of a set, s.
const MARKER_INTERVAL: f64 = 0.1;

/// Curves of the ICRs, as poses and track speeds show them, and as each set has them.
pub(super) fn tab(drive: &Drive, pieces: &[Stretch]) -> Tab {
    let plots = COORDINATES.map(|(title, topic, value)| {
        let (mut observed, mut sets) =
            (Trace::default(), vec![Trace::default(); drive.shown.len()]);
        for piece in pieces {
            let (stamp, speeds) = (drive.middle(piece), drive.mean_speeds(piece));
            if let Some(moment) = Moment::of_motion(&piece.observed, piece.duration, speeds) {
                observed.push(stamp, value(&moment.tracks));
            }
            for (shown, trace) in drive.shown.iter().zip(&mut sets) {
                if let (Some(icrs), _) = shown.set.steady(speeds) {
                    trace.push(stamp, value(&icrs));
                }
            }
        }
        let sets = drive.shown.iter().zip(sets);
        let sets = sets.map(|(shown, trace)| shown.actor.curve(topic, trace));
        plot(title, std::iter::once(drive.observed.curve(topic, observed)).chain(sets))
    });
    Tab { title: "ICRs".to_owned(), plots: plots.into() }
}

/// Markers of the ICRs, which move with the robot.
pub(super) fn layers(drive: &Drive, pieces: &[Stretch]) -> Vec<MarkerLayer> {
    let gauge = drive.odometry.gauge().metres();
    let mut observed = markers(&drive.observed, &drive.base_frame, gauge);
    for piece in pieces {
        let speeds = drive.mean_speeds(piece);
        let moment = Moment::of_motion(&piece.observed, piece.duration, speeds);
        observed.stamps.push(drive.middle(piece));
        observed.places.push(places(moment.as_ref()));
    }
    let sets = drive.shown.iter().map(|shown| {
        let mut layer = markers(&shown.actor, &drive.base_frame, gauge);
        for path in &drive.odometry.comparison.paths {
            let mut next = f64::NEG_INFINITY;
            for &t in &path.stamps {
                if t < next {
                    continue;
                }
                next = t + MARKER_INTERVAL;
                layer.stamps.push(drive.stamp(path.index, t));
                layer.places.push(places(drive.moment_of(shown, path.index, t).as_ref()));
            }
        }
        layer
    });
    std::iter::once(observed).chain(sets).collect()
}

impl Drive<'_> {
    /// Mean of the measured track speeds over a stretch, m/s.
    fn mean_speeds(&self, stretch: &Stretch) -> PerSide<f64> {
        let (start, end) = (stretch.start, stretch.start + stretch.duration);
        let tracks = self.run(stretch.run).tracks();
        let way = hold::travelled(tracks, start, end, self.odometry.comparison.tau);
        way.map(|way| way / stretch.duration)
    }

    /// The ICRs of a set at a time of a run, s of the pose clock; none before its first reading,
    /// and of forces that do not turn the robot.
    fn moment_of(&self, shown: &Shown, run: usize, t: f64) -> Option<Moment> {
        let tracks = self.run(run).tracks();
        let reading = hold::holding(tracks, t - self.odometry.comparison.tau)?;
        let speeds = tracks[reading].speeds();
        let (icrs, twist) = shown.set.steady(speeds);
        Some(Moment::new(icrs?, &twist))
    }
}

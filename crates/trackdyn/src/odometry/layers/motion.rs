//! Curves of what was recorded and predicted over segments.

use super::Drive;
use crate::viewer::{Actor, RATES, plot, track_speeds};
use trackdyn_core::Pose;
use trackdyn_estimate::odometry::{Residual, Stretch};
use trackdyn_export::viewer::{JointLayer, Plot, Tab, Trace};

/// The tabs of motion and of residuals.
pub(super) fn tabs(drive: &Drive, tracks: &JointLayer) -> Vec<Tab> {
    let mut motion = vec![track_speeds(tracks)];
    motion.extend(RATES.map(|(title, topic, rate)| {
        let curve = |actor: &Actor, moved: &dyn Fn(&Stretch) -> Option<Pose>| {
            let rate = |segment: &Stretch| rate(&moved(segment)?, segment.duration);
            actor.curve(topic, drive.trace(rate))
        };
        let observed = curve(&drive.observed, &|segment| Some(segment.observed));
        let predicted = drive
            .shown
            .iter()
            .map(|shown| curve(&shown.actor, &|segment| drive.predicted(segment, shown.place)));
        plot(title, std::iter::once(observed).chain(predicted))
    }));
    let residuals = vec![
        residuals(drive, "Residual of a segment, forward [m]", "along", |of| of.along),
        residuals(drive, "Residual of a segment, to the left [m]", "across", |of| of.across),
        residuals(drive, "Residual of a segment, yaw [rad]", "yaw", |of| of.yaw),
    ];
    let tab = |title: &str, plots| Tab { title: title.to_owned(), plots };
    vec![tab("Motion", motion), tab("Residuals", residuals)]
}

/// Observed minus predicted motion of all segments, for each set.
fn residuals(drive: &Drive, title: &str, topic: &str, value: fn(&Residual) -> f64) -> Plot {
    let curves = drive.shown.iter().map(|shown| {
        let trace = drive.trace(|segment| {
            let motion = drive.predicted(segment, shown.place)?;
            Some(value(&Residual::new(&segment.observed, &motion)))
        });
        shown.actor.curve(&format!("residual/{topic}"), trace)
    });
    plot(title, curves)
}

impl Drive<'_> {
    /// A value of each segment at its middle, where it has one.
    fn trace(&self, value: impl Fn(&Stretch) -> Option<f64>) -> Trace {
        let mut trace = Trace::default();
        for segment in &self.segments {
            if let Some(value) = value(segment) {
                trace.push(self.middle(segment), value);
            }
        }
        trace
    }

    /// The motion over a stretch that a set predicts, seen from its beginning; none in a run that
    /// was not replayed.
    fn predicted(&self, stretch: &Stretch, set: usize) -> Option<Pose> {
        let paths = &self.odometry.comparison.paths;
        let place = paths.binary_search_by_key(&stretch.run, |path| path.index).ok()?;
        let trajectory = &paths[place].trajectories[set];
        let [from, to] =
            stretch.poses.map(|index| trajectory.poses.get(index.checked_sub(trajectory.first)?));
        Some(from?.relative(to?))
    }
}

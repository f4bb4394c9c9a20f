//! Places tried for effects with an extent: where the robot was.

use crate::evidence::Evidence;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use trackdyn_model::effect::{Card, Role};

/// Extent of an effect's place, m; none where it has none.
pub(super) fn extent(of: &Card, values: &[f64]) -> Option<f64> {
    let shape = of.parameters.iter().position(|one| one.role == Role::Shape);
    shape.filter(|_| of.has_extent()).map(|place| values[place])
}

/// The values with every place that is tried for their extent; unchanged without an extent.
pub(super) fn of_extent(of: &Card, values: Vec<f64>, evidence: &Evidence) -> Vec<Vec<f64>> {
    let Some(extent) = extent(of, &values) else { return vec![values] };
    let placed = |place: [f64; 2]| {
        let values = values.iter().zip(of.parameters).map(|(value, one)| match one.role {
            Role::Place { axis } => place[axis].clamp(one.range[0], one.range[1]),
            _ => *value,
        });
        values.collect()
    };
    visited(evidence, extent).into_iter().map(placed).collect()
}

/// Centres of the squares with this side (m) that hold most samples.
fn visited(evidence: &Evidence, side: f64) -> Vec<[f64; 2]> {
    #[expect(clippy::cast_possible_truncation, reason = "robots stay within millions of squares")]
    let square = |place: f64| (place / side).floor() as i64;
    let mut counts: BTreeMap<[i64; 2], usize> = BTreeMap::new();
    for sample in evidence.samples() {
        *counts.entry([square(sample.pose.x), square(sample.pose.y)]).or_default() += 1;
    }
    let mut squares: Vec<([i64; 2], usize)> = counts.into_iter().collect();
    squares.sort_by_key(|(_, count)| Reverse(*count));
    #[expect(clippy::cast_precision_loss, reason = "robots stay within millions of squares")]
    let middle = |square: i64| (square as f64 + 0.5) * side;
    squares
        .into_iter()
        .take(evidence.settings().candidates.max_places)
        .map(|(square, _)| square.map(middle))
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::candidate::variants;
    use crate::evidence::Evidence;
    use crate::evidence::planned::{PlannedRun, READINGS};
    use crate::settings::Settings;
    use nalgebra::Vector3;
    use trackdyn_core::Pose;
    use trackdyn_estimate::weighting::SegmentNoise;
    use trackdyn_model::EffectId;
    use trackdyn_recording::TrackSample;

    const NOISE: SegmentNoise =
        SegmentNoise { pose: [1e-6; 3], walk: [0.0; 3], heading: 0.0, stamp: 0.0 };

    /// Circles with a radius of 1 m, then 30 m straight ahead.
    fn drive() -> Evidence {
        let reading = |k: usize| {
            let t = 0.03 * trackdyn_core::real(k);
            let turning = if t < 60.0 { 0.2 } else { 0.0 };
            TrackSample { t, v_left: 0.5 - turning, v_right: 0.5 + turning }
        };
        let run = PlannedRun {
            pose: Pose::default(),
            tracks: (0..=400 * READINGS).map(reading).collect(),
            blocks: vec![0],
        };
        Evidence::planned(&[run], NOISE, 0.0, &Settings::default(), |evidence| {
            let motion = |speeds: [f64; 2], duration: f64| {
                let [left, right] = speeds;
                Vector3::new(f64::midpoint(left, right), 0.0, 1.25 * (right - left)) * duration
            };
            let samples = evidence.samples().iter();
            samples.map(|s| motion([s.speeds.left, s.speeds.right], s.duration)).collect()
        })
    }

    #[test]
    fn what_is_passed_often_is_tried_however_far_the_robot_went_once() {
        let evidence = drive();
        let patch = EffectId::of("terrain-patch").expect("a patch");
        let tried = variants(patch, &evidence);
        let smallest = tried.iter().map(|one| one.values[2]).fold(f64::MAX, f64::min);
        let inside = |x: f64, y: f64| {
            let distance = |values: &[f64]| (values[0] - x).hypot(values[1] - y);
            tried.iter().any(|one| one.values[2] == smallest && distance(&one.values) < smallest)
        };
        let circles = evidence.samples().iter().filter(|sample| sample.start < 60.0);
        assert!(circles.map(|sample| sample.pose).all(|pose| inside(pose.x, pose.y)));
    }
}

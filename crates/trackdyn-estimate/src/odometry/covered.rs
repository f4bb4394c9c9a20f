//! Which poses a replay leads to.

use std::ops::Range;
use trackdyn_recording::Run;

/// Largest difference of stamps by rounding, s.
const STAMP_ROUNDING: f64 = 1e-9;

/// Indices of the poses whose motion the readings of the tracks cover: a reading holds until the
/// next one, and the last one was measured until its stamp only.
pub(super) fn covered(run: &Run, tau: f64) -> Range<usize> {
    let (tracks, poses) = (run.tracks(), run.poses());
    let [first, .., last] = tracks else { return 0..0 };
    let from = poses.partition_point(|pose| pose.t - tau < first.t - STAMP_ROUNDING);
    let until = poses.partition_point(|pose| pose.t - tau <= last.t + STAMP_ROUNDING);
    from..until.max(from)
}

//! Chords of curves, which are no lines.
//!
//! A round surface is cut into chords that fit as well as straight walls do, but where they end
//! depends on where the scanner stands: a scan matched against them sticks to them. Chords of a
//! curve meet, and at small angles: along a chord of length c on a radius R, within noise, the
//! direction turns by c/R.

use crate::beam;
use crate::line::Line;
use trackdyn_core::Pose;
use trackdyn_core::pose::wrap_angle;

/// Largest angle at which chords of a curve meet, rad: 45 degrees. At 10 mm noise chords on a
/// radius of 0.2 m, a large bin, turn by as much; on smaller ones too few beams fall.
const MAX_CHORD_ANGLE: f64 = std::f64::consts::FRAC_PI_4;

/// Number of standard deviations by which directions must differ at least, and ends may at most.
const SIGNIFICANT_DEVIATIONS: f64 = 4.0;

/// Whether two neighbouring lines pass into one another as chords of a curve do: they meet between
/// their beams, within what is known of them, and surely differ in direction, but not by much.
/// `bearing_between` lies between the last beam of the one and the first of the other, rad.
pub(super) fn are_chords(one: &Line, other: &Line, bearing_between: f64) -> bool {
    let turn = wrap_angle(other.angle - one.angle).abs();
    let deviation = (one.covariance[(0, 0)] + other.covariance[(0, 0)]).sqrt();
    if turn > MAX_CHORD_ANGLE || turn < SIGNIFICANT_DEVIATIONS * deviation {
        return false;
    }
    let (sin, cos) = bearing_between.sin_cos();
    let on = |line| beam::on_line(line, &Pose::default(), [cos, sin]);
    let (Some(a), Some(b)) = (on(one), on(other)) else { return false };
    let variance = a.by_line.dot(&(one.covariance * a.by_line))
        + b.by_line.dot(&(other.covariance * b.by_line));
    (a.range - b.range).powi(2) < SIGNIFICANT_DEVIATIONS * SIGNIFICANT_DEVIATIONS * variance
}

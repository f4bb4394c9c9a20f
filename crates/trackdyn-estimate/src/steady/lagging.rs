//! Points that turn less than others that are driven less hard.
//!
//! # Law
//! Whatever the ICRs are, more speed on the outer track and less on the inner one does not turn a
//! robot more slowly. So if a point turns more slowly than one that is driven less hard, one of its
//! tracks missed its speed: a motor saturates or stalls, or a belt slips on its sprocket.
//!
//! # Assumes
//! The scatter of yaw rates, found without a model: of each point between its neighbours on a line
//! of constant track speed, against the straight line through these.

use crate::noise::{self, scatter};
use trackdyn_recording::OperatingPoint;

/// Smallest shortfall in standard deviations that is not chance: of a hundred thousand pairs of
/// points one exceeds 4.4, and the worst of many pairs is looked at.
const MIN_SHORTFALL: f64 = 5.0;

/// A point that lags.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lagging {
    /// Its index.
    pub point: usize,
    /// Index of the point that is driven less and turns the most.
    pub than: usize,
    /// By how much that one turns faster, rad/s.
    pub shortfall: f64,
    /// The shortfall in standard deviations of a difference.
    pub certainty: f64,
}

/// The points that lag, in their order; none where the table does not show the scatter of yaw
/// rates.
pub fn lagging(points: &[OperatingPoint]) -> Vec<Lagging> {
    let turning: Vec<(usize, &OperatingPoint, f64)> = points
        .iter()
        .enumerate()
        .filter_map(|(index, point)| Some((index, point, point.yaw_rate?)))
        .collect();
    let scatter = scatter(points, |point| point.yaw_rate, &noise::Settings::default());
    let Some(scatter) = scatter else { return Vec::new() };
    let mut found = Vec::new();
    for &(index, point, rate) in &turning {
        let sense = (point.v_right - point.v_left).signum();
        let driven_less = turning.iter().filter(|(other_index, other, _)| {
            *other_index != index
                && sense * other.v_right <= sense * point.v_right
                && sense * other.v_left >= sense * point.v_left
        });
        let fastest = driven_less.max_by(|a, b| (sense * a.2).total_cmp(&(sense * b.2)));
        let Some(&(than, _, other_rate)) = fastest else { continue };
        let shortfall = sense * (other_rate - rate);
        let certainty = shortfall / (scatter * std::f64::consts::SQRT_2);
        if point.v_right != point.v_left && certainty > MIN_SHORTFALL {
            found.push(Lagging { point: index, than, shortfall, certainty });
        }
    }
    found
}

//! Curves over time: broken at gaps, and with no more points than columns of pixels show.

use crate::colour::INK;
use crate::figure::{Axis, Panel};
use crate::ticks::number;
use trackdyn_core::robust::{quantile, usual_interval};
use trackdyn_estimate::Rate;

/// Intervals between readings above which a curve is broken, in usual ones.
const MAX_INTERVAL: f64 = 5.0;

/// Share of the values that an axis shows in any case.
const SHOWN_SHARE: f64 = 0.99;

/// Values beyond this many times the quantile of [`SHOWN_SHARE`] would flatten all others.
const MAX_RATIO: f64 = 4.0;

/// Range of the values that are shown, and what lies beyond.
pub(super) struct Limits {
    range: [f64; 2],
    beyond: usize,
    largest: f64,
}

impl Limits {
    /// Limits that show all values, unless a few are so large that the others could not be seen.
    pub(super) fn of(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        let largest = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let mut sizes: Vec<f64> = values.iter().map(|value| value.abs()).collect();
        let usual = quantile(&mut sizes, SHOWN_SHARE).unwrap_or(0.0);
        let limit = if usual > 0.0 && largest > MAX_RATIO * usual {
            MAX_RATIO / 2.0 * usual
        } else {
            largest
        };
        let [low, high] = values.iter().fold([0.0_f64; 2], |[low, high], value| {
            [low.min(value.max(-limit)), high.max(value.min(limit))]
        });
        let room = if high > low { 0.08 * (high - low) } else { 1.0 };
        let beyond = values.iter().filter(|value| value.abs() > limit).count();
        Self { range: [low - room, high + room], beyond, largest }
    }

    /// The axis.
    pub(super) fn axis(&self, quantity: &str, unit: &str) -> Axis {
        Axis::new(quantity, unit, self.range)
    }

    /// A value, at the edge of the panel where it lies beyond.
    pub(super) fn clamp(&self, value: f64) -> f64 {
        value.clamp(self.range[0], self.range[1])
    }

    /// Says above a panel what lies beyond it.
    pub(super) fn note(&self, panel: &mut Panel) {
        if self.beyond > 0 {
            let (beyond, unit) = (self.beyond, &panel.y.unit);
            let values = if beyond == 1 { "value" } else { "values" };
            let largest = number(self.largest, 1);
            panel.remark = format!("{beyond} {values} beyond the edge, up to {largest} {unit}");
            let edges = self.range.map(|edge| vec![[0.0, edge], [panel.x.range[1], edge]]);
            for points in edges {
                panel.show(crate::figure::Line { points, thickness: 6.0, colour: INK });
            }
        }
    }
}

/// Curves through readings, one for each stretch without a gap.
pub(super) fn readings(points: &[[f64; 2]], column: f64) -> Vec<Vec<[f64; 2]>> {
    let longest = MAX_INTERVAL * usual_interval(points.iter().map(|point| point[0]));
    let pieces = points.chunk_by(|a, b| b[0] - a[0] <= longest);
    pieces.map(|piece| thinned(piece, column)).collect()
}

/// Curves that are level over each segment, one for each stretch of segments that follow one
/// another.
pub(super) fn steps(
    rates: &[Rate],
    start: f64,
    value: &dyn Fn(&Rate) -> f64,
    column: f64,
) -> Vec<Vec<[f64; 2]>> {
    let stretches = rates.chunk_by(|_, next| next.follows);
    let stretches = stretches.map(|rates| {
        let level = |rate: &Rate| {
            let value = value(rate);
            [[start + rate.start, value], [start + rate.end, value]]
        };
        thinned(&rates.iter().flat_map(level).collect::<Vec<_>>(), column)
    });
    stretches.collect()
}

/// The first, lowest, highest and last point of each column of pixels: they look like all.
fn thinned(points: &[[f64; 2]], column: f64) -> Vec<[f64; 2]> {
    let of = |point: &[f64; 2]| (point[0] / column).floor();
    let mut kept = Vec::new();
    for points in points.chunk_by(|a, b| of(a) == of(b)) {
        if points.len() <= 4 {
            kept.extend_from_slice(points);
            continue;
        }
        let by_value = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
        let ends = [points.first(), points.last()];
        let extremes = [points.iter().min_by(by_value), points.iter().max_by(by_value)];
        let mut few: Vec<[f64; 2]> = ends.into_iter().chain(extremes).flatten().copied().collect();
        few.sort_by(|a, b| a[0].total_cmp(&b[0]));
        kept.extend(few);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_points_keep_ends_and_extremes() {
        let points: Vec<[f64; 2]> =
            (0..1000).map(|k| [0.001 * f64::from(k), if k == 333 { 9.0 } else { 0.0 }]).collect();
        let few = thinned(&points, 0.1);
        assert!(few.len() <= 44, "{}", few.len());
        assert!(few.contains(&points[333]) && few.contains(&points[0]));
        assert_eq!(few.last(), points.last());
    }

    #[test]
    fn curves_are_broken_at_gaps() {
        let points = [0.0, 1.0, 2.0, 9.0, 10.0].map(|t| [t, 0.0]);
        let lengths: Vec<usize> = readings(&points, 0.1).iter().map(Vec::len).collect();
        assert_eq!(lengths, [3, 2]);
    }

    #[test]
    fn a_few_large_values_do_not_flatten_the_others() {
        let values = (0..1000).map(|k| if k == 5 { -300.0 } else { f64::from(k % 10) / 10.0 });
        let limits = Limits::of(values);
        assert!(limits.range[1] < 3.0 && limits.range[0] > -3.0, "{:?}", limits.range);
        assert_eq!((limits.beyond, limits.largest), (1, 300.0));
        let none = Limits::of(std::iter::empty());
        assert_eq!((none.range, none.beyond), ([-1.0, 1.0], 0));
    }
}

//! What is taken as independent of one another.

use super::Part;
use nalgebra::DMatrix;
use std::collections::BTreeMap;
use trackdyn_recording::OperatingPoint;

/// Smallest number of groups beyond that of the parameters for a jackknife.
const MIN_SPARE_GROUPS: usize = 5;

/// Points that are left out together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// Each by itself.
    Points,
    /// Those with the same left track speed.
    LeftSpeed,
    /// Those with the same right track speed.
    RightSpeed,
}

impl Grouping {
    const ALL: [Self; 3] = [Self::Points, Self::LeftSpeed, Self::RightSpeed];

    /// In words, for messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Points => "points",
            Self::LeftSpeed => "left track speeds",
            Self::RightSpeed => "right track speeds",
        }
    }

    /// What tells the groups apart; a tenth of a millimetre per second is the same speed.
    fn key(self, index: usize, point: &OperatingPoint) -> i64 {
        #[expect(clippy::cast_possible_truncation, reason = "speeds of robots")]
        let speed = |speed: f64| (speed * 1e4).round() as i64;
        match self {
            Self::Points => i64::try_from(index).unwrap_or(i64::MAX),
            Self::LeftSpeed => speed(point.v_left),
            Self::RightSpeed => speed(point.v_right),
        }
    }
}

/// The grouping whose covariance is the widest, the number of its groups, and that covariance.
pub(super) fn widest(
    points: &[OperatingPoint],
    parts: &[Part],
    covariance: impl Fn(&[Part]) -> DMatrix<f64>,
) -> (Grouping, usize, DMatrix<f64>) {
    let of = |grouping: Grouping| {
        let mut groups: BTreeMap<i64, Part> = BTreeMap::new();
        for (index, (point, part)) in points.iter().zip(parts).enumerate() {
            groups
                .entry(grouping.key(index, point))
                .and_modify(|sum| {
                    sum.0 += &part.0;
                    sum.1 += &part.1;
                })
                .or_insert_with(|| part.clone());
        }
        let groups: Vec<Part> = groups.into_values().collect();
        (grouping, groups.len(), covariance(&groups))
    };
    let single = of(Grouping::Points);
    let parameters = single.2.nrows();
    // Variances in those of the points, summed: no unit.
    let width = |covariance: &DMatrix<f64>| -> f64 {
        (0..parameters).map(|k| covariance[(k, k)] / single.2[(k, k)].max(f64::MIN_POSITIVE)).sum()
    };
    let others = Grouping::ALL[1..].iter().map(|grouping| of(*grouping));
    let wider = others
        .filter(|(_, count, _)| *count >= parameters + MIN_SPARE_GROUPS)
        .max_by(|a, b| width(&a.2).total_cmp(&width(&b.2)))
        .filter(|(_, _, covariance)| width(covariance) > width(&single.2));
    wider.unwrap_or(single)
}

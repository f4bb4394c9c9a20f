//! Sectors of the speed plane in which a map is nearly constant.

use crate::icr::Icrs;
use crate::map::{IcrMap, Statistics};
use std::collections::BTreeMap;
use trackdyn_core::{PerSide, real};

/// Largest standard deviation of equal ICRs, m: rounding of the solver, with a margin.
const ICR_ROUNDING: f64 = 1e-9;

/// The ICRs of one sector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sector {
    /// Signs (−1, 0, 1) of V_l, V_r and |V_r| − |V_l|.
    pub signs: [i8; 3],
    /// Means and standard deviations of its motions.
    pub statistics: Statistics,
}

impl Sector {
    /// The sector of a pair of track speeds.
    pub fn signs_of(speed: PerSide<f64>) -> [i8; 3] {
        let sign = |value: f64| {
            if value == 0.0 {
                0
            } else if value > 0.0 {
                1
            } else {
                -1
            }
        };
        [sign(speed.left), sign(speed.right), sign(speed.right.abs() - speed.left.abs())]
    }
}

/// Largest share of the variance of a coordinate within the sectors of a piecewise map.
const MAX_WITHIN_SHARE: f64 = 0.1;

/// Sectors of a map, if they explain nine tenths of the variance of x_l, x_r or y; empty otherwise.
pub(super) fn sectors(map: &IcrMap) -> Vec<Sector> {
    let Some(whole) = map.statistics() else { return Vec::new() };
    let mut members: BTreeMap<[i8; 3], Vec<Icrs>> = BTreeMap::new();
    for solution in map.turning() {
        let icrs = members.entry(Sector::signs_of(solution.track_speed)).or_default();
        icrs.extend(solution.icrs);
    }
    let sectors: Vec<Sector> = members
        .into_iter()
        .filter_map(|(signs, icrs)| {
            let statistics = Statistics::of(icrs.into_iter(), map.gauge)?;
            Some(Sector { signs, statistics })
        })
        .collect();
    let explained = (0..3).any(|k| {
        let variance = whole.spread.to_array()[k].powi(2);
        let within: f64 = sectors
            .iter()
            .map(|sector| {
                count(&sector.statistics) * sector.statistics.spread.to_array()[k].powi(2)
            })
            .sum();
        // Each sector takes one degree of freedom: otherwise few pairs of speeds would always be
        // explained.
        let free = count(&whole) - real(sectors.len());
        variance > ICR_ROUNDING.powi(2) && within < MAX_WITHIN_SHARE * variance * free
    });
    if explained { sectors } else { Vec::new() }
}

#[expect(clippy::cast_precision_loss, reason = "at most four million pairs")]
fn count(statistics: &Statistics) -> f64 {
    statistics.count as f64
}

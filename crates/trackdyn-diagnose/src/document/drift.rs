//! Drift of dead reckoning, in units of driving.

use super::DIGITS;
use crate::drift::{Compared, Drift};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use trackdyn_estimate::odometry::Estimate;

/// Drift of dead reckoning with the vehicle as filed and as corrected.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct DriftTable {
    /// Error of place over 100 m of driving, m; absent where too little was driven.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place_m_per_100_m: Option<ComparedTable>,
    /// Error of yaw over a turn of 360 degrees, degrees; absent where too little was turned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yaw_deg_per_turn: Option<ComparedTable>,
}

/// A drift before and after, over the same pieces of the runs.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct ComparedTable {
    /// With the vehicle as filed.
    pub before: f64,
    /// Its 95 % interval; absent where too few blocks have pieces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub before95: Option<[f64; 2]>,
    /// With the corrected vehicle.
    pub after: f64,
    /// Its 95 % interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub after95: Option<[f64; 2]>,
    /// What the noise of the poses alone makes of both.
    pub pose_noise: f64,
    /// Number of pieces.
    pub pieces: usize,
    /// Length of a piece, m; of the yaw, turns.
    pub piece: f64,
}

impl DriftTable {
    /// Whether the corrected vehicle surely drifts more in place or in yaw. Then the way it drives
    /// contradicts the evidence that it was fitted to.
    pub fn is_worse(&self) -> bool {
        let Self { place_m_per_100_m: place, yaw_deg_per_turn: yaw } = self;
        place.iter().chain(yaw).any(ComparedTable::is_worse)
    }

    /// Whether nothing is known of either.
    pub(crate) fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// The table of a drift.
    pub fn of(drift: &Drift) -> Self {
        Self {
            place_m_per_100_m: drift.place.map(|place| ComparedTable::of(place, 100.0, 1.0)),
            yaw_deg_per_turn: drift.yaw.map(|yaw| ComparedTable::of(yaw, 360.0, TAU)),
        }
    }
}

impl ComparedTable {
    /// Whether the interval after lies above that before.
    pub fn is_worse(&self) -> bool {
        let both = self.before95.zip(self.after95);
        both.is_some_and(|([_, before], [after, _])| after > before)
    }

    /// The table of a drift over a way of `over`; pieces are counted in `unit`.
    fn of(compared: Compared, over: f64, unit: f64) -> Self {
        let Compared { before, after, pose_noise, pieces, length } = compared;
        let value = |of: Estimate| DIGITS.round(over * of.value);
        let ends =
            |of: Estimate| of.interval().map(|ends| ends.map(|end| DIGITS.round(over * end)));
        Self {
            before: value(before),
            before95: ends(before),
            after: value(after),
            after95: ends(after),
            pose_noise: DIGITS.round(over * pose_noise),
            pieces,
            piece: DIGITS.round(length / unit),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_is_worse_where_the_intervals_part() {
        let table = |after: f64, half: f64| ComparedTable {
            before: 1.0,
            before95: Some([0.8, 1.2]),
            after,
            after95: Some([after - half, after + half]),
            pose_noise: 0.1,
            pieces: 20,
            piece: 1.0,
        };
        let of = |place, yaw| DriftTable { place_m_per_100_m: place, yaw_deg_per_turn: yaw };
        assert!(of(Some(table(7.0, 2.0)), None).is_worse());
        assert!(of(Some(table(0.4, 0.1)), Some(table(1.6, 0.2))).is_worse());
        assert!(!of(Some(table(1.6, 0.5)), Some(table(0.5, 0.1))).is_worse());
        let unknown = ComparedTable { after95: None, ..table(9.0, 1.0) };
        assert!(!of(Some(unknown), None).is_worse());
    }
}

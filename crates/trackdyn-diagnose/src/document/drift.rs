//! Drift of dead reckoning, in units of driving.

use super::rounded;
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
    /// The table of a drift over a way of `over`; pieces are counted in `unit`.
    fn of(compared: Compared, over: f64, unit: f64) -> Self {
        let Compared { before, after, pose_noise, pieces, length } = compared;
        let value = |of: Estimate| rounded(over * of.value);
        let ends = |of: Estimate| of.interval().map(|ends| ends.map(|end| rounded(over * end)));
        Self {
            before: value(before),
            before95: ends(before),
            after: value(after),
            after95: ends(after),
            pose_noise: rounded(over * pose_noise),
            pieces,
            piece: rounded(length / unit),
        }
    }
}

//! The ICRs of both tracks over the whole map.

use crate::colour::DARK_PLASMA;
use crate::figure::{Cloud, Scale};
use trackdyn_core::{PerSide, Side};
use trackdyn_model::IcrMap;

/// The ICRs of both tracks.
pub(super) struct Clouds {
    /// Places of each track's ICRs, m.
    pub places: PerSide<Vec<[f64; 2]>>,
    /// The larger track speed of each, m/s.
    speeds: Vec<f64>,
    /// Colours of the speeds.
    pub scale: Scale,
}

impl Clouds {
    /// The clouds of a map.
    pub(super) fn of(map: &IcrMap) -> Self {
        let turning = || map.turning().filter_map(|solution| Some((solution, solution.icrs?)));
        let places = |side| {
            let x = turning().map(|(_, icrs)| match side {
                Side::Left => [icrs.x_left, icrs.y],
                Side::Right => [icrs.x_right, icrs.y],
            });
            x.collect()
        };
        let speeds = turning().map(|(solution, _)| {
            let speed = solution.track_speed;
            speed.left.abs().max(speed.right.abs())
        });
        Self {
            places: PerSide::from_fn(places),
            speeds: speeds.collect(),
            scale: Scale::new(DARK_PLASMA, [0.0, map.grid.max_speed()], "m/s"),
        }
    }

    /// The cloud of one track. Slow motions lie above fast ones: these are where the base model has
    /// them, and fast ones around.
    pub(super) fn cloud(&self, side: Side, place: impl Fn([f64; 2]) -> [f64; 2]) -> Cloud {
        Cloud {
            points: self.places[side].iter().map(|&at| place(at)).collect(),
            values: self.speeds.clone(),
            scale: self.scale.clone(),
        }
    }
}

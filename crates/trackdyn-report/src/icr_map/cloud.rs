//! The ICRs of one track over the whole map.

use crate::canvas::Canvas;
use crate::colour::{DARK_PLASMA, LAST};
use crate::panel::Panel;
use trackdyn_core::Side;
use trackdyn_model::IcrMap;

/// The ICRs of one track.
#[derive(Clone, Debug)]
pub(super) struct Cloud {
    /// Places, m, each with the larger track speed as a share (0 to [`LAST`]) of the largest of the map.
    points: Vec<([f64; 2], u8)>,
}

impl Cloud {
    /// The cloud of one side's ICRs.
    pub(super) fn of(map: &IcrMap, side: Side) -> Self {
        let level = f64::from(LAST) / map.grid.max_speed();
        let points = map
            .turning()
            .filter_map(|solution| {
                let icrs = solution.icrs?;
                let x = match side {
                    Side::Left => icrs.x_left,
                    Side::Right => icrs.x_right,
                };
                let speed = solution.track_speed.left.abs().max(solution.track_speed.right.abs());
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a small whole number"
                )]
                let level = (speed * level).round() as u8;
                Some(([x, icrs.y], level))
            })
            .collect();
        Self { points }
    }

    /// Places of the ICRs, m.
    pub(super) fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        self.points.iter().map(|&(place, _)| place)
    }

    /// Draws a dot for each ICR, slow motions over fast ones: these lie where the base model has them,
    /// and fast ones around.
    pub(super) fn draw(&self, canvas: &mut Canvas, panel: &Panel) {
        let colours = DARK_PLASMA.table();
        // Dots of one speed on one pixel look alike: one of them will do. Slowness, row and column in
        // one number sort fast.
        let mut dots: Vec<u64> = self
            .points
            .iter()
            .filter(|(place, _)| panel.contains(*place))
            .map(|&(place, level)| {
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "places inside the panel"
                )]
                let [column, row] = panel.pixel(place).map(|pixel| pixel.round() as u64);
                u64::from(LAST - level) << 32 | row << 16 | column
            })
            .collect();
        dots.sort_unstable();
        dots.dedup();
        let radius = match dots.len() {
            ..=300 => 6.0,
            301..=4000 => 4.0,
            _ => 2.5,
        };
        let dots = dots.into_iter().map(|dot| {
            let [.., slowness, row_high, row_low, column_high, column_low] = dot.to_be_bytes();
            let place = |high, low| i32::from(u16::from_be_bytes([high, low]));
            let centre = [place(column_high, column_low), place(row_high, row_low)];
            (centre, colours[usize::from(LAST - slowness)])
        });
        canvas.clip(panel.plot, |canvas| canvas.dots(radius, dots));
    }
}

//! One coordinate of the ICRs over the track speeds.

use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{LAST, Rgb, VIRIDIS};
use crate::colour_bar;
use crate::panel::{Labels, Panel};
use trackdyn_model::{IcrMap, Status};

/// Side of a map, pixels.
const SIDE: i32 = 370;
/// Smallest range of the colours, m, and relative to the value: rounding must not look like a law.
const LEAST_RANGE: f64 = 1e-3;
/// Range, m, below which a map is called constant.
const CONSTANT: f64 = 1e-6;

/// One coordinate over the speeds.
pub(super) struct HeatMap<'m> {
    map: &'m IcrMap,
    /// Position in [`trackdyn_model::Icrs::NAMES`].
    coordinate: usize,
    /// Smallest and largest value, m; none where the robot never turns.
    extremes: Option<[f64; 2]>,
}

impl<'m> HeatMap<'m> {
    /// The map of xₗ (0), xᵣ (1) or y (2).
    pub(super) fn new(map: &'m IcrMap, coordinate: usize) -> Self {
        let extremes = map
            .turning()
            .filter_map(|solution| solution.icrs)
            .map(|icrs| icrs.to_array()[coordinate])
            .fold(None, |extremes: Option<[f64; 2]>, value| {
                Some(extremes.map_or([value; 2], |[low, high]| [low.min(value), high.max(value)]))
            });
        Self { map, coordinate, extremes }
    }

    /// Range of the colours, m.
    fn range(&self) -> Option<[f64; 2]> {
        let [low, high] = self.extremes?;
        let middle = f64::midpoint(low, high);
        let half = ((high - low) / 2.0).max(LEAST_RANGE / 2.0 * middle.abs().max(1.0));
        Some([middle - half, middle + half])
    }

    /// Draws map and colour bar.
    pub(super) fn draw(&self, canvas: &mut Canvas, [left, top]: [i32; 2]) -> Result<(), Error> {
        const TITLES: [&str; 3] = ["xₗ of left ICRs", "xᵣ of right ICRs", "y of all ICRs"];
        let speeds = self.map.grid.max_speed();
        #[expect(clippy::cast_precision_loss, reason = "at most 2001 points")]
        let half_cell = speeds / (self.map.grid.points() - 1) as f64;
        let ends = [-speeds - half_cell, speeds + half_cell];
        let panel = Panel { plot: Area::new(left, top, SIDE, SIDE), x: ends, y: ends };
        let labels = Labels { title: TITLES[self.coordinate], x: "Vₗ (m/s)", y: "Vᵣ (m/s)" };
        panel.frame(canvas, &labels, false)?;
        self.cells(canvas, panel.plot);
        panel.border(canvas);
        if let Some(range) = self.range() {
            let bar = Area::new(panel.plot.right() + 18, top, 28, SIDE);
            colour_bar::draw(canvas, bar, &VIRIDIS, range, "m");
        }
        panel.remark(
            canvas,
            match self.extremes {
                None => "never turns",
                Some([low, high]) if high - low < CONSTANT => "constant",
                Some(_) => "",
            },
        );
        Ok(())
    }

    /// Fills the plot pixel by pixel.
    fn cells(&self, canvas: &mut Canvas, plot: Area) {
        let points = self.map.grid.points();
        let colours = VIRIDIS.table();
        let [low, high] = self.range().unwrap_or([0.0, 1.0]);
        let cells: Vec<Cell> = self
            .map
            .solutions
            .iter()
            .map(|solution| match (solution.status, solution.icrs) {
                (Status::Turning, Some(icrs)) => {
                    let share = (icrs.to_array()[self.coordinate] - low) / (high - low);
                    #[expect(
                        clippy::cast_possible_truncation,
                        clippy::cast_sign_loss,
                        reason = "a small whole number"
                    )]
                    let place = (share * f64::from(LAST)).round() as usize;
                    Cell::Turning(colours[place.min(usize::from(LAST))])
                }
                (status, _) => Cell::Gap(status),
            })
            .collect();
        let side = SIDE.unsigned_abs() as usize;
        let nearest: Vec<usize> = (0..side).map(|pixel| pixel * points / side).collect();
        canvas.paint(plot, |column, row| {
            #[expect(clippy::cast_sign_loss, reason = "inside the plot")]
            let [left, right] =
                [column - plot.left, plot.bottom() - 1 - row].map(|pixel| nearest[pixel as usize]);
            match cells[left * points + right] {
                Cell::Turning(colour) => colour,
                Cell::Gap(status) => gap(status, column, row),
            }
        });
    }
}

/// How a pair of speeds is painted.
#[derive(Clone, Copy)]
enum Cell {
    Turning(Rgb),
    Gap(Status),
}

/// The pattern of motions that are not turns.
pub(super) fn gap(status: Status, column: i32, row: i32) -> Rgb {
    const PALE: Rgb = [222, 222, 222];
    const DARK: Rgb = [120, 120, 120];
    const RED: Rgb = [200, 30, 45];
    const WHITE: Rgb = [255, 255, 255];
    let stripe = |along: i32, period: i32| along.rem_euclid(period) < 3;
    match status {
        Status::Holds(_) if stripe(column + row, 12) => DARK,
        Status::Lifts if stripe(column - row, 12) || stripe(column + row, 12) => DARK,
        Status::Turning | Status::Straight | Status::Holds(_) => PALE,
        Status::Lifts => WHITE,
        Status::NotConverged => RED,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_model::Grid;
    use trackdyn_model::{Circumstance, Effects, Model, VehicleFile};

    const CORNER: [i32; 2] = [150, 60];

    /// The base model's map with an error on every ICR.
    fn with_error(of: impl Fn(usize) -> f64) -> IcrMap {
        let model = Model::new(VehicleFile::auriga_alpha().vehicle, Effects::none());
        let grid = Grid::new(7, 1.0).expect("a grid");
        let mut map = IcrMap::solve(&model, grid, &Circumstance::default(), &|_| {});
        for (k, solution) in map.solutions.iter_mut().enumerate() {
            if let Some(icrs) = &mut solution.icrs {
                icrs.x_left = -0.4 + of(k);
            }
        }
        map
    }

    fn drawn(map: &IcrMap) -> Vec<u8> {
        let mut canvas = Canvas::new(700, 520).expect("a canvas");
        HeatMap::new(map, 0).draw(&mut canvas, CORNER).expect("drawn");
        canvas.to_png().expect("encoded")
    }

    #[test]
    fn rounding_noise_is_invisible_and_a_law_is_not() {
        let constant = drawn(&with_error(|_| 0.0));
        // 1e-7 m: far more than the solver's rounding
        assert!(drawn(&with_error(|k| if k % 2 == 0 { 1e-7 } else { -1e-7 })) == constant);
        assert!(drawn(&with_error(|k| if k % 2 == 0 { 1e-4 } else { -1e-4 })) != constant);
    }

    #[test]
    fn colours_span_at_least_a_millimetre() {
        let range = HeatMap::new(&with_error(|_| 0.0), 0).range().expect("a range");
        assert!((range[1] - range[0] - LEAST_RANGE).abs() < 1e-12);
        let wide = with_error(|k| if k == 1 { 0.3 } else { 0.0 });
        let range = HeatMap::new(&wide, 0).range().expect("a range");
        assert!((range[0] + 0.4).abs() < 1e-12 && (range[1] + 0.1).abs() < 1e-12);
    }

    #[test]
    fn kinds_of_motion_look_different() {
        use trackdyn_core::Side;
        let patterns: Vec<Vec<Rgb>> =
            [Status::Straight, Status::Holds(Side::Left), Status::Lifts, Status::NotConverged]
                .map(|status| (0..144).map(|k| gap(status, k % 12, k / 12)).collect())
                .into();
        for (k, pattern) in patterns.iter().enumerate() {
            assert!(patterns[k + 1..].iter().all(|other| other != pattern));
        }
    }
}

//! One coordinate of the ICRs over the track speeds.

use super::metres;
use crate::colour::{INK, Rgb, VIRIDIS, WHITE};
use crate::figure::{Area, Axis, Cell, Cells, ColourBar, Hatch, Marker, Panel, Points, Shape};
use trackdyn_core::real;
use trackdyn_model::{IcrMap, Status};

/// Side of a map, pixels.
const SIDE: i32 = 370;
/// Smallest range of the colours, m, and relative to the value: rounding must not look like a law.
const MIN_RANGE: f64 = 1e-3;
/// Range, m, below which a map is called constant.
const MAX_CONSTANT_RANGE: f64 = 1e-6;

/// What the sign of motions with part of the contact lifted says.
pub(super) const LIFTED_MEANING: &str = "part of the contact has lifted";

/// The sign of a motion with part of the contact lifted, in a cell of this side (pixels): seen on
/// dark and on bright colours.
pub(super) fn lifted_sign(cell: f64) -> Marker {
    let radius = (0.35 * cell).min(5.0);
    Marker { shape: Shape::Open(radius, radius / 3.0), colour: INK }
}

/// The map of xₗ (0), xᵣ (1) or y (2), with its upper left corner.
pub(super) fn heat_map(map: &IcrMap, coordinate: usize, [left, top]: [i32; 2]) -> Panel {
    const TITLES: [&str; 3] = ["xₗ of left ICRs", "xᵣ of right ICRs", "y of all ICRs"];
    let speeds = map.grid.max_speed();
    let half_cell = speeds / real(map.grid.points() - 1);
    let ends = [-speeds - half_cell, speeds + half_cell];
    let axis = |quantity: &str| Axis::new(quantity, "m/s", ends).without_grid();
    let place = Area::new(left, top, SIDE, SIDE);
    let title = TITLES[coordinate];
    let mut panel = Panel::new(title, place, axis("Vₗ"), axis("Vᵣ"));
    let extremes = extremes(map, coordinate);
    let scale = metres(VIRIDIS, extremes.map_or([0.0, 1.0], range));
    let cells = map.solutions.iter().map(|solution| match (solution.status, solution.icrs) {
        (Status::Turning, Some(icrs)) => Cell::Value(icrs.to_array()[coordinate]),
        (status, _) => Cell::Gap(gap(status)),
    });
    let cells = cells.collect();
    panel.show_as(title, Cells { count: map.grid.points(), cells, scale: scale.clone() });
    let lifted: Vec<[f64; 2]> =
        map.lifted().map(|motion| [motion.track_speed.left, motion.track_speed.right]).collect();
    if !lifted.is_empty() {
        let cell = f64::from(SIDE) / real(map.grid.points());
        panel.show_as(LIFTED_MEANING, Points::new(lifted, lifted_sign(cell)));
    }
    if extremes.is_some() {
        let place = Area::new(place.right() + 18, top, 28, SIDE);
        panel.colour_bars.push(ColourBar { place, scale });
    }
    panel.remark = String::from(match extremes {
        None => "never turns",
        Some([low, high]) if high - low < MAX_CONSTANT_RANGE => "constant",
        Some(_) => "",
    });
    panel
}

/// Smallest and largest value, m; none where the robot never turns.
fn extremes(map: &IcrMap, coordinate: usize) -> Option<[f64; 2]> {
    let icrs = map.turning().filter_map(|solution| solution.icrs);
    icrs.map(|icrs| icrs.to_array()[coordinate]).fold(None, |extremes: Option<[f64; 2]>, value| {
        Some(extremes.map_or([value; 2], |[low, high]| [low.min(value), high.max(value)]))
    })
}

/// Range of the colours, m.
fn range([low, high]: [f64; 2]) -> [f64; 2] {
    let middle = f64::midpoint(low, high);
    let half = ((high - low) / 2.0).max(MIN_RANGE / 2.0 * middle.abs().max(1.0));
    [middle - half, middle + half]
}

/// The pattern of motions that are not turns.
pub(super) const fn gap(status: Status) -> Hatch {
    const PALE_GREY: Rgb = [222, 222, 222];
    const DARK_GREY: Rgb = [120, 120, 120];
    const RED: Rgb = [200, 30, 45];
    match status {
        Status::Turning | Status::Straight => {
            Hatch { paper: PALE_GREY, ink: DARK_GREY, directions: 0 }
        }
        Status::Holds(_) => Hatch { paper: PALE_GREY, ink: DARK_GREY, directions: 1 },
        Status::Tips => Hatch { paper: WHITE, ink: DARK_GREY, directions: 2 },
        Status::NotConverged => Hatch { paper: RED, ink: RED, directions: 0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Figure;
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
        let mut figure = Figure::new("test", [700, 520]);
        figure.panels.push(heat_map(map, 0, CORNER));
        figure.to_png().expect("encoded")
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
        let of = |map: &IcrMap| range(extremes(map, 0).expect("it turns"));
        let narrow = of(&with_error(|_| 0.0));
        assert!((narrow[1] - narrow[0] - MIN_RANGE).abs() < 1e-12);
        let wide = of(&with_error(|k| if k == 1 { 0.3 } else { 0.0 }));
        assert!((wide[0] + 0.4).abs() < 1e-12 && (wide[1] + 0.1).abs() < 1e-12);
    }

    #[test]
    fn kinds_of_motion_look_different() {
        use trackdyn_core::Side;
        let patterns: Vec<Vec<Rgb>> =
            [Status::Straight, Status::Holds(Side::Left), Status::Tips, Status::NotConverged]
                .map(|status| (0..144).map(|k| gap(status).at(k % 12, k / 12)).collect())
                .into();
        for (k, pattern) in patterns.iter().enumerate() {
            assert!(patterns[k + 1..].iter().all(|other| other != pattern));
        }
    }
}

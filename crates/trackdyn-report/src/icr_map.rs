//! The figure of an ICR map.

mod cloud;
mod heading;
mod heat_map;
mod legend;
mod robot;
mod zoom;

use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour_bar;
use cloud::Cloud;
use heat_map::HeatMap;
use trackdyn_core::{PerSide, Side};
use trackdyn_model::IcrMap;
use trackdyn_model::Model;
use trackdyn_model::map::Statistics;

const WIDTH: u16 = 2400;
const HEIGHT: u16 = 1350;
/// Left end of all lines of text.
const LEFT: i32 = 40;

const ROBOT: Area = Area::new(LEFT + 118, 258, 700, 500);
const SPEED_BAR: Area = Area::new(880, 258, 28, 500);
const ZOOM: PerSide<Area> =
    PerSide::new(Area::new(LEFT + 118, 900, 340, 280), Area::new(640, 900, 340, 280));
/// Upper left corners of the heat maps of xₗ, xᵣ and y.
const HEAT_MAPS: [[i32; 2]; 3] = [[1158, 258], [1824, 258], [1158, 800]];
const LEGEND: Area = Area::new(1740, 768, 620, 512);

/// The ICR map as a picture: the robot from above with the ICRs of both tracks, as in Figs 6-7; both
/// clouds enlarged; and xₗ, xᵣ and y over the track speeds. `caption` stands below, for what the
/// figure was made from.
///
/// Returns the bytes of a PNG. They depend on the arguments only.
///
/// # Errors
/// [`Error`] where a part cannot be drawn; no map is the cause of one.
pub fn icr_map(map: &IcrMap, model: &Model, caption: &str) -> Result<Vec<u8>, Error> {
    let mut canvas = Canvas::new(WIDTH, HEIGHT)?;
    let statistics = map.statistics();
    heading::draw(&mut canvas, map, model, statistics.as_ref(), caption);
    let clouds = PerSide::from_fn(|side| Cloud::of(map, side));
    robot::draw(&mut canvas, model, &clouds, statistics.as_ref())?;
    if let Some(statistics) = &statistics {
        colour_bar::of_speed(&mut canvas, SPEED_BAR, map.grid.max_speed());
        let half = zoom::half_extent(&clouds, statistics);
        for side in Side::BOTH {
            zoom::draw(&mut canvas, ZOOM[side], &clouds[side], side, statistics, half)?;
        }
    }
    for (k, corner) in HEAT_MAPS.into_iter().enumerate() {
        HeatMap::new(map, k).draw(&mut canvas, corner)?;
    }
    legend::draw(&mut canvas, LEGEND, map, statistics.as_ref());
    canvas.to_png()
}

/// The place of one track's ICR of the mean.
fn mean_of(statistics: &Statistics, side: Side) -> [f64; 2] {
    let mean = statistics.mean;
    [[mean.x_left, mean.x_right][usize::from(side == Side::Right)], mean.y]
}

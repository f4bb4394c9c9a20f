//! The figure of an ICR map.

mod clouds;
mod heading;
mod heat_map;
mod legend;
mod robot;
mod zoom;

use crate::figure::{Area, ColourBar, Figure, Label, Panel, Scale};
use crate::text::{Horizontal, Style, TICK_SIZE, Vertical};
use clouds::Clouds;
use heat_map::heat_map;
use trackdyn_core::{PerSide, Side};
use trackdyn_model::IcrMap;
use trackdyn_model::Model;
use trackdyn_model::map::Statistics;

const WIDTH: i32 = 2400;
const HEIGHT: i32 = 1350;
/// Left end of all lines of text.
const LEFT: i32 = 40;

const ROBOT: Area = Area::new(LEFT + 118, 258, 700, 500);
const SPEED_BAR: Area = Area::new(880, 258, 28, 500);
const ZOOM: PerSide<Area> =
    PerSide::new(Area::new(LEFT + 118, 900, 340, 280), Area::new(640, 900, 340, 280));
/// Upper left corners of the heat maps of xₗ, xᵣ and y.
const HEAT_MAPS: [[i32; 2]; 3] = [[1158, 258], [1824, 258], [1158, 800]];
const LEGEND: Area = Area::new(1740, 768, 620, 512);

/// The ICR map as a picture: the robot from above with the ICRs of both tracks, as in Figs 6-7;
/// both clouds enlarged; and xₗ, xᵣ and y over the track speeds. `caption` stands below, for what
/// the figure was made from.
pub fn icr_map(map: &IcrMap, model: &Model, caption: &str) -> Figure {
    let mut figure = Figure::new("icr_map", [WIDTH, HEIGHT]);
    let statistics = map.statistics();
    heading::write(&mut figure, map, model, statistics.as_ref(), caption);
    let clouds = Clouds::of(map);
    let mut robot = robot::panel(model, &clouds, statistics.as_ref());
    if statistics.is_some() {
        robot.labels.push(bar_label(&robot));
        robot.colour_bars.push(ColourBar { place: SPEED_BAR, scale: clouds.scale.clone() });
    }
    figure.panels.push(robot);
    if let Some(statistics) = &statistics {
        let half = zoom::half_extent(&clouds, statistics);
        for side in Side::BOTH {
            figure.panels.push(zoom::panel(ZOOM[side], &clouds, side, statistics, half));
        }
    }
    for (k, corner) in HEAT_MAPS.into_iter().enumerate() {
        figure.panels.push(heat_map(map, k, corner));
    }
    figure.panels.extend(legend::panels(LEGEND, map, statistics.as_ref()));
    figure
}

/// What the colours of clouds mean, right of their bar.
fn bar_label(robot: &Panel) -> Label {
    let style = Style { upwards: true, ..Style::new(TICK_SIZE) };
    let style = style.anchor(Horizontal::Centre, Vertical::Bottom);
    let middle = [robot.x.range[1], f64::midpoint(robot.y.range[0], robot.y.range[1])];
    let right = SPEED_BAR.right() + 98 - ROBOT.right();
    Label::new("larger track speed, max(|Vₗ|, |Vᵣ|)", middle, style).shifted([right, 0])
}

/// A scale of metres.
fn metres(colours: crate::colour::ColourMap, range: [f64; 2]) -> Scale {
    Scale::new(colours, range, "m")
}

/// The place of one track's ICR of the mean.
fn mean_of(statistics: &Statistics, side: Side) -> [f64; 2] {
    let mean = statistics.mean;
    [[mean.x_left, mean.x_right][usize::from(side == Side::Right)], mean.y]
}

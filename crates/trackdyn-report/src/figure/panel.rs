//! Panels: axes around a rectangle of the sheet, and what is shown inside.

use super::{Area, Axis, ColourBar, Series};
use crate::colour::{GREY, INK, Rgb};
use crate::text::{Horizontal, Style, TICK_SIZE, Vertical};
use serde::{Deserialize, Serialize};

/// Part of the size of the main points by which further ones may extend the shown range.
const MAX_EXTENSION: f64 = 0.6;

/// A text at a point of a panel.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Label {
    /// What is written.
    pub text: String,
    /// The point, in the units of the axes.
    pub at: [f64; 2],
    /// Distance from the point to the right and down, pixels.
    pub shift: [i32; 2],
    /// How it looks.
    pub style: Style,
    /// Whether white paper lies below it.
    pub is_on_white: bool,
}

impl Label {
    /// A text at a point.
    pub fn new(text: impl Into<String>, at: [f64; 2], style: Style) -> Self {
        Self { text: text.into(), at, shift: [0, 0], style, is_on_white: false }
    }

    /// A text that ends so many pixels left of a point.
    pub fn left_of(text: &str, at: [f64; 2], by: i32, (size, colour): (f32, Rgb)) -> Self {
        let style = Style::new(size).colour(colour).anchor(Horizontal::Right, Vertical::Middle);
        Self { shift: [-by, 0], ..Self::new(text, at, style) }
    }

    /// A text that begins so many pixels right of a point.
    pub fn right_of(text: &str, at: [f64; 2], by: i32, (size, colour): (f32, Rgb)) -> Self {
        let style = Style::new(size).colour(colour).anchor(Horizontal::Left, Vertical::Middle);
        Self { shift: [by, 0], ..Self::new(text, at, style) }
    }

    /// A text in the middle of a point.
    pub fn on(text: &str, at: [f64; 2], (size, colour): (f32, Rgb)) -> Self {
        let style = Style::new(size).colour(colour).anchor(Horizontal::Centre, Vertical::Middle);
        Self::new(text, at, style)
    }

    /// The text at a distance from its point, pixels to the right and down.
    pub fn shifted(self, shift: [i32; 2]) -> Self {
        Self { shift, ..self }
    }

    /// The text on white paper.
    pub fn on_white(self) -> Self {
        Self { is_on_white: true, ..self }
    }
}

/// A rectangle of the sheet with axes, series and labels.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Panel {
    /// The plot inside the axes.
    pub place: Area,
    /// Above the plot, from its left end.
    pub title: String,
    /// Above the plot, to its right end.
    pub remark: String,
    /// Axis to the right.
    pub x: Axis,
    /// Axis upwards.
    pub y: Axis,
    /// Whether axes and border are drawn.
    pub is_framed: bool,
    /// What is shown, in the order of drawing, with nothing outside the plot.
    pub series: Vec<Series>,
    /// Texts inside and around the plot.
    pub labels: Vec<Label>,
    /// What colours mean.
    pub colour_bars: Vec<ColourBar>,
}

impl Panel {
    /// An empty panel with axes.
    pub fn new(title: &str, place: Area, x: Axis, y: Axis) -> Self {
        Self {
            place,
            title: title.to_owned(),
            remark: String::new(),
            x,
            y,
            is_framed: true,
            series: Vec::new(),
            labels: Vec::new(),
            colour_bars: Vec::new(),
        }
    }

    /// A panel without axes whose units are the pixels of the sheet.
    pub fn of_sheet(place: Area) -> Self {
        let x = Axis::unmarked([f64::from(place.left), f64::from(place.right())]);
        let y = Axis::unmarked([f64::from(place.bottom()), f64::from(place.top)]);
        Self { is_framed: false, ..Self::new("", place, x, y) }
    }

    /// Pixels per unit along x.
    pub fn scale(&self) -> f64 {
        f64::from(self.place.width) / (self.x.range[1] - self.x.range[0])
    }

    /// Column and row of a point.
    pub fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            f64::from(self.place.left) + self.x.share(x) * f64::from(self.place.width),
            f64::from(self.place.bottom()) - self.y.share(y) * f64::from(self.place.height),
        ]
    }

    /// The pixels of a rectangle from its lower left to its upper right corner.
    #[expect(clippy::cast_possible_truncation, reason = "places on the sheet")]
    pub fn area(&self, [lower_left, upper_right]: [[f64; 2]; 2]) -> Area {
        let [left, bottom] = self.pixel(lower_left).map(|place| place.round() as i32);
        let [right, top] = self.pixel(upper_right).map(|place| place.round() as i32);
        Area::new(left, top, right - left, bottom - top)
    }

    /// Whether a point lies inside.
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        self.x.contains(x) && self.y.contains(y)
    }

    /// Adds what is shown.
    pub fn show(&mut self, series: impl Into<Series>) {
        self.series.push(series.into());
    }

    /// Adds what is shown under a name.
    pub fn show_as(&mut self, name: &str, series: impl Into<Series>) {
        let series = Series { name: name.to_owned(), ..series.into() };
        self.series.push(series);
    }

    /// Says in the middle of the plot why nothing is in it.
    pub fn explain_emptiness(&mut self, reason: &str) {
        let [x, y] = [&self.x, &self.y].map(|axis| f64::midpoint(axis.range[0], axis.range[1]));
        self.labels.push(Label::on(reason, [x, y], (TICK_SIZE, GREY)));
    }

    /// Writes a name in ink left of a point.
    pub fn name(&mut self, text: &str, at: [f64; 2], by: i32) {
        self.labels.push(Label::left_of(text, at, by, (TICK_SIZE, INK)));
    }
}

/// Ranges of x and y that show at least these, with one scale on both axes of a plot.
pub fn equal_scale(place: Area, x: [f64; 2], y: [f64; 2]) -> [[f64; 2]; 2] {
    let (width, height) = (f64::from(place.width), f64::from(place.height));
    let per_pixel = ((x[1] - x[0]) / width).max((y[1] - y[0]) / height);
    let around = |[low, high]: [f64; 2], pixels: f64| {
        let middle = f64::midpoint(low, high);
        [middle - per_pixel * pixels / 2.0, middle + per_pixel * pixels / 2.0]
    };
    [around(x, width), around(y, height)]
}

/// Ranges with one scale that show the main points, and further ones that are not too far away.
pub fn around(
    place: Area,
    main: impl IntoIterator<Item = [f64; 2]>,
    further: impl IntoIterator<Item = [f64; 2]>,
) -> [[f64; 2]; 2] {
    let mut ranges = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let take = |ranges: &mut [[f64; 2]; 2], k: usize, value: f64| {
        ranges[k] = [ranges[k][0].min(value), ranges[k][1].max(value)];
    };
    for point in main {
        take(&mut ranges, 0, point[0]);
        take(&mut ranges, 1, point[1]);
    }
    let size =
        |ranges: &[[f64; 2]; 2]| ranges.iter().map(|[low, high]| high - low).fold(0.05, f64::max);
    let beyond = MAX_EXTENSION * size(&ranges);
    let limits = ranges.map(|[low, high]| [low - beyond, high + beyond]);
    for point in further {
        for k in 0..2 {
            take(&mut ranges, k, point[k].clamp(limits[k][0], limits[k][1]));
        }
    }
    let room = 0.06 * size(&ranges);
    let [x, y] = ranges.map(|[low, high]| [low - room, high + room]);
    equal_scale(place, x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_scale_keeps_what_it_must_show() {
        let place = Area::new(100, 50, 400, 200);
        let [x, y] = equal_scale(place, [-1.0, 1.0], [0.0, 3.0]);
        assert_eq!([x, y], [[-3.0, 3.0], [0.0, 3.0]]);
        let panel = Panel::new("", place, Axis::new("x", "m", x), Axis::new("y", "m", y));
        assert_eq!(panel.pixel([0.0, 0.0]), [300.0, 250.0]);
        assert_eq!(panel.area([[-3.0, 0.0], [3.0, 3.0]]), place);
        assert!(panel.contains([2.9, 0.1]) && !panel.contains([0.0, 3.1]));
    }

    #[test]
    fn a_panel_of_the_sheet_counts_pixels() {
        let panel = Panel::of_sheet(Area::new(40, 30, 100, 50));
        assert_eq!(panel.pixel([41.0, 32.0]), [41.0, 32.0]);
        assert_eq!(panel.area([[50.0, 60.0], [70.0, 40.0]]), Area::new(50, 40, 20, 20));
    }
}

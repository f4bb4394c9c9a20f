//! Axes around a rectangle of the canvas.

pub mod ticks;

use crate::Error;
use crate::brush::Brush;
use crate::canvas::{Area, Canvas};
use crate::colour::{FRAME, GREY, GRID, INK, Rgb};
use crate::text::{Horizontal, Style, Vertical};
use plotters::coord::ranged1d::ValueFormatter;
use plotters::prelude::*;
use ticks::{Axis, Ticks};

/// Size of numbers at ticks, pixels.
pub const TICK_SIZE: f32 = 24.0;
/// Size of axis labels, pixels.
pub const LABEL_SIZE: f32 = 26.0;
/// Size of a panel's title, pixels.
pub const TITLE_SIZE: f32 = 28.0;

/// Room left of the plot for numbers and label, pixels.
pub const LEFT: i32 = 118;
/// Room below the plot for numbers and label, pixels.
pub const BELOW: i32 = 84;
/// Distance from the title's baseline to the plot, pixels.
const ABOVE: i32 = 16;

/// What else is shown may leave the box of the main thing by this share of its size.
const BEYOND: f64 = 0.6;

/// A rectangle of the canvas with the ranges that it shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Panel {
    /// The plot inside the axes.
    pub plot: Area,
    /// Left and right end.
    pub x: [f64; 2],
    /// Lower and upper end.
    pub y: [f64; 2],
}

/// Texts around a panel.
#[derive(Clone, Copy, Debug)]
pub struct Labels<'a> {
    /// Above the plot, from its left end.
    pub title: &'a str,
    /// Below.
    pub x: &'a str,
    /// At the left, upwards.
    pub y: &'a str,
}

impl Panel {
    /// The panel that shows at least these ranges, with the same scale on both axes.
    pub fn equal_scale(plot: Area, x: [f64; 2], y: [f64; 2]) -> Self {
        let (width, height) = (f64::from(plot.width), f64::from(plot.height));
        let per_pixel = ((x[1] - x[0]) / width).max((y[1] - y[0]) / height);
        let around = |[low, high]: [f64; 2], pixels: f64| {
            let middle = f64::midpoint(low, high);
            [middle - per_pixel * pixels / 2.0, middle + per_pixel * pixels / 2.0]
        };
        Self { plot, x: around(x, width), y: around(y, height) }
    }

    /// The panel with equal scales that shows the main points, and further ones that are not too far
    /// away.
    pub fn around(
        plot: Area,
        main: impl IntoIterator<Item = [f64; 2]>,
        further: impl IntoIterator<Item = [f64; 2]>,
    ) -> Self {
        let mut ranges = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let take = |ranges: &mut [[f64; 2]; 2], k: usize, value: f64| {
            ranges[k] = [ranges[k][0].min(value), ranges[k][1].max(value)];
        };
        for point in main {
            take(&mut ranges, 0, point[0]);
            take(&mut ranges, 1, point[1]);
        }
        let size = |ranges: &[[f64; 2]; 2]| {
            ranges.iter().map(|[low, high]| high - low).fold(0.05, f64::max)
        };
        let beyond = BEYOND * size(&ranges);
        let limits = ranges.map(|[low, high]| [low - beyond, high + beyond]);
        for point in further {
            for k in 0..2 {
                take(&mut ranges, k, point[k].clamp(limits[k][0], limits[k][1]));
            }
        }
        let room = 0.06 * size(&ranges);
        let [x, y] = ranges.map(|[low, high]| [low - room, high + room]);
        Self::equal_scale(plot, x, y)
    }

    /// Pixels per unit along x.
    pub fn scale(&self) -> f64 {
        f64::from(self.plot.width) / (self.x[1] - self.x[0])
    }

    /// Column and row of a point.
    pub fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let share = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        [
            f64::from(self.plot.left) + share(x, self.x) * f64::from(self.plot.width),
            f64::from(self.plot.bottom()) - share(y, self.y) * f64::from(self.plot.height),
        ]
    }

    /// The pixels of a rectangle from its lower left to its upper right corner.
    #[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
    pub fn area(&self, lower_left: [f64; 2], upper_right: [f64; 2]) -> Area {
        let [left, bottom] = self.pixel(lower_left).map(|place| place.round() as i32);
        let [right, top] = self.pixel(upper_right).map(|place| place.round() as i32);
        Area::new(left, top, right - left, bottom - top)
    }

    /// Whether a point lies inside.
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        (self.x[0]..=self.x[1]).contains(&x) && (self.y[0]..=self.y[1]).contains(&y)
    }

    /// Draws axes, numbers and labels; `grid` lines only where points shall be read off.
    ///
    /// # Errors
    /// [`Error::Axes`].
    pub fn frame(&self, canvas: &mut Canvas, labels: &Labels, grid: bool) -> Result<(), Error> {
        let Area { left, top, width, height } = self.plot;
        let x = self.axis_across(canvas);
        let y = Axis::new(self.y, Ticks::along(self.y, height, 60));
        let (x_label, y_label) = (x.label(labels.x), y.label(labels.y));
        {
            let root = Brush(canvas).into_drawing_area();
            let corner = (left - LEFT, top);
            let mut chart = ChartBuilder::on(&root.shrink(corner, (width + LEFT, height + BELOW)))
                .x_label_area_size(BELOW)
                .y_label_area_size(LEFT)
                .build_cartesian_2d(x, y)?;
            let mut mesh = chart.configure_mesh();
            if !grid {
                mesh.disable_mesh();
            }
            mesh.bold_line_style(plain(GRID))
                .axis_style(plain(FRAME))
                .set_all_tick_mark_size(8)
                .label_style(font(TICK_SIZE, GREY))
                .axis_desc_style(font(LABEL_SIZE, INK))
                .x_desc(x_label)
                .y_desc(y_label)
                .draw()?;
        }
        let title = Style::new(TITLE_SIZE).anchor(Horizontal::Left, Vertical::Baseline);
        canvas.text(labels.title, [left, top - ABOVE], &title);
        self.border(canvas);
        Ok(())
    }

    /// The axis along x, with as many numbers as there is room for.
    fn axis_across(&self, canvas: &Canvas) -> Axis {
        const GAP: f64 = 18.0;
        let mut spacing = 40;
        let mut denser: Option<Ticks> = None;
        loop {
            let axis = Axis::new(self.x, Ticks::along(self.x, self.plot.width, spacing));
            let Ticks { values, step, .. } = &axis.ticks;
            let widths =
                values.iter().map(|value| canvas.text_width(&axis.format_ext(value), TICK_SIZE));
            if widths.max().is_none_or(|widest| step * self.scale() >= f64::from(widest) + GAP) {
                // One number alone does not tell the scale
                return match denser {
                    Some(denser) if values.len() < 2 => Axis::new(self.x, denser.every_second()),
                    _ => axis,
                };
            }
            spacing += spacing / 4;
            denser = Some(axis.ticks);
        }
    }

    /// Draws the border again, over what was drawn inside.
    pub fn border(&self, canvas: &mut Canvas) {
        let Area { left, top, width, height } = self.plot;
        canvas.outline(Area::new(left - 1, top - 1, width + 2, height + 2), 2, FRAME);
    }

    /// Writes at the right end of the title's line.
    pub fn remark(&self, canvas: &mut Canvas, text: &str) {
        let style =
            Style::new(TICK_SIZE).colour(GREY).anchor(Horizontal::Right, Vertical::Baseline);
        canvas.text(text, [self.plot.right(), self.plot.top - ABOVE], &style);
    }

    /// In the middle of a plot with nothing in it: why.
    pub fn explain_emptiness(&self, canvas: &mut Canvas, reason: &str) {
        let Area { left, top, width, height } = self.plot;
        let style = Style::new(TICK_SIZE).colour(GREY).anchor(Horizontal::Centre, Vertical::Middle);
        canvas.text(reason, [left + width / 2, top + height / 2], &style);
    }
}

fn plain([r, g, b]: Rgb) -> ShapeStyle {
    ShapeStyle::from(&RGBColor(r, g, b)).stroke_width(1)
}

fn font(size: f32, [r, g, b]: Rgb) -> TextStyle<'static> {
    let color = RGBColor(r, g, b).to_backend_color();
    TextStyle { color, ..TextStyle::from(("sans-serif", f64::from(size))) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_scale_keeps_what_it_must_show() {
        let plot = Area::new(100, 50, 400, 200);
        let panel = Panel::equal_scale(plot, [-1.0, 1.0], [0.0, 3.0]);
        assert_eq!(panel.y, [0.0, 3.0]);
        assert_eq!(panel.x, [-3.0, 3.0]);
        assert_eq!(panel.pixel([0.0, 0.0]), [300.0, 250.0]);
        assert_eq!(panel.area([-3.0, 0.0], [3.0, 3.0]), plot);
        assert!(panel.contains([2.9, 0.1]) && !panel.contains([0.0, 3.1]));
    }
}

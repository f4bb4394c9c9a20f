//! Axes, grids and numbers by `plotters`, on any paper.

use super::paper::Paper;
use crate::Error;
use crate::colour::{FRAME, GREY, GRID, INK, Rgb};
use crate::figure::{Area, Axis, Panel, Ticks as Numbers};
use crate::text::{self, Horizontal, LABEL_SIZE, Style, TICK_SIZE, Vertical};
use crate::ticks::{Ticks, number};
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingErrorKind, FontTransform,
};
use std::convert::Infallible;
use std::ops::Range;

/// Room left of a plot for numbers and label, pixels.
const ROOM_LEFT: i32 = 118;
/// Room below a plot for numbers and label, pixels.
const ROOM_BELOW: i32 = 84;
/// Least distance of numbers upwards, pixels.
const SPACING: i32 = 60;

/// Draws axes, numbers, labels and grid of a panel.
pub(super) fn draw(
    panel: &Panel,
    [width, height]: [i32; 2],
    paper: &mut impl Paper,
) -> Result<(), Error> {
    let Area { left, top, .. } = panel.place;
    let y = match &panel.y.ticks {
        Numbers::Round => Ticks::along(panel.y.range, panel.place.height, SPACING),
        Numbers::At(_) => Ticks::default(),
    };
    let (x, y) = (Scaled::new(&panel.x, across(panel)), Scaled::new(&panel.y, y));
    let size = [width, height].map(i32::unsigned_abs);
    let root = Brush { paper, size: size.into() }.into_drawing_area();
    let corner = (left - ROOM_LEFT, top);
    let area =
        root.shrink(corner, (panel.place.width + ROOM_LEFT, panel.place.height + ROOM_BELOW));
    let mut chart = ChartBuilder::on(&area)
        .x_label_area_size(ROOM_BELOW)
        .y_label_area_size(ROOM_LEFT)
        .build_cartesian_2d(x, y)?;
    let mut mesh = chart.configure_mesh();
    if !panel.x.has_grid {
        mesh.disable_x_mesh();
    }
    if !panel.y.has_grid {
        mesh.disable_y_mesh();
    }
    // finer lines would lie under the others and darken their edges where a picture is scaled
    mesh.light_line_style(TRANSPARENT)
        .bold_line_style(plain(GRID))
        .axis_style(plain(FRAME))
        .set_all_tick_mark_size(8)
        .label_style(font(TICK_SIZE, GREY))
        .axis_desc_style(font(LABEL_SIZE, INK))
        .x_desc(panel.x.label())
        .y_desc(panel.y.label())
        .draw()?;
    Ok(())
}

/// Round numbers along x, as many as there is room for.
fn across(panel: &Panel) -> Ticks {
    const GAP: f64 = 18.0;
    if matches!(panel.x.ticks, Numbers::At(_)) {
        return Ticks::default();
    }
    let mut spacing = 40;
    let mut denser: Option<Ticks> = None;
    loop {
        let axis = Scaled::new(&panel.x, Ticks::along(panel.x.range, panel.place.width, spacing));
        let Ticks { values, step, .. } = &axis.ticks;
        let widths = values.iter().map(|value| text::width(&axis.format_ext(value), TICK_SIZE));
        if widths.max().is_none_or(|widest| step * panel.scale() >= f64::from(widest) + GAP) {
            // One number alone does not tell the scale
            return match denser {
                Some(denser) if values.len() < 2 => denser.every_second(),
                _ => axis.ticks,
            };
        }
        spacing += spacing / 4;
        denser = Some(axis.ticks);
    }
}

/// An axis with its round numbers, as `plotters` asks for it.
#[derive(Clone)]
struct Scaled<'a> {
    axis: &'a Axis,
    ticks: Ticks,
    origin: f64,
}

impl<'a> Scaled<'a> {
    fn new(axis: &'a Axis, ticks: Ticks) -> Self {
        Self { axis, ticks, origin: axis.origin() }
    }
}

impl Ranged for Scaled<'_> {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    #[expect(clippy::cast_possible_truncation, reason = "places on the sheet")]
    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        limit.0 + (self.axis.share(*value) * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _hint: Hint) -> Vec<f64> {
        match &self.axis.ticks {
            Numbers::Round => self.ticks.values.clone(),
            Numbers::At(ticks) => ticks.iter().map(|(value, _)| *value).collect(),
        }
    }

    fn range(&self) -> Range<f64> {
        self.axis.range[0]..self.axis.range[1]
    }
}

impl ValueFormatter<f64> for Scaled<'_> {
    fn format_ext(&self, value: &f64) -> String {
        match &self.axis.ticks {
            Numbers::Round => number(*value - self.origin, self.ticks.decimals),
            Numbers::At(ticks) => {
                let text = ticks.iter().find(|(at, _)| at == value).map(|(_, text)| text.clone());
                text.unwrap_or_default()
            }
        }
    }
}

fn plain([r, g, b]: Rgb) -> ShapeStyle {
    ShapeStyle::from(&RGBColor(r, g, b)).stroke_width(1)
}

fn font(size: f32, [r, g, b]: Rgb) -> TextStyle<'static> {
    let color = RGBColor(r, g, b).to_backend_color();
    TextStyle { color, ..TextStyle::from(("sans-serif", f64::from(size))) }
}

/// What `plotters` draws with.
struct Brush<'p, P> {
    paper: &'p mut P,
    size: (u32, u32),
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

fn rgb(colour: BackendColor) -> Rgb {
    colour.rgb.into()
}

impl<P: Paper> DrawingBackend for Brush<'_, P> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, colour: BackendColor) -> Drawn {
        self.paper.fill(Area::new(x, y, 1, 1), rgb(colour));
        Ok(())
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Drawn {
        if style.color().alpha == 0.0 {
            return Ok(());
        }
        let place = |(x, y): BackendCoord| [f64::from(x), f64::from(y)];
        let colour = rgb(style.color());
        self.paper.line(place(from), place(to), f64::from(style.stroke_width()), colour);
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &S,
        (x, y): BackendCoord,
    ) -> Drawn {
        let anchor = style.anchor();
        let horizontal = match anchor.h_pos {
            HPos::Left => Horizontal::Left,
            HPos::Center => Horizontal::Centre,
            HPos::Right => Horizontal::Right,
        };
        let vertical = match anchor.v_pos {
            VPos::Top => Vertical::Top,
            VPos::Center => Vertical::Middle,
            VPos::Bottom => Vertical::Bottom,
        };
        let upwards = matches!(style.transform(), FontTransform::Rotate270);
        let colour = rgb(style.color());
        let style = Style { upwards, ..size(style).colour(colour).anchor(horizontal, vertical) };
        self.paper.text(text, [x, y], &style);
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let Style { size, .. } = size(style);
        let width = text::width(text, size).unsigned_abs();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a size in pixels"
        )]
        let height = size.ceil() as u32;
        Ok((width, height))
    }
}

fn size(style: &impl BackendTextStyle) -> Style {
    #[expect(clippy::cast_possible_truncation, reason = "a size in pixels")]
    Style::new(style.size() as f32)
}

//! From a figure to a picture: one renderer, onto paper of pixels or of SVG.
//!
//! `plotters` draws axes, grids and numbers. It knows whole pixels only and has neither clipping
//! nor evenly spaced text, so that marks inside panels and texts are put on the paper directly.

mod axes;
mod canvas;
mod legend;
mod marks;
mod paper;
mod svg;

use crate::Error;
use crate::colour::{FRAME, GREY, INK, WHITE};
use crate::figure::{Area, ColourBar, Figure, Label, Panel, Sign};
use crate::text::{Horizontal, Style, TICK_SIZE, TITLE_SIZE, Vertical, width};
use crate::ticks::{Ticks, number};
use canvas::Canvas;
use paper::Paper;
use svg::Svg;

/// Distance from the baseline of a panel's title to its plot, pixels.
const TITLE_DISTANCE: i32 = 16;

impl Figure {
    /// The bytes of a PNG file. They depend on the figure only.
    ///
    /// # Errors
    /// [`Error`] where axes cannot be laid out or the picture cannot be encoded.
    pub fn to_png(&self) -> Result<Vec<u8>, Error> {
        self.pixels()?.to_png(png::Compression::Fast, png::Filter::Paeth)
    }

    /// The bytes of a PNG file that takes longer to make and is half as large.
    ///
    /// # Errors
    /// [`Error`] where axes cannot be laid out or the picture cannot be encoded.
    pub fn to_small_png(&self) -> Result<Vec<u8>, Error> {
        self.pixels()?.to_png(png::Compression::Balanced, png::Filter::Up)
    }

    /// An SVG file.
    ///
    /// # Errors
    /// [`Error`] where axes cannot be laid out.
    pub fn to_svg(&self) -> Result<String, Error> {
        let svg = self.to_svg_element()?;
        Ok(svg.replacen("<svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"", 1))
    }

    /// An `svg` element for a page of HTML.
    ///
    /// # Errors
    /// [`Error`] where axes cannot be laid out.
    pub fn to_svg_element(&self) -> Result<String, Error> {
        let mut paper = Svg::new(&self.name);
        draw(self, &mut paper)?;
        Ok(paper.element(self.size, &self.title))
    }

    fn pixels(&self) -> Result<Canvas, Error> {
        let mut canvas = Canvas::new(self.size);
        draw(self, &mut canvas)?;
        Ok(canvas)
    }
}

/// Draws a whole figure.
fn draw(figure: &Figure, paper: &mut impl Paper) -> Result<(), Error> {
    for text in &figure.texts {
        paper.text(&text.text, text.at, &text.style);
    }
    for legend in &figure.legends {
        legend::draw(paper, legend);
    }
    for one in &figure.panels {
        panel(one, figure.size, paper)?;
    }
    Ok(())
}

fn panel(panel: &Panel, size: [i32; 2], paper: &mut impl Paper) -> Result<(), Error> {
    if panel.is_framed {
        axes::draw(panel, size, paper)?;
    }
    let is_rule = |sign: &Sign| matches!(sign, Sign::Rule(_));
    for run in panel.series.chunk_by(|a, b| is_rule(&a.sign) == is_rule(&b.sign)) {
        if is_rule(&run[0].sign) {
            marks::draw(run, panel, paper);
        } else {
            paper.clip(panel.place, |paper| marks::draw(run, panel, paper));
        }
    }
    if panel.is_framed {
        paper.outline(panel.place.grown(1), 2, FRAME);
    }
    let above = panel.place.top - TITLE_DISTANCE;
    let title = Style::new(TITLE_SIZE).anchor(Horizontal::Left, Vertical::Baseline);
    paper.text(&panel.title, [panel.place.left, above], &title);
    let remark = Style::new(TICK_SIZE).colour(GREY).anchor(Horizontal::Right, Vertical::Baseline);
    paper.text(&panel.remark, [panel.place.right(), above], &remark);
    for one in &panel.labels {
        label(one, panel, paper);
    }
    for bar in &panel.colour_bars {
        colour_bar(bar, paper);
    }
    Ok(())
}

/// Writes a label; white paper below it covers capitals and descenders.
fn label(label: &Label, panel: &Panel, paper: &mut impl Paper) {
    let [column, row] = panel.pixel(label.at).map(whole);
    let at = [column + label.shift[0], row + label.shift[1]];
    if label.is_on_white {
        let Style { size, anchor, .. } = label.style;
        let width = width(&label.text, size);
        let left = match anchor.0 {
            Horizontal::Left => 0,
            Horizontal::Centre => width / 2,
            Horizontal::Right => width,
        };
        let baseline = at[1] + whole(f64::from(label.style.baseline()));
        let [above, below] = [0.95, 0.3].map(|share| whole(share * f64::from(size)));
        let white = Area::new(at[0] - left - 4, baseline - above, width + 8, above + below);
        paper.fill(white, WHITE);
    }
    paper.text(&label.text, at, &label.style);
}

/// Draws an upright bar with numbers at its right and the unit above.
fn colour_bar(of: &ColourBar, paper: &mut impl Paper) {
    let (bar, range) = (of.place, of.scale.range);
    paper.ramp(bar, &of.scale.colours);
    paper.outline(bar.grown(1), 2, FRAME);
    let ticks = Ticks::along(range, bar.height, 60);
    let style = Style::new(TICK_SIZE).colour(GREY).anchor(Horizontal::Left, Vertical::Middle);
    for value in ticks.values {
        let row = whole(f64::from(bar.bottom()) - of.scale.share(value) * f64::from(bar.height));
        paper.fill(Area::new(bar.right(), row - 1, 8, 2), FRAME);
        paper.text(&number(value, ticks.decimals), [bar.right() + 14, row], &style);
    }
    let style = Style::new(TICK_SIZE).colour(INK).anchor(Horizontal::Left, Vertical::Baseline);
    paper.text(&of.scale.label, [bar.left, bar.top - 16], &style);
}

/// The nearest pixel.
#[expect(clippy::cast_possible_truncation, reason = "places on the sheet")]
fn whole(place: f64) -> i32 {
    place.clamp(-1e6, 1e6).round() as i32
}

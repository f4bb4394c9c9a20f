//! Scalable pictures: SVG with text as text.

use super::paper::Paper;
use crate::colour::{ColourMap, Rgb, hex};
use crate::figure::{Area, Cell, Hatch, Scale};
use crate::text::{Horizontal, SUBSCRIPT_DROP, SUBSCRIPT_SIZE, Style, subscript};
use std::collections::HashSet;
use std::fmt::Write;

/// Fonts, the embedded one first; the others are hardly wider, so that what fits in pixels fits
/// here.
const FONTS: &str = "DejaVu Sans,Verdana,Geneva,Roboto,Arial,sans-serif";

/// How a shape is drawn. Neighbours that are drawn alike become one element.
#[derive(Clone, PartialEq)]
enum Look {
    /// Filled with a colour or a definition.
    Fill(String),
    /// Filled without smooth edges, so that neighbours leave no gaps.
    CrispFill(String),
    /// Stroked with round ends, so many tenths of a pixel wide.
    Stroke(Rgb, i64),
}

/// An SVG picture in the making.
pub(super) struct Svg {
    /// What identifiers begin with: a page may carry several pictures.
    name: String,
    /// Patterns and gradients.
    definitions: String,
    count: usize,
    body: String,
    /// The element that neighbours still join: its look and its path.
    look: Option<Look>,
    path: String,
    /// End of the path, tenths of a pixel.
    at: [i64; 2],
    /// Dots of the path: another on the same place does not show.
    dots: HashSet<[i64; 2]>,
}

impl Svg {
    /// An empty picture.
    pub(super) fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            definitions: String::new(),
            count: 0,
            body: String::new(),
            look: None,
            path: String::new(),
            at: [0, 0],
            dots: HashSet::new(),
        }
    }

    /// The element of a page.
    pub(super) fn element(mut self, [width, height]: [i32; 2], title: &str) -> String {
        self.flush();
        let title = escaped(title);
        // Whole numbers are the centres of pixels
        format!(
            "<svg role=\"img\" xml:space=\"preserve\" aria-label=\"{title}\" \
             viewBox=\"-.5 -.5 {width} {height}\" \
             font-family=\"{FONTS}\" fill=\"none\" stroke-linecap=\"round\" \
             stroke-linejoin=\"round\"><defs>{}</defs>\
             <path fill=\"#fff\" d=\"m-.5-.5h{width}v{height}h-{width}z\"/>{}</svg>",
            self.definitions, self.body
        )
    }

    /// Begins an element unless the last one looks alike.
    fn begin(&mut self, look: Look) {
        if self.look.as_ref() != Some(&look) {
            self.flush();
            self.look = Some(look);
        }
    }

    /// Ends the element that neighbours may join.
    fn flush(&mut self) {
        let Some(look) = self.look.take() else { return };
        let attributes = match look {
            Look::Fill(fill) => format!("fill=\"{fill}\""),
            Look::CrispFill(fill) => format!("fill=\"{fill}\" shape-rendering=\"crispEdges\""),
            Look::Stroke(colour, width) => {
                format!("stroke=\"{}\" stroke-width=\"{}\"", hex(colour), decimal(width))
            }
        };
        let _ = write!(self.body, "<path {attributes} d=\"{}\"/>", self.path);
        self.path.clear();
        self.dots.clear();
        self.at = [0, 0];
    }

    /// Goes to a place without drawing.
    fn go(&mut self, to: [i64; 2]) {
        if to != self.at || self.path.is_empty() {
            self.step('m', to);
        }
    }

    /// Adds a step by its distance, which is shorter than the place.
    fn step(&mut self, letter: char, to: [i64; 2]) {
        // The first step of a path counts from the origin
        let by = [to[0] - self.at[0], to[1] - self.at[1]];
        self.path.push(letter);
        self.pair(by);
        self.at = to;
    }

    fn pair(&mut self, [x, y]: [i64; 2]) {
        self.path.push_str(&decimal(x));
        let y = decimal(y);
        if !y.starts_with('-') {
            self.path.push(' ');
        }
        self.path.push_str(&y);
    }

    /// Adds a filled rectangle to the path.
    fn rectangle(&mut self, [left, top]: [i64; 2], [width, height]: [i64; 2]) {
        self.step('m', [left, top]);
        let (w, h) = (decimal(width), decimal(height));
        let _ = write!(self.path, "h{w}v{h}h{}z", decimal(-width));
    }

    /// Adds whole pixels to the path.
    fn area(&mut self, Area { left, top, width, height }: Area) {
        let corner = [left, top].map(|place| 10 * i64::from(place) - 5);
        self.rectangle(corner, [width, height].map(|size| 10 * i64::from(size)));
    }

    /// A fill by a definition, which `write` gives from its identifier.
    fn define(&mut self, write: impl FnOnce(&str) -> String) -> String {
        let id = format!("{}-{}", self.name, self.count);
        self.count += 1;
        self.definitions.push_str(&write(&id));
        format!("url(#{id})")
    }
}

impl Paper for Svg {
    fn clip(&mut self, area: Area, draw: impl FnOnce(&mut Self)) {
        self.flush();
        let Area { left, top, width, height } = area;
        let [x, y] = [left, top].map(|place| decimal(10 * i64::from(place) - 5));
        // An inner picture clips without a name of its own
        let _ = write!(
            self.body,
            "<svg x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"{x} {y} {width} {height}\">"
        );
        draw(self);
        self.flush();
        self.body.push_str("</svg>");
    }

    fn fill(&mut self, area: Area, colour: Rgb) {
        if area.width <= 0 || area.height <= 0 {
            return;
        }
        self.begin(Look::Fill(hex(colour)));
        self.area(area);
    }

    /// One stroke in place of four rectangles.
    fn outline(&mut self, area: Area, thickness: i32, colour: Rgb) {
        let Area { left, top, width, height } = area;
        if width <= thickness || height <= thickness {
            return self.fill(area, colour);
        }
        let thickness = i64::from(thickness);
        self.begin(Look::Stroke(colour, 10 * thickness));
        let corner = [left, top].map(|place| 10 * i64::from(place) - 5 + 5 * thickness);
        self.rectangle(corner, [width, height].map(|size| 10 * (i64::from(size) - thickness)));
    }

    fn line(&mut self, from: [f64; 2], to: [f64; 2], thickness: f64, colour: Rgb) {
        self.begin(Look::Stroke(colour, tenths(thickness)));
        self.go(from.map(tenths));
        self.step('l', to.map(tenths));
    }

    fn disc(&mut self, centre: [f64; 2], radius: f64, colour: Rgb) {
        self.begin(Look::Stroke(colour, tenths(2.0 * radius)));
        // Half a pixel is seen with small discs, of which there are many
        let centre = centre.map(|place| 5 * (tenths(place).div_euclid(5)));
        if self.dots.insert(centre) {
            self.step('m', centre);
            self.path.push_str("h0");
        }
    }

    fn ring(&mut self, centre: [f64; 2], radius: f64, thickness: f64, colour: Rgb) {
        self.begin(Look::Stroke(colour, tenths(thickness)));
        let ([x, y], radius) = (centre.map(tenths), tenths(radius));
        self.step('m', [x - radius, y]);
        let (r, there) = (decimal(radius), decimal(2 * radius));
        let _ = write!(self.path, "a{r} {r} 0 1 0 {there} 0a{r} {r} 0 1 0 -{there} 0");
    }

    fn arrow(&mut self, from: [f64; 2], to: [f64; 2], thickness: f64, colour: Rgb) {
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let along = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
        let head = 5.0 * thickness;
        let neck = [to[0] - head * along[0], to[1] - head * along[1]];
        self.line(from, neck, thickness, colour);
        self.begin(Look::Fill(hex(colour)));
        let beside = |side: f64| {
            [neck[0] - side * head * along[1], neck[1] + side * head * along[0]].map(tenths)
        };
        self.step('m', to.map(tenths));
        self.step('l', beside(0.4));
        self.step('l', beside(-0.4));
        self.path.push('z');
        self.at = to.map(tenths);
    }

    fn dots(&mut self, radius: f64, dots: impl Iterator<Item = ([i32; 2], Rgb)>) {
        for (centre, colour) in dots {
            self.disc(centre.map(f64::from), radius, colour);
        }
    }

    fn cells(&mut self, area: Area, count: usize, cells: &[Cell], scale: &Scale) {
        let edge = |cell: usize, side: i32| {
            #[expect(clippy::cast_possible_truncation, reason = "places on the sheet")]
            let place = (10.0 * f64::from(side) * trackdyn_core::real(cell)
                / trackdyn_core::real(count))
            .round() as i64;
            place
        };
        let (left, bottom) = (10 * i64::from(area.left) - 5, 10 * i64::from(area.bottom()) - 5);
        let mut hatches: Vec<(Hatch, String)> = Vec::new();
        let mut fill = |cell: &Cell| match *cell {
            Cell::Value(value) => hex(scale.colours.at(scale.share(value))),
            Cell::Gap(hatch) => {
                if let Some((_, fill)) = hatches.iter().find(|(other, _)| *other == hatch) {
                    return fill.clone();
                }
                hatches.push((hatch, self.define(|id| pattern(id, &hatch))));
                hatches[hatches.len() - 1].1.clone()
            }
        };
        // Upward runs of cells that look alike, look by look
        let fills: Vec<String> = cells.iter().map(&mut fill).collect();
        let mut runs = Vec::new();
        for (column, fills) in fills.chunks(count).enumerate() {
            let mut row = 0;
            for run in fills.chunk_by(|a, b| a == b) {
                let [x, end] = [column, column + 1].map(|cell| edge(cell, area.width));
                let [y, top] = [row, row + run.len()].map(|cell| edge(cell, area.height));
                row += run.len();
                runs.push((&run[0], [left + x, bottom - top], [end - x, top - y]));
            }
        }
        runs.sort();
        for (fill, corner, size) in runs {
            self.begin(Look::CrispFill(fill.clone()));
            self.rectangle(corner, size);
        }
    }

    fn ramp(&mut self, area: Area, colours: &ColourMap) {
        let last = trackdyn_core::real(colours.anchors().len() - 1);
        let stops = colours.anchors().iter().enumerate().map(|(k, colour)| {
            let offset = trackdyn_core::real(k) / last;
            format!("<stop offset=\"{offset:.3}\" stop-color=\"{}\"/>", hex(*colour))
        });
        let stops: String = stops.collect();
        let fill = self.define(|id| {
            format!(
                "<linearGradient id=\"{id}\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">{stops}\
                 </linearGradient>"
            )
        });
        self.begin(Look::Fill(fill));
        self.area(area);
    }

    fn text(&mut self, text: &str, [column, row]: [i32; 2], style: &Style) {
        if text.is_empty() {
            return;
        }
        self.flush();
        let anchor = match style.anchor.0 {
            Horizontal::Left => "",
            Horizontal::Centre => " text-anchor=\"middle\"",
            Horizontal::Right => " text-anchor=\"end\"",
        };
        let drop = style.baseline().round();
        let place = if style.upwards {
            format!("transform=\"translate({column} {row})rotate(-90)\" y=\"{drop}\"")
        } else {
            format!("x=\"{column}\" y=\"{}\"", f64::from(row) + f64::from(drop))
        };
        let _ = write!(
            self.body,
            "<text {place} font-size=\"{}\" fill=\"{}\"{anchor}>{}</text>",
            style.size,
            hex(style.colour),
            lowered(text, style.size)
        );
    }
}

/// The definition of a pattern of diagonal lines.
fn pattern(id: &str, hatch: &Hatch) -> String {
    let [period, width] = Hatch::LINES;
    let falling = format!("M0 {period}L{period} 0");
    let rising =
        if hatch.directions > 1 { format!("M0 0L{period} {period}") } else { String::new() };
    let lines = if hatch.directions > 0 { falling + &rising } else { String::new() };
    // Lines are as wide along a row as in pixels
    let thickness = f64::from(width) * std::f64::consts::FRAC_1_SQRT_2;
    format!(
        "<pattern id=\"{id}\" width=\"{period}\" height=\"{period}\" \
         patternUnits=\"userSpaceOnUse\">\
         <path fill=\"{}\" d=\"M0 0h{period}v{period}h-{period}z\"/>\
         <path stroke=\"{}\" stroke-width=\"{thickness:.2}\" d=\"{lines}\"/></pattern>",
        hex(hatch.paper),
        hex(hatch.ink)
    )
}

/// Text for SVG. Subscripts are lowered letters, as few fonts have them.
fn lowered(text: &str, size: f32) -> String {
    let (drop, small) = ((SUBSCRIPT_DROP * size).round(), (SUBSCRIPT_SIZE * size).round());
    let letters: Vec<char> = text.chars().collect();
    let (mut out, mut was_low) = (String::new(), false);
    let is_low = |letter: &char| subscript(*letter).is_some();
    for run in letters.chunk_by(|a, b| is_low(a) == is_low(b)) {
        let run_is_low = is_low(&run[0]);
        let letters = run.iter().map(|letter| subscript(*letter).unwrap_or(*letter));
        let letters = escaped(&letters.collect::<String>());
        let text = match (run_is_low, was_low) {
            (true, _) => format!("<tspan dy=\"{drop}\" font-size=\"{small}\">{letters}</tspan>"),
            // The baseline stays where the last letters left it
            (false, true) => format!("<tspan dy=\"-{drop}\">{letters}</tspan>"),
            (false, false) => letters,
        };
        out.push_str(&text);
        was_low = run_is_low;
    }
    out
}

/// Text without what XML takes for its own.
fn escaped(text: &str) -> String {
    let safe = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    safe.replace('"', "&quot;").replace('\'', "&#39;")
}

/// The nearest tenth of a pixel; places far outside the sheet stay outside.
#[expect(clippy::cast_possible_truncation, reason = "places on the sheet")]
fn tenths(place: f64) -> i64 {
    (10.0 * place.clamp(-1e5, 1e5)).round() as i64
}

/// Tenths as a number.
fn decimal(tenths: i64) -> String {
    let sign = if tenths < 0 { "-" } else { "" };
    let (whole, rest) = (tenths.abs() / 10, tenths.abs() % 10);
    match (whole, rest) {
        (whole, 0) => format!("{sign}{whole}"),
        (0, rest) => format!("{sign}.{rest}"),
        (whole, rest) => format!("{sign}{whole}.{rest}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::INK;

    fn body(draw: impl FnOnce(&mut Svg)) -> String {
        let mut svg = Svg::new("test");
        draw(&mut svg);
        svg.flush();
        svg.body
    }

    #[test]
    fn what_looks_alike_is_one_element() {
        let body = body(|svg| {
            svg.line([0.0, 0.0], [10.0, 0.5], 3.0, INK);
            svg.line([10.0, 0.5], [9.0, -2.25], 3.0, INK);
            svg.disc([5.0, 5.0], 1.5, INK);
            svg.disc([5.0, 5.0], 1.5, INK);
            svg.fill(Area::new(1, 2, 3, 4), INK);
        });
        assert_eq!(
            body,
            "<path stroke=\"#1a1a1a\" stroke-width=\"3\" d=\"m0 0l10 .5l-1-2.8m-4 7.3h0\"/>\
             <path fill=\"#1a1a1a\" d=\"m.5 1.5h3v4h-3z\"/>"
        );
    }

    #[test]
    fn an_outline_lies_inside_its_rectangle() {
        let body = body(|svg| svg.outline(Area::new(10, 20, 30, 40), 2, INK));
        // From half a pixel before the first row, one pixel inside
        assert_eq!(
            body,
            "<path stroke=\"#1a1a1a\" stroke-width=\"2\" d=\"m10.5 20.5h28v38h-28z\"/>"
        );
    }

    #[test]
    fn text_is_text_and_nothing_else() {
        let body = body(|svg| svg.text("xₗ <b> & 'c'", [3, 4], &Style::new(20.0)));
        assert_eq!(
            body,
            "<text x=\"3\" y=\"4\" font-size=\"20\" fill=\"#1a1a1a\">x\
             <tspan dy=\"4\" font-size=\"14\">l</tspan>\
             <tspan dy=\"-4\"> &lt;b&gt; &amp; &#39;c&#39;</tspan></text>"
        );
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([0, 5, -5, 10, -123].map(decimal), ["0", ".5", "-.5", "1", "-12.3"]);
    }
}

//! What panels show, in the units of their axes.

use super::{Paint, Scale};
use crate::colour::{INK, Rgb};
use serde::{Deserialize, Serialize};

/// Colours that every kind of colour vision tells apart (Okabe and Ito, 2008).
const ENTRY_COLOURS: [Rgb; 6] =
    [[213, 94, 0], [0, 114, 178], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233]];

/// Colour of the entry at this place among those that a figure compares.
pub fn entry_colour(entry: usize) -> Rgb {
    ENTRY_COLOURS[entry % ENTRY_COLOURS.len()]
}

/// Shape of a marker; lengths are pixels.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A disc of this radius.
    Disc(f64),
    /// A ring: radius to its middle, and thickness.
    Ring(f64, f64),
    /// A ring around white paper: radius to its middle, and thickness.
    Open(f64, f64),
    /// A filled square.
    Square,
    /// The outline of a square.
    OpenSquare,
    /// A disc with two black quarters: a centre of gravity.
    CentreOfGravity,
    /// A ring with four strokes that leaves its middle free.
    Sights,
}

/// A marker: form tells entries apart where colour does not.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Marker {
    /// Its form.
    pub shape: Shape,
    /// Its colour.
    pub colour: Rgb,
}

impl Marker {
    /// A disc of this radius, pixels.
    pub const fn disc(radius: f64, colour: Rgb) -> Self {
        Self { shape: Shape::Disc(radius), colour }
    }

    /// A ring in ink around white paper: where a path starts.
    pub const fn start(radius: f64) -> Self {
        Self { shape: Shape::Open(radius, 4.0), colour: INK }
    }

    /// The marker of the entry at this place.
    pub fn of_entry(entry: usize) -> Self {
        let shape = match entry % 4 {
            0 => Shape::Disc(10.0),
            1 => Shape::Square,
            2 => Shape::Ring(8.0, 4.0),
            _ => Shape::OpenSquare,
        };
        Self { shape, colour: entry_colour(entry) }
    }
}

/// A line through points.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Line {
    /// The points.
    pub points: Vec<[f64; 2]>,
    /// Thickness, pixels.
    pub thickness: f64,
    /// Colour.
    pub colour: Rgb,
}

/// A straight line across a whole panel.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Rule {
    /// Value on the axis that it crosses.
    pub at: f64,
    /// Whether it is level, at a value of y; else it is upright, at a value of x.
    pub is_level: bool,
    /// Thickness, pixels.
    pub thickness: f64,
    /// Colour.
    pub colour: Rgb,
    /// Whether it is broken.
    pub is_dashed: bool,
}

impl Rule {
    /// An unbroken upright line.
    pub const fn upright(at: f64, thickness: f64, colour: Rgb) -> Self {
        Self { at, is_level: false, thickness, colour, is_dashed: false }
    }

    /// An unbroken level line.
    pub const fn level(at: f64, thickness: f64, colour: Rgb) -> Self {
        Self { is_level: true, ..Self::upright(at, thickness, colour) }
    }

    /// The line broken into dashes.
    pub const fn dashed(self) -> Self {
        Self { is_dashed: true, ..self }
    }
}

/// An arrow from a point.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Arrow {
    /// Its beginning.
    pub from: [f64; 2],
    /// From its beginning to its end, pixels to the right and down.
    pub by: [f64; 2],
    /// Thickness, pixels.
    pub thickness: f64,
    /// Colour.
    pub colour: Rgb,
}

/// Points with one form.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Points {
    /// The points.
    pub points: Vec<[f64; 2]>,
    /// Their form.
    pub shape: Shape,
    /// Their colours.
    pub paint: Paint,
    /// Colour of a thin edge around discs.
    pub edge: Option<Rgb>,
}

impl Points {
    /// Points that look alike.
    pub fn new(points: Vec<[f64; 2]>, marker: Marker) -> Self {
        Self { points, shape: marker.shape, paint: Paint::One(marker.colour), edge: None }
    }
}

/// Estimates with their intervals.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Estimates {
    /// The estimates.
    pub points: Vec<[f64; 2]>,
    /// Ends of the interval of each, on the axis of the intervals.
    pub intervals: Vec<Option<[f64; 2]>>,
    /// Whether intervals lie along x; else along y.
    pub is_across: bool,
    /// Form of the estimates; none where something else shows them.
    pub shape: Option<Shape>,
    /// Colour.
    pub colour: Rgb,
    /// Thickness of a line that joins them, pixels.
    pub joined: Option<f64>,
    /// Distance to the right of their points, pixels, so that estimates of one value stand side by
    /// side.
    pub aside: f64,
}

impl Estimates {
    /// Estimates of the entry at this place with upright intervals.
    pub fn of_entry(
        entry: usize,
        estimates: impl IntoIterator<Item = ([f64; 2], Option<[f64; 2]>)>,
    ) -> Self {
        let (points, intervals) = estimates.into_iter().unzip();
        let Marker { shape, colour } = Marker::of_entry(entry);
        let shape = Some(shape);
        Self { points, intervals, is_across: false, shape, colour, joined: None, aside: 0.0 }
    }

    /// The estimates with level intervals.
    pub fn across(self) -> Self {
        Self { is_across: true, ..self }
    }

    /// The estimates with a line of this thickness through them, pixels.
    pub fn joined(self, thickness: f64) -> Self {
        Self { joined: Some(thickness), ..self }
    }
}

/// Rectangles: bars, bands, and cells of a matrix.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Boxes {
    /// Lower left and upper right corners.
    pub boxes: Vec<[[f64; 2]; 2]>,
    /// Colours inside; none where they are only framed.
    pub paint: Option<Paint>,
    /// Thickness, pixels, and colour of an outline inside each.
    pub edge: Option<(i32, Rgb)>,
}

impl Boxes {
    /// Boxes without outlines.
    pub fn new(boxes: Vec<[[f64; 2]; 2]>, paint: Paint) -> Self {
        Self { boxes, paint: Some(paint), edge: None }
    }

    /// Outlines only.
    pub fn framed(boxes: Vec<[[f64; 2]; 2]>, thickness: i32, colour: Rgb) -> Self {
        Self { boxes, paint: None, edge: Some((thickness, colour)) }
    }

    /// The boxes with outlines.
    pub fn edged(self, thickness: i32, colour: Rgb) -> Self {
        Self { edge: Some((thickness, colour)), ..self }
    }
}

/// A pattern of diagonal lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
pub struct Hatch {
    /// Colour between the lines.
    pub paper: Rgb,
    /// Colour of the lines.
    pub ink: Rgb,
    /// Directions of the lines: 0 to 2.
    pub directions: u8,
}

impl Hatch {
    /// Distance of the lines along rows and columns, and their width, pixels.
    pub const LINES: [i32; 2] = [12, 3];

    /// Its colour at a pixel of the sheet.
    pub fn at(&self, column: i32, row: i32) -> Rgb {
        let [period, width] = Self::LINES;
        let is_on_line = |along: i32| along.rem_euclid(period) < width;
        let is_ink = (self.directions > 0 && is_on_line(column + row))
            || (self.directions > 1 && is_on_line(column - row));
        if is_ink { self.ink } else { self.paper }
    }
}

/// A cell of a heat map.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Cell {
    /// It has a value.
    Value(f64),
    /// It has none, for a reason that its pattern shows.
    Gap(Hatch),
}

/// A heat map that fills its panel.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Cells {
    /// Cells along each axis.
    pub count: usize,
    /// Cells upwards, column by column.
    pub cells: Vec<Cell>,
    /// Colours of their values.
    pub scale: Scale,
}

/// Many points, each with a value. Those of small values lie above the others.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Cloud {
    /// The points.
    pub points: Vec<[f64; 2]>,
    /// Their values.
    pub values: Vec<f64>,
    /// Colours of their values.
    pub scale: Scale,
}

/// What a series consists of.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Sign {
    /// A line through points.
    Line(Line),
    /// A line across the panel.
    Rule(Rule),
    /// An arrow.
    Arrow(Arrow),
    /// Points of one form.
    Points(Points),
    /// Estimates with intervals.
    Estimates(Estimates),
    /// Rectangles.
    Boxes(Boxes),
    /// A heat map.
    Cells(Cells),
    /// Points with values.
    Cloud(Cloud),
}

/// A part of what a panel shows.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Series {
    /// What it is of; empty where it speaks for itself.
    pub name: String,
    /// What is drawn.
    pub sign: Sign,
    /// Stretches of the log that each member stands for, s on the axis of time of the figure
    /// `time`; empty where members stand for none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stretches: Vec<Vec<[f64; 2]>>,
}

impl Series {
    /// The series, each of whose members stands for these stretches of the log.
    pub fn from_stretches(self, stretches: Vec<Vec<[f64; 2]>>) -> Self {
        Self { stretches, ..self }
    }
}

macro_rules! series_of {
    ($($sign:ident),*) => {$(
        impl From<$sign> for Series {
            fn from(sign: $sign) -> Self {
                Self { name: String::new(), sign: Sign::$sign(sign), stretches: Vec::new() }
            }
        }
    )*};
}

series_of!(Line, Rule, Arrow, Points, Estimates, Boxes, Cells, Cloud);

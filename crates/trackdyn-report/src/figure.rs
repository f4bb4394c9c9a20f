//! Figures as values: plain data that is drawn only when a picture is asked for.

mod axis;
mod legend;
mod matrix;
mod panel;
mod scale;
mod series;

use crate::text::{Style, Text};
use serde::{Deserialize, Serialize};

pub use axis::{Axis, Ticks};
pub use legend::{Entry, Legend, Swatch};
pub use matrix::Matrix;
pub use panel::{Label, Panel, around, equal_scale};
pub use scale::{ColourBar, Paint, Scale};
pub use series::{
    Arrow, Boxes, Cell, Cells, Cloud, Estimates, Hatch, Line, Marker, Points, Rule, Series, Shape,
    Sign, entry_colour,
};

/// A rectangle on the sheet, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
pub struct Area {
    /// Leftmost column.
    pub left: i32,
    /// Topmost row.
    pub top: i32,
    /// Columns.
    pub width: i32,
    /// Rows.
    pub height: i32,
}

impl Area {
    /// The rectangle of this corner and size.
    pub const fn new(left: i32, top: i32, width: i32, height: i32) -> Self {
        Self { left, top, width, height }
    }

    /// First column right of the rectangle.
    pub const fn right(&self) -> i32 {
        self.left + self.width
    }

    /// First row below the rectangle.
    pub const fn bottom(&self) -> i32 {
        self.top + self.height
    }

    /// The rectangle with this many more pixels on each side.
    pub const fn grown(&self, by: i32) -> Self {
        Self::new(self.left - by, self.top - by, self.width + 2 * by, self.height + 2 * by)
    }

    /// The part that both rectangles share; empty ones have no width or no height.
    pub fn intersection(&self, other: &Self) -> Self {
        let (left, top) = (self.left.max(other.left), self.top.max(other.top));
        let width = (self.right().min(other.right()) - left).max(0);
        Self::new(left, top, width, (self.bottom().min(other.bottom()) - top).max(0))
    }
}

/// A figure: panels with axes and series, texts and legends, on a sheet of pixels.
///
/// Panels hold what is shown in its own units. Places on the sheet are pixels from the upper left
/// corner; sheets are drawn at twice the size at which they are usually read. A figure that was
/// written with serde is read as the one that it was.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Figure {
    /// Name of its file, without the ending.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// How to read it.
    pub reading: String,
    /// Columns and rows of the sheet, pixels.
    pub size: [i32; 2],
    /// Texts outside the panels.
    pub texts: Vec<Text>,
    /// What marks mean.
    pub legends: Vec<Legend>,
    /// What is shown.
    pub panels: Vec<Panel>,
}

impl Figure {
    /// An empty sheet of this name and size.
    pub fn new(name: &str, size: [i32; 2]) -> Self {
        Self {
            name: name.to_owned(),
            title: String::new(),
            reading: String::new(),
            size,
            texts: Vec::new(),
            legends: Vec::new(),
            panels: Vec::new(),
        }
    }

    /// The figure with what it shows and how to read it, for pages that carry it.
    pub fn explained(self, title: &str, reading: &str) -> Self {
        Self { title: title.to_owned(), reading: reading.to_owned(), ..self }
    }

    /// Name of its file as PNG.
    pub fn file(&self) -> String {
        format!("{}.png", self.name)
    }

    /// The whole sheet.
    pub fn whole(&self) -> Area {
        Area::new(0, 0, self.size[0], self.size[1])
    }

    /// Adds a line of text at a place on the sheet.
    pub fn write(&mut self, text: impl Into<String>, at: [i32; 2], style: Style) {
        self.texts.push(Text { text: text.into(), at, style });
    }
}

//! Legends.

use super::{Marker, Shape, entry_colour};
use crate::colour::{INK, Rgb};
use serde::{Deserialize, Serialize};

/// A sample of how something is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Swatch {
    /// A line of this thickness, pixels.
    Line(Rgb, f64),
    /// A box of this colour.
    Box(Rgb),
    /// A marker.
    Marker(Marker),
}

impl Swatch {
    /// The marker of the entry at this place.
    pub fn entry(entry: usize) -> Self {
        Self::Marker(Marker::of_entry(entry))
    }

    /// A disc of this colour.
    pub fn disc(colour: Rgb) -> Self {
        Self::Marker(Marker { shape: Shape::Disc(9.0), colour })
    }

    /// A ring.
    pub fn ring() -> Self {
        Self::Marker(Marker { shape: Shape::Ring(8.0, 3.5), colour: INK })
    }
}

/// Samples with their meaning.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Entry {
    /// What they mean.
    pub text: String,
    /// Samples on each other.
    pub swatches: Vec<Swatch>,
}

/// Entries in at most two lines; what has no room is counted.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Legend {
    /// Left end and middle row of the first line, pixels.
    pub at: [i32; 2],
    /// Right end, pixels.
    pub right: i32,
    /// Size of the text, pixels.
    pub size: f32,
    /// Length of a sample of a line, pixels.
    pub sample: i32,
    /// Distance between sample and text, and between entries, pixels.
    pub gaps: [i32; 2],
    /// What is explained.
    pub entries: Vec<Entry>,
}

impl Legend {
    /// A legend of markers.
    pub fn of_marks<'a>(
        at: [i32; 2],
        right: i32,
        entries: impl IntoIterator<Item = (Swatch, &'a str)>,
    ) -> Self {
        let entry = |(swatch, text): (Swatch, &str)| Entry {
            text: text.to_owned(),
            swatches: vec![swatch],
        };
        let entries = entries.into_iter().map(entry).collect();
        Self { at, right, size: 24.0, sample: 48, gaps: [12, 50], entries }
    }

    /// A legend of lines: what the others are compared with, and one with a marker for each of
    /// them.
    pub fn of_lines<'a>(
        at: [i32; 2],
        right: i32,
        first: &str,
        others: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let first = Entry { text: first.to_owned(), swatches: vec![Swatch::Line(INK, 8.0)] };
        let others = others.into_iter().enumerate().map(|(entry, name)| Entry {
            text: name.to_owned(),
            swatches: vec![Swatch::Line(entry_colour(entry), 4.0), Swatch::entry(entry)],
        });
        let entries = std::iter::once(first).chain(others).collect();
        Self { at, right, size: 26.0, sample: 64, gaps: [14, 46], entries }
    }
}

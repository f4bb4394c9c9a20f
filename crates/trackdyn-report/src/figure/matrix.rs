//! Matrices: cells with values, numbers and names.

use super::{Area, Axis, Boxes, Label, Paint, Panel, Scale, Series};
use crate::colour::{INK, Rgb, WHITE};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_core::real;

/// Share of the scale above which the number in a cell is white.
const MIN_DARK_SHARE: f64 = 0.6;

/// Rows of cells from the upper left corner.
pub struct Matrix {
    /// Names of the rows, with their colours.
    pub rows: Vec<(String, Rgb)>,
    /// Names of the columns, with their colours.
    pub columns: Vec<(String, Rgb)>,
    /// Size of the names, and of the numbers.
    pub sizes: [f32; 2],
    /// Value of each cell, row by row, and what is written in it.
    pub cells: Vec<(f64, Option<String>)>,
    /// Colours of the values.
    pub scale: Scale,
}

impl Matrix {
    /// Corners of a cell.
    pub fn cell(row: usize, column: usize) -> [[f64; 2]; 2] {
        [[real(column), real(row + 1)], [real(column + 1), real(row)]]
    }

    /// The panel of the matrix, its names left of it and below.
    pub fn panel(self, place: Area, edge: Option<(i32, Rgb)>) -> Panel {
        let x = Axis::unmarked([0.0, real(self.columns.len().max(1))]);
        let mut panel = Panel::new("", place, x, Axis::rows(self.rows.len()));
        let [name, numbers] = self.sizes;
        for (row, (text, colour)) in self.rows.iter().enumerate() {
            let at = [0.0, real(row) + 0.5];
            panel.labels.push(Label::left_of(text, at, 16, (name, *colour)));
        }
        let upwards = Style { upwards: true, ..Style::new(name) };
        let upwards = upwards.anchor(Horizontal::Right, Vertical::Middle);
        for (column, (text, colour)) in self.columns.iter().enumerate() {
            let at = [real(column) + 0.5, panel.y.range[0]];
            panel.labels.push(Label::new(text, at, upwards.colour(*colour)).shifted([0, 16]));
        }
        let (mut boxes, mut values) = (Vec::new(), Vec::new());
        for (k, (value, text)) in self.cells.into_iter().enumerate() {
            let (row, column) = (k / self.columns.len(), k % self.columns.len());
            boxes.push(Self::cell(row, column));
            values.push(value);
            let is_dark = self.scale.share(value) > MIN_DARK_SHARE;
            let style = (numbers, if is_dark { WHITE } else { INK });
            let middle = [real(column) + 0.5, real(row) + 0.5];
            panel.labels.extend(text.map(|text| Label::on(&text, middle, style)));
        }
        let name = self.scale.label.clone();
        let paint = Some(Paint::Values { values, scale: self.scale });
        panel.show_as(&name, Series::from(Boxes { boxes, paint, edge }));
        panel
    }
}

//! What a figure is drawn on.

use crate::colour::{ColourMap, Rgb};
use crate::figure::{Area, Cell, Scale};
use crate::text::Style;

/// Paper for marks at fractions of a pixel, of which whole numbers are the centres of pixels.
pub(super) trait Paper: Sized {
    /// Draws with nothing reaching outside `area`.
    fn clip(&mut self, area: Area, draw: impl FnOnce(&mut Self));

    /// Fills a rectangle.
    fn fill(&mut self, area: Area, colour: Rgb);

    /// A straight line with round ends.
    fn line(&mut self, from: [f64; 2], to: [f64; 2], thickness: f64, colour: Rgb);

    /// A filled circle.
    fn disc(&mut self, centre: [f64; 2], radius: f64, colour: Rgb);

    /// A circle of this thickness, `radius` to its middle.
    fn ring(&mut self, centre: [f64; 2], radius: f64, thickness: f64, colour: Rgb);

    /// A line with a filled head at its end.
    fn arrow(&mut self, from: [f64; 2], to: [f64; 2], thickness: f64, colour: Rgb);

    /// Filled circles of one radius, each with its centre and colour, in this order.
    fn dots(&mut self, radius: f64, dots: impl Iterator<Item = ([i32; 2], Rgb)>);

    /// A square heat map, of so many cells along each side.
    fn cells(&mut self, area: Area, count: usize, cells: &[Cell], scale: &Scale);

    /// A rectangle with all colours of a map, from its foot upwards.
    fn ramp(&mut self, area: Area, colours: &ColourMap);

    /// Writes one line of text at a point.
    fn text(&mut self, text: &str, at: [i32; 2], style: &Style);

    /// Outlines a rectangle with lines inside it.
    fn outline(&mut self, area: Area, thickness: i32, colour: Rgb) {
        let Area { left, top, width, height } = area;
        self.fill(Area::new(left, top, width, thickness), colour);
        self.fill(Area::new(left, area.bottom() - thickness, width, thickness), colour);
        self.fill(Area::new(left, top, thickness, height), colour);
        self.fill(Area::new(area.right() - thickness, top, thickness, height), colour);
    }
}

//! Paths from above: what they are compared with, and one of each entry.

use crate::colour::INK;
use crate::figure::{Area, Axis, Line, Marker, Panel, Points, entry_colour};

/// A named path.
pub(crate) type Named<'a> = (&'a str, Vec<[f64; 2]>);

/// A panel of paths that shows these ranges. Marks at the ends lie on each other in this order:
/// that of the reference, its start, and those of the entries.
pub(crate) fn panel(place: Area, ranges: [[f64; 2]; 2], reference: Named, all: &[Named]) -> Panel {
    let [x, y] = ranges;
    let mut panel = Panel::new("Paths", place, Axis::new("x", "m", x), Axis::new("y", "m", y));
    let (name, points) = reference;
    let (start, end) = (points.first().copied(), points.last().copied());
    panel.show_as(name, Line { points, thickness: 10.0, colour: INK });
    for (entry, (name, points)) in all.iter().enumerate() {
        let (points, colour) = (points.clone(), entry_colour(entry));
        panel.show_as(name, Line { points, thickness: 4.0, colour });
    }
    if let (Some(start), Some(end)) = (start, end) {
        panel.show_as("end", Points::new(vec![end], Marker::disc(14.0, INK)));
        panel.show_as("start", Points::new(vec![start], Marker::start(16.0)));
    }
    for (entry, (_, points)) in all.iter().enumerate() {
        if let Some(&end) = points.last() {
            panel.show_as("end", Points::new(vec![end], Marker::of_entry(entry)));
        }
    }
    panel
}

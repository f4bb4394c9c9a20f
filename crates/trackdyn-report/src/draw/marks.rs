//! The marks of series.

use super::paper::Paper;
use super::whole;
use crate::colour::{INK, LAST_INDEX, Rgb, WHITE};
use crate::figure::{
    Area, Boxes, Cloud, Estimates, Line, Marker, Panel, Points, Rule, Series, Shape, Sign,
};

/// Draws series, later ones above earlier ones.
pub(super) fn draw(all: &[Series], panel: &Panel, paper: &mut impl Paper) {
    for series in all {
        draw_sign(&series.sign, panel, paper);
    }
}

fn draw_sign(sign: &Sign, panel: &Panel, paper: &mut impl Paper) {
    match sign {
        Sign::Line(line) => path(line, panel, paper),
        Sign::Rule(of) => rule(of, panel, paper),
        Sign::Arrow(arrow) => {
            let [column, row] = panel.pixel(arrow.from);
            let end = [column + arrow.by[0], row + arrow.by[1]];
            paper.arrow([column, row], end, arrow.thickness, arrow.colour);
        }
        Sign::Points(of) => points(of, panel, paper),
        Sign::Estimates(of) => estimates(of, panel, paper),
        Sign::Boxes(of) => boxes(of, panel, paper),
        Sign::Cells(of) => paper.cells(panel.place, of.count, &of.cells, &of.scale),
        Sign::Cloud(of) => cloud(of, panel, paper),
    }
}

/// Draws a marker.
pub(super) fn marker(paper: &mut impl Paper, Marker { shape, colour }: Marker, at: [f64; 2]) {
    let [column, row] = at.map(whole);
    let square = Area::new(column - 9, row - 9, 19, 19);
    match shape {
        Shape::Disc(radius) => paper.disc(at, radius, colour),
        Shape::Ring(radius, thickness) => paper.ring(at, radius, thickness, colour),
        Shape::Open(radius, thickness) => {
            paper.disc(at, radius, WHITE);
            paper.ring(at, radius, thickness, colour);
        }
        Shape::Square => paper.fill(square, colour),
        Shape::OpenSquare => paper.outline(square, 4, colour),
        Shape::CentreOfGravity => {
            const RADIUS: f64 = 13.0;
            const QUARTER: i32 = 14;
            paper.disc(at, RADIUS, WHITE);
            for (left, top) in [(column, row - QUARTER), (column - QUARTER, row)] {
                paper.clip(Area::new(left, top, QUARTER, QUARTER), |paper| {
                    paper.disc(at, RADIUS, INK);
                });
            }
            paper.ring(at, RADIUS, 2.5, colour);
        }
        Shape::Sights => {
            const RADIUS: f64 = 15.0;
            paper.ring(at, RADIUS, 3.0, colour);
            for [right, down] in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
                let place = |radius: f64| [at[0] + radius * right, at[1] + radius * down];
                paper.line(place(RADIUS), place(RADIUS + 9.0), 3.0, colour);
            }
        }
    }
}

/// A line through points; steps shorter than a pixel are joined.
fn path(line: &Line, panel: &Panel, paper: &mut impl Paper) {
    let mut places = line.points.iter().map(|&point| panel.pixel(point));
    let Some(mut from) = places.next() else { return };
    let mut to = from;
    for next in places {
        to = next;
        if (to[0] - from[0]).hypot(to[1] - from[1]) >= 1.0 {
            paper.line(from, to, line.thickness, line.colour);
            from = to;
        }
    }
    paper.line(from, to, line.thickness, line.colour);
}

fn rule(rule: &Rule, panel: &Panel, paper: &mut impl Paper) {
    const PERIOD: usize = 16;
    const DASH: i32 = 9;
    let Area { left, top, .. } = panel.place;
    let (right, bottom) = (panel.place.right(), panel.place.bottom());
    let [x, y] = [&panel.x, &panel.y].map(|axis| axis.range[0]);
    let across =
        if rule.is_level { panel.pixel([x, rule.at])[1] } else { panel.pixel([rule.at, y])[0] };
    let ends = |low: i32, high: i32| [f64::from(low), f64::from(high)];
    if !rule.is_dashed {
        let [from, to] = if rule.is_level {
            ends(left, right).map(|column| [column, across])
        } else {
            ends(top, bottom).map(|row| [across, row])
        };
        return paper.line(from, to, rule.thickness, rule.colour);
    }
    let thickness = whole(rule.thickness);
    let first = whole(across) - thickness / 2;
    if rule.is_level {
        for column in (left..right).step_by(PERIOD) {
            let dash = DASH.min(right - column);
            paper.fill(Area::new(column, first, dash, thickness), rule.colour);
        }
    } else {
        for row in (top..bottom).step_by(PERIOD) {
            let dash = DASH.min(bottom - row);
            paper.fill(Area::new(first, row, thickness, dash), rule.colour);
        }
    }
}

/// Points, edges of all below: neighbours that look alike are one element of a picture. Among
/// discs with edges those of a colour follow each other.
fn points(of: &Points, panel: &Panel, paper: &mut impl Paper) {
    let mut members: Vec<usize> = (0..of.points.len()).collect();
    if let (Some(edge), Shape::Disc(radius)) = (of.edge, of.shape) {
        for &point in &of.points {
            paper.disc(panel.pixel(point), radius + 1.0, edge);
        }
        members.sort_by_key(|&member| of.paint.colour(member));
    }
    for member in members {
        let marker = Marker { shape: of.shape, colour: of.paint.colour(member) };
        self::marker(paper, marker, panel.pixel(of.points[member]));
    }
}

fn estimates(of: &Estimates, panel: &Panel, paper: &mut impl Paper) {
    let mut before = None;
    for (&point, interval) in of.points.iter().zip(&of.intervals) {
        let [column, row] = panel.pixel(point);
        let at = [column + of.aside, row];
        if let Some(ends) = interval {
            let place = |end: f64| {
                let [x, y] = if of.is_across { [end, point[1]] } else { [point[0], end] };
                panel.pixel([x, y])[usize::from(!of.is_across)].clamp(-1e5, 1e5)
            };
            whisker(paper, at, ends.map(place), of.is_across, of.colour);
        }
        if let (Some(thickness), Some(before)) = (of.joined, before.replace(at)) {
            paper.line(before, at, thickness, of.colour);
        }
        if let Some(shape) = of.shape {
            marker(paper, Marker { shape, colour: of.colour }, at);
        }
    }
}

/// A whisker between two columns or rows.
fn whisker(paper: &mut impl Paper, at: [f64; 2], ends: [f64; 2], is_across: bool, colour: Rgb) {
    const HALF_CAP: f64 = 7.0;
    let place =
        |end: f64, aside: f64| if is_across { [end, at[1] + aside] } else { [at[0] + aside, end] };
    paper.line(place(ends[0], 0.0), place(ends[1], 0.0), 3.0, colour);
    for end in ends {
        paper.line(place(end, -HALF_CAP), place(end, HALF_CAP), 3.0, colour);
    }
}

/// Boxes, then their outlines: outlines of one look are one element of a picture.
fn boxes(of: &Boxes, panel: &Panel, paper: &mut impl Paper) {
    if let Some(paint) = &of.paint {
        for (member, corners) in of.boxes.iter().enumerate() {
            paper.fill(panel.area(*corners), paint.colour(member));
        }
    }
    if let Some((thickness, colour)) = of.edge {
        for corners in &of.boxes {
            paper.outline(panel.area(*corners), thickness, colour);
        }
    }
}

/// Draws a dot for each point, large values first.
fn cloud(of: &Cloud, panel: &Panel, paper: &mut impl Paper) {
    let colours = of.scale.colours.table();
    let level = f64::from(LAST_INDEX) / (of.scale.range[1] - of.scale.range[0]);
    // Dots of one level on one pixel look alike: one of them will do. Level from above, row and
    // column in one number sort fast.
    let mut dots: Vec<u64> = of
        .points
        .iter()
        .zip(&of.values)
        .filter(|(place, _)| panel.contains(**place))
        .map(|(&place, value)| {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "places inside the panel, and a small whole number"
            )]
            let ([column, row], level) = (
                panel.pixel(place).map(|pixel| pixel.round() as u64),
                ((value - of.scale.range[0]) * level).round() as u8,
            );
            u64::from(LAST_INDEX - level.min(LAST_INDEX)) << 32 | row << 16 | column
        })
        .collect();
    dots.sort_unstable();
    dots.dedup();
    let radius = match dots.len() {
        ..=300 => 6.0,
        301..=4000 => 4.0,
        _ => 2.5,
    };
    let dots = dots.into_iter().map(|dot| {
        let [.., from_above, row_high, row_low, column_high, column_low] = dot.to_be_bytes();
        let place = |high, low| i32::from(u16::from_be_bytes([high, low]));
        let centre = [place(column_high, column_low), place(row_high, row_low)];
        (centre, colours[usize::from(LAST_INDEX - from_above)])
    });
    paper.dots(radius, dots);
}

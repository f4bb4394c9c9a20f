//! Outlines of patches.

use crate::form::Draws;
use std::f64::consts::{PI, TAU};

/// Directions in which an outline is tabulated.
const DIRECTIONS: u16 = 256;
/// Widths beyond the outline at which nothing of a soft edge is left: e⁻¹² of it.
const MAX_WIDTHS: f64 = 12.0;

/// A closed line around the origin.
#[derive(Clone, Debug)]
pub(super) struct Border {
    /// Distance from the middle in even directions, m; the first one again at the end.
    radii: Box<[f64]>,
    farthest: f64,
    /// Width of the edge over the distance.
    edge: f64,
}

impl Border {
    /// An ellipse or a smooth star with the area of a disc of this radius (m).
    pub(super) fn draw(radius: f64, random: &mut Draws) -> Self {
        let directions = (0..=DIRECTIONS).map(|k| TAU * f64::from(k) / f64::from(DIRECTIONS));
        let shape: Vec<f64> = if random.happens(0.35) {
            let (aspect, turn) = (random.log_between(1.3, 2.5), random.between(0.0, PI));
            let at = |angle: f64| {
                let (sin, cos) = (angle - turn).sin_cos();
                ((cos * cos) / aspect + sin * sin * aspect).sqrt().recip()
            };
            directions.map(at).collect()
        } else {
            let mut waves = Vec::new();
            for count in 2..=5_u32 {
                let count = f64::from(count);
                waves.push((count, random.between(0.0, 0.4) / count, random.between(0.0, TAU)));
            }
            let ln = |angle: f64| {
                waves.iter().map(|(n, height, turn)| height * (n * angle - turn).cos()).sum::<f64>()
            };
            directions.map(|angle| ln(angle).exp()).collect()
        };
        let edge = if random.happens(0.5) { 0.0 } else { random.between(0.02, 0.12) };
        // area ½ ∮ r² dφ of the shape, times ∫ 2 u du/(1 + e^((u − 1)/w)) = 1 + π² w²/3 of the edge
        let squares: f64 = shape[1..].iter().map(|r| r * r).sum();
        let area = squares / f64::from(DIRECTIONS) * (1.0 + (PI * edge).powi(2) / 3.0);
        let radii: Box<[f64]> = shape.into_iter().map(|r| radius * r / area.sqrt()).collect();
        let farthest = radii.iter().copied().fold(0.0, f64::max) * (1.0 + MAX_WIDTHS * edge);
        Self { radii, farthest, edge }
    }

    /// How much of the patch there is at a place: 1 inside, 0 outside.
    pub(super) fn weight(&self, [x, y]: [f64; 2]) -> f64 {
        let distance = x.hypot(y);
        if distance > self.farthest {
            return 0.0;
        }
        let place = (y.atan2(x) / TAU).rem_euclid(1.0) * f64::from(DIRECTIONS);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a direction")]
        let knot = (place as usize).min(self.radii.len() - 2);
        let share = place.fract();
        let radius = self.radii[knot] * (1.0 - share) + self.radii[knot + 1] * share;
        if self.edge == 0.0 {
            return f64::from(u8::from(distance < radius));
        }
        1.0 / (1.0 + ((distance / radius - 1.0) / self.edge).exp())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form::Form;

    #[test]
    fn all_outlines_have_the_area_of_the_disc() {
        const STEP: f64 = 0.01;
        for number in 0..40 {
            let mut draws = Form::Drawn(number).draws().expect("draws");
            let border = Border::draw(1.0, &mut draws);
            let cells = (-350..350).flat_map(|i| (-350..350).map(move |j| [i, j]));
            let middle = |cell: [i32; 2]| cell.map(|k| (f64::from(k) + 0.5) * STEP);
            let weights = cells.map(|cell| border.weight(middle(cell)));
            let area = weights.sum::<f64>() * STEP * STEP;
            // of a hard edge, the cells on the line
            assert!((area / PI - 1.0).abs() < 3e-3, "{number}: {area}");
        }
    }
}

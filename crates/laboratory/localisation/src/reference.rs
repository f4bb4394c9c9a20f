//! A scan as straight lines, against which other scans are matched.
//!
//! Between neighbouring returns at 10 mm noise a line has any direction. A line through all returns
//! of a wall has a direction that is worth using, with a covariance that says how much.

use crate::error::{Error, positive};
use crate::line::Line;
use crate::scan::{Return, Scan};
use trackdyn_core::real;

mod curve;
mod fit;
mod partition;

/// The lines of a scan.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    lines: Vec<Line>,
    first_angle: f64,
    angle_step: f64,
    /// For each beam, the line that it surely hits.
    line_of_beam: Vec<Option<usize>>,
}

/// Number of returns on either end of a piece that do not enter its line: where the piece ends was
/// chosen to fit best, which biases those next to it.
const EXCLUDED_END_RETURNS: usize = 1;

/// Smallest number of returns that enter a line. With fewer, direction and offset say little more
/// than the returns did.
const MIN_RETURNS: usize = 5;

/// Largest standard deviation of the direction of a line, rad: 3 degrees. The law of a match
/// is linear in the direction for errors much below one radian.
const MAX_DIRECTION_DEVIATION: f64 = 0.05;

impl Reference {
    /// Finds the lines of a scan, given the standard deviation of its ranges in m.
    ///
    /// # Errors
    /// [`Error::Value`] for noise that is not positive.
    pub fn new(scan: &Scan, range_noise: f64) -> Result<Self, Error> {
        positive("range_noise", range_noise)?;
        let returns: Vec<Return> = scan.returns().collect();
        let found: Vec<(Line, &[Return])> = partition::pieces(&returns, range_noise)
            .into_iter()
            .filter(|piece| piece.len() >= MIN_RETURNS + 2 * EXCLUDED_END_RETURNS)
            .filter_map(|piece| {
                let sure =
                    &returns[piece.start + EXCLUDED_END_RETURNS..piece.end - EXCLUDED_END_RETURNS];
                let line = fit::line(sure, range_noise)?;
                (line.covariance[(0, 0)] < MAX_DIRECTION_DEVIATION * MAX_DIRECTION_DEVIATION)
                    .then_some((line, sure))
            })
            .collect();
        let chord: Vec<bool> = found
            .windows(2)
            .map(|pair| {
                let [(one, _), (other, _)] = pair else { return false };
                let middle = f64::midpoint(real(one.last_beam), real(other.first_beam));
                let bearing = scan.first_angle() + scan.angle_step() * middle;
                curve::are_chords(one, other, bearing)
            })
            .collect();
        let mut lines = Vec::new();
        let mut line_of_beam = vec![None; scan.ranges().len()];
        for (index, (line, sure)) in found.into_iter().enumerate() {
            let to_next = chord.get(index).is_some_and(|chord| *chord);
            let to_last = index > 0 && chord[index - 1];
            if to_next || to_last {
                continue;
            }
            // A beam at the very end of the line may pass it from another place.
            for hit in &sure[1..sure.len() - 1] {
                line_of_beam[hit.beam] = Some(lines.len());
            }
            lines.push(line);
        }
        Ok(Self {
            lines,
            first_angle: scan.first_angle(),
            angle_step: scan.angle_step(),
            line_of_beam,
        })
    }

    /// Its lines, by bearing.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// The line that a ray along `bearing` (rad) surely hits.
    pub(crate) fn line_at(&self, bearing: f64) -> Option<usize> {
        *self.line_of_beam.get(self.beam_at(bearing)?)?
    }

    /// Indices of the lines within `window` rad of a bearing, not across the seam of a scan all
    /// round.
    pub(crate) fn lines_around(&self, bearing: f64, window: f64) -> std::ops::Range<usize> {
        let Some(beam) = self.beam_at(bearing) else { return 0..0 };
        let reach = to_index(window / self.angle_step);
        let from = self.lines.partition_point(|line| line.last_beam + reach < beam);
        let until = self.lines.partition_point(|line| line.first_beam <= beam + reach);
        from..until.max(from)
    }

    /// The beam nearest to a bearing, if it lies in the field of view.
    fn beam_at(&self, bearing: f64) -> Option<usize> {
        let turned =
            (bearing - self.first_angle + self.angle_step / 2.0).rem_euclid(std::f64::consts::TAU);
        Some(to_index(turned / self.angle_step)).filter(|beam| *beam < self.line_of_beam.len())
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "floor of a number that is not negative"
)]
fn to_index(value: f64) -> usize {
    value as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Room, Scanner};
    use trackdyn_core::Pose;

    fn reference(noise: f64, index: u64) -> Reference {
        let scanner = Scanner { range_noise: noise, ..Scanner::default() };
        let pose = Pose::new(5.0, 4.0, 0.2);
        let scan = scanner.scan(&Room::furnished(), 0.0, index, |_| pose).expect("a scan");
        Reference::new(&scan, noise.max(1e-5)).expect("lines")
    }

    #[test]
    fn without_noise_every_line_is_a_wall() {
        let lines = reference(0.0, 0);
        assert!(lines.lines().len() >= 8, "{}", lines.lines().len());
        let pose = Pose::new(5.0, 4.0, 0.2);
        for line in lines.lines() {
            let on_a_wall = Room::furnished().segments().iter().any(|segment| {
                [segment.from, segment.to].iter().all(|&[x, y]| {
                    let end = pose.inverse().compose(&Pose::new(x, y, 0.0));
                    let across = line.angle.cos() * end.x + line.angle.sin() * end.y;
                    // Rounding of the fit, over ends up to 10 m away.
                    (across - line.distance).abs() < 1e-9
                })
            });
            assert!(on_a_wall, "{line:?}");
        }
    }

    #[test]
    fn the_covariance_of_a_line_is_that_of_its_scatter() {
        // The front of the desk at the near wall, 36 beams wide.
        let exact = reference(0.0, 0);
        let line_at = |lines: &Reference| {
            let bearing = -1.4;
            lines.line_at(bearing).map(|index| lines.lines()[index])
        };
        let truth = line_at(&exact).expect("the desk");
        let trials = 400;
        let mut sum = 0.0;
        for index in 0..trials {
            let found = line_at(&reference(0.01, index)).expect("the desk");
            let error =
                nalgebra::Vector2::new(found.angle - truth.angle, found.distance - truth.distance);
            sum +=
                error.dot(&found.covariance.try_inverse().map_or(error, |inverse| inverse * error));
        }
        // χ² with 800 degrees of freedom: 800 ± 3 · 40.
        assert!((680.0..920.0).contains(&sum), "{sum}");
    }
}

//! Grids of track speeds.

/// Evenly spaced speeds from −max to +max, equal for both tracks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    points: usize,
    max_speed: f64,
}

/// An invalid grid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// Too few or too many points.
    #[error("grid = {0}: expected {expected}", expected = self.expected())]
    Points(usize),
    /// A speed that is not positive, or too large for a robot.
    #[error("speed = {0}: expected {expected}", expected = self.expected())]
    Speed(f64),
}

impl GridError {
    /// Valid values.
    pub fn expected(&self) -> String {
        match self {
            Self::Points(_) => format!("2 to {} points per track", Grid::MAX_POINTS),
            Self::Speed(_) => {
                let (least, most) = (Grid::MIN_SPEED, Grid::MAX_SPEED);
                format!("a positive largest track speed in m/s, at least {least}, at most {most}")
            }
        }
    }
}

impl Grid {
    /// The paper's range: ±1 m/s.
    pub const PAPER_SPEED: f64 = 1.0;

    /// Most points per track: four million pairs.
    pub const MAX_POINTS: usize = 2001;

    /// Smallest largest speed of a grid, m/s: a metre in twelve days. Squares of far smaller speeds
    /// are zero in the memory of a computer.
    pub const MIN_SPEED: f64 = 1e-6;

    /// Largest speed of a grid, m/s.
    pub const MAX_SPEED: f64 = 1000.0;

    /// A grid with `points` speeds per track from −`max_speed` to `max_speed` (m/s).
    ///
    /// # Errors
    /// [`GridError`].
    pub fn new(points: usize, max_speed: f64) -> Result<Self, GridError> {
        if !(2..=Self::MAX_POINTS).contains(&points) {
            return Err(GridError::Points(points));
        }
        if !(Self::MIN_SPEED..=Self::MAX_SPEED).contains(&max_speed) {
            return Err(GridError::Speed(max_speed));
        }
        Ok(Self { points, max_speed })
    }

    /// Speeds per track.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Largest speed, m/s.
    pub fn max_speed(&self) -> f64 {
        self.max_speed
    }

    /// The speeds, ascending and symmetric about zero to the last bit, m/s.
    #[expect(clippy::cast_precision_loss, reason = "at most 2001 points")]
    pub fn speeds(&self) -> Vec<f64> {
        let last = (self.points - 1) as f64;
        (0..self.points).map(|k| self.max_speed * (2.0 * k as f64 - last) / last).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_are_symmetric_and_hit_zero() {
        let speeds = Grid::new(11, 0.7).expect("a grid").speeds();
        assert_eq!(speeds[5], 0.0);
        assert!(speeds.iter().zip(speeds.iter().rev()).all(|(a, b)| *a == -b));
        assert_eq!((speeds[0], speeds[10]), (-0.7, 0.7));
    }

    #[test]
    fn nonsense_is_refused() {
        assert_eq!(Grid::new(0, 1.0), Err(GridError::Points(0)));
        assert_eq!(Grid::new(1_000_000, 1.0), Err(GridError::Points(1_000_000)));
        assert_eq!(Grid::new(11, 0.0), Err(GridError::Speed(0.0)));
        assert_eq!(Grid::new(11, 1e308), Err(GridError::Speed(1e308)));
        assert!(Grid::new(11, f64::NAN).is_err());
    }
}

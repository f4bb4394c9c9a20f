//! A path of simple shape.

use super::Path;
use crate::Error;

impl Path {
    /// A square from the origin along x, with corners to the left (or right), driven `laps` times,
    /// m.
    ///
    /// # Errors
    /// [`Error::Option`].
    pub fn square(side: f64, to_the_left: bool, laps: usize) -> Result<Self, Error> {
        check("side", side, laps)?;
        let y = if to_the_left { side } else { -side };
        let corners = [[0.0, 0.0], [side, 0.0], [side, y], [0.0, y]];
        let points = corners.into_iter().cycle().take(4 * laps + 1).collect();
        Self::new(points)
    }
}

impl Default for Path {
    /// A square of 3 m, once to the left.
    fn default() -> Self {
        Self::square(3.0, true, 1).expect("numbers in range")
    }
}

fn check(name: &'static str, size: f64, laps: usize) -> Result<(), Error> {
    if !(size > 0.0 && size <= 1e5) {
        return Err(Error::option(name, &size, "a positive length in m, at most 100000"));
    }
    if !(1..=1000).contains(&laps) {
        return Err(Error::option("laps", &laps, "1 to 1000"));
    }
    Ok(())
}

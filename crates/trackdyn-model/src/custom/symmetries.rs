//! Which symmetries of the ICRs a law breaks, measured at typical values.
//!
//! # Law
//! Coulomb friction depends on the ICRs and the sense of turning alone. A law breaks a symmetry
//! where it differs between two motions with the same ICRs that the symmetry makes alike.

use super::{Batch, CustomLaw, Failure, Kind};
use crate::effect::Symmetry;

/// ICRs (x_l, x_r, y) of all probes, m. Not symmetric, so that nothing vanishes by chance.
const ICRS: [f64; 3] = [-0.61, 0.57, 0.083];

/// Points of the contact (x, y), m: of the left and the right side.
const POINTS: [[f64; 2]; 4] = [[-0.27, 0.31], [-0.23, -0.19], [0.21, 0.17], [0.29, -0.37]];

/// Belt speeds of turns to the left, m/s: an arc, a turn against each other, a spin.
const SPEEDS: [[f64; 2]; 3] = [[0.31, 0.83], [-0.12, 0.47], [-0.39, 0.39]];

/// Part of the largest result below which a difference is rounding.
const ROUNDING: f64 = 1e-9;

/// A motion at a place, heading and time.
#[derive(Clone, Copy)]
struct Probe {
    speeds: [f64; 2],
    icrs: [f64; 3],
    loads: [f64; 2],
    /// −1: points and sides are exchanged.
    mirror: f64,
    place: [f64; 2],
    heading: f64,
    time: f64,
}

impl Probe {
    fn of(speeds: [f64; 2]) -> Self {
        let (loads, place) = ([1000.0, 1200.0], [0.0, 0.0]);
        Self { speeds, icrs: ICRS, loads, mirror: 1.0, place, heading: 0.0, time: 0.0 }
    }

    fn times(self, factor: f64) -> Self {
        Self { speeds: self.speeds.map(|speed| factor * speed), ..self }
    }

    fn mirrored(self) -> Self {
        let ([left, right], [x_left, x_right, y]) = (self.speeds, self.icrs);
        let [load_left, load_right] = self.loads;
        Self {
            speeds: [right, left],
            icrs: [-x_right, -x_left, y],
            loads: [load_right, load_left],
            mirror: -1.0,
            ..self
        }
    }

    /// States of a law in columns, and their number.
    fn columns(&self, kind: Kind) -> (usize, Vec<f64>) {
        let ([left, right], [x_left, x_right, y]) = (self.speeds, self.icrs);
        // eqs (7)-(9) in the paper's frame
        let w = (right - left) / (x_right - x_left);
        let (v_x, v_y) = (w * y, left - w * x_left);
        let [place_x, place_y] = self.place;
        let motion = [v_y, -v_x, w, left, right, place_x, place_y, self.heading, self.time];
        let rows: Vec<Vec<f64>> = match kind {
            Kind::Force => vec![[&motion[..], &self.loads].concat()],
            Kind::Friction => {
                let at_point = |[x, y]: [f64; 2]| {
                    let x = self.mirror * x;
                    let belt = if x < 0.0 { left } else { right };
                    let (slip_x, slip_y) = (v_x - w * y, v_y + w * x - belt);
                    let (sin, cos) = self.heading.sin_cos();
                    let there = [place_x + cos * y + sin * x, place_y + sin * y - cos * x];
                    let pressure = 8000.0 + 3000.0 * y;
                    let slip = [slip_y, -slip_x, slip_x.hypot(slip_y)];
                    let point = [pressure, belt, y, -x, there[0], there[1]];
                    [&motion[..], &slip, &point].concat()
                };
                POINTS.into_iter().map(at_point).collect()
            }
        };
        let arguments = kind.arguments().len();
        let columns = (0..arguments).flat_map(|place| rows.iter().map(move |row| row[place]));
        (rows.len(), columns.collect())
    }
}

impl CustomLaw {
    /// The law with the symmetries on its card that it breaks at typical values.
    ///
    /// # Errors
    /// The failure of its function.
    pub fn measured(self) -> Result<Self, Failure> {
        let broken = broken(&self)?;
        Ok(self.breaking(broken))
    }
}

/// The symmetries that a law breaks, ascending.
fn broken(law: &CustomLaw) -> Result<Vec<Symmetry>, Failure> {
    let values: Vec<f64> = law.card().parameters.iter().map(|one| one.typical).collect();
    let results = |probe: Probe| -> Result<Vec<f64>, Failure> {
        let (rows, columns) = probe.columns(law.kind());
        let at = Batch::new(law.kind(), rows, &columns);
        let found = law.results(&at, &values)?;
        law.not_finite(&at, &values, &found, rows).map_or(Ok(found), Err)
    };
    // Friction is odd in the velocity; a force is as it is.
    let reversed = if law.kind() == Kind::Force { -1.0 } else { 1.0 };
    let mut largest = 0.0_f64;
    let mut differ = |one: Probe, other: Probe, signs: [f64; 3]| -> Result<bool, Failure> {
        let (one, other) = (results(one)?, results(other)?);
        let rows = one.len() / law.kind().results().len();
        let pairs = one.iter().zip(&other).enumerate();
        let off = pairs.map(|(k, (a, b))| (a - signs[k / rows] * b).abs()).fold(0.0, f64::max);
        largest = one.iter().chain(&other).fold(largest, |most, value| most.max(value.abs()));
        Ok(off > ROUNDING * largest)
    };
    let alike = [1.0; 3];
    let mirrored = if law.kind() == Kind::Force { [1.0, -1.0, -1.0] } else { alike };
    let spin = Probe::of(SPEEDS[2]);
    let mut broken = Vec::new();
    for speeds in SPEEDS {
        let here = Probe::of(speeds);
        let elsewhere = [[2.3, 0.0], [-31.0, 17.0]];
        let tried = [
            (Symmetry::SpeedScale, here.times(2.0), alike),
            (Symmetry::Reversal, here.times(-1.0), [reversed; 3]),
            (Symmetry::Manoeuvre, spin, alike),
            (Symmetry::Mirror, here.mirrored(), mirrored),
            (Symmetry::Heading, Probe { heading: 0.7, ..here }, alike),
            (Symmetry::Heading, Probe { heading: -2.1, ..here }, alike),
            (Symmetry::Place, Probe { place: elsewhere[0], ..here }, alike),
            (Symmetry::Place, Probe { place: elsewhere[1], ..here }, alike),
            (Symmetry::Time, Probe { time: 3.7, ..here }, alike),
            (Symmetry::Time, Probe { time: 311.0, ..here }, alike),
        ];
        for (symmetry, other, signs) in tried {
            if differ(here, other, signs)? && !broken.contains(&symmetry) {
                broken.push(symmetry);
            }
        }
    }
    broken.sort_unstable();
    Ok(broken)
}

//! A patch of other ground.

use crate::mechanism::{Contact, Described, Mechanism, scale_ratio};
use crate::sheet::{Invariance, Origin, Parameter, Sheet};

use std::f64::consts::PI;

/// Half the root of three.
const SIN_60: f64 = 0.866_025_403_784_438_6;
/// Normals of the hexagon's sides: at 0, 60 and 120 degrees.
const NORMALS: [[f64; 2]; 3] = [[1.0, 0.0], [0.5, SIN_60], [-0.5, SIN_60]];

/// A hexagon, each shoe on its own side of the border.
#[derive(Clone, Copy, Debug)]
pub struct TerrainPatch {
    factor: f64,
    centre: [f64; 2],
    apothem: f64,
}

impl Described for TerrainPatch {
    const SHEET: Sheet = Sheet {
        id: "terrain-patch",
        origin: Origin::Catalogue,
        law: "μ_x √f, μ_y/√f inside a regular hexagon",
        size: "the hexagon has the area of a disc of the radius",
        breaks: &[Invariance::Place],
        parameters: &[
            Parameter { key: "x_m", unit: "m", range: [-10000.0, 10000.0], typical: 0.0 },
            Parameter { key: "y_m", unit: "m", range: [-10000.0, 10000.0], typical: 0.0 },
            Parameter { key: "radius_m", unit: "m", range: [0.05, 10000.0], typical: 1.0 },
            Parameter { key: "ratio", unit: "1", range: [0.2, 5.0], typical: 1.3 },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        // π r² = 2 √3 a²
        let apothem = values[2] * (PI / (2.0 * 3.0_f64.sqrt())).sqrt();
        Self { factor: values[3], centre: [values[0], values[1]], apothem }
    }
}

impl Mechanism for TerrainPatch {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let [x, y] = contact.world();
        let (x, y) = (x - self.centre[0], y - self.centre[1]);
        let inside = NORMALS.iter().all(|[cos, sin]| (cos * x + sin * y).abs() < self.apothem);
        if inside {
            scale_ratio(mu, self.factor);
        }
    }
}

//! A patch of other ground.

use crate::mechanism::{Contact, Described, Mechanism, scale_ratio};
use crate::sheet::{Anchor, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

use std::f64::consts::PI;

/// Half the root of three.
const SIN_60: f64 = 0.866_025_403_784_438_6;
/// Normals of the hexagon's sides: at 0, 60 and 120 degrees.
const SIDE_NORMALS: [[f64; 2]; 3] = [[1.0, 0.0], [0.5, SIN_60], [-0.5, SIN_60]];

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
        shares_size: false,
        breaks: &[Symmetry::Place],
        trial: Trial::law(Identifiability::Distinct, 4.0),
        parameters: &[
            Parameter {
                key: "x_m",
                unit: "m",
                range: [-10000.0, 10000.0],
                typical: 0.0,
                draw: Draw::place(0, Anchor::OnPath),
            },
            Parameter {
                key: "y_m",
                unit: "m",
                range: [-10000.0, 10000.0],
                typical: 0.0,
                draw: Draw::place(1, Anchor::OnPath),
            },
            Parameter {
                key: "radius_m",
                unit: "m",
                range: [0.05, 10000.0],
                typical: 1.0,
                draw: Draw::shape(0.8, 2.5, &[1.5]),
            },
            Parameter {
                key: "ratio",
                unit: "1",
                range: [0.2, 5.0],
                typical: 1.3,
                draw: Draw::factor(1.3).signed(),
            },
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
        let inside = SIDE_NORMALS.iter().all(|[cos, sin]| (cos * x + sin * y).abs() < self.apothem);
        if inside {
            scale_ratio(mu, self.factor);
        }
    }
}

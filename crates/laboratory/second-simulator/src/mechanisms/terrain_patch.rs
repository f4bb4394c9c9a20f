//! A patch of other ground.

mod border;

use border::Border;
use crate::form::Draws;
use crate::mechanism::{Contact, Described, Mechanism, scale_ratio, share_ratio};
use crate::sheet::{
    Anchor, Draw, Family, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial,
};

use std::f64::consts::PI;

/// Half the root of three.
const SIN_60: f64 = 0.866_025_403_784_438_6;
/// Normals of the hexagon's sides: at 0, 60 and 120 degrees.
const SIDE_NORMALS: [[f64; 2]; 3] = [[1.0, 0.0], [0.5, SIN_60], [-0.5, SIN_60]];

/// A hexagon, each shoe on its own side of the border.
#[derive(Clone, Debug)]
pub struct TerrainPatch {
    factor: f64,
    centre: [f64; 2],
    outline: Outline,
}

/// Where the patch ends.
#[derive(Clone, Debug)]
enum Outline {
    /// A regular hexagon.
    Hexagon { apothem: f64 },
    /// Another one.
    Drawn { border: Border, across: f64 },
}

impl Described for TerrainPatch {
    const SHEET: Sheet = Sheet {
        id: "terrain-patch",
        origin: Origin::Catalogue,
        law: "μ_x √f, μ_y/√f inside a regular hexagon",
        size: "the hexagon has the area of a disc of the radius",
        shares_size: false,
        family: Some(Family {
            law: "μ_x f^(q w), μ_y f^((q − 1) w), w from 1 inside to 0 outside within 0 to 12 % of \
                  the radius, of an ellipse up to 1 : 2.5 or a random smooth star, q from 0 to 1",
            size: "all outlines have the area of a disc of the radius",
            shares_size: false,
        }),
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
        let outline = Outline::Hexagon { apothem };
        Self { factor: values[3], centre: [values[0], values[1]], outline }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let across = random.between(0.0, 1.0);
        let outline = Outline::Drawn { border: Border::draw(values[2], random), across };
        Self { outline, ..Self::from_values(values) }
    }
}

impl Mechanism for TerrainPatch {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let [x, y] = contact.world();
        let (x, y) = (x - self.centre[0], y - self.centre[1]);
        match &self.outline {
            Outline::Hexagon { apothem } => {
                let inside = |[cos, sin]: &[f64; 2]| (cos * x + sin * y).abs() < *apothem;
                if SIDE_NORMALS.iter().all(inside) {
                    scale_ratio(mu, self.factor);
                }
            }
            Outline::Drawn { border, across } => {
                let weight = border.weight([x, y]);
                if weight > 0.0 {
                    share_ratio(mu, self.factor.powf(weight), *across);
                }
            }
        }
    }
}

//! Wind on a tall body.

use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Scale, Sheet, Symmetry, Trial};
use trackdyn_core::{Twist, Wrench};

/// The body is broader from the side than from the front, and moves through the air.
#[derive(Clone, Copy, Debug)]
pub struct SideWind {
    force: f64,
    towards: f64,
}

impl Described for SideWind {
    const SHEET: Sheet = Sheet {
        id: "side-wind",
        origin: Origin::Outside,
        law: "F = F₀ (0.5 + 0.5 |cos β|) along the wind, β between the wind and the robot's x \
              axis, at 0.1 m before the middle",
        size: "a slope with the heading's second harmonic and a moment",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::Reversal, Symmetry::Mirror, Symmetry::Heading],
        trial: Trial::law(Identifiability::Distinct, 7.0),
        parameters: &[
            Parameter {
                key: "force_n",
                unit: "N",
                range: [0.0, 10000.0],
                typical: 80.0,
                draw: Draw::size(0.03).times(Scale::Weight),
            },
            Parameter {
                key: "towards_deg",
                unit: "deg",
                range: [-360.0, 360.0],
                typical: 0.0,
                draw: Draw::direction(),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { force: values[0], towards: values[1].to_radians() }
    }
}

impl Mechanism for SideWind {
    fn push(&self, scene: &Scene, _twist: &Twist, wrench: &mut Wrench) {
        let (sin, cos) = self.towards.sin_cos();
        let wind = scene.body_axes_from_world([cos, sin]);
        let force = self.force * f64::midpoint(1.0, wind[0].abs());
        wrench.add_force(wind.map(|wind| wind * force), [0.0, 0.1]);
    }
}

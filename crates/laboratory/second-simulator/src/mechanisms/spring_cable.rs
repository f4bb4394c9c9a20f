//! An elastic cable to a post.

use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{
    Anchor, Draw, Identifiability, Origin, Parameter, Scale, Sheet, Symmetry, Trial,
};
use trackdyn_core::{Twist, Wrench};

/// It hangs loose within its length and pulls like a spring beyond.
#[derive(Clone, Copy, Debug)]
pub struct SpringCable {
    rate: f64,
    length: f64,
    post: [f64; 2],
}

impl Described for SpringCable {
    const SHEET: Sheet = Sheet {
        id: "spring-cable",
        origin: Origin::Outside,
        law: "F = k (|d| − l) d/|d| at 0.3 m behind the middle, for |d| > l",
        size: "a bungee: stretched by 2 m it pulls a twentieth of Auriga-alpha's weight",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::Reversal, Symmetry::Mirror, Symmetry::Heading, Symmetry::Place],
        trial: Trial::law(Identifiability::Distinct, 2.5),
        parameters: &[
            Parameter {
                key: "rate_n_per_m",
                unit: "N/m",
                range: [0.0, 1e5],
                typical: 60.0,
                draw: Draw::size(1.0 / 42.0).times(Scale::Weight),
            },
            Parameter {
                key: "length_m",
                unit: "m",
                range: [0.0, 1000.0],
                typical: 1.0,
                draw: Draw::fixed(1.0),
            },
            Parameter {
                key: "x_m",
                unit: "m",
                range: [-1e4, 1e4],
                typical: 3.0,
                draw: Draw::place(0, Anchor::Around([1.5, 5.0])),
            },
            Parameter {
                key: "y_m",
                unit: "m",
                range: [-1e4, 1e4],
                typical: 0.0,
                draw: Draw::place(1, Anchor::Around([1.5, 5.0])),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { rate: values[0], length: values[1], post: [values[2], values[3]] }
    }
}

impl Mechanism for SpringCable {
    fn push(&self, scene: &Scene, _twist: &Twist, wrench: &mut Wrench) {
        let eye = [0.0, -0.3];
        let [x, y] = scene.world_from_body(eye);
        let away = [self.post[0] - x, self.post[1] - y];
        let distance = away[0].hypot(away[1]);
        if distance > self.length {
            let factor = self.rate * (distance - self.length) / distance;
            let force = scene.body_axes_from_world(away.map(|away| away * factor));
            wrench.add_force(force, eye);
        }
    }
}

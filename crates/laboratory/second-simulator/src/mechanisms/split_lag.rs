//! One belt that follows late.

use crate::mechanism::{Described, Mechanism, Scene, Step};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{PerSide, Side};

/// A motor whose belt lags behind.
#[derive(Clone, Copy, Debug)]
pub struct SplitLag {
    late: Side,
    lag: f64,
    belt: f64,
}

impl Described for SplitLag {
    const SHEET: Sheet = Sheet {
        id: "split-lag",
        origin: Origin::Catalogue,
        law: "V' = (V_shown − V)/|δ|, left for δ > 0, right for δ < 0",
        size: "the same",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Transient],
        trial: Trial::law(Identifiability::Distinct, 4.0).with_drawn_forms_only(),
        parameters: &[
            Parameter {
                key: "left_s",
                unit: "s",
                range: [-2.0, 2.0],
                typical: 0.1,
                draw: Draw::size(0.1).signed(),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        let late = if values[0] >= 0.0 { Side::Left } else { Side::Right };
        Self { late, lag: values[0].abs(), belt: 0.0 }
    }
}

impl Mechanism for SplitLag {
    fn drive(&self, _scene: &Scene, dt: f64, belt: &mut PerSide<f64>) {
        if self.lag > 0.0 {
            let (steps, input) = (dt / self.lag, belt[self.late]);
            // mean of V_shown + (V − V_shown) e^(−t/T) over the step
            belt[self.late] = input - (self.belt - input) * (-steps).exp_m1() / steps;
        }
    }

    fn advance(&mut self, step: &Step) {
        if self.lag > 0.0 {
            let input = step.fed[self.late];
            self.belt = input + (self.belt - input) * (-step.dt / self.lag).exp();
        }
    }
}

//! A force on the body without a known cause.

mod coefficients;
mod factor;

use crate::effect::{Card, Effect, Nature, Stage, Symmetry, Term};
use crate::pipeline::Situation;
use coefficients::{COUNT, FACTORS, PARAMETERS};
use factor::{Arguments, Component, Scales};
use trackdyn_core::{PerSide, STANDARD_GRAVITY, Scalar, Wrench};

/// A wrench that is a sum of dimensionless terms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceLaw {
    coefficients: [f64; COUNT],
    /// Time unit of the time-dependent terms, s.
    time_scale: f64,
}

impl Effect for ForceLaw {
    const CARD: Card = Card {
        id: "force-law",
        title: "Force on the body of an empirical form",
        law: "F_x, F_y = m g Σ c_k b_k, M = m g ℓ/2 Σ c_k b_k, b_k of v/√(g ℓ), ω √(ℓ/g), the \
              signs of V_l + V_r and V_r − V_l, heading, place/ℓ and t/T",
        assumes: "A form and no mechanism: it describes what was seen, within what was driven. ℓ \
                  is the length of the contact, v and ω are those of the hull at the origin. \
                  Changes of speed and what sensors and encoders do have no term.",
        shows: "Where its terms say. A diagnosis proposes terms of it where no effect explains \
                what is left.",
        resembles: "",
        breaks: &[
            Symmetry::SpeedScale,
            Symmetry::Reversal,
            Symmetry::Manoeuvre,
            Symmetry::Mirror,
            Symmetry::Heading,
            Symmetry::Place,
            Symmetry::Time,
        ],
        stages: &[Stage::Wrench],
        parameters: PARAMETERS,
        sources: &[
            "Dimensional analysis: Buckingham, Physical Review 4(4), 1914; sparse regression of \
             laws: Brunton, Proctor, Kutz, Proceedings of the National Academy of Sciences \
             113(15), 2016",
        ],
    };

    const NATURE: Nature = Nature::Form;

    fn terms() -> Vec<Term> {
        factor::terms(FACTORS, PARAMETERS)
    }

    fn from_values(values: &[f64]) -> Self {
        let mut coefficients = [0.0; COUNT];
        coefficients.copy_from_slice(&values[..COUNT]);
        Self { coefficients, time_scale: values[COUNT] }
    }

    fn wrench<S: Scalar>(
        &self,
        situation: &Situation<S>,
        _normal_load: &PerSide<S>,
        wrench: &mut Wrench<S>,
    ) {
        let weight = situation.vehicle.mass * STANDARD_GRAVITY;
        let [rear, front] = situation.footprint.ends;
        let length = front - rear;
        let scales = Scales { length, time: self.time_scale };
        let arguments = Arguments::of(situation, &scales);
        let circumstance = &situation.ground.circumstance;
        for (coefficient, factor) in self.coefficients.iter().zip(FACTORS) {
            if *coefficient == 0.0 {
                continue;
            }
            // F = c b m g, M = c b m g ℓ/2
            let share = factor.value(&arguments) * (coefficient * weight);
            match factor.component {
                Component::Side => wrench.force_x += share,
                Component::Forward => wrench.force_y += share,
                Component::Turn => wrench.moment += share * (length / 2.0),
                Component::World(axis) => {
                    let [x, y] = circumstance.to_robot(axis.map(f64::from));
                    wrench.force_x += share * x;
                    wrench.force_y += share * y;
                }
                Component::Spring => {
                    let [x, y] = circumstance.position;
                    // F = −c m g p/ℓ
                    let [x, y] = circumstance.to_robot([-x / length, -y / length]);
                    wrench.force_x += share * x;
                    wrench.force_y += share * y;
                }
            }
        }
    }
}

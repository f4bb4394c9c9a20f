//! Ground that holds the tracks back.

use crate::form::Draws;
use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Belt speed at which the ground resists with 71 %, m/s.
const ONSET_SPEED: f64 = 2e-3;

/// How the ground resists.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rolling {
    onset_speed: f64,
    sinking: Option<Sinking>,
}

/// Ground in which tracks sink.
#[derive(Clone, Copy, Debug)]
struct Sinking {
    /// Power of the load of the side over half the weight.
    load_power: f64,
    /// Excess where the track slips and does not move.
    slip: f64,
}

impl Rolling {
    /// Hard ground.
    pub(super) const HARD_GROUND: Self = Self { onset_speed: ONSET_SPEED, sinking: None };

    /// Some ground.
    pub(super) fn draw(random: &mut Draws) -> Self {
        let load_power = random.between(-0.3, 0.5);
        let sinking = Sinking { load_power, slip: random.between(0.0, 0.6) };
        Self { onset_speed: random.log_between(5e-4, 5e-3), sinking: Some(sinking) }
    }

    /// Force along the track that holds a shoe back, N.
    pub(super) fn resistance(self, coefficient: f64, contact: &Contact) -> f64 {
        let (scene, onset) = (contact.scene, self.onset_speed);
        let speed = scene.sprocket[contact.side];
        let hard = -coefficient * contact.load * speed / (speed * speed + onset * onset).sqrt();
        let Some(Sinking { load_power, slip }) = self.sinking else { return hard };
        let load = 2.0 * scene.weight[contact.side] / scene.total_weight();
        let slips = contact.slip_speed();
        let part = slips / slips.hypot(speed).max(f64::MIN_POSITIVE);
        hard * load.powf(load_power) * (1.0 + slip * part)
    }
}

/// Each shoe pays for the ground it presses in.
#[derive(Clone, Copy, Debug)]
pub struct MotionResistance {
    coefficient: f64,
    rolling: Rolling,
}

impl Described for MotionResistance {
    const SHEET: Sheet = Sheet {
        id: "motion-resistance",
        origin: Origin::Catalogue,
        law: "R = −c N V/√(V² + v₀²) on every shoe, v₀ = 2 mm/s",
        size: "the same above 2 cm/s, smooth below",
        shares_size: true,
        family: Some(Family {
            law: "R = −c N (2 N_j/W)^q (1 + k |s|/√(s² + V²)) V/√(V² + v₀²), N_j the load of the \
                  side, q from −0.3 to 0.5, k from 0 to 0.6, v₀ from 0.5 to 5 mm/s",
            size: "the same straight ahead; where the tracks slip they sink in deeper",
            shares_size: false,
        }),
        breaks: &[Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::DistinctWhenLarge, 6.0),
        parameters: &[Parameter {
            key: "coefficient",
            unit: "1",
            range: [0.0, 0.5],
            typical: 0.05,
            draw: Draw::size(0.05),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { coefficient: values[0], rolling: Rolling::HARD_GROUND }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        Self { coefficient: values[0], rolling: Rolling::draw(random) }
    }
}

impl Mechanism for MotionResistance {
    fn resistance(&self, contact: &Contact, force: &mut f64) {
        *force += self.rolling.resistance(self.coefficient, contact);
    }
}

//! More friction under the front than under the rear.

use crate::form::Draws;
use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Trial};

/// A step of friction in the middle of the contact.
#[derive(Clone, Copy, Debug)]
pub struct FrictionGradient {
    /// Excess at the front end.
    end: f64,
    profile: Profile,
}

/// How it goes from the rear to the front end.
#[derive(Clone, Copy, Debug)]
enum Profile {
    /// A step in the middle.
    Step,
    /// A power of the distance from the middle.
    Power(f64),
}

impl Described for FrictionGradient {
    const SHEET: Sheet = Sheet {
        id: "friction-gradient",
        origin: Origin::Catalogue,
        law: "μ (1 + (2/3) γ tanh(5 η)), η = y over the half length of a side's contact",
        size: "a step of 2/3 γ has the first moment along y of the linear law 1 + γ η",
        shares_size: false,
        family: Some(Family {
            law: "μ (1 + γ (p + 2)/3 sign(η) |η|^p), p from 0.2 to 0.7 or 1.4 to 2.5, not below \
                  nothing",
            size: "first moment of 1 + γ η",
            shares_size: false,
        }),
        breaks: &[],
        trial: Trial::law(Identifiability::Indistinct, 5.0),
        parameters: &[Parameter {
            key: "gradient",
            unit: "1",
            range: [-0.9, 0.9],
            typical: 0.1,
            draw: Draw::size(0.1).signed(),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        // ∫ η γ η dη = ∫ |η| step dη over the contact
        Self { end: 2.0 / 3.0 * values[0], profile: Profile::Step }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let is_steep = random.happens(0.5);
        let power = if is_steep { random.between(0.2, 0.7) } else { random.between(1.4, 2.5) };
        // ∫ η γ η dη = ∫ |η|^(p + 1) end dη
        Self { end: (power + 2.0) / 3.0 * values[0], profile: Profile::Power(power) }
    }
}

impl Mechanism for FrictionGradient {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let eta = contact.relative_y();
        let profile = match self.profile {
            Profile::Step => (5.0 * eta).tanh(),
            Profile::Power(power) => eta.abs().powf(power).copysign(eta),
        };
        let factor = (1.0 + self.end * profile).max(0.0);
        *mu = mu.map(|mu| mu * factor);
    }
}

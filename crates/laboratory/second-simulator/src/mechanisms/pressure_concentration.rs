//! Load that the belt hands on under its rollers.

use crate::form::Draws;
use crate::mechanism::{Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Trial};

/// Five road wheels, the outer ones over the ends of the contact.
#[derive(Clone, Debug)]
pub struct PressureConcentration {
    share: f64,
    rollers: Rollers,
}

/// Where the rollers press.
#[derive(Clone, Debug)]
enum Rollers {
    /// Five of one print.
    Five,
    /// Others.
    Prints { places: Vec<f64>, width: f64, weights: Vec<f64> },
}


impl Described for PressureConcentration {
    const SHEET: Sheet = Sheet {
        id: "pressure-concentration",
        origin: Origin::Catalogue,
        law: "k(η) = 1 − κ + κ c(η) (1 + cos 4πη), c = 2 for the end rollers, else 1",
        size: "excess of the second moment of pressure along y: 0.43 κ/(1 + κ/4); 0.4 κ_U of a \
               U-shape 1 + κ_U (3 η² − 1)/2",
        shares_size: false,
        family: Some(Family {
            law: "k(η) = 1 − σ + σ P(η), P of four to seven even prints exp(−((η − η_i)/w)²/2), w \
                  from 0.1 to 0.2, the outer two 5 to 8 times as heavy, half of them beyond the \
                  ends, mean 1",
            size: "the second moment along y is that of the U-shape",
            shares_size: false,
        }),
        breaks: &[],
        trial: Trial::law(Identifiability::Indistinct, 2.25),
        parameters: &[Parameter {
            key: "concentration",
            unit: "1",
            range: [0.0, 0.95],
            typical: 0.5,
            draw: Draw::size(0.4),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { share: values[0], rollers: Rollers::Five }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let count = random.whole(4, 7);
        let places: Vec<f64> =
            (0..count).map(|k| 2.0 * f64::from(k) / f64::from(count - 1) - 1.0).collect();
        let width = random.between(0.1, 0.2);
        let outer = random.between(5.0, 8.0);
        let is_outer = |k: u32| k == 0 || k == count - 1;
        let weights: Vec<f64> =
            (0..count).map(|k| if is_outer(k) { outer } else { 1.0 }).collect();
        let shape = Rollers::Prints { places: places.clone(), width, weights: weights.clone() };
        let [mean, second] = [0, 2].map(|power| moment(|eta| shape.at(eta), power));
        let weights = weights.into_iter().map(|weight| weight / mean).collect();
        // 3 ⟨η² P⟩ − 1 against 0.4 κ of the U-shape
        let excess = 3.0 * second / mean - 1.0;
        let share = (0.4 * values[0] / excess).min(1.0);
        Self { share, rollers: Rollers::Prints { places, width, weights } }
    }
}

impl Mechanism for PressureConcentration {
    fn bed(&self, y: f64, [rear, front]: [f64; 2], stiffness: &mut f64) {
        let eta = (2.0 * y - rear - front) / (front - rear);
        *stiffness *= 1.0 - self.share + self.share * self.rollers.at(eta);
    }
}

impl Rollers {
    /// Pressure at a place along the contact, in parts of about the mean.
    fn at(&self, eta: f64) -> f64 {
        match self {
            Self::Five => {
                // half of an end roller's print lies beyond the contact, and the other half carries
                // its load
                let carries = if eta.abs() > 0.75 { 2.0 } else { 1.0 };
                carries * (1.0 + (4.0 * std::f64::consts::PI * eta).cos())
            }
            Self::Prints { places, width, weights } => {
                let print = |place: &f64| (-((eta - place) / width).powi(2) / 2.0).exp();
                places.iter().zip(weights).map(|(place, weight)| weight * print(place)).sum()
            }
        }
    }
}

/// Mean of a power of η times a profile along the contact.
fn moment(profile: impl Fn(f64) -> f64, power: i32) -> f64 {
    const PARTS: u32 = 1000;
    let middles = (0..PARTS).map(|k| (2.0 * f64::from(k) + 1.0) / f64::from(PARTS) - 1.0);
    middles.map(|eta| eta.powi(power) * profile(eta)).sum::<f64>() / f64::from(PARTS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form::Form;

    #[test]
    fn all_prints_have_the_second_moment_of_the_u_shape() {
        for number in 0..100 {
            let mut draws = Form::Drawn(number).draws().expect("draws");
            let drawn = PressureConcentration::drawn(&[0.5], &mut draws);
            let stiffness = |eta: f64| {
                let mut stiffness = 1.0;
                drawn.bed(eta, [-1.0, 1.0], &mut stiffness);
                stiffness
            };
            // sums over a thousand parts
            assert!((moment(stiffness, 0) - 1.0).abs() < 1e-5, "{number}");
            // 1 + κ (3 η² − 1)/2
            let excess = 3.0 * moment(stiffness, 2) - 1.0;
            assert!((excess - 0.4 * 0.5).abs() < 1e-5, "{number}: {excess}");
        }
    }
}

//! A term of a proposed law in words.

use super::Proposed;
use crate::uncertainty::Interval;
use trackdyn_core::rounding::decimals;
use trackdyn_model::effect::Pairing;

/// A number with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Estimate.
    pub value: f64,
    /// Half width of the interval.
    pub half: f64,
}

impl Proposed {
    /// Size of the term: its coefficient, or the norm of its coefficients.
    pub fn size(&self) -> Size {
        match self.term.pairing {
            Pairing::Alone | Pairing::Spring => size(&self.coefficients[0]),
            Pairing::Heading(_) | Pairing::World => {
                let [value, _] = polar(&self.coefficients);
                Size { value, half: half(&self.coefficients) }
            }
        }
    }

    /// Heading at which a term is largest, or direction in the world in which it points or grows,
    /// degrees counter-clockwise from the world's x axis, with half its 95 % interval; none for
    /// terms without a direction.
    pub fn direction(&self) -> Option<Size> {
        let times = match self.term.pairing {
            Pairing::Heading(times) => f64::from(times),
            Pairing::World => 1.0,
            Pairing::Alone | Pairing::Spring => return None,
        };
        let [length, angle] = polar(&self.coefficients);
        let half = (half(&self.coefficients) / length).min(std::f64::consts::PI);
        let angle = angle.rem_euclid(std::f64::consts::TAU);
        Some(Size { value: angle.to_degrees() / times, half: half.to_degrees() / times })
    }

    /// The term as a phrase, such as "sideways force of 0.0310 ± 0.0040 of the weight times
    /// cos(heading − 40° ± 7°)".
    pub fn phrase(&self, contact_length: f64) -> String {
        let term = &self.term;
        let Size { value, half } = self.size();
        let decimals = decimals(half);
        let head =
            format!("{} of {value:.decimals$} ± {half:.decimals$} {}", term.component, term.unit);
        let times = |parts: [&str; 2]| {
            let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
            if parts.is_empty() {
                head.clone()
            } else {
                format!("{head} times {}", parts.join(" "))
            }
        };
        let angle = self
            .direction()
            .map_or(String::new(), |angle| format!("{:.0}° ± {:.0}°", angle.value, angle.half));
        match term.pairing {
            Pairing::Alone => times([&term.factor, ""]),
            Pairing::Heading(1) => times([&term.factor, &format!("cos(heading − {angle})")]),
            Pairing::Heading(n) => times([&term.factor, &format!("cos {n}(heading − {angle})")]),
            Pairing::World if term.factor.is_empty() => {
                format!("{head} towards {angle} of the world")
            }
            Pairing::World => {
                let per = "per length of the contact from the world's origin towards";
                format!("{} {per} {angle}", times([&term.factor, ""]))
            }
            Pairing::Spring => {
                let place = |k: usize| contact_length * self.coefficients[k].value / value;
                let (x, y) = (place(1), place(2));
                let per = "per length of the contact, towards the place";
                format!("{head} {per} ({x:.1}, {y:.1}) m")
            }
        }
    }
}

fn size(interval: &Interval) -> Size {
    Size { value: interval.value, half: (interval.high - interval.low) / 2.0 }
}

/// Norm and angle (rad) of a pair of coefficients.
fn polar(pair: &[Interval]) -> [f64; 2] {
    let (a, b) = (pair[0].value, pair[1].value);
    [a.hypot(b), b.atan2(a)]
}

/// Mean half width of the intervals of a pair.
fn half(pair: &[Interval]) -> f64 {
    f64::midpoint(size(&pair[0]).half, size(&pair[1]).half)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hypothesis::Unknown;
    use crate::verdict::Support;
    use trackdyn_model::EffectId;

    /// A term with these coefficients ± 0.004.
    fn proposed(key: &str, values: &[f64]) -> Proposed {
        let form = EffectId::all().find(|effect| effect.card().is_form());
        let effect = form.expect("a form");
        let terms = effect.card().terms();
        let term = terms.into_iter().find(|term| term.key == key).expect("a term");
        let coefficients = term.coefficients.iter().zip(values).map(|(&place, &value)| Interval {
            unknown: Unknown::Effect(effect, place),
            value,
            low: value - 0.004,
            high: value + 0.004,
        });
        let support = Support {
            p: 0.0005,
            ln_bayes_factor: 9.0,
            held_out_gain: 9.0,
            held_out_error: 1.0,
            ..Support::none()
        };
        Proposed { coefficients: coefficients.collect(), term, support }
    }

    #[test]
    fn cosine_and_sine_are_one_size_and_one_angle() {
        let (sin, cos) = 40.0_f64.to_radians().sin_cos();
        let side = proposed("side_cos_heading", &[0.03 * cos, 0.03 * sin]);
        assert_eq!(
            side.phrase(0.7),
            "sideways force of 0.0300 ± 0.0040 of the weight times cos(heading − 40° ± 8°)"
        );
        let twice = proposed("turn_turning_cos_double_heading", &[0.04 * cos, 0.04 * sin]);
        let angle = twice.direction().expect("an angle");
        assert!((angle.value - 20.0).abs() < 1e-9 && (angle.half - 2.86).abs() < 0.01, "{angle:?}");
    }

    #[test]
    fn forces_of_the_world_point_and_springs_pull_to_a_place() {
        let west = proposed("world_x", &[-0.05, 0.0]);
        assert!(west.phrase(0.7).ends_with("of the weight towards 180° ± 5° of the world"));
        // The spring's force at the origin of the world is its stiffness times the distance to its
        // end.
        let spring = proposed("spring", &[0.01, 0.05, -0.02]);
        assert!(spring.phrase(0.7).ends_with("towards the place (3.5, -1.4) m"));
        let drag = proposed("forward_speed", &[-0.1]);
        assert!(drag.phrase(0.7).ends_with("of the weight times v/√(g ℓ)"), "{}", drag.phrase(0.7));
    }
}

//! How much of a mechanism there is: one number that is 0 where there is none.

use crate::machine::Machine;
use crate::random::{log_uniform, sign, uniform};
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;
use trackdyn_core::rounding::Digits;
use trackdyn_second_simulator::sheet::{Anchor, Concealment, Draw, Role, Scale, Trial};
use trackdyn_second_simulator::{ActiveMechanism, Form, Parameter, Sheet};

/// Digits of the values of a mechanism, so that answers read well.
const DIGITS: Digits = Digits::Significant(6);

/// A parameter that grows with the strength.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Growth {
    /// value = unit · strength.
    Proportional(f64),
    /// value = unit^strength: a factor, which is 1 where there is nothing.
    Power(f64),
}

/// A mechanism whose size is still open.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dose {
    sheet: &'static Sheet,
    grows: Vec<(&'static str, Growth)>,
    fixed: Vec<(&'static str, f64)>,
    form: Form,
}

/// What a draw of places and directions needs to know.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scene<'a> {
    pub(crate) machine: &'a Machine,
    /// Places where the robot has been, at equal intervals of time, m.
    pub(crate) visited: &'a [[f64; 2]],
}

impl Scene<'_> {
    /// A place where the robot has been, m.
    pub(crate) fn visited(&self, random: &mut ChaCha8Rng) -> [f64; 2] {
        self.visited.choose(random).copied().unwrap_or_default()
    }

    fn place(&self, anchor: Anchor, random: &mut ChaCha8Rng) -> [f64; 2] {
        match anchor {
            Anchor::OnPath => self.visited(random),
            Anchor::Around([near, far]) => {
                polar(uniform(random, near, far), direction(random).to_radians())
            }
        }
    }
}

/// The place in a distance (m) from the origin and a direction (rad).
pub(crate) fn polar(distance: f64, bearing: f64) -> [f64; 2] {
    let (sin, cos) = bearing.sin_cos();
    [distance * cos, distance * sin]
}

/// Whole degrees of a direction in the world.
fn direction(random: &mut ChaCha8Rng) -> f64 {
    uniform(random, -180.0, 180.0).round()
}

impl Dose {
    /// A mechanism with drawn places, directions, shapes and signs. Strength 1 is a size that a
    /// roboticist may meet.
    pub(crate) fn draw(sheet: &'static Sheet, scene: Scene, random: &mut ChaCha8Rng) -> Self {
        let form = Form::Plain;
        let mut dose = Self { sheet, grows: Vec::new(), fixed: Vec::new(), form };
        let mut place = None;
        for parameter in sheet.parameters {
            let Draw { role, scale, is_signed } = parameter.draw;
            let scale = of(scene.machine, scale);
            let sign = if is_signed { sign(random) } else { 1.0 };
            let key = parameter.key;
            match role {
                Role::Size(unit) => {
                    dose.grows.push((key, Growth::Proportional(unit * scale * sign)));
                }
                Role::Factor(unit) => dose.grows.push((key, Growth::Power(unit.powf(sign)))),
                Role::Shape { between: [low, high], is_logarithmic, .. } => {
                    let draw = if is_logarithmic { log_uniform } else { uniform };
                    dose.fixed.push((key, scale * draw(random, low, high)));
                }
                Role::Direction => dose.fixed.push((key, direction(random))),
                Role::Place { axis, anchor } => {
                    let place = place.get_or_insert_with(|| scene.place(anchor, random));
                    dose.fixed.push((key, place[axis]));
                }
                Role::Reading { exact, small, .. } => dose.fixed.push((key, exact + scale * small)),
            }
        }
        dose
    }

    /// With the parameter of this key, which does not grow, at a value in multiples of its scale.
    pub(crate) fn with(self, key: &'static str, machine: &Machine, multiple: f64) -> Self {
        let scale = self.sheet.parameter(key).map_or(1.0, |one| of(machine, one.draw.scale));
        self.set(|one| (one.key == key).then_some(scale * multiple))
    }

    /// In a direction of the world, degrees.
    pub(crate) fn towards(self, degrees: f64) -> Self {
        self.set(|one| (one.draw.role == Role::Direction).then_some(degrees))
    }

    /// At a place in the world, m.
    pub(crate) fn at_place(self, place: [f64; 2]) -> Self {
        self.set(|one| match one.draw.role {
            Role::Place { axis, .. } => Some(place[axis]),
            _ => None,
        })
    }

    /// With new values of parameters that do not grow.
    fn set(mut self, value: impl Fn(&Parameter) -> Option<f64>) -> Self {
        for (key, fixed) in &mut self.fixed {
            if let Some(value) = self.sheet.parameter(key).and_then(&value) {
                *fixed = value;
            }
        }
        self
    }

    /// With this form of its law.
    pub(crate) fn of_form(self, form: Form) -> Self {
        Self { form, ..self }
    }

    /// Description of the mechanism.
    pub(crate) fn sheet(&self) -> &'static Sheet {
        self.sheet
    }

    /// The largest strength.
    pub(crate) fn largest(&self) -> f64 {
        concealment(self.sheet).map_or(1.0, |law| law.largest)
    }

    /// The smallest strength above nothing: that at which a value reaches the low end of its range.
    pub(crate) fn smallest(&self) -> f64 {
        let lowest = self.grows.iter().map(|(key, growth)| {
            let low = self.sheet.parameter(key).map_or(0.0, |parameter| parameter.range[0]);
            match growth {
                Growth::Proportional(unit) if low > 0.0 => low / unit,
                _ => 0.0,
            }
        });
        lowest.fold(0.0, f64::max)
    }

    /// The mechanism at a strength. Values are held within the ranges of the sheet.
    ///
    /// # Panics
    /// Never: parameters and forms are those of the sheet.
    pub(crate) fn at(&self, strength: f64) -> ActiveMechanism {
        let grown = self.grows.iter().map(|(key, growth)| {
            let value = match growth {
                Growth::Proportional(unit) => unit * strength,
                Growth::Power(unit) => unit.powf(strength),
            };
            (*key, value)
        });
        let settings: Vec<(&str, f64)> = grown
            .chain(self.fixed.iter().copied())
            .map(|(key, value)| {
                let range = self.sheet.parameter(key).map(|parameter| parameter.range);
                let [low, high] = range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
                (key, DIGITS.round(value.clamp(low, high)))
            })
            .collect();
        let active = ActiveMechanism::new(self.sheet.id, &settings);
        let active = active.and_then(|active| active.with(self.form));
        active.expect("a form, keys and values of the sheet")
    }
}

/// How a law is concealed; none of an error of an instrument.
pub(crate) fn concealment(sheet: &Sheet) -> Option<&Concealment> {
    match &sheet.trial {
        Trial::Law(law) => Some(law),
        Trial::Instrument(_) => None,
    }
}

/// A property of a machine, in the unit of its scale.
pub(crate) fn of(machine: &Machine, scale: Scale) -> f64 {
    match scale {
        Scale::Unit => 1.0,
        Scale::Weight => machine.weight(),
        Scale::Gauge => machine.vehicle.gauge,
        Scale::ContactLength => machine.length(),
        Scale::NormalPressure => machine.pressure(),
        Scale::GyrationRadius => machine.gyration,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::key::Root;
    use crate::random::{Purpose, stream};
    use trackdyn_second_simulator::MECHANISMS;

    #[test]
    fn every_law_has_a_dose_that_grows_from_nothing_to_its_largest() {
        let laws = MECHANISMS.iter().filter(|sheet| concealment(sheet).is_some());
        for (number, sheet) in (0..).zip(laws) {
            let grows = |role: Role| matches!(role, Role::Size(_) | Role::Factor(_));
            assert!(sheet.parameters.iter().any(|one| grows(one.draw.role)), "{}", sheet.id);
            for case in 0..5 {
                let mut random = stream(&Root::of_seed(11), case, number, Purpose::Concealed);
                let machine = Machine::draw(&mut random);
                let scene = Scene { machine: &machine, visited: &[[1.0, 2.0]] };
                let dose = Dose::draw(sheet, scene, &mut random);
                assert!(dose.largest() >= 1.0, "{}: {}", sheet.id, dose.largest());
                for strength in [0.05, 1.0, dose.largest()] {
                    assert_eq!(dose.at(strength).sheet(), sheet);
                }
                assert_ne!(dose.at(0.5), dose.at(1.0));
            }
        }
    }
}

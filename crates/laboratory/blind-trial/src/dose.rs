//! How much of a mechanism there is: one number that is 0 where there is none.

use crate::machine::Machine;
use crate::random::{log_uniform, sign, uniform};
use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;
use trackdyn_second_simulator::{ActiveMechanism, Sheet, sheet_of};

/// A parameter that goes with the strength.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Growth {
    /// value = unit · strength.
    Proportional(f64),
    /// value = unit^strength: a factor, which is 1 where there is nothing.
    Power(f64),
}

/// A mechanism whose size is still open.
#[derive(Clone, Debug, PartialEq)]
pub struct Dose {
    id: &'static str,
    grows: Vec<(&'static str, Growth)>,
    fixed: Vec<(&'static str, f64)>,
    /// Strength beyond which the size is not physical, or the robot stops.
    largest: f64,
}

/// What a draw of places and directions needs to know.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scene<'a> {
    pub(crate) machine: &'a Machine,
    /// Places where the robot has been, at equal intervals of time, m.
    pub(crate) visited: &'a [[f64; 2]],
}

impl Dose {
    /// A mechanism with drawn places, directions and signs. Strength 1 is a size that a roboticist may
    /// meet.
    ///
    /// # Panics
    /// Where the trial has no dose for a mechanism; a test goes through all.
    pub(crate) fn draw(id: &'static str, scene: Scene, random: &mut ChaCha8Rng) -> Self {
        use Growth::{Power, Proportional as By};
        let Scene { machine, visited } = scene;
        let (weight, gauge, length) = (machine.weight(), machine.vehicle.gauge, machine.length());
        let dose =
            |grows: Vec<(&'static str, Growth)>, fixed, largest| Self { id, grows, fixed, largest };
        let by = |key, unit, largest: f64| dose(vec![(key, By(unit))], Vec::new(), largest / unit);
        let direction = |random: &mut ChaCha8Rng| uniform(random, -180.0, 180.0).round();
        match id {
            "drivetrain-lag" => by("time_constant_s", 0.15, 0.6),
            "yaw-inertia" => {
                dose(vec![("strength", By(1.0))], vec![("gyration_m", machine.gyration)], 4.0)
            }
            "centripetal" => by("strength", 1.0, 4.0),
            "load-transfer" => by("cog_height_m", 0.5 * gauge, 1.5 * gauge),
            "viscous-friction" => by("growth_s_per_m", 0.5, 5.0),
            "stribeck-friction" => {
                let speed = log_uniform(random, 0.05, 0.3);
                // with more, the robot jumps from stick to slip instead of moving on
                dose(vec![("excess", By(0.25))], vec![("speed_m_per_s", speed)], 3.0)
            }
            "friction-creep" => by("speed_m_per_s", 0.03, 0.3),
            "motion-resistance" => by("coefficient", 0.05, 0.3),
            "resistance-split" => by("difference", 0.05 * sign(random), 0.3).absolute(),
            "hitch-drag" => {
                let distance = length * uniform(random, 0.5, 1.5);
                dose(vec![("drag", By(0.05))], vec![("distance_m", distance)], 6.0)
            }
            "belt-slip" => by("slip", 0.1, 0.5),
            "shear-displacement" => by("modulus_m", 0.02, 0.3),
            "directional-lugs" => by("excess", 0.05 * sign(random), 0.6).absolute(),
            "slope" => {
                dose(vec![("angle_deg", By(2.0))], vec![("uphill_deg", direction(random))], 7.0)
            }
            "tether" => {
                let (bearing, away) = (direction(random).to_radians(), uniform(random, 3.0, 8.0));
                Self::tether(weight, [away * bearing.cos(), away * bearing.sin()])
            }
            "terrain-patch" => {
                let centre = visited.choose(random).copied().unwrap_or_default();
                let ratio = if random.random() { 1.3 } else { 1.0 / 1.3 };
                Self::patch(centre, uniform(random, 0.8, 2.5), ratio)
            }
            "friction-drift" => by("rate_1_per_s", 0.001 * sign(random), 0.005).absolute(),
            "friction-anisotropy" => dose(vec![("ratio", Power(1.2))], Vec::new(), 3.0),
            "cog-shift" => {
                let grows = vec![
                    ("x_m", By(0.05 * gauge * sign(random))),
                    ("y_m", By(0.03 * length * sign(random))),
                ];
                dose(grows, Vec::new(), 2.0)
            }
            "friction-split" => by("split", 0.1 * sign(random), 0.5).absolute(),
            "friction-gradient" => by("gradient", 0.1 * sign(random), 0.5).absolute(),
            "pressure-concentration" => by("concentration", 0.4, 0.9),
            "cohesion" => by("stress_pa", 0.15 * machine.pressure(), 0.6 * machine.pressure()),
            "bulldozing" => by("coefficient", 0.1, 0.5),
            "brushed-ground" => {
                dose(vec![("excess", By(0.3))], vec![("grain_deg", direction(random))], 10.0)
            }
            "spring-cable" => {
                let (bearing, away) = (direction(random).to_radians(), uniform(random, 1.5, 5.0));
                let place = vec![
                    ("length_m", 1.0),
                    ("x_m", away * bearing.cos()),
                    ("y_m", away * bearing.sin()),
                ];
                dose(vec![("rate_n_per_m", By(weight / 42.0))], place, 2.5)
            }
            "steering-grip" => by("loss_s_per_m", 0.15, 2.0),
            "washboard" => {
                let wave = log_uniform(random, 0.6, 2.0);
                dose(vec![("depth", By(0.3))], vec![("wavelength_m", wave)], 2.8)
            }
            "splayed-belts" => by("splay_deg_s_per_m", 3.0 * sign(random), 15.0).absolute(),
            "twisted-frame" => by("shift_m", 0.04 * length * sign(random), 0.1 * length).absolute(),
            "stiff-hull" => by("share", 1.0, 1.0),
            "side-wind" => dose(
                vec![("force_n", By(0.03 * weight))],
                vec![("towards_deg", direction(random))],
                7.0,
            ),
            "warm-rubber" => by("softening", 1.0, 5.0),
            "drive-backlash" => by("play_m", 0.01, 0.1),
            _ => panic!("no dose of {id}"),
        }
    }

    /// A cable with the anchor at a place (m); its unit pulls with a twenty-fifth of the weight (N).
    pub(crate) fn tether(weight: f64, [x, y]: [f64; 2]) -> Self {
        Self {
            id: "tether",
            grows: vec![("tension_n", Growth::Proportional(0.04 * weight))],
            fixed: vec![("anchor_x_m", x), ("anchor_y_m", y)],
            largest: 6.0,
        }
    }

    /// A slope that rises in a direction of the world, degrees.
    pub(crate) fn slope(uphill: f64) -> Self {
        Self {
            id: "slope",
            grows: vec![("angle_deg", Growth::Proportional(2.0))],
            fixed: vec![("uphill_deg", uphill)],
            largest: 7.0,
        }
    }

    /// A patch about a place (m) with a radius (m) and a factor on the friction ratio as its unit.
    pub(crate) fn patch([x, y]: [f64; 2], radius: f64, ratio: f64) -> Self {
        Self {
            id: "terrain-patch",
            grows: vec![("ratio", Growth::Power(ratio))],
            fixed: vec![("x_m", x), ("y_m", y), ("radius_m", radius)],
            largest: 4.0,
        }
    }

    fn absolute(mut self) -> Self {
        self.largest = self.largest.abs();
        self
    }

    /// The same with another value of a parameter that does not grow.
    pub(crate) fn with(mut self, key: &'static str, value: f64) -> Self {
        for (of, fixed) in &mut self.fixed {
            if *of == key {
                *fixed = value;
            }
        }
        self
    }

    /// Id of the mechanism.
    pub fn id(&self) -> &'static str {
        self.id
    }

    /// The largest strength.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// The smallest strength above nothing: that at which a value reaches the low end of its range.
    pub fn smallest(&self) -> f64 {
        let sheet = sheet(self.id);
        let lowest = self.grows.iter().map(|(key, growth)| {
            let low = sheet.parameters.iter().find(|p| p.key == *key).map_or(0.0, |p| p.range[0]);
            match growth {
                Growth::Proportional(unit) if low > 0.0 => low / unit,
                _ => 0.0,
            }
        });
        lowest.fold(0.0, f64::max)
    }

    /// The mechanism at a strength; values are held within the sheet's ranges.
    ///
    /// # Panics
    /// Never: parameters are those of the sheets, which a test goes through.
    pub fn at(&self, strength: f64) -> ActiveMechanism {
        let sheet = sheet(self.id);
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
                let range = sheet.parameters.iter().find(|p| p.key == key).map(|p| p.range);
                let [low, high] = range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
                (key, significant(value.clamp(low, high)))
            })
            .collect();
        match ActiveMechanism::new(self.id, &settings) {
            Ok(active) => active,
            Err(error) => panic!("{error}"),
        }
    }
}

/// The sheet of a mechanism.
///
/// # Panics
/// For an id that no mechanism has.
pub(crate) fn sheet(id: &str) -> &'static Sheet {
    match sheet_of(id) {
        Some(sheet) => sheet,
        None => panic!("no mechanism {id}"),
    }
}

/// Six significant digits, so that answers read well.
fn significant(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let scale = 10_f64.powf(5.0 - value.abs().log10().floor());
    let rounded = (value * scale).round() / scale;
    if rounded.is_finite() { rounded } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::key::Root;
    use crate::plan::INSTRUMENTS;
    use crate::random::{Purpose, stream};
    use trackdyn_second_simulator::MECHANISMS;

    #[test]
    fn every_mechanism_has_a_dose_that_grows_from_nothing_to_its_largest() {
        for (number, sheet) in (0..).zip(MECHANISMS) {
            if INSTRUMENTS.contains(&sheet.id) {
                continue;
            }
            for case in 0..5 {
                let mut random = stream(&Root::of_seed(11), case, number, Purpose::Concealed);
                let machine = Machine::draw(&mut random);
                let scene = Scene { machine: &machine, visited: &[[1.0, 2.0]] };
                let dose = Dose::draw(sheet.id, scene, &mut random);
                assert!(dose.largest >= 1.0, "{}: {}", sheet.id, dose.largest);
                for strength in [0.05, 1.0, dose.largest] {
                    assert_eq!(dose.at(strength).sheet().id, sheet.id);
                }
                assert_ne!(dose.at(0.5), dose.at(1.0));
            }
        }
    }
}

//! One case: a robot, its drive, what is concealed, and the recording of it.

use crate::alternatives::places;
use crate::answer::{Answer, Concealed, Instrument, is_in_catalogue, letters, parameters};
use crate::dose::{Dose, Scene};
use crate::driving::Driving;
use crate::error::Error;
use crate::ground::{Fineness, Ground, observations};
use crate::instruments::{Instruments, mechanism};
use crate::key::Root;
use crate::machine::Machine;
use crate::oracle::{Judge, Sized, Standing};
use crate::order::Order;
use crate::plan::{CONSTANTS, PlannedCase, Stratum};
use crate::random::{Purpose, log_uniform, stream, uniform};
use crate::recorded::recorded;
use crate::signature::Bench;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use trackdyn_core::real;
use trackdyn_model::{ActiveEffect, VehicleFile};
use trackdyn_recording::Recording;
use trackdyn_second_simulator::ActiveMechanism;

/// Draws of a case before it is given up.
pub(crate) const ATTEMPTS: u64 = 12;
/// Share of the robots that move without `yaw-inertia`, and as many without `centripetal`, where neither
/// is concealed: an effect that is absent from a vehicle file is not for that reason concealed.
const WITHOUT_INERTIA: f64 = 0.06;
/// The same of nulls. Effects of inertia are concealed in a tenth of the other cases: absence from the
/// file is as frequent in both.
const NULLS_WITHOUT_INERTIA: f64 = 0.11;
/// Effects of inertia, which owners know.
const INERTIA: [&str; 2] = ["yaw-inertia", "centripetal"];
/// Factor of friction by which its level is told from effects: owners know it roughly.
const ROUGHER: f64 = 1.15;

/// A case with its answer.
#[derive(Clone, Debug)]
pub struct Case {
    /// What was concealed.
    pub answer: Answer,
    /// What the diagnosis gets.
    pub recording: Recording,
    /// The vehicle as its owner knows it.
    pub vehicle: VehicleFile,
}

impl Case {
    /// The case of a number (from 0) in a trial that is drawn from this.
    ///
    /// # Errors
    /// [`Error::Ground`] where a dozen draws give no robot that drives.
    pub fn make(
        planned: &PlannedCase,
        number: u64,
        order: &Order,
        root: &Root,
    ) -> Result<Self, Error> {
        let id = name(number);
        let mut reason = String::new();
        for attempt in 0..ATTEMPTS {
            let draw = Draw { planned, id: &id, order, root, number: number + 1, attempt };
            match draw.case() {
                Ok(case) => return Ok(case),
                Err(why) => reason = why,
            }
        }
        Err(Error::Ground { case: id, reason })
    }
}

/// Name of a case by its number from 0.
pub fn name(number: u64) -> String {
    format!("case-{:04}", number + 1)
}

struct Draw<'a> {
    planned: &'a PlannedCase,
    id: &'a str,
    order: &'a Order,
    root: &'a Root,
    number: u64,
    attempt: u64,
}

impl Draw<'_> {
    fn random(&self, purpose: Purpose) -> ChaCha8Rng {
        stream(self.root, self.number, self.attempt, purpose)
    }

    fn case(&self) -> Result<Case, String> {
        let mut random = self.random(Purpose::Machine);
        let machine = Machine::draw(&mut random);
        let known = self.known(&machine, &mut random);
        let driving =
            Driving::draw(&machine, self.order.run_time_s, &mut self.random(Purpose::Driving))?;
        let instruments = Instruments::draw(
            self.planned.difficulty,
            self.planned.stratum == Stratum::PlainNull,
            machine.vehicle.gauge,
            &mut self.random(Purpose::Instruments),
        );
        let concealed = self.concealed(&machine, &known, &driving, &instruments)?;
        let recording = self.recorded(&machine, &known, &driving, &instruments, &concealed)?;
        let vehicle = self.owned(&machine, &known)?;
        let sensors = &instruments.sensors;
        let answer = Answer {
            id: self.id.to_owned(),
            stratum: self.planned.stratum,
            difficulty: self.planned.difficulty,
            driving: driving.style.name().to_owned(),
            fastest_m_per_s: driving.fastest,
            sensors: sensors.name.clone(),
            pose_white_m: sensors.pose.white.position,
            pose_white_rad: sensors.pose.white.yaw,
            known: known.iter().map(ToString::to_string).collect(),
            recording: recording.fingerprint().to_owned(),
            files: String::new(),
            vehicle: VehicleFile {
                vehicle: machine.vehicle.clone(),
                effects: trackdyn_model::Effects::none(),
            }
            .to_toml(),
            concealed: concealed.into_iter().map(|(_, answer)| answer).collect(),
            clock_offset_s: sensors.clock_offset(),
            instruments: instruments.errors.iter().map(Instrument::of).collect(),
        };
        Ok(Case { answer, recording, vehicle })
    }

    /// The effects of inertia that the owner knows: all that the robot has but what is concealed.
    fn known(&self, machine: &Machine, random: &mut ChaCha8Rng) -> Vec<ActiveMechanism> {
        let drawn: f64 = random.random();
        let is_null = self.planned.stratum.is_null();
        let share = if is_null { NULLS_WITHOUT_INERTIA } else { WITHOUT_INERTIA };
        let left_out = INERTIA.iter().enumerate().find(|(place, _)| {
            let from = share * real(*place);
            (from..from + share).contains(&drawn)
        });
        let is_concealed = |id: &str| self.planned.concealed.contains(&id);
        let conceals_inertia = INERTIA.iter().any(|id| is_concealed(id));
        let absent = |id: &str| {
            is_concealed(id) || (!conceals_inertia && left_out.is_some_and(|(_, left)| *left == id))
        };
        let all = [
            mechanism("yaw-inertia", &[("strength", 1.0), ("gyration_m", machine.gyration)]),
            mechanism("centripetal", &[("strength", 1.0)]),
        ];
        all.into_iter().filter(|known| !absent(known.sheet().id)).collect()
    }

    fn owned(&self, machine: &Machine, known: &[ActiveMechanism]) -> Result<VehicleFile, String> {
        let vehicle = match self.planned.stratum {
            Stratum::PlainNull => machine.vehicle.clone(),
            _ => machine.as_owned(&mut self.random(Purpose::Owner)),
        };
        vehicle.check().map_err(|error| error.to_string())?;
        let effects = known.iter().map(|known| {
            let keys = known.sheet().parameters.iter().map(|parameter| parameter.key);
            let settings: Vec<_> = keys.zip(known.values().iter().copied()).collect();
            ActiveEffect::new(known.sheet().id, &settings).map_err(|error| error.to_string())
        });
        Ok(VehicleFile { vehicle, effects: effects.collect::<Result<_, _>>()? })
    }

    /// What is concealed, at its size, with what could be found of it.
    fn concealed(
        &self,
        machine: &Machine,
        known: &[ActiveMechanism],
        driving: &Driving,
        instruments: &Instruments,
    ) -> Result<Vec<(Sized, Concealed)>, String> {
        if self.planned.concealed.is_empty() {
            return Ok(Vec::new());
        }
        let mut random = self.random(Purpose::Concealed);
        let ground = self.ground(machine, known, Fineness::Signature);
        let driven = ground.drive(driving.training())?;
        let noise = instruments.noise(&driven, 2.0 * machine.vehicle.gauge);
        let visited = places(
            driven
                .iter()
                .flat_map(|run| run.body.moments().iter().step_by(50).map(|moment| &moment.pose)),
        );
        let seen = observations(&driven, &instruments.sensors)?;
        drop(driven);
        let mut rougher = machine.clone();
        rougher.vehicle.friction.across *= ROUGHER;
        rougher.vehicle.friction.along *= ROUGHER;
        let rougher = self.ground(&rougher, known, Fineness::Signature);
        let rougher = rougher.observe(driving.training(), &instruments.sensors)?;
        let bench = Bench::new(seen, noise, instruments.presence(), machine.vehicle.gauge)?;
        let bench = bench.with_nuisance(&rougher)?;
        let scene = Scene { machine, visited: &visited };
        let (runs, sensors) = (driving.training(), &instruments.sensors);
        let judge = Judge { bench: &bench, ground: &ground, runs, sensors };
        let mut sizes = Vec::new();
        let mut wanted = Vec::new();
        for id in &self.planned.concealed {
            let (dose, size) = self.dose(id, scene, &mut random);
            sizes.push(match size {
                Size::Z { wanted, otherwise } => judge.sized(dose, wanted, otherwise)?,
                Size::Strength(strength) => {
                    let strength = strength.min(dose.largest());
                    judge.at(dose, strength)?
                }
            });
            wanted.push(size.wanted());
        }
        let known: Vec<&str> = known.iter().map(|known| known.sheet().id).collect();
        let standings = judge.standings(&sizes, &known, scene, &mut random)?;
        let all = sizes.into_iter().zip(standings).zip(wanted);
        let all = all.map(|((sized, standing), wanted)| {
            let answer = answer(&sized, standing, wanted);
            (sized, answer)
        });
        Ok(all.collect())
    }

    /// A mechanism with its places, and how its size is found.
    fn dose(&self, id: &'static str, scene: Scene, random: &mut ChaCha8Rng) -> (Dose, Size) {
        let dose = Dose::draw(id, scene, random);
        let otherwise = log_uniform(random, 0.5, 2.0);
        let z = |low, high, random: &mut ChaCha8Rng| Size::Z {
            wanted: log_uniform(random, low, high),
            otherwise,
        };
        match self.planned.stratum {
            Stratum::Single | Stratum::PlainNull | Stratum::HardNull => {
                (dose, z(2.0, 60.0, random))
            }
            Stratum::Pair => (dose, z(5.0, 40.0, random)),
            Stratum::Outside => (dose, z(4.0, 60.0, random)),
            Stratum::Equivalence if CONSTANTS.contains(&id) => {
                (dose, Size::Strength(log_uniform(random, 0.3, 2.0)))
            }
            Stratum::Equivalence if id == "drivetrain-lag" => {
                (dose, Size::Strength(log_uniform(random, 0.3, 1.5)))
            }
            Stratum::Equivalence if id == "tether" => {
                let bearing = uniform(random, -180.0, 180.0).to_radians();
                let away = log_uniform(random, 40.0, 200.0);
                let anchor = [away * bearing.cos(), away * bearing.sin()];
                (Dose::tether(scene.machine.weight(), anchor), z(6.0, 40.0, random))
            }
            Stratum::Equivalence => (dose, z(4.0, 12.0, random)),
        }
    }

    fn ground<'a>(
        &self,
        machine: &'a Machine,
        active: &[ActiveMechanism],
        fineness: Fineness,
    ) -> Ground<'a> {
        let seed = self.random(Purpose::Shoes).random();
        Ground { vehicle: &machine.vehicle, active: active.to_vec(), fineness, seed }
    }

    /// What the sensors report of all runs.
    fn recorded(
        &self,
        machine: &Machine,
        known: &[ActiveMechanism],
        driving: &Driving,
        instruments: &Instruments,
        concealed: &[(Sized, Concealed)],
    ) -> Result<Recording, String> {
        let hidden = concealed.iter().map(|(sized, _)| sized.dose.at(sized.strength));
        let errors = instruments.errors.iter().cloned();
        let active: Vec<_> = known.iter().cloned().chain(hidden).chain(errors).collect();
        let ground = self.ground(machine, &active, Fineness::Recording);
        let driven = ground.drive(&driving.runs)?;
        recorded(self.id, &driven, instruments, self.random(Purpose::Noise).random())
    }
}

/// What stands in the answers of an effect at its size.
fn answer(sized: &Sized, standing: Standing, wanted: Option<f64>) -> Concealed {
    let active = sized.dose.at(sized.strength);
    Concealed {
        mechanism: active.sheet().id.to_owned(),
        in_catalogue: is_in_catalogue(&active),
        parameters: parameters(&active),
        breaks: letters(&active),
        z_wanted: wanted.map(two_digits),
        z_det: two_digits(standing.z_det),
        z_iso: two_digits(standing.z_iso),
        z_beyond: Some(two_digits(standing.z_beyond)),
        nearest: standing.nearest.to_owned(),
        class: standing.class.into_iter().map(str::to_owned).collect(),
    }
}

/// How the size of a concealed effect is found.
#[derive(Clone, Copy)]
enum Size {
    /// By its z; by a strength where it does not show.
    Z { wanted: f64, otherwise: f64 },
    /// By its strength.
    Strength(f64),
}

impl Size {
    fn wanted(self) -> Option<f64> {
        match self {
            Self::Z { wanted, .. } => Some(wanted),
            Self::Strength(_) => None,
        }
    }
}

/// The hundredth below: what is below a limit stays below it.
fn two_digits(value: f64) -> f64 {
    (value * 100.0).floor() / 100.0
}

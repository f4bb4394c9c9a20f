//! One case: a robot, its drive, what is concealed, and the recording of it.

use crate::alternatives::places;
use crate::answer::{Answer, Concealed, Instrument, is_in_catalogue, letters, parameters};
use crate::dose::{Dose, Scene, concealment, polar};
use crate::driving::Driving;
use crate::error::Error;
use crate::failure::Failure;
use crate::ground::{Fineness, Ground, observations};
use crate::instruments::Instruments;
use crate::key::Root;
use crate::machine::Machine;
use crate::oracle::{Judge, Sized, Standing};
use crate::order::Order;
use crate::plan::{PlannedCase, Stratum};
use crate::random::{Purpose, log_uniform, stream, uniform};
use crate::recorded::recorded;
use crate::signature::Bench;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use trackdyn_core::real;
use trackdyn_model::{ActiveEffect, CATALOGUE, VehicleFile};
use trackdyn_recording::Recording;
use trackdyn_second_simulator::sheet::{Anchor, Identifiability, Role};
use trackdyn_second_simulator::{ActiveMechanism, Sheet, sheet_of};

/// Draws of a case before it is given up.
pub(crate) const ATTEMPTS: u64 = 12;
/// Share of the robots whose vehicle file lacks a given effect of inertia, where no such effect is
/// concealed. So absence from a file does not tell that an effect is concealed.
const ABSENT_INERTIA_SHARE: f64 = 0.06;
/// Share of nulls without one effect of inertia. Such effects are concealed in a tenth of the other
/// cases: absence from the file is as frequent in both.
const ABSENT_INERTIA_SHARE_OF_NULLS: f64 = 0.11;
/// Factor of friction by which its level is told from effects: owners know it roughly.
const FRICTION_LEVEL_FACTOR: f64 = 1.15;

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
        let mut reason = Failure::NoCase;
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

    fn case(&self) -> Result<Case, Failure> {
        let mut random = self.random(Purpose::Machine);
        let machine = Machine::draw(&mut random);
        let known = self.known(&machine, &mut random);
        let driving =
            Driving::draw(&machine, self.order.run_time_s, &mut self.random(Purpose::Driving))?;
        let instruments = Instruments::draw(
            self.planned.difficulty,
            self.planned.stratum == Stratum::PlainNull,
            &machine,
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
                source: None,
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
        let share = if is_null { ABSENT_INERTIA_SHARE_OF_NULLS } else { ABSENT_INERTIA_SHARE };
        let inertia: Vec<&'static Sheet> = inertia().collect();
        let is_concealed =
            |sheet: &Sheet| self.planned.concealed.iter().any(|one| one.id == sheet.id);
        let conceals_inertia = inertia.iter().any(|sheet| is_concealed(sheet));
        let is_left_out = |place: usize| {
            let from = share * real(place);
            !conceals_inertia && (from..from + share).contains(&drawn)
        };
        let scene = Scene { machine, visited: &[] };
        let known = inertia.into_iter().enumerate();
        let known = known.filter(|(place, sheet)| !is_concealed(sheet) && !is_left_out(*place));
        // nothing of them is left to the draw: strength 1, and the inertia of the machine
        known.map(|(_, sheet)| Dose::draw(sheet, scene, random).at(1.0)).collect()
    }

    fn owned(&self, machine: &Machine, known: &[ActiveMechanism]) -> Result<VehicleFile, Failure> {
        let vehicle = match self.planned.stratum {
            Stratum::PlainNull => machine.vehicle.clone(),
            _ => machine.as_owned(&mut self.random(Purpose::Owner)),
        };
        vehicle.check()?;
        let effects = known.iter().map(|known| {
            let keys = known.sheet().parameters.iter().map(|parameter| parameter.key);
            let settings: Vec<_> = keys.zip(known.values().iter().copied()).collect();
            ActiveEffect::new(known.sheet().id, &settings)
        });
        Ok(VehicleFile { vehicle, effects: effects.collect::<Result<_, _>>()?, source: None })
    }

    /// What is concealed, at its size, with what could be found of it.
    fn concealed(
        &self,
        machine: &Machine,
        known: &[ActiveMechanism],
        driving: &Driving,
        instruments: &Instruments,
    ) -> Result<Vec<(Sized, Concealed)>, Failure> {
        if self.planned.concealed.is_empty() {
            return Ok(Vec::new());
        }
        let mut random = self.random(Purpose::Concealed);
        let forms = self.order.forms;
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
        rougher.vehicle.friction.across *= FRICTION_LEVEL_FACTOR;
        rougher.vehicle.friction.along *= FRICTION_LEVEL_FACTOR;
        let rougher = self.ground(&rougher, known, Fineness::Signature);
        let rougher = rougher.observe(driving.training(), &instruments.sensors)?;
        let bench = Bench::new(seen, noise, instruments.presence(), machine.vehicle.gauge)?;
        let bench = bench.with_nuisance(&rougher)?;
        let scene = Scene { machine, visited: &visited };
        let (runs, sensors) = (driving.training(), &instruments.sensors);
        let judge = Judge { bench: &bench, ground: &ground, runs, sensors, forms };
        let mut sizes = Vec::new();
        let mut wanted = Vec::new();
        for sheet in &self.planned.concealed {
            let (dose, size) = self.dose(sheet, scene, &mut random);
            let dose = dose.of_form(forms.draw(sheet, &mut random));
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
    fn dose(&self, sheet: &'static Sheet, scene: Scene, random: &mut ChaCha8Rng) -> (Dose, Size) {
        let dose = Dose::draw(sheet, scene, random);
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
            Stratum::Equivalence if is_indistinct(sheet) => {
                let largest = if sheet.is_constant() { 2.0 } else { 1.5 };
                (dose, Size::Strength(log_uniform(random, 0.3, largest)))
            }
            Stratum::Equivalence if has_anchor(sheet) => {
                let bearing = uniform(random, -180.0, 180.0).to_radians();
                let place = polar(log_uniform(random, 40.0, 200.0), bearing);
                (dose.at_place(place), z(6.0, 40.0, random))
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
    ) -> Result<Recording, Failure> {
        let hidden = concealed.iter().map(|(sized, _)| sized.dose.at(sized.strength));
        let errors = instruments.errors.iter().cloned();
        let active: Vec<_> = known.iter().cloned().chain(hidden).chain(errors).collect();
        let ground = self.ground(machine, &active, Fineness::Recording);
        let driven = ground.drive(&driving.runs)?;
        recorded(self.id, &driven, instruments, self.random(Purpose::Noise).random())
    }
}

/// The effects of inertia, which owners know.
fn inertia() -> impl Iterator<Item = &'static Sheet> {
    CATALOGUE.iter().filter(|card| card.is_inertia()).filter_map(|card| sheet_of(card.id))
}

/// Whether other effects leave the trace of a law at all sizes.
fn is_indistinct(sheet: &Sheet) -> bool {
    concealment(sheet).is_some_and(|law| law.identifiability == Identifiability::Indistinct)
}

/// Whether a law has a place that the robot does not pass, so that from far away it is a direction.
fn has_anchor(sheet: &Sheet) -> bool {
    let is_anchor = |role: Role| matches!(role, Role::Place { anchor: Anchor::Around(_), .. });
    sheet.parameters.iter().any(|parameter| is_anchor(parameter.draw.role))
}

/// What stands in the answers of an effect at its size.
fn answer(sized: &Sized, standing: Standing, wanted: Option<f64>) -> Concealed {
    let active = sized.dose.at(sized.strength);
    Concealed {
        mechanism: active.sheet().id.to_owned(),
        in_catalogue: is_in_catalogue(&active),
        form: active.form().number(),
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

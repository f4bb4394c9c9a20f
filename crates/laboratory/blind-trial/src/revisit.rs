//! A case once more: the robot, the ground and the instruments of a case, driven by another
//! schedule.

use crate::answer::{Answer, Answers};
use crate::case::ATTEMPTS;
use crate::driving::{Drive, HELD_OUT_RUNS, TRAINING_RUNS};
use crate::error::Error;
use crate::failure::Failure;
use crate::ground::{Fineness, Ground};
use crate::instruments::Instruments;
use crate::key::Root;
use crate::machine::Machine;
use crate::plan::Stratum;
use crate::random::{Purpose, stream};
use crate::recorded::recorded;
use rand::RngExt;
use std::collections::BTreeMap;
use trackdyn_core::document::Document;
use trackdyn_core::{Pose, Schedule};
use trackdyn_model::{Vehicle, VehicleFile};
use trackdyn_recording::Recording;
use trackdyn_second_simulator::{ActiveMechanism, Form};

/// The recording of a case that follows a schedule from the origin, heading along x: everything is
/// as it was in the case but for the noise, which is drawn anew.
///
/// # Errors
/// [`Error::Ground`] where there is no such case, or the robot cannot follow; [`Error::Document`].
pub fn revisit(answers: &Answers, id: &str, schedule: Schedule) -> Result<Recording, Error> {
    let failed = |reason: Failure| Error::Ground { case: id.to_owned(), reason };
    let numbered = (1..).zip(&answers.cases).find(|(_, answer)| answer.id == id);
    let (number, answer) = numbered.ok_or_else(|| failed(Failure::NoCase))?;
    let document = Document::new(format!("{id}, sealed vehicle"), &answer.vehicle);
    let VehicleFile { vehicle, .. } = VehicleFile::from_document(&document)?;
    let root = answers.drawn_from();
    let (attempt, machine) =
        attempt(&root, number, &vehicle).ok_or_else(|| failed(Failure::OtherRobot))?;
    let random = |purpose| stream(&root, number, attempt, purpose);
    let instruments = Instruments::draw(
        answer.difficulty,
        answer.stratum == Stratum::PlainNull,
        &machine,
        &mut random(Purpose::Instruments),
    );
    let active = active(answer).map_err(failed)?;
    let seed = random(Purpose::Shoes).random();
    let ground = Ground { vehicle: &vehicle, active, fineness: Fineness::Recording, seed };
    // a number that no run of the case has: shoes and noise go by it
    let run = i64::try_from(TRAINING_RUNS + HELD_OUT_RUNS).unwrap_or_default();
    let drive = Drive { id: run, schedule, start: Pose::default() };
    let driven = ground.drive(&[drive]).map_err(failed)?;
    recorded(id, &driven, &instruments, random(Purpose::Revisit).random()).map_err(failed)
}

/// The attempt that drew a robot, and the robot.
fn attempt(root: &Root, number: u64, vehicle: &Vehicle) -> Option<(u64, Machine)> {
    let drawn = (0..ATTEMPTS).map(|attempt| {
        (attempt, Machine::draw(&mut stream(root, number, attempt, Purpose::Machine)))
    });
    drawn.into_iter().find(|(_, machine)| machine.vehicle == *vehicle)
}

/// All that acts in a case.
fn active(answer: &Answer) -> Result<Vec<ActiveMechanism>, Failure> {
    let of = |id: &str, parameters: &BTreeMap<String, f64>| -> Result<_, Failure> {
        let settings: Vec<_> =
            parameters.iter().map(|(key, value)| (key.as_str(), *value)).collect();
        Ok(ActiveMechanism::new(id, &settings)?)
    };
    let known = answer.known.iter().map(|text| Ok(text.parse()?));
    let concealed = answer.concealed.iter().map(|one| {
        let form = one.form.map_or(Form::Plain, Form::Drawn);
        Ok(of(&one.mechanism, &one.parameters)?.with(form)?)
    });
    let errors = answer.instruments.iter().map(|one| of(&one.mechanism, &one.parameters));
    known.chain(concealed).chain(errors).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::{Concealed, SCHEMA};
    use crate::case::Case;
    use crate::forms::Forms;
    use crate::order::Order;
    use crate::plan::PlannedCase;
    use trackdyn_core::{Command, PerSide};

    /// A null, which takes the least time to make.
    fn null() -> Answers {
        let planned =
            PlannedCase { stratum: Stratum::PlainNull, concealed: Vec::new(), difficulty: None };
        let (version, forms) = (String::new(), Forms::Drawn);
        let order = Order { version, seed: 8, cases: 1, run_time_s: 10.0, forms };
        let case = Case::make(&planned, 0, &order, &Root::of_seed(8)).expect("a case");
        let version = String::new();
        let (schema, cases) = (SCHEMA.to_owned(), vec![case.answer]);
        Answers {
            salt: String::new(),
            schema,
            version,
            seed: order.seed,
            root: None,
            run_time_s: Some(10.0),
            forms,
            cases,
        }
    }

    fn end(answers: &Answers) -> Pose {
        let command = |t, speed| Command { t, speeds: PerSide::new(0.5 * speed, speed) };
        let commands =
            vec![command(0.0, 0.0), command(1.0, 0.4), command(7.0, 0.0), command(8.0, 0.0)];
        let schedule = Schedule::new(commands).expect("a schedule");
        let recording = revisit(answers, "case-0001", schedule).expect("it drives");
        let [run] = recording.runs() else { panic!("one run") };
        run.poses().last().expect("poses").pose
    }

    #[test]
    fn what_is_concealed_acts_and_nothing_else_changes() {
        let answers = null();
        let flat = end(&answers);
        assert_eq!(flat, end(&answers));
        let mut sloped = answers.clone();
        let slope = [("angle_deg", 5.0), ("uphill_deg", 90.0)];
        sloped.cases[0].concealed = vec![Concealed {
            mechanism: "slope".to_owned(),
            in_catalogue: true,
            form: None,
            parameters: slope.map(|(key, value)| (key.to_owned(), value)).into(),
            breaks: Vec::new(),
            z_wanted: None,
            z_det: 0.0,
            z_iso: 0.0,
            z_beyond: None,
            nearest: String::new(),
            class: Vec::new(),
        }];
        let moved = (end(&sloped).x - flat.x).hypot(end(&sloped).y - flat.y);
        // far more than some millimetres of noise, far less than the way
        assert!((0.02..2.0).contains(&moved), "{moved} m");
    }

    #[test]
    fn answers_of_another_seed_lead_to_no_robot() {
        let answers = Answers { seed: 9, ..null() };
        let schedule = Schedule::new(vec![
            Command { t: 0.0, speeds: PerSide::new(0.0, 0.0) },
            Command { t: 1.0, speeds: PerSide::new(0.0, 0.0) },
        ]);
        let error =
            revisit(&answers, "case-0001", schedule.expect("a schedule")).expect_err("none");
        assert!(error.to_string().contains("seed"), "{error}");
    }
}

//! What to do next.

use crate::diagnosis::Subject;
use serde::Serialize;
use trackdyn_diagnose::Status;
use trackdyn_diagnose::diagnosis::Kind;
use trackdyn_diagnose::document::separate_by;
use trackdyn_diagnose::evidence::Origin;

/// A diagnosis of two logs.
const BOTH_LOGS: &str = "trackdyn diagnose LOG NEW_LOG --vehicle VEHICLE";

/// Something to do, and what to type.
#[derive(Serialize)]
pub(super) struct Step {
    text: String,
    command: &'static str,
}

/// The steps, the first one first.
pub(super) fn of(subject: &Subject) -> Vec<Step> {
    let step = |text: &str, command: &'static str| Step { text: text.to_owned(), command };
    let answer = &subject.diagnosis.answer;
    let is_table = matches!(subject.evidence().origin(), Origin::SteadyPoints(_));
    let again = "trackdyn diagnose NEW_LOG --vehicle vehicle.corrected.toml";
    let mut steps = Vec::new();
    if subject.diagnosis.contradiction().is_some() {
        steps.push(step(
            "Drive on without the correction: runs that nothing was fitted to \
                         contradict it.",
            "",
        ));
    }
    match answer.status {
        Status::NothingMissing => {
            steps.push(step("Keep the vehicle file as it is.", ""));
            steps.push(step(
                "Read the detection limits before you rule an effect out: what is smaller than its \
                 limit would not have shown.",
                "",
            ));
        }
        Status::Explained => {
            steps.push(step(
                "Take vehicle.corrected.toml in place of the vehicle file: to replay, to simulate, \
                 to map.",
                "trackdyn odometry NEW_LOG --vehicle vehicle.corrected.toml",
            ));
            if answer.missing.iter().any(|missing| missing.kind == Kind::Instrument) {
                steps.push(step(
                    "Mend what concerns clock and sensors where it arises, if you can: then \
                     nothing has to be corrected.",
                    "",
                ));
            }
            steps.push(step("Check it on a new log: nothing should be missing any more.", again));
        }
        Status::Ambiguous => {
            let open = answer.missing.iter().filter(|missing| missing.verdict.one_of.len() > 1);
            let (constants, effects): (Vec<_>, Vec<_>) =
                open.partition(|missing| missing.kind == Kind::Constant);
            let is_open = !effects.is_empty();
            if is_open {
                steps.push(step(
                    "Drive what tells them apart.",
                    "trackdyn plan --diagnosis diagnosis.toml --out plan",
                ));
            }
            for missing in constants {
                steps.push(step(
                    &format!("What tells which number it is: {}.", separate_by(missing)),
                    "",
                ));
            }
            if is_open && !is_table {
                steps.push(step("Diagnose the old and the new log together.", BOTH_LOGS));
            }
            steps.push(step(
                "Until then vehicle.corrected.toml takes the first of each: good to predict \
                 driving like this, not to reason about causes.",
                "",
            ));
        }
        Status::Unexplained => {
            let look = if is_table {
                "Look below at which track speeds the points depart."
            } else {
                "Look below where and when the robot departs: choose a cell of strong colour to \
                 see its stretches of the log."
            };
            steps.push(step(look, ""));
            if !is_table {
                steps.push(step("Drive there again, and diagnose both logs together.", BOTH_LOGS));
            }
            steps.push(step("Do not build on vehicle.corrected.toml beyond this log.", ""));
        }
    }
    steps
}

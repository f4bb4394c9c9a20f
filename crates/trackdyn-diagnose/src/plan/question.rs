//! What a diagnosis left open.

use crate::diagnosis::Status;
use crate::document::DiagnosisFile;
use crate::hypothesis::neutral;
use std::ops::Range;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_physics::effect::Role;
use trackdyn_physics::{CATALOGUE, effect::Stage};

/// Effects that explain a recording alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// The one that was fitted, by its place in the catalogue.
    pub effect: usize,
    /// All of them, ascending.
    pub members: Vec<usize>,
    /// The fitted values of its parameters; typical ones where the file has none.
    pub values: Vec<f64>,
}

impl Question {
    /// The questions of a diagnosis file.
    ///
    /// # Errors
    /// A [`DocumentError`] that points at a word that is none of the schema's, an id that is not in the
    /// catalogue, or a parameter that its effect does not have.
    pub fn of(document: &Document) -> Result<Vec<Self>, DocumentError> {
        let file = DiagnosisFile::from_document(document)?;
        if !Status::ALL.iter().any(|status| status.name() == file.status) {
            let names = Status::ALL.map(|status| format!("\"{}\"", status.name())).join(", ");
            return Err(wrong(document, "status", &file.status, names));
        }
        let mut questions = Vec::new();
        for missing in &file.missing {
            let mut members = Vec::new();
            for id in &missing.one_of {
                members.push(place(document, "missing.one_of", id)?);
            }
            let effect = place(document, "missing.effect", &missing.effect)?;
            if !members.contains(&effect) {
                let expected = format!("one of {}", missing.one_of.join(", "));
                return Err(wrong(document, "missing.effect", &missing.effect, expected));
            }
            members.sort_unstable();
            members.dedup();
            let card = &CATALOGUE[effect];
            let typical = |p: &trackdyn_physics::effect::Parameter| p.typical;
            let mut values: Vec<f64> = card.parameters.iter().map(typical).collect();
            for parameter in &missing.parameters {
                let known = card.parameters.iter().position(|p| p.key == parameter.name);
                let Some(known) = known else {
                    let keys: Vec<&str> = card.parameters.iter().map(|p| p.key).collect();
                    let expected = format!("a parameter of {}: {}", card.id, keys.join(", "));
                    return Err(wrong(
                        document,
                        "missing.parameters.name",
                        &parameter.name,
                        expected,
                    ));
                };
                let [low, high] = card.parameters[known].range;
                if !(low..=high).contains(&parameter.value) {
                    let value = value_after(document.text(), &parameter.name);
                    let key = format!("missing.parameters.{}", parameter.name);
                    let expected = format!("a value from {low} to {high} {}", parameter.unit);
                    return Err(document.value_error(value, key, expected));
                }
                values[known] = parameter.value;
            }
            // Sizes of none are no question.
            let sizes = card.parameters.iter().zip(&values);
            let is_there = |(parameter, value): (&trackdyn_physics::effect::Parameter, &f64)| {
                matches!(parameter.role, Role::Size { .. }) && *value != neutral(parameter)
            };
            if members.len() > 1 && sizes.into_iter().any(is_there) {
                questions.push(Self { effect, members, values });
            }
        }
        Ok(questions)
    }
}

fn place(document: &Document, key: &str, id: &str) -> Result<usize, DocumentError> {
    CATALOGUE.iter().position(|card| card.id == id).ok_or_else(|| {
        wrong(document, key, id, "an effect of the catalogue (see `trackdyn effects`)".to_owned())
    })
}

/// The error of a text value, where it first stands.
fn wrong(document: &Document, key: &str, value: &str, expected: String) -> DocumentError {
    let quoted = format!("\"{value}\"");
    let start = document.text().find(&quoted).unwrap_or_default();
    document.value_error(start..start + quoted.len(), key, expected)
}

/// Where the value of the parameter of this name stands.
fn value_after(text: &str, name: &str) -> Range<usize> {
    let after = |from: usize, what: &str| {
        text[from..].find(what).map_or(from, |place| from + place + what.len())
    };
    let name = after(0, &format!("\"{name}\""));
    let start = after(after(name, "value"), "=");
    let ends = |letter: char| matches!(letter, '\n' | ',' | '}' | '#');
    let until = text[start..].find(ends).map_or(text.len(), |end| start + end);
    let value = text[start..until].trim_start();
    until - value.len()..start + text[start..until].trim_end().len()
}

/// What can be measured at rest where driving cannot tell an effect from another.
pub fn measurement(effect: usize) -> &'static str {
    match CATALOGUE[effect].stages.first() {
        None | Some(Stage::Body) => "weigh each track, front and rear (mass and its centre)",
        Some(Stage::Drive) => {
            "mark a belt and count its travel against its encoder, slowly and at a start"
        }
        Some(Stage::Ground) => {
            "pull each side along and across its track with a force gauge, here and elsewhere"
        }
        Some(Stage::Load) => "tilt the robot until it tips (height of the centre of gravity)",
        Some(Stage::Shear) => {
            "pull the robot along and across with a force gauge, forward and backward, at several speeds"
        }
        Some(Stage::Wrench) => {
            "tow the robot with free belts, with and without what hangs on it, and read the force"
        }
        Some(Stage::Sense) => {
            "measure the mount of the pose sensor, and its clock against the encoders'"
        }
    }
}

//! Questions that a diagnosis left open.

use crate::diagnosis::Status;
use crate::document::DiagnosisFile;
use crate::hypothesis::neutral;
use serde::Deserialize;
use toml::Spanned;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_model::effect::Role;
use trackdyn_model::{EffectId, effect::Stage};

/// The part of a diagnosis file that is read, with positions for errors.
#[derive(Deserialize)]
struct Stated {
    status: Spanned<String>,
    #[serde(default)]
    missing: Vec<StatedMissing>,
}

/// A missing part as stated in a diagnosis file.
#[derive(Deserialize)]
struct StatedMissing {
    effect: Spanned<String>,
    one_of: Vec<Spanned<String>>,
    parameters: Vec<StatedParameter>,
}

/// A parameter as stated in a diagnosis file.
#[derive(Deserialize)]
struct StatedParameter {
    name: Spanned<String>,
    value: Spanned<f64>,
}

/// A class of effects that explain a recording equally well.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// The effect that was fitted.
    pub effect: EffectId,
    /// All members, ascending.
    pub members: Vec<EffectId>,
    /// Fitted values of its parameters; typical ones where the file has none.
    pub values: Vec<f64>,
}

impl Question {
    /// Reads the questions of a diagnosis file.
    ///
    /// # Errors
    /// A [`DocumentError`] that points at a word outside the schema, an id outside the catalogue,
    /// or a parameter that the effect does not have.
    pub fn of(document: &Document) -> Result<Vec<Self>, DocumentError> {
        DiagnosisFile::from_document(document)?;
        let file: Stated = document.parse()?;
        if !Status::ALL.iter().any(|status| status.name() == file.status.get_ref()) {
            let names = Status::ALL.map(|status| format!("\"{}\"", status.name())).join(", ");
            return Err(document.value_error(file.status.span(), "status", names));
        }
        let mut questions = Vec::new();
        for missing in &file.missing {
            let members = missing.one_of.iter();
            let members = members.map(|id| place(document, "missing.one_of", id));
            let mut members: Vec<EffectId> = members.collect::<Result<_, _>>()?;
            let effect = place(document, "missing.effect", &missing.effect)?;
            if !members.contains(&effect) {
                let ids: Vec<&str> =
                    missing.one_of.iter().map(|id| id.get_ref().as_str()).collect();
                let expected = format!("one of {}", ids.join(", "));
                return Err(document.value_error(
                    missing.effect.span(),
                    "missing.effect",
                    expected,
                ));
            }
            members.sort_unstable();
            members.dedup();
            let card = effect.card();
            let typical = |p: &trackdyn_model::effect::Parameter| p.typical;
            let mut values: Vec<f64> = card.parameters.iter().map(typical).collect();
            for StatedParameter { name, value } in &missing.parameters {
                let known = card.parameters.iter().position(|p| p.key == name.get_ref());
                let Some(known) = known else {
                    let keys: Vec<&str> = card.parameters.iter().map(|p| p.key).collect();
                    let expected = format!("a parameter of {}: {}", card.id, keys.join(", "));
                    let key = "missing.parameters.name";
                    return Err(document.value_error(name.span(), key, expected));
                };
                let parameter = &card.parameters[known];
                let [low, high] = parameter.range;
                if !(low..=high).contains(value.get_ref()) {
                    let key = format!("missing.parameters.{}", parameter.key);
                    let unit = parameter.unit_behind();
                    let expected = format!("a value from {low} to {high}{unit}");
                    return Err(document.value_error(value.span(), key, expected));
                }
                values[known] = *value.get_ref();
            }
            // An effect with neutral sizes raises no question.
            let sizes = card.parameters.iter().zip(&values);
            let is_there = |(parameter, value): (&trackdyn_model::effect::Parameter, &f64)| {
                matches!(parameter.role, Role::Size { .. }) && *value != neutral(parameter)
            };
            if members.len() > 1 && sizes.into_iter().any(is_there) {
                questions.push(Self { effect, members, values });
            }
        }
        Ok(questions)
    }
}

/// Looks up an effect in the catalogue.
fn place(document: &Document, key: &str, id: &Spanned<String>) -> Result<EffectId, DocumentError> {
    let found = EffectId::of(id.get_ref());
    let expected = "an effect of the catalogue (see `trackdyn effects`)";
    found.ok_or_else(|| document.value_error(id.span(), key, expected))
}

/// Measurement at rest that helps where driving cannot separate an effect from others.
pub fn measurement(effect: EffectId) -> &'static str {
    match effect.card().stages.first() {
        None | Some(Stage::Body) => "weigh each track, front and rear (mass and its centre)",
        Some(Stage::Drive) => {
            "mark a belt and count its travel against its encoder, slowly and at a start"
        }
        Some(Stage::Ground) => {
            "pull each side along and across its track with a force gauge, here and elsewhere"
        }
        Some(Stage::Load) => "tilt the robot until it tips (height of the centre of gravity)",
        Some(Stage::Shear) => {
            "pull the robot along and across with a force gauge, forward and backward, at several \
             speeds"
        }
        Some(Stage::Wrench) => {
            "tow the robot with free belts, with and without what hangs on it, and read the force"
        }
        Some(Stage::Sense) => {
            "measure the mount of the pose sensor, and its clock against the encoders'"
        }
    }
}

//! What the model lacks.

use super::Shown;
use crate::diagnosis::Subject;
use crate::diagnosis::words::{probability, sized};
use serde::Serialize;
use trackdyn_diagnose::diagnosis::{Kind, Missing};
use trackdyn_diagnose::document::MissingTable;
use trackdyn_diagnose::hypothesis::Unknown;

/// A claim.
#[derive(Serialize)]
pub(super) struct Lack {
    title: String,
    ids: String,
    sizes: Vec<Size>,
    chance: Shown,
}

/// A size with its interval.
#[derive(Serialize)]
struct Size {
    meaning: String,
    value: Shown,
    low: Shown,
    high: Shown,
    unit: String,
}

/// All claims, in the order of the file.
pub(super) fn of(subject: &Subject) -> Vec<Lack> {
    let missing = subject.diagnosis.answer.missing.iter().zip(&subject.file.missing);
    missing.map(|(missing, table)| lack(missing, table)).collect()
}

fn lack(missing: &Missing, table: &MissingTable) -> Lack {
    let is_constant = missing.kind == Kind::Constant;
    let several = table.one_of.len() > 1;
    let title = if is_constant {
        "A number of the vehicle file is off, not its physics".to_owned()
    } else if several {
        let titles = missing.verdict.one_of.iter().map(|effect| effect.card().title);
        format!("One of: {}", titles.collect::<Vec<_>>().join("; "))
    } else {
        missing.verdict.effect.card().title.to_owned()
    };
    let unknowns = missing.parameters.iter().filter_map(|interval| {
        interval.unknown.parameter().map(|parameter| (interval.unknown, parameter))
    });
    let own = unknowns.zip(&table.parameters).filter(|((unknown, _), _)| {
        matches!(unknown, Unknown::Effect(effect, _) if *effect == missing.verdict.effect)
    });
    let sizes = own.map(|((_, parameter), of)| {
        let [value, low, high] = [of.value, of.low95, of.high95];
        let [value_text, low_text, high_text] = sized([value, low, high]);
        Size {
            meaning: parameter.meaning.to_owned(),
            value: Shown { data: value, text: value_text },
            low: Shown { data: low, text: low_text },
            high: Shown { data: high, text: high_text },
            unit: parameter.unit_behind(),
        }
    });
    let p = table.evidence.p;
    Lack {
        title,
        ids: table.one_of.join(" or "),
        sizes: sizes.collect(),
        chance: Shown { data: p, text: probability(p) },
    }
}

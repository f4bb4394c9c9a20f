//! The answer in a paragraph: what, where, how much, and so what.

use super::Subject;
use super::words::{id, ids, significant, symmetry, with_interval};
use crate::ticks::number;
use trackdyn_diagnose::Status;
use trackdyn_diagnose::diagnosis::{Kind, Missing};
use trackdyn_diagnose::hypothesis::Unknown;
use trackdyn_diagnose::locate::cells::Cell;
use trackdyn_diagnose::locate::{Along, Wave};
use trackdyn_diagnose::proposal::Proposal;
use trackdyn_diagnose::verdict::{Refusal, Verdict};
use trackdyn_model::EffectId;
use trackdyn_model::effect::Parameter;

/// The status in words, and what kind of news it is.
pub(super) fn status(subject: &Subject) -> [&'static str; 2] {
    match subject.diagnosis.answer.status {
        Status::Explained => ["Explained: what the model lacks has a name", "good"],
        Status::NothingMissing => ["Nothing is missing that this evidence could show", "good"],
        Status::Ambiguous => ["Ambiguous: several effects explain it alike", "mixed"],
        Status::Unexplained => {
            ["Unexplained: something is there that the catalogue does not know", "bad"]
        }
    }
}

/// The answer, each part with its question.
pub(super) fn parts(subject: &Subject) -> Vec<[String; 2]> {
    let diagnosis = subject.diagnosis;
    let mut what: Vec<String> =
        diagnosis.answer.missing.iter().map(|m| named(subject, m)).collect();
    match (diagnosis.answer.status, what.is_empty()) {
        (Status::Unexplained, true) => what.push(
            "Observation and model differ, but no effect of the catalogue, nor two or three \
             together, explain how."
                .to_owned(),
        ),
        (Status::Unexplained, false) => what.push(left(subject)),
        (_, true) => what.push(format!(
            "The model of {} as filed, with constant ICRs (the centres about which the tracks \
             turn), clock and sensor fitted, explains this evidence down to its noise.",
            subject.vehicle.vehicle.name
        )),
        _ => {}
    }
    let is_met_once = |verdict: &&Verdict| matches!(verdict.refused, Some(Refusal::MetOnce { .. }));
    let met_once = diagnosis.answer.refused.iter().filter(is_met_once);
    what.extend(met_once.filter_map(|verdict| once(subject, verdict)));
    what.extend(diagnosis.answer.proposed.as_ref().map(proposed));
    let place = if diagnosis.answer.broken.is_empty() {
        "Nowhere: no symmetry of driving is broken beyond chance.".to_owned()
    } else {
        let mut letters = diagnosis.answer.place.chars();
        let first = letters.next().map(char::to_uppercase);
        format!("{}{}.", first.into_iter().flatten().collect::<String>(), letters.as_str())
    };
    let slide = diagnosis.friction_by_inertia().map(slide);
    let much = std::iter::once(errors(subject)).chain(worth(subject)).chain(slide);
    let much: Vec<String> = much.collect();
    [
        ["What", what.join(" ").as_str()],
        ["Where", place.as_str()],
        ["How much", much.join(" ").as_str()],
        ["So what", advice(subject)],
    ]
    .map(|part| part.map(str::to_owned))
    .to_vec()
}

/// How far the robot slides, as factor of the file's friction with its interval.
fn slide([factor, low, high]: [f64; 3]) -> String {
    let [factor, low, high] = [factor, low, high].map(|value| number(value, 3));
    format!(
        "It slides as on {factor} times the friction of the vehicle file (95 % interval {low} to \
         {high}): inertia is felt in units of friction."
    )
}

/// What is not claimed because the robot met it once.
fn once(subject: &Subject, verdict: &Verdict) -> Option<String> {
    let found = verdict.found.as_ref()?;
    let card = found.card();
    let values = card.parameters.iter().zip(found.values());
    let values = values.map(|(parameter, &value)| is(parameter, value));
    Some(format!(
        "Not claimed, because {} of {} blocks of time show it and whatever happens once would look \
         the same: {} ({}, {}). Drive there again, and diagnose that.",
        number(verdict.support.blocks, 1),
        subject.diagnosis.evidence.seen.blocks(),
        lower(card.title),
        card.id,
        values.collect::<Vec<_>>().join(", ")
    ))
}

/// What the claims do not explain.
fn left(subject: &Subject) -> String {
    let left = &subject.diagnosis.answer.left_over;
    let names: Vec<&str> = left.iter().map(|one| symmetry(*one)[0]).collect();
    let part = format!(
        "That is part of it, not all: what is left still breaks symmetries of driving ({}).",
        names.join(", ")
    );
    std::iter::once(part).chain(waves(subject)).collect::<Vec<_>>().join(" ")
}

/// Waves that the corrected model leaves, a sentence each.
pub(super) fn waves(subject: &Subject) -> Vec<String> {
    let sentence = |wave: &Wave| match wave.along {
        Along::Ground { direction } => format!(
            "The ground is wavy: the ICRs come and go every {} m in the direction of {} degrees.",
            number(wave.length, 2),
            number(direction.to_degrees(), 0)
        ),
        Along::Belts => format!(
            "A track runs faster and slower every {} m of its way, as with a sprocket or an \
             encoder that runs out of true, or a damaged belt.",
            number(wave.length, 2)
        ),
    };
    subject.diagnosis.evidence.after.waves.iter().map(sentence).collect()
}

/// The law that is proposed for what no effect explains.
fn proposed(proposal: &Proposal) -> String {
    let names: Vec<&str> = proposal.breaks().into_iter().map(|one| symmetry(one)[0]).collect();
    let share = proposal.explains().map_or(String::new(), |share| {
        format!(", {} % of what was left above the noise floor", number(100.0 * share, 0))
    });
    let rest = if proposal.left_over.is_empty() {
        "after which no symmetry is surely broken".to_owned()
    } else {
        let names: Vec<&str> = proposal.left_over.iter().map(|&one| symmetry(one)[0]).collect();
        format!("after which symmetries are surely broken still ({})", names.join(", "))
    };
    format!(
        "A force of this form, whose cause the catalogue does not know, describes it: {} (breaks \
         {}). With it the error falls from {} to {} standard deviations of the noise{share}, \
         {rest}.",
        proposal.sentence(),
        names.join(", "),
        number(proposal.held_out.before, 3),
        number(proposal.held_out.after, 3)
    )
}

fn named(subject: &Subject, missing: &Missing) -> String {
    let effects = &missing.verdict.one_of;
    if missing.kind == Kind::Constant {
        return format!(
            "A number of the vehicle file is off, not its physics: the constant ICRs (the centres \
             about which the tracks turn) differ from what the file gives, for which any one of {} \
             would account.",
            some(effects)
        );
    }
    let sizes: Vec<String> = missing
        .parameters
        .iter()
        .filter_map(|interval| {
            let Unknown::Effect(effect, _) = interval.unknown else { return None };
            let parameter = interval.unknown.parameter()?;
            (effect == missing.verdict.effect).then(|| {
                let [value, low, high] = with_interval(interval);
                let (key, unit) = (parameter.key, parameter.unit_behind());
                format!("{key} = {value}{unit} (95 % interval {low} to {high})")
            })
        })
        .collect();
    let sizes = if sizes.is_empty() { String::new() } else { format!(", {}", sizes.join(", ")) };
    let title = |effect: EffectId| effect.card().title;
    if effects.len() > 1 {
        let names: Vec<String> = effects
            .iter()
            .map(|&effect| format!("{} ({})", lower(title(effect)), id(effect)))
            .collect();
        return format!(
            "The model of {} lacks one of these, and this evidence cannot tell which: {}. \
             If it is {}{sizes}.",
            subject.vehicle.vehicle.name,
            names.join(" or "),
            id(missing.verdict.effect)
        );
    }
    let effect = missing.verdict.effect;
    let lacks = if missing.kind == Kind::Instrument {
        "What encoders or pose sensor do, not the motion, differs from"
    } else {
        "Missing from"
    };
    format!("{lacks} the model: {} ({}){sizes}.", lower(title(effect)), id(effect))
}

/// A parameter in a sentence.
fn is(parameter: &Parameter, value: f64) -> String {
    format!("{} = {}{}", parameter.key, significant(value, 4), parameter.unit_behind())
}

/// Names of a few effects, or how many they are.
pub(super) fn some(effects: &[EffectId]) -> String {
    const MAX_NAMED_EFFECTS: usize = 3;
    if effects.len() > MAX_NAMED_EFFECTS {
        format!("{} effects", effects.len())
    } else {
        ids(effects, " or ")
    }
}

/// A title inside a sentence.
fn lower(title: &str) -> String {
    let mut letters = title.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

fn errors(subject: &Subject) -> String {
    let fit = &subject.diagnosis.evidence.errors;
    let on = if fit.are_held_out {
        "On runs that nothing was fitted or chosen on"
    } else {
        "On the runs of the fit (none were held out)"
    };
    let share = fit.excess_explained().map_or_else(
        || "there was no excess over that floor".to_owned(),
        |share| {
            format!("{} % of the excess over that floor is explained", number(100.0 * share, 1))
        },
    );
    let contradiction = subject.diagnosis.contradiction();
    let contradiction = contradiction.map_or_else(String::new, |sentence| format!(" {sentence}"));
    format!(
        "{on} the error is {} standard deviations of the noise before and {} after, where {} would \
         be left if everything that could move ICRs or instruments were fitted away: \
         {share}.{contradiction}",
        number(fit.before, 3),
        number(fit.after, 3),
        number(fit.noise_floor, 3)
    )
}

/// What it is worth: the largest departure that is surely one.
fn worth(subject: &Subject) -> Option<String> {
    const MIN_DEVIATIONS: f64 = 4.0;
    if subject.diagnosis.answer.missing.is_empty() {
        return None;
    }
    let [before, _] = subject.cells();
    let surely = |cell: &Cell| {
        let sure = cell.departure.iter().filter(|(value, sd)| value.abs() > MIN_DEVIATIONS * sd);
        sure.map(|(value, _)| value.abs()).fold(0.0, f64::max)
    };
    let worst = before.iter().max_by(|a, b| surely(a).total_cmp(&surely(b)))?;
    (surely(worst) > 0.0).then(|| {
        format!(
            "Whoever drives with constant ICRs is off by up to {} mm in one of them, in {} at \
             {} m/s.",
            number(1e3 * surely(worst), 0),
            worst.manoeuvre.name(),
            number(worst.mean_speed, 2)
        )
    })
}

fn advice(subject: &Subject) -> &'static str {
    match subject.diagnosis.answer.status {
        Status::Explained => {
            "vehicle.corrected.toml has what is claimed, to simulate, calibrate and replay with."
        }
        Status::NothingMissing => {
            "There is no reason to change the vehicle file; the detection limits below say what \
             would have shown, and what would not."
        }
        Status::Ambiguous => {
            "vehicle.corrected.toml takes the first of each class; before more is built on it, do \
             what decides between its members (below)."
        }
        Status::Unexplained => {
            "Do not build on the corrected vehicle beyond this recording: look at the figures for \
             where and when it departs, and at the run for what happened there."
        }
    }
}

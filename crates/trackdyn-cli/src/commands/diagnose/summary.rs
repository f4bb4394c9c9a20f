//! A diagnosis in one screen.

use crate::wrapped::wrapped;
use std::fmt::Write;
use trackdyn::Diagnosis;
use trackdyn::crates::core::rounding::decimals;
use trackdyn::crates::diagnose::diagnosis::{Kind, Missing};
use trackdyn::crates::diagnose::document::{ComparedTable, DriftTable, separate_by};
use trackdyn::crates::diagnose::mismatch::words;
use trackdyn::crates::diagnose::noise;
use trackdyn::crates::diagnose::proposal::Proposal;
use trackdyn::crates::diagnose::uncertainty::{Interval, Level};
use trackdyn::crates::diagnose::verdict::Refusal;
use trackdyn::crates::diagnose::{Diagnosis as Found, Status};
use trackdyn::crates::model::EffectId;
use trackdyn::crates::model::effect::Symmetry;

/// Effects whose limits are printed where nothing is missing.
const LIMITS: usize = 6;

/// Decimals of a size at least.
const DECIMALS: usize = 4;

/// The text of a diagnosis.
pub fn text(diagnosis: &Diagnosis) -> String {
    let (evidence, name) = (diagnosis.evidence(), diagnosis.name());
    let vehicle = diagnosis.vehicle().name();
    let diagnosis = diagnosis.found();
    let mut text = String::new();
    let samples = evidence.samples().len();
    let unit = evidence.origin().samples();
    // Writing to a String cannot fail.
    text += &wrapped("", &format!("{name}: {samples} {unit}, {}", evidence.description()));
    let _ = writeln!(text, "vehicle  {vehicle}");
    if let Some(noise) = diagnosis.evidence.seen.noise() {
        text += &wrapped("noise    ", &noise::sentence(noise));
    }
    let _ = writeln!(text, "\nstatus   {}", diagnosis.answer.status.name());
    let place = format!(
        "{} ({:.2} times the noise with clock, mount and constant ICRs fitted)",
        diagnosis.answer.place, diagnosis.evidence.before.excess_over_noise
    );
    text += &wrapped("where    ", &place);
    if diagnosis.answer.missing.is_empty() {
        text += &wrapped("missing  ", &nothing(diagnosis));
    }
    for (index, missing) in diagnosis.answer.missing.iter().enumerate() {
        let head = if index == 0 { "missing  " } else { "         " };
        text += &wrapped(head, &line(missing));
        if missing.verdict.one_of.len() > 1 {
            text += &wrapped("           decides: ", &separate_by(missing));
        }
        let resembling = missing.resembling();
        if !resembling.is_empty() {
            text += &wrapped("           acts alike: ", &resembling);
        }
    }
    if let Some(level) = diagnosis.models.friction_level.filter(|level| level.is_sure) {
        text += &wrapped("friction ", &friction(level));
    }
    if let Some(factors) = diagnosis.friction_by_inertia() {
        text += &wrapped("friction ", &slide(factors));
    }
    for verdict in &diagnosis.answer.refused {
        let id = verdict.effect.name();
        let why = verdict.refused.as_ref().map_or_else(String::new, Refusal::to_string);
        text += &wrapped("refused  ", &format!("{id}: {why}"));
    }
    if diagnosis.answer.status == Status::Unexplained {
        let is_left = |symmetry: Symmetry| diagnosis.answer.left_over.contains(&symmetry);
        let left = diagnosis.evidence.after.tests.iter().filter(|one| is_left(one.symmetry));
        let left: Vec<String> = left
            .map(|one| {
                let test = &one.test;
                format!(
                    "{} (chi2 {:.0} of {} columns, p = {:.4})",
                    words(one.symmetry, &diagnosis.evidence.after),
                    test.statistic,
                    test.degrees,
                    test.p
                )
            })
            .collect();
        text += &wrapped("left     ", &left.join("; "));
    }
    if let Some(proposal) = &diagnosis.answer.proposed {
        text += &wrapped("form     ", &form(proposal));
    }
    let fit = &diagnosis.evidence.errors;
    let of = diagnosis.evidence.seen.origin().runs();
    let on =
        if fit.are_held_out { format!("held-out {of}") } else { format!("the {of} of the fit") };
    let explained = fit.excess_explained();
    let share = explained.map_or("no excess".to_owned(), |share| {
        format!("{:.1} % of the excess explained", 100.0 * share)
    });
    let errors = format!(
        "on {on}: {:.3} before, {:.3} with instruments and constants alone, {:.3} after, noise \
         floor {:.3} ({share})",
        fit.before, fit.instruments, fit.after, fit.noise_floor
    );
    text += &wrapped("fit      ", &errors);
    if let Some(sentence) = diagnosis.contradiction() {
        text += &wrapped("         ", &sentence);
    }
    if let Some(sentence) = driving(&DriftTable::of(&diagnosis.evidence.drift)) {
        text += &wrapped("driving  ", &sentence);
    }
    text
}

/// Errors of dead reckoning with the vehicle as filed and as corrected; none where too little was
/// driven, or nothing was corrected.
fn driving(drift: &DriftTable) -> Option<String> {
    let DriftTable { place_m_per_100_m: place, yaw_deg_per_turn: yaw } = drift;
    let of = |what: &str, unit: &str, table: &ComparedTable| {
        let ComparedTable { before, after, pose_noise, .. } = table;
        let [before, after, noise] =
            [before, after, pose_noise].map(|value| format!("{value:.*} {unit}", decimals(*value)));
        format!("{what} {before} as filed, {after} as corrected ({noise} is noise of the poses)")
    };
    let is_corrected = |table: &&ComparedTable| table.before != table.after;
    let place =
        place.as_ref().filter(is_corrected).map(|table| of("place lost per 100 m", "m", table));
    let yaw =
        yaw.as_ref().filter(is_corrected).map(|table| of("heading lost per turn", "deg", table));
    let worse = "the corrected vehicle drives worse than the filed one, against what the fit says: \
                 do not take it";
    let worse = drift.is_worse().then(|| worse.to_owned());
    let all: Vec<String> = place.into_iter().chain(yaw).chain(worse).collect();
    (!all.is_empty()).then(|| all.join("; "))
}

/// By how much both coefficients of friction differ from what was supposed.
fn friction(Level { value, half, .. }: Level) -> String {
    let [factor, low, high] = [value, value - half, value + half].map(f64::exp);
    format!(
        "both coefficients times {factor:.2} [{low:.2}, {high:.2}]: steady turns do not tell, but \
         mass slides that far"
    )
}

/// How far the robot slides, as factor of the file's friction.
fn slide([factor, low, high]: [f64; 3]) -> String {
    format!(
        "it slides as on {factor:.3} [{low:.3}, {high:.3}] times the friction of the vehicle file: \
         inertia is felt in units of friction"
    )
}

/// The law that is proposed where no effect explains what is left.
fn form(proposal: &Proposal) -> String {
    let letters = |symmetries: &[Symmetry]| -> String {
        symmetries.iter().map(|symmetry| symmetry.letter()).collect()
    };
    let share = proposal.explains().map_or(String::new(), |share| {
        format!(", {:.0} % of what was left above the noise floor", 100.0 * share)
    });
    let rest = if proposal.left_over.is_empty() {
        "no symmetry is surely broken any more".to_owned()
    } else {
        format!("{} surely broken still", letters(&proposal.left_over))
    };
    format!(
        "not in the catalogue, no cause known: {} (breaks {}; error {:.3} to {:.3}{share}; {rest})",
        proposal.sentence(),
        letters(&proposal.breaks()),
        proposal.held_out.before,
        proposal.held_out.after
    )
}

fn nothing(diagnosis: &Found) -> String {
    if diagnosis.answer.status == Status::Unexplained {
        return "something outside the catalogue: no effect, nor two or three, explains it"
            .to_owned();
    }
    let limits: Vec<String> = diagnosis
        .limits
        .detectable
        .iter()
        .filter_map(|one| {
            let card = one.effect.card();
            let parameter = &card.parameters[one.parameter];
            Some(format!("{} {:.2e}{}", card.id, one.size?, parameter.unit_behind()))
        })
        .collect();
    match limits.len() {
        0 => "nothing, and no effect of a physical size would have shown".to_owned(),
        count => {
            let more = if count > LIMITS { ", ..." } else { "" };
            let shown = limits[..count.min(LIMITS)].join(", ");
            format!("nothing; the smallest that this recording would have shown: {shown}{more}")
        }
    }
}

fn line(missing: &Missing) -> String {
    let id = |effect: &EffectId| effect.name();
    let verdict = &missing.verdict;
    if missing.kind == Kind::Constant {
        let ids: Vec<&str> = verdict.one_of.iter().map(id).collect();
        return format!(
            "a wrong number, not physics: the constant ICRs differ from the vehicle file's. One \
             of {}",
            ids.join(", ")
        );
    }
    let sizes: Vec<String> = missing
        .parameters
        .iter()
        .filter_map(|interval| {
            let parameter = interval.unknown.parameter()?;
            let Interval { value, low, high, .. } = interval;
            let digits = decimals((high - low) / 2.0).max(DECIMALS);
            let (key, unit) = (parameter.key, parameter.unit_behind());
            Some(format!("{key} = {value:.digits$} [{low:.digits$}, {high:.digits$}]{unit}"))
        })
        .collect();
    let names: Vec<&str> = verdict.one_of.iter().map(id).collect();
    let kind = if missing.kind == Kind::Instrument { " (encoders or pose sensor)" } else { "" };
    format!(
        "{}{kind}: {}; ln Bayes factor {:.1}, p = {:.4}",
        names.join(" or "),
        sizes.join(", "),
        verdict.support.ln_bayes_factor,
        verdict.support.p
    )
}

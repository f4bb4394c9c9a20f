//! A comparison in words: of the screen and of the page.

use super::{Comparison, Difference, Estimate, Member, Number, Quantity, Status, Subject, Which};
use crate::hypothesis::Unknown;
use crate::proposal::words::decimals;
use trackdyn_model::EffectId;

/// Most digits behind the point that a size has.
const MAX_DECIMALS: usize = 6;

/// Smallest differences that a sentence lists.
const LISTED: usize = 6;

/// The status as a sentence.
pub fn headline(comparison: &Comparison) -> &'static str {
    match comparison.status() {
        Status::NothingDiffers => "Nothing differs that these recordings could have shown.",
        Status::Explained => "They differ, and what differs is named.",
        Status::Ambiguous => "They differ, and more than one cause explains it.",
        Status::Unexplained => {
            "They differ in a way outside the catalogue. What is named beside it differs, too."
        }
    }
}

/// An estimate with its interval, to digits that the interval bears.
fn with_interval(of: &Estimate, unit: &str) -> String {
    let Estimate { value, low, high } = *of;
    let digits = decimals((high - low) / 2.0).min(MAX_DECIMALS);
    let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
    format!("{value:.digits$} [{low:.digits$}, {high:.digits$}]{unit}")
}

/// A number in both sets.
pub fn number(quantity: &Quantity) -> String {
    let [sim, real] =
        quantity.each.each_ref().map(|one| with_interval(one, quantity.number.unit()));
    format!("{} is {sim} in SIM and {real} in REAL", quantity.number.name())
}

fn names(effects: &[EffectId]) -> String {
    let names: Vec<&str> = effects.iter().map(|effect| effect.name()).collect();
    names.join(" or ")
}

/// A difference as a sentence: what it is, and which set has it.
pub fn sentence(one: &Difference) -> String {
    let numbers: Vec<String> = one.group.numbers.iter().map(number).collect();
    let numbers = numbers.join("; ");
    match one.group.subject {
        Subject::Constants => {
            let is_alone = one.members.iter().any(|member| !member.sizes.is_empty());
            let how = if is_alone { "each of" } else { "several of" };
            format!("constant ICRs differ: {how} {} explains it ({numbers})", names(&one.one_of))
        }
        Subject::FrictionLevel => format!("the friction by which they slide differs ({numbers})"),
        Subject::CentreOfGravity => {
            format!("the centre of gravity that inertia shows differs ({numbers})")
        }
        Subject::Effect(_) => {
            let which = match one.which {
                Which::First => "SIM has it, REAL lacks it",
                Which::Second => "REAL has it, SIM lacks it",
                Which::Both => "both have it, in different sizes",
            };
            format!("{}: {which} ({numbers})", names(&one.one_of))
        }
    }
}

/// What to set in the simulator.
pub fn settings(one: &Difference) -> Vec<String> {
    match one.group.subject {
        Subject::Constants => one.members.iter().filter_map(setting_of).collect(),
        Subject::FrictionLevel => one.group.numbers.iter().map(level).collect(),
        Subject::CentreOfGravity | Subject::Effect(_) => {
            let of = |quantity: &Quantity| {
                let real = with_interval(&quantity.each[1], quantity.number.unit());
                let what = match quantity.number {
                    Number::Unknown(Unknown::Effect(effect, place)) => {
                        effect.card().parameters[place].meaning
                    }
                    _ => "centre of gravity, as a shift against the vehicle file",
                };
                format!("{} = {real} ({what})", quantity.number.name())
            };
            one.group.numbers.iter().map(of).collect()
        }
    }
}

fn level(quantity: &Quantity) -> String {
    let factor = Estimate {
        value: quantity.difference.value.exp(),
        low: quantity.difference.low.exp(),
        high: quantity.difference.high.exp(),
    };
    format!("all friction times {}", with_interval(&factor, "1"))
}

/// Sizes of an effect that the robot has more than the simulator.
fn setting_of(member: &Member) -> Option<String> {
    let card = member.effect.card();
    let sizes = member.sizes.iter().map(|(place, size)| {
        let parameter = &card.parameters[*place];
        let size = with_interval(size, parameter.unit);
        format!("{} = {size} ({})", parameter.key, parameter.meaning)
    });
    let sizes: Vec<String> = sizes.collect();
    (!sizes.is_empty()).then(|| format!("on what it has, {}: {}", card.id, sizes.join(", ")))
}

/// How much closer the simulator would be; none where nothing was named.
pub fn closer(comparison: &Comparison) -> Option<String> {
    if comparison.differences.is_empty() {
        return None;
    }
    let closer = &comparison.closer;
    let runs = if closer.are_held_out { "held-out runs" } else { "the runs of the fit" };
    let [sim, corrected, real] = closer.errors;
    let mut text = format!(
        "{runs} of REAL: error {sim:.2} times the noise by the model of SIM, {corrected:.2} with \
         what is named, {real:.2} by the model of REAL"
    );
    let drifts =
        [(closer.drift.place, 100.0, "m per 100 m"), (closer.drift.yaw, 360.0, "deg per turn")];
    for (drift, scale, unit) in drifts {
        let Some(drift) = drift else { continue };
        let [before, after] = [drift.before, drift.after].map(|one| {
            let half = one.half_width.unwrap_or(f64::INFINITY);
            let digits = decimals(scale * half.min(one.value.abs())).min(MAX_DECIMALS);
            if half.is_finite() {
                format!("{:.digits$} ± {:.digits$}", scale * one.value, scale * half)
            } else {
                format!("{:.digits$}", scale * one.value)
            }
        });
        text += &format!("; {before} {unit} by SIM, {after} with what is named");
    }
    Some(text)
}

/// What both have alike and the vehicle file lacks; none where there is nothing.
pub fn common(comparison: &Comparison) -> Option<String> {
    let common: Vec<&str> = comparison.common().map(|effect| effect.name()).collect();
    (!common.is_empty())
        .then(|| format!("both have {}, which the vehicle file lacks", common.join(" and ")))
}

/// Instruments that differ, which is no physics of the simulator; none where none does.
pub fn instruments(comparison: &Comparison) -> Option<String> {
    let numbers = comparison.instruments.iter().flat_map(|group| &group.numbers);
    let other = numbers.filter(|one| !one.difference.holds(0.0));
    let words: Vec<String> = other.map(number).collect();
    (!words.is_empty()).then(|| words.join("; "))
}

/// What one set has and the other cannot show.
pub fn not_shown(comparison: &Comparison) -> Vec<String> {
    let words = comparison.not_shown.iter().map(|(effect, set)| {
        let [lacking, has] = if *set == 0 { ["SIM", "REAL"] } else { ["REAL", "SIM"] };
        format!("{effect}: {has} has it, and the recordings of {lacking} cannot show it")
    });
    words.collect()
}

/// The smallest differences that would have shown.
pub fn smallest(comparison: &Comparison) -> String {
    let sizes = comparison.smallest.iter().filter_map(|one| {
        let parameter = &one.effect.card().parameters[one.parameter];
        Some(format!("{} {:.2e}{}", one.effect, one.size?, parameter.unit_behind()))
    });
    let sizes: Vec<String> = sizes.collect();
    let more = if sizes.len() > LISTED { ", ..." } else { "" };
    if sizes.is_empty() {
        "no difference of a physical size would have shown".to_owned()
    } else {
        format!(
            "the smallest differences that would have shown: {}{more}",
            sizes[..sizes.len().min(LISTED)].join(", ")
        )
    }
}

//! A comparison in words: of the screen and of the page. SIM is the simulator, REAL the robot.

use super::{Comparison, Difference, Estimate, Member, Number, Quantity, Status, Subject, Which};
use crate::hypothesis::{Unknown, find};
use trackdyn_core::rounding::decimals;
use trackdyn_model::EffectId;
use trackdyn_model::effect::{Role, Symmetry};

/// Most digits behind the point that a size has.
const MAX_DECIMALS: usize = 6;

/// Smallest differences that a sentence lists.
const MAX_LISTED_DIFFERENCES: usize = 6;

/// The status as a sentence.
pub fn headline(comparison: &Comparison) -> &'static str {
    let is_named = !comparison.differences.is_empty();
    match comparison.status() {
        Status::NothingDiffers => {
            "SIM and REAL differ in nothing that these recordings could have shown."
        }
        Status::Explained => "SIM and REAL differ, and what differs is named.",
        Status::Ambiguous => "SIM and REAL differ, and more than one cause explains it.",
        Status::Unexplained if is_named => {
            "SIM and REAL differ, and what is named explains a part of it only."
        }
        Status::Unexplained if comparison.is_not_told_apart() => {
            "SIM and REAL differ, and what differs is not told apart."
        }
        Status::Unexplained => "SIM and REAL differ, and nothing in the catalogue explains it.",
    }
}

/// What is said where nothing is named.
pub fn nothing_named(comparison: &Comparison) -> String {
    if comparison.is_not_told_apart() {
        let [sim, _, real] = comparison.closer.errors;
        format!(
            "something that is not told apart: SIM's model leaves {sim:.2} times the noise of the \
             runs of REAL, REAL's own {real:.2}, and no one number is surely what differs"
        )
    } else if comparison.status() == Status::Unexplained {
        "something outside the catalogue: no effect and no number of the vehicle explains it"
            .to_owned()
    } else {
        format!("nothing; {}", smallest(comparison))
    }
}

/// What a difference depends on if it breaks a symmetry.
pub fn depends_on(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::SpeedScale => "speed",
        Symmetry::Reversal => "direction (forward or backward)",
        Symmetry::Manoeuvre => "manoeuvre (arc, counter-rotation or spin)",
        Symmetry::Mirror => "side (left or right turns)",
        Symmetry::Heading => "heading",
        Symmetry::Place => "place",
        Symmetry::Time => "time",
        Symmetry::Transient => "changes of speed or what was driven before",
        Symmetry::Straight => "straight driving (its speed or its drift)",
    }
}

/// An estimate with its interval, to digits that the interval bears.
fn with_interval(of: &Estimate, unit: &str) -> String {
    let Estimate { value, low, high } = *of;
    let digits = decimals((high - low) / 2.0).min(MAX_DECIMALS);
    // no minus before a zero
    let shown = |value: f64| {
        let text = format!("{value:.digits$}");
        let is_zero = text.chars().all(|one| matches!(one, '-' | '0' | '.'));
        if is_zero { text.trim_start_matches('-').to_owned() } else { text }
    };
    let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
    format!("{} [{}, {}]{unit}", shown(value), shown(low), shown(high))
}

/// A number of a logarithm as a factor.
fn factor(of: &Estimate) -> Estimate {
    let Estimate { value, low, high } = *of;
    Estimate { value: value.exp(), low: low.exp(), high: high.exp() }
}

/// A number in a word or a few.
pub fn name(number: Number) -> &'static str {
    match number {
        Number::Icr(0) => "middle between the ICRs",
        Number::Icr(1) => "half the distance of the ICRs",
        Number::Icr(_) => "y of the ICRs",
        Number::Level | Number::Unknown(Unknown::FrictionLevel) => "ln of the friction",
        Number::Unknown(_) => number.name(),
    }
}

/// A number in both sets.
pub fn number(quantity: &Quantity) -> String {
    if matches!(quantity.number, Number::Level | Number::Unknown(Unknown::FrictionLevel)) {
        let [sim, real] = quantity.each.each_ref().map(|one| with_interval(&factor(one), "1"));
        return format!("{sim} times the vehicle file's in SIM, {real} times in REAL");
    }
    let [sim, real] =
        quantity.each.each_ref().map(|one| with_interval(one, quantity.number.unit()));
    format!("{} = {sim} in SIM, {real} in REAL", name(quantity.number))
}

fn names(effects: &[EffectId]) -> String {
    let names: Vec<&str> = effects.iter().map(|effect| effect.name()).collect();
    names.join(" or ")
}

/// A difference as a sentence: what it is, and which set has it.
pub fn sentence(one: &Difference) -> String {
    let numbers: Vec<String> = one.group.numbers.iter().map(number).collect();
    let numbers = numbers.join("; ");
    let names = names(&one.one_of);
    match one.group.subject {
        Subject::Constants => {
            let is_alone = one.members.iter().any(|member| !member.sizes.is_empty());
            let by = match (is_alone, one.one_of.len()) {
                (_, 0) => String::new(),
                (true, 1) => format!(", by {names}"),
                (true, _) => format!(", by one of {names}"),
                (false, _) => format!(", by several of {names} together"),
            };
            format!("the constant ICRs differ{by}: {numbers}")
        }
        Subject::FrictionLevel => format!("the friction differs on which they slide: {numbers}"),
        Subject::CentreOfGravity => {
            format!("the centre of gravity differs that inertia shows: {numbers}")
        }
        Subject::Effect(effect) => {
            let what = match one.which {
                Which::First => format!("SIM has {names}, which REAL lacks"),
                Which::Second => format!("SIM lacks {names}, which REAL has"),
                Which::Both => format!("SIM and REAL have {names}, in different sizes"),
            };
            let as_one = if one.one_of.len() > 1 && one.one_of.contains(&effect) {
                format!("as {effect}, ")
            } else {
                String::new()
            };
            format!("{what}: {as_one}{numbers}")
        }
    }
}

/// What speaks for a difference.
pub fn support(one: &Difference) -> String {
    format!(
        "probability of chance {:.4}, ln Bayes factor {:.1}",
        one.support.p, one.support.ln_bayes_factor
    )
}

/// What to set in the simulator, to be read behind the word "set".
pub fn settings(comparison: &Comparison, one: &Difference) -> Vec<String> {
    match one.group.subject {
        Subject::Constants => {
            let all = one.members.iter().filter_map(setting_of).enumerate();
            all.map(|(k, setting)| if k == 0 { setting } else { format!("or {setting}") }).collect()
        }
        Subject::FrictionLevel => one.group.numbers.iter().map(level).collect(),
        Subject::CentreOfGravity => {
            let of = |quantity: &Quantity| {
                let real = with_interval(&quantity.each[1], quantity.number.unit());
                format!("{} = {real}", name(quantity.number))
            };
            let both: Vec<String> = one.group.numbers.iter().map(of).collect();
            vec![format!(
                "the centre of gravity to that of the vehicle file, moved by {} in all",
                both.join(", ")
            )]
        }
        Subject::Effect(effect) => {
            if one.which == Which::First {
                return vec![format!("no {effect}")];
            }
            vec![format!("{effect}: {}", sizes(comparison, one, effect).join(", "))]
        }
    }
}

/// Sizes of an effect as in the second set, then its other parameters.
fn sizes(comparison: &Comparison, one: &Difference, effect: EffectId) -> Vec<String> {
    let parameters = effect.card().parameters;
    let of = |quantity: &Quantity| {
        let real = with_interval(&quantity.each[1], quantity.number.unit());
        let name = name(quantity.number);
        let meaning = quantity.number.parameter().map_or("", |parameter| parameter.meaning);
        format!("{name} = {real} ({meaning})")
    };
    let sizes = one.group.numbers.iter().map(of);
    let active = find(&comparison.closer.vehicle.effects, effect);
    let others = parameters.iter().enumerate().filter_map(|(place, parameter)| {
        let world = match parameter.role {
            Role::Size { .. } => return None,
            Role::Shape => "",
            Role::Place { .. } | Role::Direction | Role::Time => "; of the world of REAL",
        };
        let value = active?.values()[place];
        let (key, unit, meaning) = (parameter.key, parameter.unit_behind(), parameter.meaning);
        Some(format!("{key} = {value:.3}{unit} ({meaning}{world})"))
    });
    sizes.chain(others).collect()
}

fn level(quantity: &Quantity) -> String {
    format!(
        "the mean √(mu_x mu_y) of the friction to {} times that of SIM, in all: a ratio that is \
         set changes it, too",
        with_interval(&factor(&quantity.difference), "1")
    )
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
    (!sizes.is_empty()).then(|| format!("{} on top of what SIM has: {}", card.id, sizes.join(", ")))
}

/// How much closer the simulator would be; none where nothing was named.
pub fn closer(comparison: &Comparison) -> Option<String> {
    if comparison.differences.is_empty() {
        return None;
    }
    let closer = &comparison.closer;
    let runs = if closer.are_held_out { "held-out runs" } else { "runs" };
    let [sim, corrected, real] = closer.errors;
    let mut parts = vec![format!(
        "SIM predicts the {runs} of REAL with an error of {sim:.2} times the noise as it is, \
         {corrected:.2} so set; REAL's own model with {real:.2}"
    )];
    let drifts = [
        (closer.drift.place, 100.0, "m of place per 100 m"),
        (closer.drift.yaw, 360.0, "deg of heading per turn"),
    ];
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
        parts.push(format!("dead reckoning loses {before} {unit} as it is, {after} so set"));
    }
    Some(parts.join("; "))
}

/// What both have alike and the vehicle file lacks; none where there is nothing.
pub fn common(comparison: &Comparison) -> Option<String> {
    let common: Vec<&str> = comparison.common().map(EffectId::name).collect();
    (!common.is_empty())
        .then(|| format!("both have {}, which the vehicle file lacks", common.join(" and ")))
}

/// Instruments that differ, which is no physics of the simulator; none where none does.
pub fn instruments(comparison: &Comparison) -> Option<String> {
    let other = comparison.instruments.iter().flat_map(|group| {
        let differ = group.numbers.iter().filter(|one| !one.difference.holds(0.0));
        differ.map(|one| format!("{}: {}", group.subject.name(), number(one)))
    });
    let words: Vec<String> = other.collect();
    (!words.is_empty()).then(|| words.join("; "))
}

/// Differences that are no chance and yet are not claimed, where something is left unexplained.
pub fn refused(comparison: &Comparison) -> Vec<String> {
    if comparison.status() != Status::Unexplained {
        return Vec::new();
    }
    let max_p = comparison.before.max_p[0];
    let close = comparison.alike.iter().filter(|one| one.support.p < max_p);
    let words = close.filter_map(|one| {
        let why = one.refused.as_ref()?;
        Some(format!("{}: {why}", one.group.subject.name()))
    });
    words.collect()
}

/// What one set has and the other cannot show.
pub fn not_shown(comparison: &Comparison) -> Vec<String> {
    let words = comparison.not_shown.iter().map(|(effect, set)| {
        let [lacking, has] = if *set == 0 { ["SIM", "REAL"] } else { ["REAL", "SIM"] };
        format!("{has} has {effect}; the recordings of {lacking} cannot show it")
    });
    words.collect()
}

/// The smallest differences that would have shown, in units that a reader has at hand.
pub fn smallest(comparison: &Comparison) -> String {
    let sizes = comparison.smallest.iter().filter_map(|one| {
        let parameter = &one.effect.card().parameters[one.parameter];
        let (size, key) = (one.size?, parameter.key);
        let digits = decimals(size).min(MAX_DECIMALS);
        Some(format!("{} {key} {size:.digits$}{}", one.effect, parameter.unit_behind()))
    });
    let sizes: Vec<String> = sizes.collect();
    let more = if sizes.len() > MAX_LISTED_DIFFERENCES { ", ..." } else { "" };
    if sizes.is_empty() {
        "no difference of a physical size would have shown".to_owned()
    } else {
        format!(
            "the smallest differences that would have shown: {}{more}",
            sizes[..sizes.len().min(MAX_LISTED_DIFFERENCES)].join(", ")
        )
    }
}

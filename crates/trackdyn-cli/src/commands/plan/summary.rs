//! A plan in one screen.

use crate::wrapped::wrapped;
use std::collections::BTreeSet;
use std::fmt::Write;
use trackdyn::Plan;
use trackdyn::crates::diagnose::Plan as Found;
use trackdyn::crates::diagnose::noise;
use trackdyn::crates::diagnose::plan::menu::Manoeuvre;
use trackdyn::crates::diagnose::plan::{Answer, Separation, measurements};
use trackdyn::crates::model::EffectId;
use trackdyn::plan::NoiseOrigin;

/// The text of a plan.
pub fn text(plan: &Plan) -> String {
    let (noise, origin) = plan.noise();
    let noise = noise::sentence(noise);
    let origin = match origin {
        NoiseOrigin::Given => "as given",
        NoiseOrigin::Measured => "as the diagnosis measured it",
        NoiseOrigin::Assumed => "assumed, for the diagnosis does not tell: --noise-xy, --noise-yaw",
    };
    let mut text = format!("vehicle  {}\n", plan.vehicle());
    text += &wrapped("noise    ", &format!("{noise} ({origin})"));
    let plan = plan.found();
    // Pairs that driving may tell apart have a column each.
    let columns: Vec<usize> =
        (0..plan.pairs.len()).filter(|&k| plan.pairs[k].answer != Answer::Never).collect();
    // Writing to a String cannot fail.
    for (index, &column) in columns.iter().enumerate() {
        text += &wrapped(&format!("[{}] ", index + 1), &answer(&plan.pairs[column], plan));
    }
    for members in never(plan) {
        let ids: Vec<&str> = members.iter().map(|&effect| effect.name()).collect();
        let why = format!(
            "{}: driving cannot decide, z is below {} over all {} manoeuvres of the menu ({:.0} s)",
            ids.join(" or "),
            plan.min_separation,
            plan.menu.0,
            plan.menu.1
        );
        text += &wrapped("", &why);
        for measurement in measurements(members) {
            let _ = writeln!(text, "    instead: {measurement}");
        }
    }
    if plan.steps.is_empty() {
        return text;
    }
    let _ = writeln!(
        text,
        "\n{} manoeuvres, {:.2} s, each from rest to rest; z of each pair (z per second). z² adds \
        up, z does \
         not.",
        plan.steps.len(),
        plan.duration()
    );
    let name = plan.steps.iter().map(|step| step.manoeuvre.name.len()).max().unwrap_or(0);
    let heads: Vec<String> =
        (1..=columns.len()).map(|k| format!("{:>16}", format!("[{k}]"))).collect();
    let heads = heads.concat();
    let _ = writeln!(text, "{:>8} {:>7}  {:name$}{heads}", "start s", "for s", "manoeuvre");
    let row = |start: f64, time: f64, words: &str, z: &dyn Fn(usize) -> f64| {
        let cell = |&k: &usize| format!("{:>16}", format!("{:.2} ({:.3})", z(k), z(k) / time));
        let cells = columns.iter().map(cell).collect::<Vec<String>>().concat();
        format!("{start:8.2} {time:7.2}  {words:name$}{cells}\n")
    };
    for step in &plan.steps {
        let Manoeuvre { name, .. } = &step.manoeuvre;
        text += &row(step.start, step.manoeuvre.duration(), name, &|k| step.z[k]);
    }
    text += &row(0.0, plan.duration(), "all", &|k| plan.pairs[k].z);
    text
}

/// The members of each question that no driving tells from one another: those of pairs that share
/// one.
fn never(plan: &Found) -> Vec<BTreeSet<EffectId>> {
    let mut groups: Vec<(usize, BTreeSet<EffectId>)> = Vec::new();
    for pair in plan.pairs.iter().filter(|pair| pair.answer == Answer::Never) {
        let known = groups.iter_mut().find(|(question, members)| {
            *question == pair.question && pair.effects.iter().any(|effect| members.contains(effect))
        });
        match known {
            Some((_, members)) => members.extend(pair.effects),
            None => groups.push((pair.question, pair.effects.into())),
        }
    }
    groups.into_iter().map(|(_, members)| members).collect()
}

fn answer(pair: &Separation, plan: &Found) -> String {
    let [one, other] = pair.effects.map(EffectId::name);
    match pair.answer {
        Answer::Longer(time) => format!(
            "{one} or {other}: this plan does not decide, z = {:.1} is below {}; it would \
             take some {time:.0} s. Instead: {}",
            pair.z,
            plan.min_separation,
            measurements(pair.effects).join("; ")
        ),
        Answer::Plan | Answer::Never => format!(
            "{one} or {other}: the plan decides, z = {:.1} ({:.3} per second)",
            pair.z,
            pair.z / plan.duration()
        ),
    }
}

//! Scores as tables: Markdown to read, CSV to work with.

use super::Score;
use super::by_law::ByLaw;
use super::coverage;
use super::interval::clopper_pearson;
use super::means::Mean;
use super::power::PowerBin;
use super::rate::Rate;
use super::resolution::{self, Outcome, Revisited};
use crate::diagnosis::Fit;
use std::fmt::Write;
use trackdyn_core::real;

/// The scores as a page.
pub fn markdown(score: &Score) -> String {
    let mut text = String::from("# Scores of the trial\n\n");
    let _ = writeln!(text, "{} cases diagnosed, {} not yet.", score.judged.len(), score.absent);
    text.push_str(
        "Intervals: 95 %; of rates by Clopper and Pearson, of means by their standard \
                   errors, of medians by ranks.\n\n",
    );
    text.push_str("## Rates\n\n");
    rate_table(&mut text, &score.rates);
    text.push_str("\n## Means\n\n| what | cases | mean | interval | median | interval |\n");
    text.push_str("|---|---|---|---|---|---|\n");
    for Mean { name, mean, mean_interval, median, median_interval, cases } in &score.means {
        let [around_mean, around_median] = [mean_interval, median_interval].map(|interval| {
            interval.map_or_else(String::new, |[low, high]| format!("{low:.3} to {high:.3}"))
        });
        let _ = writeln!(
            text,
            "| {name} | {cases} | {mean:.3} | {around_mean} | {median:.3} | {around_median} |"
        );
    }
    text.push_str(
        "\n## Power\n\nSingle effects of the catalogue, without the class of constants.\n\n",
    );
    text.push_str("| z | cases | truth in the set | interval | named exactly | interval |\n");
    text.push_str("|---|---|---|---|---|---|\n");
    for bin in score.power.iter().filter(|bin| bin.cases > 0) {
        let (in_set, of_set) = shown(bin.in_set, bin.cases);
        let (exact, of_exact) = shown(bin.exact, bin.cases);
        let limits = limits(bin);
        let _ = writeln!(
            text,
            "| {limits} | {} | {in_set} | {of_set} | {exact} | {of_exact} |",
            bin.cases
        );
    }
    reach_table(&mut text, score);
    by_law_table(&mut text, score);
    text.push_str("\n## What was taken for what\n\n");
    let columns = score.confusion.columns();
    let _ = writeln!(text, "| concealed | {} |", columns.join(" | "));
    let _ = writeln!(text, "|{}", "---|".repeat(columns.len() + 1));
    for row in score.confusion.rows() {
        let cells = columns.iter().map(|column| match score.confusion.count(row, column) {
            0 => String::new(),
            count => count.to_string(),
        });
        let _ = writeln!(text, "| {row} | {} |", cells.collect::<Vec<_>>().join(" | "));
    }
    text
}

/// Every law of the catalogue, with what is found of it.
fn by_law_table(text: &mut String, score: &Score) {
    text.push_str("\n## Law by law\n\n");
    text.push_str(
        "Where it is concealed by itself and detectable, or a large error of a hard null.\n\n",
    );
    text.push_str("| law | cases | in a set | alone |\n|---|---|---|---|\n");
    for ByLaw { law, cases, in_set, alone } in &score.by_law {
        let _ = writeln!(text, "| {law} | {cases} | {in_set} | {alone} |");
    }
}

/// What a rule would name alone that sees separations with an error of one standard deviation.
fn reach_table(text: &mut String, score: &Score) {
    if score.reach.is_empty() {
        return;
    }
    text.push_str("\n## What a rule could reach\n\n");
    text.push_str(
        "Expected of a rule that sees how far an effect is from the next other one with \
                   an error of one standard\n",
    );
    text.push_str("deviation, as the best one does, and names it alone from t on.\n\n");
    text.push_str("| t | isolable singles named | others named alone |\n|---|---|---|\n");
    for reach in &score.reach {
        let [isolable, others] = [reach.isolable, reach.others].map(|share| 100.0 * share);
        let _ = writeln!(text, "| {:.1} | {isolable:.1} % | {others:.1} % |", reach.threshold);
    }
}

/// The rates of several programs beside each other, as a page.
///
/// A rate is empty where no case of a program counts.
pub fn comparison(scores: &[(&str, &Score)]) -> String {
    let names: Vec<&str> = scores.iter().map(|(name, _)| *name).collect();
    let mut text = String::from("# Scores of several programs\n\n");
    for (name, score) in scores {
        let (judged, absent) = (score.judged.len(), score.absent);
        let _ = writeln!(text, "- {name}: {judged} cases diagnosed, {absent} not yet.");
    }
    let _ =
        writeln!(text, "\n| what | {} |\n|---{}|", names.join(" | "), "|---".repeat(names.len()));
    for what in distinct(scores.iter().flat_map(|(_, score)| &score.rates)) {
        let cells = scores.iter().map(|(_, score)| {
            let rate = score.rates.iter().find(|rate| rate.name == what && rate.cases > 0);
            rate.map_or_else(String::new, |rate| {
                let (share, interval) = shown(rate.successes, rate.cases);
                format!("{share} of {} ({interval})", rate.cases)
            })
        });
        let _ = writeln!(text, "| {what} | {} |", cells.collect::<Vec<_>>().join(" | "));
    }
    text
}

/// Names of rates in the order in which they come up.
pub fn distinct<'a>(rates: impl Iterator<Item = &'a Rate>) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for rate in rates {
        if !names.contains(&rate.name.as_str()) {
            names.push(&rate.name);
        }
    }
    names
}

/// What further driving made of ambiguous diagnoses, as a page.
pub fn resolution_markdown(revisited: &[Revisited]) -> String {
    let mut text = String::from("# Further driving\n\n");
    text.push_str("Intervals: 95 %, Clopper and Pearson.\n\n");
    rate_table(&mut text, &resolution::rates(revisited));
    text.push_str("\n| case | concealed | open before | with the truth, after | outcome |\n");
    text.push_str("|---|---|---|---|---|\n");
    for case in revisited {
        let concealed = case.before.answer.concealed.iter().map(|c| c.mechanism.as_str());
        let outcome = match &case.outcome {
            Outcome::NothingToDrive => "nothing to drive",
            Outcome::Failed(reason) => reason.lines().next().unwrap_or_default(),
            Outcome::Diagnosed(diagnosis) => diagnosis.status.name(),
        };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {outcome} |",
            case.before.answer.id,
            concealed.collect::<Vec<_>>().join(" "),
            case.set_before().join(", "),
            case.set_after().unwrap_or_default().join(", "),
        );
    }
    text
}

/// `what,successes,cases,rate,low95,high95`.
pub fn rates_csv(rates: &[Rate]) -> String {
    let mut text = String::from("what,successes,cases,rate,low95,high95\n");
    for rate in rates {
        let numbers = csv_numbers(rate.successes, rate.cases);
        let _ = writeln!(text, "\"{}\",{},{},{numbers}", rate.name, rate.successes, rate.cases);
    }
    text
}

/// `z,from,until,cases,in_set,in_set_low95,in_set_high95,exact,exact_low95,exact_high95`, shares.
pub fn power_csv(score: &Score) -> String {
    let mut text = String::from(
        "z,from,until,cases,in_set,in_set_low95,in_set_high95,exact,exact_low95,exact_high95\n",
    );
    for bin in &score.power {
        let (in_set, exact) =
            (csv_numbers(bin.in_set, bin.cases), csv_numbers(bin.exact, bin.cases));
        let [from, until] = bin.limits;
        let _ = writeln!(text, "{},{from},{until},{},{in_set},{exact}", bin.of, bin.cases);
    }
    text
}

/// What was concealed against what was named; one row per truth.
pub fn confusion_csv(score: &Score) -> String {
    let columns = score.confusion.columns();
    let mut text = format!("concealed,{}\n", columns.join(","));
    for row in score.confusion.rows() {
        let cells = columns.iter().map(|column| score.confusion.count(row, column).to_string());
        let _ = writeln!(text, "{row},{}", cells.collect::<Vec<_>>().join(","));
    }
    text
}

/// One row per case: what was there and what was said.
pub fn cases_csv(score: &Score) -> String {
    let mut text = String::from(
        "case,stratum,concealed,z_det,z_iso,nearest,status,named,broken,false_claim,absent_law,\
         intervals_hold,intervals,excess_explained,held_out_before,held_out_instruments,\
         held_out_after,noise_floor,z_beyond\n",
    );
    for case in &score.judged {
        let answer = &case.answer;
        let list = |of: &dyn Fn(&crate::answer::Concealed) -> String| {
            answer.concealed.iter().map(of).collect::<Vec<_>>().join(" ")
        };
        let (status, named, broken) = match case.diagnosis() {
            None => ("failed", String::new(), String::new()),
            Some(diagnosis) => {
                let named = diagnosis.missing.iter().map(|claim| claim.members().join("|"));
                let named = named.collect::<Vec<_>>().join(" ");
                (diagnosis.status.name(), named, diagnosis.located.broken.join(""))
            }
        };
        let intervals = coverage::of_case(case);
        let hold = intervals.iter().filter(|(_, holds)| *holds).count();
        let fit = case.diagnosis().map(|diagnosis| &diagnosis.fit);
        let figure = |of: fn(&Fit) -> Option<f64>| {
            fit.and_then(of).map_or_else(String::new, |value| format!("{value:.4}"))
        };
        let figures = [
            figure(|fit| fit.excess_explained),
            figure(|fit| fit.held_out_before),
            figure(|fit| fit.held_out_instruments),
            figure(|fit| fit.held_out_after),
            figure(|fit| fit.noise_floor),
        ];
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},{status},{named},{broken},{},{},{hold},{},{},{}",
            answer.id,
            answer.stratum.name(),
            list(&|c| c.mechanism.clone()),
            list(&|c| c.z_det.to_string()),
            list(&|c| c.z_iso.to_string()),
            list(&|c| c.nearest.clone()),
            case.claims_falsely(),
            case.names_absent_law(),
            intervals.len(),
            figures.join(","),
            list(&|c| c.z_beyond.map_or_else(String::new, |z| z.to_string()))
        );
    }
    text
}

fn rate_table(text: &mut String, rates: &[Rate]) {
    text.push_str("| what | of | rate | interval |\n|---|---|---|---|\n");
    for rate in rates {
        let (share, interval) = shown(rate.successes, rate.cases);
        let Rate { name, successes, cases } = rate;
        let _ = writeln!(text, "| {name} | {successes} of {cases} | {share} | {interval} |");
    }
}

fn shown(successes: usize, cases: usize) -> (String, String) {
    match clopper_pearson(successes, cases) {
        Some([low, high]) => {
            let share = real(successes) / real(cases);
            (
                format!("{:.1} %", 100.0 * share),
                format!("{:.1} to {:.1} %", 100.0 * low, 100.0 * high),
            )
        }
        None => ("-".to_owned(), "-".to_owned()),
    }
}

fn csv_numbers(successes: usize, cases: usize) -> String {
    match clopper_pearson(successes, cases) {
        Some([low, high]) => {
            format!("{:.4},{low:.4},{high:.4}", real(successes) / real(cases))
        }
        None => ",,".to_owned(),
    }
}

fn limits(bin: &PowerBin) -> String {
    let [from, until] = bin.limits;
    if until.is_finite() {
        format!("{} {from} to {until}", bin.of)
    } else {
        format!("{} from {from} on", bin.of)
    }
}

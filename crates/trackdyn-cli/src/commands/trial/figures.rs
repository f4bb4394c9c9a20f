//! Scores as figures.

use std::path::Path;
use trackdyn::crates::core::output::write_file;
use trackdyn::crates::report::{
    Entrant, Figure, Matrix, Power, Share, Shares, confusion, power, shares,
};
use trackdyn_blind_trial::Score;
use trackdyn_blind_trial::oracle::{MIN_DETECTABLE_Z, MIN_DISTINCT_Z};
use trackdyn_blind_trial::score::interval::clopper_pearson;
use trackdyn_blind_trial::score::{PowerBin, Rate, distinct};

/// Scores with the names of their programs.
pub type Named<'a> = [(&'a str, &'a Score)];

type Written = Result<(), Box<dyn std::error::Error>>;

/// Writes the figures that programs share: `power.png`, `rates.png` and `coverage.png`.
pub fn write(out: &Path, scores: &Named, caption: &str) -> Written {
    let panels = [("named by itself", false), ("truth in a named set", true)];
    let panels = panels.map(|(title, in_set)| {
        [("z_det", (MIN_DETECTABLE_Z, "detectable")), ("z_iso", (MIN_DISTINCT_Z, "distinct"))]
            .map(|(z, mark)| (title, in_set, z, mark))
    });
    let limits = scores.first().map_or(Vec::new(), |(_, score)| limits(score));
    let panels = panels.as_flattened().iter().map(|(title, in_set, z, mark)| Power {
        title,
        z,
        mark: *mark,
        limits: &limits,
        entrants: entrants(scores, |score| {
            let bins = score.power.iter().filter(|bin| bin.of == *z);
            bins.map(|bin| Some(of_bin(bin, *in_set))).collect()
        }),
    });
    let panels: Vec<Power> = panels.collect();
    if let Ok(panels) = <&[Power; 4]>::try_from(panels.as_slice()) {
        write_file(&out.join("power.png"), &power(panels, caption).to_small_png()?)?;
    }
    let rates = sheet(scores, |score| &score.rates, &RATES, caption);
    write_file(&out.join("rates.png"), &rates.to_small_png()?)?;
    let coverage = sheet(scores, |score| &score.coverage, &COVERAGE, caption);
    Ok(write_file(&out.join("coverage.png"), &coverage.to_small_png()?)?)
}

/// Writes `confusion.png`, the figure of one program.
pub fn write_confusion(out: &Path, (name, score): (&str, &Score), caption: &str) -> Written {
    let of = &score.confusion;
    let [rows, columns] =
        [of.rows(), of.columns()].map(|names| names.into_iter().map(str::to_owned).collect());
    let (rows, columns): (Vec<String>, Vec<String>) = (rows, columns);
    let counts =
        rows.iter().map(|row| columns.iter().map(|column| of.count(row, column)).collect());
    let places =
        (0..rows.len()).flat_map(|row| (0..columns.len()).map(move |column| [row, column]));
    let right = places.filter(|[row, column]| of.is_right(&rows[*row], &columns[*column]));
    let (counts, right) = (counts.collect(), right.collect());
    let matrix = Matrix { rows: &rows, columns: &columns, counts, right, remarks: CONFUSION };
    Ok(write_file(&out.join("confusion.png"), &confusion(&matrix, name, caption).to_small_png()?)?)
}

/// What columns in brackets mean.
const CONFUSION: &str = "(set with it), (set without it): one answer of several effects. (both): \
                         both effects of a pair, and nothing else. (several): any other answer \
                         with more than one effect. (absent law in a true set): one answer of an \
                         error that is there, of instruments or of the vehicle file, and a law \
                         that is not. (failed): no answer.";

/// Texts of a sheet of shares.
struct Texts {
    title: &'static str,
    explanation: &'static str,
    of: &'static str,
    wanted: Option<f64>,
}

const RATES: Texts = Texts {
    title: "Rates",
    explanation: "What each row counts stands in docs/trials.md. Of false claims, wrong names and \
                  failures less is better, of all others more; files have to tell nulls in half of \
                  the cases.",
    of: "cases",
    wanted: None,
};

const COVERAGE: Texts = Texts {
    title: "Intervals that hold the true size",
    explanation: "Of every effect that is rightly named by itself and has one law in both \
                  simulators (where it has two, its size is another number): how many of the \
                  stated intervals of 95 % hold the true value. Dashed: 95 %.",
    of: "intervals",
    wanted: Some(0.95),
};

fn sheet(scores: &Named, of: fn(&Score) -> &Vec<Rate>, texts: &Texts, caption: &str) -> Figure {
    let rows = distinct(scores.iter().flat_map(|(_, score)| of(score)));
    let entrants = entrants(scores, |score| {
        let find = |name: &&str| of(score).iter().find(|rate| rate.name == *name).map(of_rate);
        rows.iter().map(find).collect()
    });
    let rows: Vec<String> = rows.into_iter().map(str::to_owned).collect();
    let Texts { title, explanation, of, wanted } = *texts;
    let sheet = Shares { title, explanation, of, rows: &rows, entrants: &entrants, wanted };
    shares(&sheet, caption)
}

fn entrants<'a>(
    scores: &Named<'a>,
    shares: impl Fn(&Score) -> Vec<Option<Share>>,
) -> Vec<Entrant<'a>> {
    scores.iter().map(|(name, score)| Entrant { name, shares: shares(score) }).collect()
}

/// The limits of z, which both have in common.
fn limits(score: &Score) -> Vec<f64> {
    let bins = || score.power.iter().filter(|bin| bin.of == "z_det");
    let first = bins().next().map(|bin| bin.limits[0]);
    first.into_iter().chain(bins().map(|bin| bin.limits[1])).collect()
}

fn of_bin(bin: &PowerBin, in_set: bool) -> Share {
    let successes = if in_set { bin.in_set } else { bin.exact };
    Share { successes, cases: bin.cases, interval: clopper_pearson(successes, bin.cases) }
}

fn of_rate(rate: &Rate) -> Share {
    Share { successes: rate.successes, cases: rate.cases, interval: rate.interval() }
}

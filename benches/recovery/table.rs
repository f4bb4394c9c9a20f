//! The table of all cases: lines of text, so that lines of an earlier run stand beside new ones.

use crate::case::{Case, NOTHING_NAME, Setting};
use std::fmt::Write;
use std::path::Path;
use trackdyn_diagnose::Status;

/// Its columns.
const HEAD: [&str; 13] = [
    "effect",
    "size",
    "driving",
    "concealed",
    "status",
    "named",
    "outcome",
    "p",
    "ln_bayes_factor",
    "value_over_true",
    "covered",
    "excess_explained",
    "seconds",
];

/// Lines, each with the cells of [`HEAD`].
pub struct Table {
    lines: Vec<Vec<String>>,
}

/// What an answer is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The truth alone is named; where nothing is concealed, nothing.
    Exact,
    /// A set with the truth in it is named, and nothing else.
    InSet,
    /// Something that is not there is named beside the truth.
    Beside,
    /// Something that is not there is named, and not the truth.
    Wrong,
    /// Something unknown is said to be there.
    Unexplained,
    /// Nothing is named.
    Missed,
    /// There is no diagnosis.
    Refused,
}

impl Outcome {
    const ALL: [Self; 7] = [
        Self::Exact,
        Self::InSet,
        Self::Beside,
        Self::Wrong,
        Self::Unexplained,
        Self::Missed,
        Self::Refused,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::InSet => "in-set",
            Self::Beside => "beside",
            Self::Wrong => "wrong",
            Self::Unexplained => "unexplained",
            Self::Missed => "missed",
            Self::Refused => "refused",
        }
    }

    fn of(truth: &str, named: &[String], status: &str) -> Self {
        let holds = |answer: &String| ids(answer).any(|id| id == truth);
        let own = named.iter().find(|answer| holds(answer));
        let is_nothing = truth == NOTHING_NAME;
        if is_refusal(status) {
            return Self::Refused;
        }
        match own {
            Some(own) if named.len() == 1 && ids(own).count() == 1 => Self::Exact,
            Some(_) if named.len() == 1 => Self::InSet,
            Some(_) => Self::Beside,
            None if status == "unexplained" && named.is_empty() => Self::Unexplained,
            None if named.is_empty() && is_nothing => Self::Exact,
            None if named.is_empty() => Self::Missed,
            None => Self::Wrong,
        }
    }
}

/// Whether a status says why there is no diagnosis.
pub fn is_refusal(status: &str) -> bool {
    Status::ALL.iter().all(|known| known.name() != status)
}

/// The members of an answer.
pub fn ids(answer: &str) -> impl Iterator<Item = &str> {
    answer.rsplit(':').next().unwrap_or_default().split('|')
}

impl Table {
    /// The lines of a file; none where there is none.
    ///
    /// # Errors
    /// A file of another kind.
    pub fn read(path: &Path) -> Result<Self, Box<dyn std::error::Error>> {
        if !path.exists() {
            return Ok(Self { lines: Vec::new() });
        }
        let text = std::fs::read_to_string(path)?;
        let mut lines = text.lines();
        if lines.next() != Some(HEAD.join(",").as_str()) {
            return Err(
                format!("{}: expected the columns {}", path.display(), HEAD.join(",")).into()
            );
        }
        let lines: Vec<Vec<String>> =
            lines.map(|line| line.split(',').map(str::to_owned).collect()).collect();
        match lines.iter().find(|line| line.len() != HEAD.len()) {
            Some(line) => {
                Err(format!("{}: {}: expected 13 cells", path.display(), line.join(",")).into())
            }
            None => Ok(Self { lines }),
        }
    }

    /// Whether there is a line of a setting.
    pub fn holds(&self, setting: &Setting) -> bool {
        let key = [setting.id(), setting.size.name(), setting.driving.name()];
        self.lines.iter().any(|line| line[..3] == key)
    }

    /// Adds a line.
    pub fn add(&mut self, setting: &Setting, case: &Case) {
        let number = |value: Option<f64>, decimals: usize| {
            value.map_or(String::new(), |value| format!("{value:.decimals$}"))
        };
        let joined = |of: &dyn Fn(&crate::case::Found) -> String| {
            case.found.iter().map(of).collect::<Vec<_>>().join("|")
        };
        let outcome = Outcome::of(setting.id(), &case.named, &case.status);
        self.lines.push(vec![
            setting.id().to_owned(),
            setting.size.name().to_owned(),
            setting.driving.name().to_owned(),
            case.truth.clone(),
            case.status.clone(),
            case.named.join(";"),
            outcome.name().to_owned(),
            number(case.support.map(|(p, _)| p), 4),
            number(case.support.map(|(_, factor)| factor), 1),
            joined(&|found| format!("{:.3}", found.ratio)),
            joined(&|found| if found.covered { "yes" } else { "no" }.to_owned()),
            number(case.explained, 3),
            format!("{:.1}", case.seconds),
        ]);
    }

    /// Truth, answers and status of every line.
    pub fn answers(&self) -> impl Iterator<Item = (&str, Vec<&str>, &str)> {
        self.lines.iter().map(|line| {
            let named = line[5].split(';').filter(|answer| !answer.is_empty());
            (line[0].as_str(), named.collect(), line[4].as_str())
        })
    }

    /// As a file.
    pub fn csv(&self) -> String {
        let lines = self.lines.iter().map(|line| line.join(","));
        let lines: Vec<String> = std::iter::once(HEAD.join(",")).chain(lines).collect();
        format!("{}\n", lines.join("\n"))
    }

    /// As a table for people, with its summary before it.
    pub fn markdown(&self) -> String {
        let mut text = format!("# Recovery of concealed effects\n\n{}\n", self.summary());
        let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        text += &row(HEAD.map(|head| head.replace('_', " ")).to_vec());
        text += &row(vec!["---".to_owned(); HEAD.len()]);
        for line in &self.lines {
            text += &row(line
                .iter()
                .map(|cell| cell.replace('|', " or ").replace(';', "; "))
                .collect());
        }
        text
    }

    /// Counts of outcomes by driving and size, coverage and time.
    pub fn summary(&self) -> String {
        let mut text = String::from("| driving | size | cases |");
        for outcome in Outcome::ALL {
            let _ = write!(text, " {} |", outcome.name());
        }
        let _ = writeln!(text, "\n|{}", "---|".repeat(3 + Outcome::ALL.len()));
        let mut groups: Vec<[&str; 2]> = Vec::new();
        for line in &self.lines {
            let group = [line[2].as_str(), line[1].as_str()];
            if !groups.contains(&group) {
                groups.push(group);
            }
        }
        for [driving, size] in groups {
            let of_group = || self.lines.iter().filter(move |l| l[2] == driving && l[1] == size);
            let _ = write!(text, "| {driving} | {size} | {} |", of_group().count());
            for outcome in Outcome::ALL {
                let count = of_group().filter(|line| line[6] == outcome.name()).count();
                let _ = write!(text, " {count} |");
            }
            text.push('\n');
        }
        let covered = || self.lines.iter().flat_map(|line| line[10].split('|'));
        let (yes, no) = (covered().filter(|c| *c == "yes"), covered().filter(|c| *c == "no"));
        let (yes, no) = (yes.count(), no.count());
        let mut seconds: Vec<f64> =
            self.lines.iter().filter_map(|line| line[12].parse().ok()).collect();
        seconds.sort_by(f64::total_cmp);
        let median = seconds.get(seconds.len() / 2).copied().unwrap_or_default();
        let longest = seconds.last().copied().unwrap_or_default();
        let _ = writeln!(
            text,
            "\n{yes} of {} intervals of 95 % hold the truth. A diagnosis takes {median:.1} s \
             (median), \
             {longest:.1} s at most.",
            yes + no
        );
        text
    }
}

//! The first scores of docs/measured.md and README.md, counted again from the published lines of
//! all cases.

use trackdyn_second_simulator::{Origin, Sheet, sheet_of};

const ENTRIES: [&str; 3] = [
    include_str!("../../../docs/trials/entry-39.csv"),
    include_str!("../../../docs/trials/entry-40.csv"),
    include_str!("../../../docs/trials/entry-41.csv"),
];
const MEASURED_PAGE: &str = include_str!("../../../docs/measured.md");
const README: &str = include_str!("../../../README.md");

/// A case and what was said of it.
#[expect(clippy::struct_excessive_bools, reason = "columns of a table")]
struct Line {
    concealed: Vec<&'static str>,
    z_det: f64,
    z_iso: f64,
    is_outside: bool,
    has_failed: bool,
    /// Named sets.
    sets: Vec<Vec<&'static str>>,
    false_claim: bool,
    absent_law: bool,
}

/// Lines of all entries; the columns are those of `trackdyn trial score`.
fn lines() -> Vec<Line> {
    let rows = ENTRIES.into_iter().flat_map(|entry| entry.lines().skip(1));
    let line = |row: &'static str| {
        let cells: Vec<&str> = row.split(',').collect();
        // of a pair none: nothing here counts them
        let figure = |cell: &str| cell.parse().unwrap_or(0.0);
        Line {
            is_outside: cells[1] == "outside",
            concealed: cells[2].split_whitespace().collect(),
            z_det: figure(cells[3]),
            z_iso: figure(cells[4]),
            has_failed: cells[6] == "failed",
            sets: cells[7].split_whitespace().map(|set| set.split('|').collect()).collect(),
            false_claim: cells[9] == "true",
            absent_law: cells[10] == "true",
        }
    };
    rows.map(line).collect()
}

fn is_constant(id: &str) -> bool {
    sheet_of(id).is_some_and(Sheet::is_constant)
}

/// Whether it is a law of forces or of the drive.
fn is_law(id: &str) -> bool {
    sheet_of(id).is_none_or(|sheet| !sheet.is_constant() && !sheet.is_instrument())
}

impl Line {
    /// The concealed effect of the catalogue, where there is one.
    fn only(&self) -> Option<&'static str> {
        let is_of_catalogue =
            |id: &str| sheet_of(id).is_some_and(|sheet| sheet.origin == Origin::Catalogue);
        match self.concealed.as_slice() {
            [only] if is_of_catalogue(only) => Some(only),
            _ => None,
        }
    }

    /// Whether it is an effect that can be told from others: constants cannot.
    fn is_split(&self) -> bool {
        self.z_det >= 5.0 && self.only().is_some_and(|truth| !is_constant(truth))
    }

    /// Whether it is named alone, and no other physics: no claim has nothing true, and one set
    /// holds it. What else is named is then an error of an instrument or of the vehicle file.
    fn is_exact(&self) -> bool {
        let Some(truth) = self.only() else { return false };
        let with: Vec<_> = self.sets.iter().filter(|set| set.contains(&truth)).collect();
        !self.false_claim && matches!(with.as_slice(), [set] if set.as_slice() == [truth])
    }

    fn is_in_set(&self) -> bool {
        self.only().is_some_and(|truth| self.sets.iter().any(|set| set.contains(&truth)))
    }

    fn names_absent_law_alone(&self) -> bool {
        let is_absent = |id: &str| is_law(id) && !self.concealed.contains(&id);
        self.sets.iter().any(|set| matches!(set.as_slice(), [id] if is_absent(id)))
    }
}

/// `successes of cases`, as pages write it.
fn rate<'a>(cases: impl Iterator<Item = &'a Line>, succeeds: impl Fn(&Line) -> bool) -> String {
    let outcomes: Vec<bool> = cases.map(succeeds).collect();
    format!("{} of {}", outcomes.iter().filter(|is| **is).count(), outcomes.len())
}

#[test]
fn published_scores_are_those_of_the_published_lines() {
    let lines = lines();
    assert_eq!(lines.len(), 622);
    let isolable = || lines.iter().filter(|line| line.is_split() && line.z_iso >= 4.0);
    let split = lines.iter().filter(|line| line.is_split());
    let answered = |outside: bool| {
        lines.iter().filter(move |line| !line.has_failed && line.is_outside == outside)
    };
    let counted = [
        ("strict", rate(isolable(), |line| line.is_exact() && !line.absent_law)),
        ("absent laws beside allowed", rate(isolable(), Line::is_exact)),
        ("wrong single name", rate(answered(false), Line::names_absent_law_alone)),
        ("laws outside", rate(answered(true), Line::names_absent_law_alone)),
        ("in the reported set", rate(split, Line::is_in_set)),
    ];
    for (what, rate) in &counted {
        let is_there = |line: &str| line.contains(what) && line.contains(rate.as_str());
        assert!(MEASURED_PAGE.lines().any(is_there), "docs/measured.md: {what}: {rate}");
        let is_said = README.contains(rate.as_str()) || *what == "absent laws beside allowed";
        assert!(is_said, "README.md: {what}: {rate}");
    }
}

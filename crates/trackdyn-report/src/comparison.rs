//! The figures and the page of a comparison, with both sets beside one another.

mod sizes;

use crate::Error;
use crate::diagnosis::cells::{Words, drawn};
use crate::figure::Figure;
use minijinja::Environment;
use minijinja::value::Serde;
use serde::Serialize;
use trackdyn_diagnose::compare::{Comparison, Status, words};
use trackdyn_diagnose::locate::cells::Cell;

const NAME: &str = "compare.html";

/// How the page looks.
const STYLE: &str = include_str!("diagnosis/report/page.css");

/// What is reported.
#[derive(Clone, Copy)]
pub struct Compared<'a> {
    /// The comparison.
    pub comparison: &'a Comparison,
    /// Name of the vehicle as filed.
    pub vehicle: &'a str,
    /// Names of the simulator's recordings and of the robot's.
    pub names: [&'a str; 2],
    /// Stands below every figure: what it was made from.
    pub caption: &'a str,
}

/// What the template is given.
#[derive(Serialize)]
struct Page<'a> {
    vehicle: &'a str,
    sim: &'a str,
    real: &'a str,
    status: &'a str,
    tone: &'a str,
    headline: &'a str,
    place: String,
    differs: Vec<Named>,
    alike: Vec<Row>,
    closer: Option<String>,
    common: Option<String>,
    instruments: Option<String>,
    not_shown: Vec<String>,
    nothing: String,
    refused: Vec<String>,
    figures: Vec<Picture<'a>>,
    sides: Vec<Side>,
    caption: &'a str,
    style: &'static str,
}

#[derive(Serialize)]
struct Named {
    sentence: String,
    settings: Vec<String>,
    support: String,
}

#[derive(Serialize)]
struct Row {
    what: String,
    numbers: String,
    why: String,
}

#[derive(Serialize)]
struct Side {
    name: &'static str,
    status: &'static str,
    place: String,
    lacks: String,
}

#[derive(Serialize)]
struct Picture<'a> {
    title: &'a str,
    reading: &'a str,
    svg: String,
}

/// Both sets in one list of cells: a cell that one of them lacks has no departure there.
fn aligned([first, second]: &[Vec<Cell>; 2]) -> [Vec<Cell>; 2] {
    let key = |cell: &Cell| (cell.manoeuvre, cell.speed, !cell.forward);
    let mut all: Vec<&Cell> = first.iter().chain(second).collect();
    all.sort_by_key(|cell| key(cell));
    all.dedup_by_key(|cell| key(cell));
    let of = |cells: &[Cell]| {
        let found = |cell: &&Cell| {
            let own = cells.iter().find(|one| key(one) == key(cell));
            let none =
                Cell { departure: [(f64::NAN, f64::NAN); 3], samples: 0, ..(**cell).clone() };
            own.cloned().unwrap_or(none)
        };
        all.iter().map(found).collect()
    };
    [of(first), of(second)]
}

/// All figures of a comparison, in the order of the page.
pub fn comparison_figures(subject: &Compared) -> Vec<Figure> {
    let cells = aligned(&subject.comparison.cells);
    let words = Words {
        title: "How the centres of rotation of both move with the way of driving",
        entries: ["SIM, against the model of both", "REAL, against the model of both"],
        names: ["SIM", "REAL"],
        caption: subject.caption,
    };
    let mut figures = vec![drawn(&cells, &words).explained(
        "Where they differ",
        "Every row is a way of driving. Marks of both sets at one place mean that they move alike, \
         even where they lie off zero: then both differ from the vehicle file alike. Marks apart \
         are a difference.",
    )];
    figures.extend(sizes::figure(subject).map(|figure| {
        figure.explained(
            "The sizes in each",
            "All that was compared, on one axis. Bars that do not overlap are a difference; zero \
             is the vehicle as filed, or no such effect.",
        )
    }));
    figures
}

/// The page as HTML with all figures inside.
///
/// The text depends on the arguments only.
///
/// # Errors
/// [`Error`] where a figure cannot be drawn or the page cannot be filled in.
pub fn comparison_html(subject: &Compared, figures: &[Figure]) -> Result<String, Error> {
    let mut environment = Environment::new();
    environment.add_template(NAME, include_str!("comparison/page.html"))?;
    Ok(environment.get_template(NAME)?.render(Serde(page(subject, figures)?))?)
}

fn page<'a>(subject: &Compared<'a>, figures: &'a [Figure]) -> Result<Page<'a>, Error> {
    let comparison = subject.comparison;
    let status = comparison.status();
    let differs = comparison.differences.iter().map(|one| Named {
        sentence: words::sentence(one),
        settings: words::settings(comparison, one),
        support: words::support(one),
    });
    let alike = comparison.alike.iter().map(|one| {
        let numbers: Vec<String> = one.group.numbers.iter().map(words::number).collect();
        Row {
            what: one.group.subject.name().to_owned(),
            numbers: numbers.join("; "),
            why: one.refused.as_ref().map_or_else(String::new, ToString::to_string),
        }
    });
    let side = |set: usize| {
        let answer = &comparison.diagnoses[set].answer;
        let lacks = answer.missing.iter().map(|missing| {
            let one_of = missing.verdict.one_of.iter().map(|effect| effect.name());
            one_of.collect::<Vec<_>>().join(" or ")
        });
        let lacks = lacks.collect::<Vec<_>>().join("; ");
        Side {
            name: ["SIM", "REAL"][set],
            status: answer.status.name(),
            place: answer.place.clone(),
            lacks: if lacks.is_empty() { "nothing is named".to_owned() } else { lacks },
        }
    };
    let figures = figures.iter().map(|figure| {
        let svg = figure.to_svg_element()?;
        Ok(Picture { title: &figure.title, reading: &figure.reading, svg })
    });
    Ok(Page {
        vehicle: subject.vehicle,
        sim: subject.names[0],
        real: subject.names[1],
        status: status.name(),
        tone: match status {
            Status::NothingDiffers | Status::Explained => "good",
            Status::Ambiguous => "mixed",
            Status::Unexplained => "bad",
        },
        headline: words::headline(comparison),
        place: comparison.place(),
        differs: differs.collect(),
        alike: alike.collect(),
        closer: words::closer(comparison),
        common: words::common(comparison),
        instruments: words::instruments(comparison),
        not_shown: words::not_shown(comparison),
        nothing: words::nothing_named(comparison),
        refused: words::refused(comparison),
        figures: figures.collect::<Result<_, Error>>()?,
        sides: vec![side(0), side(1)],
        caption: subject.caption,
        style: STYLE,
    })
}

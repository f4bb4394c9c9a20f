//! Figures of scores: shares of cases with their intervals, and what was taken for what.

mod confusion;
mod power;
mod shares;

use crate::colour::INK;
use crate::figure::{Legend, Swatch};
use crate::sheet;
use crate::text::{TICK_SIZE, fitted};

pub use confusion::{Matrix, confusion};
pub use power::{Power, power};
pub use shares::{Shares, shares};

/// A share of cases with its interval of 95 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Cases that succeed.
    pub successes: usize,
    /// Cases that count.
    pub cases: usize,
    /// Ends of the interval, 0 to 1; none without cases.
    pub interval: Option<[f64; 2]>,
}

impl Share {
    /// Share and interval; none without cases.
    fn shown(&self) -> Option<(f64, [f64; 2])> {
        let interval = self.interval.filter(|_| self.cases > 0)?;
        Some((trackdyn_core::real(self.successes) / trackdyn_core::real(self.cases), interval))
    }
}

/// A program with its shares, in the order of what they are shares of.
#[derive(Clone, Debug)]
pub struct Entrant<'a> {
    /// Name of the program.
    pub name: &'a str,
    /// Its shares; none of what it has not been asked.
    pub shares: Vec<Option<Share>>,
}

/// The programs' markers with their names, and what their bars mean.
fn legend<'a>(names: impl Iterator<Item = &'a str>) -> Legend {
    const MAX_NAME: i32 = 420;
    let names: Vec<String> = names.map(|name| fitted(name, TICK_SIZE, MAX_NAME)).collect();
    let marks = (0..).map(Swatch::entry).zip(names.iter().map(String::as_str));
    let entries = marks.chain([(Swatch::Line(INK, 3.0), "bars: 95 % intervals")]);
    Legend::of_marks([sheet::LEFT, sheet::TOP + 20], sheet::RIGHT, entries)
}

/// Place of an entry beside the others in an interval of length one.
fn beside(entry: usize, of: usize) -> f64 {
    const FILLED_SHARE: f64 = 0.6;
    let of = of.max(1);
    0.5 + FILLED_SHARE * ((trackdyn_core::real(entry) + 0.5) / trackdyn_core::real(of) - 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(successes: usize, cases: usize) -> Option<Share> {
        let interval = (cases > 0).then_some([0.2, 0.9]);
        Some(Share { successes, cases, interval })
    }

    fn entrants(count: usize, shares: usize) -> Vec<Entrant<'static>> {
        let of = |entry: usize| (0..shares).map(|k| share(k.min(entry + 3), entry + 3)).collect();
        (0..count).map(|entry| Entrant { name: "a program", shares: of(entry) }).collect()
    }

    #[test]
    fn the_same_scores_give_the_same_bytes_and_empty_ones_can_be_drawn() {
        for (programs, cells) in [(0, 0), (1, 3), (7, 3)] {
            let panel = Power {
                title: "power",
                z: "z",
                mark: (5.0, "detectable"),
                limits: &[0.0, 2.0, 5.0, f64::INFINITY],
                entrants: entrants(programs, cells),
            };
            let panels = [panel.clone(), panel.clone(), panel.clone(), panel];
            let rows: Vec<String> = (0..cells).map(|k| format!("row {k}")).collect();
            let sheet = Shares {
                title: "title",
                explanation: "explanation",
                of: "cases",
                rows: &rows,
                entrants: &entrants(programs, cells),
                wanted: Some(0.95),
            };
            let matrix = Matrix {
                rows: &rows,
                columns: &rows,
                counts: vec![vec![1; cells]; cells],
                right: vec![[0, 0]; cells.min(1)],
                remarks: "remarks",
            };
            let draw = || {
                [
                    power(&panels, "caption"),
                    shares(&sheet, "caption"),
                    confusion(&matrix, "a program", "caption"),
                ]
                .map(|figure| (figure.to_png().expect("drawn"), figure.to_svg().expect("drawn")))
            };
            assert!(draw() == draw());
        }
    }

    #[test]
    fn entries_stand_side_by_side_about_the_middle() {
        assert_eq!(beside(0, 1), 0.5);
        assert!((beside(0, 3) + beside(2, 3) - 1.0).abs() < 1e-12 && beside(0, 3) > 0.0);
    }

    #[test]
    fn a_share_of_no_cases_is_not_shown() {
        assert_eq!(Share { successes: 0, cases: 0, interval: None }.shown(), None);
        assert_eq!(share(1, 4).expect("a share").shown(), Some((0.25, [0.2, 0.9])));
    }
}

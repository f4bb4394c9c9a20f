//! What is found of each law of the catalogue.

use super::verdict::Judged;
use crate::answer::Concealed;
use crate::difficulty::Difficulty;
use trackdyn_second_simulator::sheet::Trial;
use trackdyn_second_simulator::{MECHANISMS, Origin, Sheet};

/// How often a law is found where it is there by itself: concealed and detectable, or the large
/// error of an instrument in a hard null.
#[derive(Clone, Debug, PartialEq)]
pub struct ByLaw {
    /// Its id.
    pub law: &'static str,
    /// Cases that have it.
    pub cases: usize,
    /// Those with it in a reported set.
    pub in_set: usize,
    /// Those in which it is a set of its own.
    pub alone: usize,
}

/// All laws of the catalogue, in its order.
pub(super) fn by_law(judged: &[Judged]) -> Vec<ByLaw> {
    let laws = MECHANISMS.iter().filter(|sheet| sheet.origin == Origin::Catalogue);
    laws.map(|sheet| of(sheet, judged)).collect()
}

fn of(sheet: &'static Sheet, judged: &[Judged]) -> ByLaw {
    let mut law = ByLaw { law: sheet.id, cases: 0, in_set: 0, alone: 0 };
    for case in judged.iter().filter(|case| has(case, sheet)) {
        let set = case.set_with(sheet.id);
        law.cases += 1;
        law.in_set += usize::from(set.is_some());
        law.alone += usize::from(set.is_some_and(|members| members.len() == 1));
    }
    law
}

fn has(case: &Judged, sheet: &Sheet) -> bool {
    match sheet.trial {
        Trial::Law(_) => {
            let is_it = |truth: &Concealed| truth.mechanism == sheet.id && truth.is_detectable();
            case.only().is_some_and(is_it)
        }
        Trial::Instrument(error) => {
            case.answer.difficulty == Some(Difficulty::Instruments(error.large_in))
        }
    }
}

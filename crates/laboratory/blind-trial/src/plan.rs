//! Which cases a trial has: the strata, and what is concealed in each of their cases.

use crate::difficulty::Difficulty;
use crate::dose::concealment;
use crate::forms::Forms;
use crate::key::Root;
use crate::random::{Purpose, stream};
use rand::seq::{IndexedRandom, SliceRandom};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use trackdyn_core::real;
use trackdyn_second_simulator::sheet::{Concealment, Identifiability};
use trackdyn_second_simulator::{MECHANISMS, Origin, Sheet};

/// Effects that a recording can name, each by itself.
pub(crate) fn isolable() -> impl Iterator<Item = &'static Sheet> {
    use Identifiability::{Distinct, DistinctWhenLarge};
    effects().filter_map(|(sheet, law)| {
        matches!(law.identifiability, Distinct | DistinctWhenLarge).then_some(sheet)
    })
}

/// Effects close to another one: a small size, or a far place, and the recording cannot split them.
pub(crate) fn close() -> impl Iterator<Item = &'static Sheet> {
    use Identifiability::{DistinctWhenLarge, Indistinct};
    effects().filter_map(|(sheet, law)| match law.identifiability {
        DistinctWhenLarge => Some(sheet),
        Indistinct if !sheet.is_constant() => Some(sheet),
        _ => None,
    })
}

/// The class of constants without errors of instruments: what moves the constant ICRs and nothing
/// else.
fn constants() -> impl Iterator<Item = &'static Sheet> {
    effects().filter_map(|(sheet, _)| sheet.is_constant().then_some(sheet))
}

/// Laws that no catalogue has.
fn outside(forms: Forms) -> impl Iterator<Item = &'static Sheet> {
    let laws = MECHANISMS.iter().filter(|sheet| sheet.origin == Origin::Outside);
    let is_there = move |law: &Concealment| !(law.needs_drawn_forms && forms.is_plain());
    laws.filter(move |sheet| concealment(sheet).is_some_and(is_there))
}

/// Laws of the catalogue.
fn effects() -> impl Iterator<Item = (&'static Sheet, &'static Concealment)> {
    let laws = MECHANISMS.iter().filter(|sheet| sheet.origin == Origin::Catalogue);
    laws.filter_map(|sheet| Some((sheet, concealment(sheet)?)))
}

/// What kind of case it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stratum {
    /// Nothing is concealed, and all that is known of the recording is right.
    PlainNull,
    /// Nothing is concealed, and something else is wrong.
    HardNull,
    /// One effect of the catalogue.
    Single,
    /// Two effects of the catalogue.
    Pair,
    /// One effect whose class the recording is not expected to split.
    Equivalence,
    /// One law that the catalogue does not have.
    Outside,
}

impl Stratum {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 6] = [
        Self::PlainNull,
        Self::HardNull,
        Self::Single,
        Self::Pair,
        Self::Equivalence,
        Self::Outside,
    ];

    /// Its name in files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::PlainNull => "plain-null",
            Self::HardNull => "hard-null",
            Self::Single => "single",
            Self::Pair => "pair",
            Self::Equivalence => "equivalence",
            Self::Outside => "outside",
        }
    }

    /// Whether nothing is concealed.
    pub fn is_null(self) -> bool {
        matches!(self, Self::PlainNull | Self::HardNull)
    }

    /// Share of the cases.
    fn share(self) -> f64 {
        match self {
            Self::PlainNull => 0.06,
            Self::HardNull => 0.18,
            Self::Single => 0.40,
            Self::Pair => 0.12,
            Self::Equivalence => 0.11,
            Self::Outside => 0.13,
        }
    }
}

/// A case before anything of it is drawn but its kind.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedCase {
    /// Its stratum.
    pub stratum: Stratum,
    /// What is concealed.
    pub concealed: Vec<&'static Sheet>,
    /// What is wrong, in a hard null.
    pub difficulty: Option<Difficulty>,
}

/// The cases of a trial in shuffled order; every kind comes up as often as the others of its
/// stratum.
pub fn plan(cases: usize, root: &Root, forms: Forms) -> Vec<PlannedCase> {
    let mut random = stream(root, 0, 0, Purpose::Plan);
    let mut planned = Vec::with_capacity(cases);
    for (stratum, count) in counts(cases) {
        planned.extend(stratum_cases(stratum, count, forms, &mut random));
    }
    planned.shuffle(&mut random);
    planned
}

/// How many cases each stratum has: nulls are rounded up, singles take what is left.
fn counts(cases: usize) -> Vec<(Stratum, usize)> {
    let mut counts: Vec<(Stratum, usize)> = Stratum::ALL
        .into_iter()
        .map(|stratum| {
            let wanted = stratum.share() * real(cases);
            let whole = if stratum.is_null() { wanted.ceil() } else { wanted.floor() };
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
            (stratum, whole as usize)
        })
        .collect();
    let others =
        counts.iter().filter(|(s, _)| *s != Stratum::Single).map(|(_, n)| n).sum::<usize>();
    for (stratum, count) in &mut counts {
        if *stratum == Stratum::Single {
            *count = cases.saturating_sub(others);
        }
    }
    let mut left = cases;
    for (_, count) in &mut counts {
        *count = (*count).min(left);
        left -= *count;
    }
    counts
}

fn stratum_cases(
    stratum: Stratum,
    count: usize,
    forms: Forms,
    random: &mut ChaCha8Rng,
) -> Vec<PlannedCase> {
    let case = |concealed, difficulty| PlannedCase { stratum, concealed, difficulty };
    let isolable: Vec<&'static Sheet> = isolable().collect();
    match stratum {
        Stratum::PlainNull => vec![case(Vec::new(), None); count],
        Stratum::HardNull => in_turn(&Difficulty::all(), count, random)
            .into_iter()
            .map(|difficulty| case(Vec::new(), Some(difficulty)))
            .collect(),
        Stratum::Single => single(isolable.into_iter(), count, random, case),
        Stratum::Outside => single(outside(forms), count, random, case),
        Stratum::Equivalence => {
            let half = count / 2;
            let mut cases = single(constants(), count - half, random, case);
            cases.extend(single(close(), half, random, case));
            cases
        }
        Stratum::Pair => in_turn(&isolable, count, random)
            .into_iter()
            .map(|first| {
                let second = loop {
                    let other = *isolable.choose(random).unwrap_or(&first);
                    if other != first {
                        break other;
                    }
                };
                case(vec![first, second], None)
            })
            .collect(),
    }
}

fn single(
    of: impl Iterator<Item = &'static Sheet>,
    count: usize,
    random: &mut ChaCha8Rng,
    case: impl Fn(Vec<&'static Sheet>, Option<Difficulty>) -> PlannedCase,
) -> Vec<PlannedCase> {
    let of: Vec<&'static Sheet> = of.collect();
    in_turn(&of, count, random).into_iter().map(|one| case(vec![one], None)).collect()
}

/// `count` of these, all as often but for one, in an order that is drawn.
fn in_turn<T: Copy>(of: &[T], count: usize, random: &mut ChaCha8Rng) -> Vec<T> {
    let mut drawn = Vec::with_capacity(count + of.len());
    while drawn.len() < count {
        let mut round = of.to_vec();
        round.shuffle(random);
        drawn.extend(round);
    }
    drawn.truncate(count);
    drawn
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_second_simulator::sheet::Trial;

    #[test]
    fn a_fifth_or_more_are_nulls_and_most_of_them_hard() {
        for cases in [1, 2, 7, 20, 60, 333, 1000] {
            let planned = plan(cases, &Root::of_seed(3), Forms::Drawn);
            assert_eq!(planned.len(), cases);
            let of = |wanted: &dyn Fn(Stratum) -> bool| {
                planned.iter().filter(|case| wanted(case.stratum)).count()
            };
            let nulls = of(&Stratum::is_null);
            assert!(5 * nulls >= cases, "{nulls} of {cases}");
            if cases >= 20 {
                assert!(2 * of(&|s| s == Stratum::HardNull) > nulls);
                assert!(Stratum::ALL.iter().all(|stratum| of(&|s| s == *stratum) > 0));
            }
        }
    }

    #[test]
    fn every_mechanism_has_a_place_in_trials() {
        for sheet in MECHANISMS {
            let lists = isolable().chain(close()).chain(constants()).chain(outside(Forms::Drawn));
            let is_concealed = lists.into_iter().any(|planned| planned.id == sheet.id);
            assert!(is_concealed != sheet.is_instrument(), "{}", sheet.id);
            // errors of instruments are never concealed; they are large in hard nulls
            if let Trial::Instrument(error) = sheet.trial {
                let large = Difficulty::Instruments(error.large_in);
                assert!(Difficulty::all().contains(&large), "{}", sheet.id);
            }
        }
        let [few, more] = [Forms::Plain, Forms::Drawn].map(|forms| outside(forms).count());
        assert_eq!((few, more), (10, 15), "trials of plain forms have the laws that they had");
        let counts = [isolable().count(), close().count(), constants().count()];
        assert!(counts.iter().all(|count| *count >= 7), "{counts:?}");
    }

    #[test]
    fn singles_are_of_all_kinds_and_the_order_says_nothing() {
        let plan = |seed| plan(400, &Root::of_seed(seed), Forms::Drawn);
        let planned = plan(5);
        let of_singles = |case: &&PlannedCase| case.stratum == Stratum::Single;
        let fair = planned.iter().filter(of_singles).count() / isolable().count();
        for sheet in isolable() {
            let found = |case: &&PlannedCase| of_singles(case) && case.concealed == [sheet];
            let count = planned.iter().filter(found).count();
            assert!(count.abs_diff(fair) <= 2, "{}: {count} of {fair}", sheet.id);
        }
        let nulls = |half: &[PlannedCase]| half.iter().filter(|c| c.stratum.is_null()).count();
        // 96 nulls fall into halves as 48 ± 4.3
        assert!(nulls(&planned[..200]).abs_diff(nulls(&planned[200..])) < 30);
        assert_ne!(planned, plan(6));
        assert_eq!(planned, plan(5));
    }
}

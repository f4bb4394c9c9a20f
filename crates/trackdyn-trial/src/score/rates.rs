//! Rates: of how many cases how many succeed.

use super::coverage;
use super::interval::clopper_pearson;
use super::verdict::Judged;
use crate::answer::Concealed;
use crate::diagnosis::Status;
use crate::plan::{Difficulty, Stratum};

/// A share of cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Rate {
    /// What is counted.
    pub name: String,
    /// Cases of which it is true.
    pub successes: usize,
    /// Cases that count.
    pub cases: usize,
}

impl Rate {
    /// A rate over cases that are told to succeed or not.
    pub(super) fn of(name: impl Into<String>, outcomes: impl IntoIterator<Item = bool>) -> Self {
        let mut rate = Self { name: name.into(), successes: 0, cases: 0 };
        for success in outcomes {
            rate.cases += 1;
            rate.successes += usize::from(success);
        }
        rate
    }

    /// The share; none without cases.
    pub fn share(&self) -> Option<f64> {
        (self.cases > 0).then(|| crate::real(self.successes) / crate::real(self.cases))
    }

    /// Its interval of 95 %.
    pub fn interval(&self) -> Option<[f64; 2]> {
        clopper_pearson(self.successes, self.cases)
    }
}

/// All rates of a trial. A process that failed has found nothing; it does not count where false claims
/// are counted.
pub fn rates(judged: &[Judged]) -> Vec<Rate> {
    let mut rates = nulls(judged);
    rates.extend(singles(judged));
    rates.extend(pairs(judged));
    rates.push(Rate::of(
        "95 % interval holds the true size",
        coverage::outcomes(judged).into_iter().map(|(_, holds)| holds),
    ));
    rates.extend(outside(judged));
    let failed = judged.iter().map(|case| case.diagnosis().is_none());
    rates.push(Rate::of("process failed", failed));
    rates
}

fn nulls(judged: &[Judged]) -> Vec<Rate> {
    let rate = |name: String, wanted: &dyn Fn(&Judged) -> bool| {
        let answered = judged.iter().filter(|case| case.diagnosis().is_some());
        let cases = answered.filter(|case| case.answer.stratum.is_null() && wanted(case));
        Rate::of(name, cases.map(Judged::claims_falsely))
    };
    let mut rates = vec![
        rate("false claim: nulls".to_owned(), &|_| true),
        rate("false claim: plain nulls".to_owned(), &|case| case.is_of(&[Stratum::PlainNull])),
        rate("false claim: hard nulls".to_owned(), &|case| case.is_of(&[Stratum::HardNull])),
    ];
    for difficulty in Difficulty::ALL {
        let name = format!("false claim: hard nulls, {}", difficulty.name());
        rates.push(rate(name, &|case| case.answer.difficulty == Some(difficulty)));
    }
    rates.retain(|rate| rate.cases > 0);
    rates
}

fn singles(judged: &[Judged]) -> Vec<Rate> {
    let one: Vec<(&Judged, &Concealed)> =
        judged.iter().filter_map(|case| Some((case, case.only()?))).collect();
    let of = |name: &str,
              counts: &dyn Fn(&Concealed) -> bool,
              succeeds: &dyn Fn(&Judged, &Concealed) -> bool| {
        let cases = one.iter().filter(|(_, truth)| counts(truth));
        Rate::of(name, cases.map(|(case, truth)| succeeds(case, truth)))
    };
    let in_set = |case: &Judged, truth: &Concealed| case.set_with(&truth.mechanism).is_some();
    vec![
        of("exact isolation: isolable singles", &Concealed::is_isolable, &|case, truth| {
            case.names_exactly(&[&truth.mechanism])
        }),
        of("truth in the reported set: detectable singles", &Concealed::is_detectable, &in_set),
        of(
            "over-claim: one effect named where none is isolable",
            &|t| !t.is_isolable(),
            &|case, _| case.names_one_alone(),
        ),
        of("false claim: singles", &|_| true, &|case, _| case.claims_falsely()),
    ]
}

fn pairs(judged: &[Judged]) -> Vec<Rate> {
    let pairs: Vec<&Judged> = judged.iter().filter(|case| case.is_of(&[Stratum::Pair])).collect();
    let both = |of: fn(&Concealed) -> bool| {
        pairs.iter().copied().filter(move |case| case.answer.concealed.iter().all(of))
    };
    let names = |case: &Judged| {
        let ids: Vec<&str> = case.answer.concealed.iter().map(|c| c.mechanism.as_str()).collect();
        case.names_exactly(&ids)
    };
    let sets = |case: &Judged| {
        case.answer.concealed.iter().all(|truth| case.set_with(&truth.mechanism).is_some())
    };
    vec![
        Rate::of("both named: isolable pairs", both(Concealed::is_isolable).map(names)),
        Rate::of(
            "both in the reported sets: detectable pairs",
            both(Concealed::is_detectable).map(sets),
        ),
    ]
}

fn outside(judged: &[Judged]) -> Vec<Rate> {
    let detectable: Vec<(&Judged, &Concealed)> = judged
        .iter()
        .filter(|case| case.is_of(&[Stratum::Outside]))
        .filter_map(|case| Some((case, case.answer.concealed.first()?)))
        .filter(|(_, truth)| truth.is_detectable())
        .collect();
    let broken = |case: &Judged| {
        let mut letters = case.diagnosis().map_or(Vec::new(), |d| d.located.broken.clone());
        letters.sort_unstable();
        letters
    };
    let isolable = detectable.iter().filter(|(_, truth)| truth.is_isolable());
    let flagged = isolable.map(|(case, _)| {
        case.diagnosis().is_some_and(|diagnosis| diagnosis.status == Status::Unexplained)
    });
    let names_alone = detectable.iter().map(|(case, _)| case.names_one_alone());
    let within = detectable.iter().map(|(case, truth)| {
        let found = broken(case);
        !found.is_empty() && found.iter().all(|letter| truth.breaks.contains(letter))
    });
    let equal = detectable.iter().map(|(case, truth)| {
        let mut own = truth.breaks.clone();
        own.sort_unstable();
        broken(case) == own
    });
    vec![
        Rate::of("outside the catalogue, unlike any effect of it: flagged as unexplained", flagged),
        Rate::of("outside the catalogue: one effect named all the same", names_alone),
        Rate::of("outside the catalogue: broken symmetries are its own", within),
        Rate::of("outside the catalogue: broken symmetries are all of its own", equal),
    ]
}

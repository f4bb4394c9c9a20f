//! Rates: of how many cases how many succeed.

use super::coverage;
use super::rate::Rate;
use super::verdict::Judged;
use crate::answer::Concealed;
use crate::diagnosis::Status;
use crate::difficulty::Difficulty;
use crate::plan::Stratum;

/// All rates of a trial, strict ones first. A process that failed has found nothing; it does not
/// count where false claims and wrong names are counted.
pub fn rates(judged: &[Judged]) -> Vec<Rate> {
    let mut rates = singles(judged);
    rates.extend(wrong_names(judged));
    rates.extend(nulls(judged));
    rates.extend(pairs(judged));
    rates.push(Rate::of(
        "95 % interval holds the true size",
        coverage::outcomes(judged).into_iter().map(|(_, holds)| holds),
    ));
    rates.extend(outside(judged));
    rates.extend(beside(judged));
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
    for difficulty in Difficulty::all() {
        let name = format!("false claim: hard nulls, {}", difficulty.name());
        rates.push(rate(name, &|case| case.answer.difficulty == Some(difficulty)));
    }
    rates.retain(|rate| rate.cases > 0);
    rates
}

/// What rates of right and wrong names pass by.
fn beside(judged: &[Judged]) -> Vec<Rate> {
    let of = |name: &str, counts: &dyn Fn(&Judged) -> bool, is: &dyn Fn(&Judged) -> bool| {
        let answered = judged.iter().filter(|case| case.diagnosis().is_some() && counts(case));
        Rate::of(name, answered.map(is))
    };
    let is_null = |case: &Judged| case.answer.stratum.is_null();
    let is_single = |case: &Judged| case.only().is_some();
    let is_pair = |case: &Judged| case.is_of(&[Stratum::Pair]);
    let is_outside = |case: &Judged| case.is_of(&[Stratum::Outside]);
    let of_catalogue = |case: &Judged| !is_null(case) && !is_outside(case);
    let unexplained = |case: &Judged| case.says(Status::Unexplained);
    let nothing = |case: &Judged| case.says(Status::NothingMissing);
    vec![
        of("false claim: singles", &is_single, &Judged::claims_falsely),
        of("false claim: pairs", &is_pair, &Judged::claims_falsely),
        of("false claim: outside the catalogue", &is_outside, &Judged::claims_falsely),
        of(
            "an absent law is named, be it in a set with what is true: nulls",
            &is_null,
            &Judged::names_absent_law,
        ),
        of("nothing missing: nulls", &is_null, &nothing),
        of("flagged as unexplained: nulls", &is_null, &unexplained),
        of("flagged as unexplained: effects of the catalogue", &of_catalogue, &unexplained),
    ]
}

/// Singles: what is found. Members of the class of constants are one answer of eight, right
/// whichever of them it is: they say nothing of what is told apart.
fn singles(judged: &[Judged]) -> Vec<Rate> {
    let of = |name: &str,
              counts: &dyn Fn(&Concealed) -> bool,
              succeeds: &dyn Fn(&Judged, &Concealed) -> bool| {
        let one = judged.iter().filter_map(|case| Some((case, case.only()?)));
        let cases = one.filter(|(_, truth)| counts(truth));
        Rate::of(name, cases.map(|(case, truth)| succeeds(case, truth)))
    };
    let is_split = |truth: &Concealed| truth.is_detectable() && !truth.is_constant();
    let is_constant = |truth: &Concealed| truth.is_detectable() && truth.is_constant();
    let in_set = |case: &Judged, truth: &Concealed| case.set_with(&truth.mechanism).is_some();
    vec![
        of(
            "strict isolation, named alone and no absent law in any set: isolable singles",
            &Concealed::is_isolable,
            &|case, truth| case.names_strictly(&truth.mechanism),
        ),
        of(
            "exact isolation, absent laws beside what is true allowed: isolable singles",
            &Concealed::is_isolable,
            &|case, truth| case.names_exactly(&[&truth.mechanism]),
        ),
        of("truth in the reported set: detectable singles but constants", &is_split, &in_set),
        of("truth in the reported set: detectable constants", &is_constant, &in_set),
    ]
}

/// An answer of one law that is not there: what costs an owner most.
fn wrong_names(judged: &[Judged]) -> Vec<Rate> {
    let of = |name: &str, counts: &dyn Fn(&Judged) -> bool| {
        let answered = judged.iter().filter(|case| case.diagnosis().is_some() && counts(case));
        Rate::of(name, answered.map(Judged::names_absent_law_alone))
    };
    let is_outside = |case: &Judged| case.is_of(&[Stratum::Outside]);
    vec![
        of("wrong single name, an absent law alone: cases of the catalogue", &|case| {
            !is_outside(case)
        }),
        of("wrong single name, an absent law alone: outside the catalogue", &is_outside),
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
    let broken = |case: &Judged| case.diagnosis().map_or(Vec::new(), |d| d.located.broken.clone());
    let flagged = |name: &str, counts: fn(&Concealed) -> bool| {
        let cases = detectable.iter().filter(|(_, truth)| counts(truth));
        Rate::of(name, cases.map(|(case, _)| case.says(Status::Unexplained)))
    };
    let answered = detectable.iter().filter(|(case, _)| case.diagnosis().is_some());
    let names_alone = answered.map(|(case, _)| case.names_one_alone());
    // Beside its own are those that known errors break: a late clock shows as a lag does.
    let is_right = |case: &Judged| {
        let (found, truly) = (broken(case), case.truly_broken());
        found.iter().all(|letter| truly.contains(letter))
    };
    let within = detectable.iter().map(|(case, truth)| {
        is_right(case) && broken(case).iter().any(|letter| truth.breaks.contains(letter))
    });
    let equal = detectable.iter().map(|(case, truth)| {
        is_right(case) && truth.breaks.iter().all(|letter| broken(case).contains(letter))
    });
    vec![
        flagged(
            "outside the catalogue, unlike any effect of it: flagged as unexplained",
            Concealed::is_isolable,
        ),
        flagged(
            "outside the catalogue, unlike any three effects: flagged as unexplained",
            Concealed::is_beyond_others,
        ),
        Rate::of("outside the catalogue: one effect named all the same", names_alone),
        Rate::of("outside the catalogue: broken symmetries are its own or of known errors", within),
        Rate::of("outside the catalogue: broken symmetries are its own, all of them", equal),
    ]
}

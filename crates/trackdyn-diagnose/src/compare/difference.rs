//! Verdicts on differences: the rules of a claim, asked of what one set has more than the other.

use super::bayes::Alternatives;
use super::choice::{Claimed, claimed};
use super::constants::{Member, members};
use super::in_common::{Sets, in_common, more};
use super::quantity::{Estimate, Group, Quantity, Subject};
use crate::diagnosis::Examination;
use crate::normal::Normal;
use crate::resampling::Resampling;
use crate::significance::{Group as Scores, test_family};
use crate::verdict::{Refusal, Support};
use trackdyn_model::EffectId;

/// Which set has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// The first alone.
    First,
    /// The second alone.
    Second,
    /// Both, in different sizes.
    Both,
}

/// Why a difference is not claimed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoDifference {
    /// One of the general rules.
    Rule(Refusal),
    /// The 95 % intervals of all its differences include zero.
    MayBeNone,
    /// Less than the share of its own size to which laws are known.
    WithinForm {
        /// Largest difference, as share of the size.
        share: f64,
        /// Least share needed.
        needed: f64,
    },
    /// With it, the first set's model predicts the second set no better.
    NotCloser {
        /// Error without it, in units of the noise.
        without: f64,
        /// Error with it.
        with: f64,
    },
}

impl std::fmt::Display for NoDifference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Rule(rule) => rule.fmt(f),
            Self::MayBeNone => f.write_str("the 95 % interval of the difference holds zero"),
            Self::WithinForm { share, needed } => write!(
                f,
                "the sizes differ by {:.0} %, less than the {:.0} % to which the form of a law is \
                 known",
                100.0 * share,
                100.0 * needed
            ),
            Self::NotCloser { without, with } => write!(
                f,
                "with it SIM predicts REAL no better: error {with:.2} times the noise, \
                 {without:.2} without"
            ),
        }
    }
}

/// A group with what speaks for a difference.
#[derive(Clone, Debug)]
pub struct Difference {
    /// The numbers, with their sizes in each set.
    pub group: Group,
    /// Which set has it.
    pub which: Which,
    /// Effects of which each explains it, ascending; empty for friction level and centre of gravity
    /// by inertia.
    pub one_of: Vec<EffectId>,
    /// Where it stands for constants: what each member would have to be.
    pub members: Vec<Member>,
    /// ln evidence of what the sets may have of it.
    pub alternatives: Alternatives,
    /// Statistical support of the difference.
    pub support: Support,
    /// Why it is not claimed; none where it is.
    pub refused: Option<NoDifference>,
}

/// Judges all groups: as one family, each beside the differences of all others.
pub(super) fn judge(both: Sets, resampling: Resampling) -> Vec<Difference> {
    let Sets { sets, choice, groups, .. } = both;
    let joint = in_common(both).joint;
    let equations = joint.equations(more(&joint, both));
    let all: Vec<usize> = equations.groups.concat();
    let whole = equations.fit_with(&all);
    let settings = sets[0].search.settings();
    let projected = equations.projected();
    // each group beside the differences of all others
    let beside = |own: &Vec<usize>| {
        let others: Vec<usize> =
            all.iter().copied().filter(|column| !own.contains(column)).collect();
        let normal = projected.projected(&others, &equations.priors);
        (others, normal)
    };
    let beside: Vec<(Vec<usize>, Normal)> = equations.groups.iter().map(beside).collect();
    let scores: Vec<Scores> = beside
        .iter()
        .zip(&equations.groups)
        .map(|((_, normal), own)| Scores::new(normal, own, &settings.location))
        .collect();
    let tests = test_family(&scores, resampling);
    let departure: f64 = sets
        .iter()
        .zip(&choice.fits)
        .map(|(set, fit)| (set.search.base.fit.objective - fit.fit.objective).max(0.0))
        .sum();
    let claims = sets.map(claimed);
    let judged = groups.iter().cloned().zip(&equations.groups).zip(beside).zip(tests);
    judged
        .map(|(((group, own), (others, normal)), test)| {
            let alternatives = alternatives(&group);
            let without = equations.fit_with(&others);
            let ln_bayes_factor = match group.subject {
                // what blurs the ICRs of a set is the same in both
                Subject::Constants => whole.ln_evidence - without.ln_evidence,
                _ => alternatives.for_difference(),
            };
            let support = Support {
                p: test.p,
                ln_bayes_factor,
                stable: 1.0,
                z: (without.misfit - whole.misfit).max(0.0).sqrt(),
                ..Support::of_blocks(&normal, &equations.priors, own)
            };
            let refused = refusal(&group, &support, departure.sqrt(), sets);
            let members = match group.subject {
                Subject::Constants => members(sets, &group),
                _ => Vec::new(),
            };
            let one_of = one_of(&group, &claims, &members);
            let which = which(&group, &alternatives);
            Difference { group, which, one_of, members, alternatives, support, refused }
        })
        .collect()
}

/// ln evidence of what the sets may have, summed over the numbers of a group.
fn alternatives(group: &Group) -> Alternatives {
    let of = |quantity: &Quantity| {
        let each = quantity.each.map(|one| [one.value, one.deviation().powi(2)]);
        Alternatives::of(each, &quantity.prior)
    };
    group.numbers.iter().map(of).fold(Alternatives::default(), Alternatives::plus)
}

/// Which set has it, by the evidence. An interval would not do: one in twenty excludes zero where
/// there is no effect.
fn which(group: &Group, alternatives: &Alternatives) -> Which {
    if !matches!(group.subject, Subject::Effect(_)) {
        return Which::Both;
    }
    let Alternatives { first, second, different, .. } = *alternatives;
    if first.max(second) < different {
        Which::Both
    } else if second >= first {
        Which::Second
    } else {
        Which::First
    }
}

/// The rules of a claim.
fn refusal(
    group: &Group,
    support: &Support,
    departure: f64,
    sets: [&Examination; 2],
) -> Option<NoDifference> {
    let settings = sets[0].search.settings();
    let rules = &settings.verdict;
    if let Some(rule) = support.falls_short(rules) {
        return Some(NoDifference::Rule(rule));
    }
    if group.numbers.iter().all(|one| one.difference.holds(0.0)) {
        return Some(NoDifference::MayBeNone);
    }
    let largest = |of: &dyn Fn(&Quantity) -> f64| group.numbers.iter().map(of).fold(0.0, f64::max);
    match group.subject {
        Subject::Constants => {
            let gauge = sets[0].search.base.as_filed.hypothesis.vehicle.gauge;
            let moved = |n: usize| group.numbers.get(n).map_or(0.0, |one| one.difference.value);
            // x_l and x_r are a ∓ h
            let largest = (moved(0).abs() + moved(1).abs()).max(moved(2).abs());
            let needed = rules.min_icr_difference;
            (largest < needed * gauge)
                .then_some(NoDifference::Rule(Refusal::ConstantsAsFiled { largest, needed }))
        }
        Subject::Effect(_) => {
            let needed = rules.max_form_error;
            let share = largest(&|one: &Quantity| {
                let away = |k: usize| (one.each[k].value - one.prior.mean).abs();
                one.difference.value.abs() / away(0).max(away(1)).max(f64::MIN_POSITIVE)
            });
            if share < needed {
                return Some(NoDifference::WithinForm { share, needed });
            }
            let (z, needed) = (support.z, needed * departure);
            (z < needed).then_some(NoDifference::Rule(Refusal::WithinForm { z, needed }))
        }
        Subject::FrictionLevel | Subject::CentreOfGravity => {
            let needed = settings.limits.min_level_change;
            let sure = group.numbers.iter().any(|one| {
                let Estimate { value, low, high } = one.difference;
                value.abs() > needed * (high - low) / 2.0
            });
            (!sure).then_some(NoDifference::MayBeNone)
        }
    }
}

/// Effects of which each explains a difference: the class of the set that has it, or what is common
/// to the classes of both.
fn one_of(group: &Group, claims: &[Vec<Claimed>; 2], members: &[Member]) -> Vec<EffectId> {
    match group.subject {
        Subject::Constants => members.iter().map(|member| member.effect).collect(),
        Subject::FrictionLevel | Subject::CentreOfGravity => Vec::new(),
        Subject::Effect(effect) => {
            let class = |k: usize| {
                let mut own = claims[k].iter();
                own.find(|claim| claim.one_of.contains(&effect)).map(|claim| claim.one_of.clone())
            };
            match (class(0), class(1)) {
                (Some(first), Some(second)) => {
                    first.into_iter().filter(|member| second.contains(member)).collect()
                }
                (Some(class), None) | (None, Some(class)) => class,
                (None, None) => vec![effect],
            }
        }
    }
}

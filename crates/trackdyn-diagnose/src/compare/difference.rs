//! Verdicts on differences: the rules of a claim, asked of what one set has more than the other.

use super::bayes::Alternatives;
use super::choice::{Choice, Claimed, claimed, sizes};
use super::constants::{Member, members};
use super::joint::Joint;
use super::quantity::{Estimate, Gradients, Group, Number, Quantity, Subject};
use crate::base::OFFSETS;
use crate::diagnosis::Examination;
use crate::equations::{Column, at_right_angles};
use crate::fit::Fit;
use crate::hypothesis::Unknown;
use crate::normal::{Normal, Prior};
use crate::prior::{prior, priors};
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
    /// The 95 % intervals of all its differences hold zero.
    MayBeNone,
    /// A share of its own size: laws are known no better.
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

/// Both fits in terms of their constant ICRs.
#[derive(Clone, Copy)]
pub(super) struct Fits<'a> {
    /// The fits.
    pub fits: [&'a Fit; 2],
    /// By how much each unknown moves the constant ICRs.
    pub moved: Option<&'a [Gradients; 2]>,
}

impl Fits<'_> {
    /// Column of an unknown of a set, whitened, at constant ICRs that stay where they are.
    ///
    /// # Law
    /// ∂p/∂θ at these ICRs is ∂p/∂θ − Σ ∂p/∂n ∂n/∂θ, n their middle, half distance and y.
    fn column(&self, set: usize, place: usize) -> Column {
        let fit = self.fits[set];
        let mut column = fit.columns[place].clone();
        let is_offset = OFFSETS.contains(&fit.unknowns[place]);
        let Some(moved) = self.moved.filter(|_| !is_offset) else { return column };
        for (n, by) in moved[set][place].into_iter().enumerate().filter(|(_, by)| *by != 0.0) {
            let Some(of_icr) = columns(fit, Number::Icr(n)) else { continue };
            for (value, change) in column.iter_mut().zip(&of_icr) {
                *value -= change * by;
            }
        }
        column
    }

    /// Column of a number of a set, whitened.
    pub fn of(&self, set: usize, number: Number) -> Option<Column> {
        match number {
            Number::Unknown(unknown) => {
                let place = self.fits[set].unknowns.iter().position(|one| *one == unknown)?;
                Some(self.column(set, place))
            }
            Number::Level => {
                // ∂p/∂λ = −Σ k ∂p/∂k
                let fit = self.fits[set];
                let strengths = fit.unknowns.iter().enumerate();
                let strengths = strengths.filter(|(_, unknown)| number.moves(**unknown));
                strengths.fold(None, |sum: Option<Column>, (place, &unknown)| {
                    let strength = fit.hypothesis.get(unknown);
                    let own = self.column(set, place).into_iter().map(|value| value * -strength);
                    Some(match sum {
                        Some(sum) => sum.into_iter().zip(own).map(|(sum, own)| sum + own).collect(),
                        None => own.collect(),
                    })
                })
            }
            Number::Icr(_) => columns(self.fits[set], number),
        }
    }
}

/// Column of a number in a fit, whitened.
fn columns<'a>(fit: &'a Fit, number: Number) -> Option<Column> {
    let of = |unknown: Unknown| {
        let place = fit.unknowns.iter().position(|one| *one == unknown)?;
        Some(&fit.columns[place])
    };
    match number {
        Number::Unknown(unknown) => of(unknown).cloned(),
        Number::Level => None,
        Number::Icr(n) => {
            let [left, right, y]: [Option<&'a Column>; 3] = OFFSETS.map(of);
            let sum = |sign: f64| -> Option<Column> {
                let both = left?.iter().zip(right?);
                Some(both.map(|(left, right)| right + left * sign).collect())
            };
            match n {
                0 => sum(1.0),
                1 => sum(-1.0),
                _ => y.cloned(),
            }
        }
    }
}

/// Unknowns that a group takes out of those of each set by itself.
fn taken(groups: &[Group]) -> Vec<Unknown> {
    let mut taken = Vec::new();
    for group in groups {
        for quantity in &group.numbers {
            match quantity.number {
                Number::Unknown(unknown) => taken.push(unknown),
                Number::Level => taken.extend(group.effects.iter().copied().flat_map(sizes)),
                Number::Icr(_) => taken.extend(OFFSETS),
            }
        }
    }
    taken
}

/// Both sets with all groups in common, and where their numbers stand among the columns.
pub(super) struct InCommon<'a> {
    /// The sets; differences are columns to be added.
    pub joint: Joint<'a>,
    /// Columns of what is free in a set by itself: the set, the place among the unknowns of its
    /// fit, and the index.
    pub own: Vec<(usize, usize, usize)>,
    /// Columns of numbers that act as constant ICRs, which these are compared for: the place among
    /// the unknowns of each fit, the value that both have, and the index.
    pub constants: Vec<([usize; 2], f64, usize)>,
    /// Columns of the compared numbers, in the order of the groups; none where a fit has none.
    pub shared: Vec<Option<usize>>,
}

/// Unknowns of both fits that act as constant ICRs and are not compared: what differs in them shows
/// in the ICRs, and one cause must not stand for two differences.
fn as_constants(sets: [&Examination; 2], choice: &Choice) -> Vec<Unknown> {
    let [first, second] = [0, 1].map(|k| &choice.fits[k].fit);
    let is_one = |unknown: &&Unknown| match **unknown {
        Unknown::Effect(effect, _) => {
            let acts = sets.iter().any(|set| set.constants.class().contains(&effect));
            acts && !choice.compared.contains(&effect) && second.unknowns.contains(unknown)
        }
        Unknown::Offset(_) | Unknown::FrictionLevel | Unknown::Cog(_) => false,
    };
    first.unknowns.iter().filter(is_one).copied().collect()
}

/// Both sets with all groups in common.
pub(super) fn in_common<'a>(
    sets: [&'a Examination; 2],
    choice: &'a Choice,
    groups: &[Group],
    moved: Option<&[Gradients; 2]>,
) -> InCommon<'a> {
    let fits = [&choice.fits[0].fit, &choice.fits[1].fit];
    let in_icrs = Fits { fits, moved };
    let evidence = sets.map(|set| &set.search.evidence);
    let mut joint = Joint::new(evidence, fits.map(|fit| &fit.residual[..]));
    let (mut own, mut constants) = (Vec::new(), Vec::new());
    let as_constants = as_constants(sets, choice);
    let taken = [taken(groups), as_constants.clone()].concat();
    for (k, fit) in fits.into_iter().enumerate() {
        let known = priors(&fit.hypothesis, &fit.unknowns, evidence[k]);
        for (place, (unknown, prior)) in fit.unknowns.iter().zip(known).enumerate() {
            if !taken.contains(unknown) {
                own.push((k, place, joint.free_in(k, &in_icrs.column(k, place), prior)));
            }
        }
        // other sizes, or other ICRs, must not pass for another form
        let numbers = groups.iter().flat_map(|group| &group.numbers);
        let compared = numbers.filter_map(|of| in_icrs.of(k, of.number));
        let compared = compared.fold(Vec::new(), |mut before: Vec<Column>, column| {
            before.push(before.iter().fold(column, at_right_angles));
            before
        });
        let forms = &choice.fits[k].forms;
        for (column, prior) in forms.columns.iter().zip(&forms.priors) {
            let form = compared.iter().fold(column.clone(), at_right_angles);
            joint.free_in(k, &form, *prior);
        }
    }
    for unknown in as_constants {
        let place = |k: usize| fits[k].unknowns.iter().position(|one| *one == unknown);
        let (Some(first), Some(second)) = (place(0), place(1)) else { continue };
        let places = [first, second];
        let values = fits.map(|fit| fit.hypothesis.get(unknown));
        let weight = |k: usize| fits[k].solution.covariance[(places[k], places[k])].recip();
        let [a, b] = [weight(0), weight(1)];
        let common = (a * values[0] + b * values[1]) / (a + b);
        let columns = [0, 1].map(|k| in_icrs.column(k, places[k]));
        for (k, column) in columns.iter().enumerate() {
            joint.add_back(k, column, values[k] - common);
        }
        let known = prior(&fits[0].hypothesis, unknown, evidence[0]);
        let known = Prior { mean: known.mean - common, ..known };
        let column = joint.free_in_both([&columns[0], &columns[1]], known);
        constants.push((places, common, column));
    }
    let mut share = |quantity: &Quantity| {
        let [first, second] = [in_icrs.of(0, quantity.number)?, in_icrs.of(1, quantity.number)?];
        let common = quantity.common();
        let factors = quantity.each.map(|one| one.value - common);
        joint.add_back(0, &first, factors[0]);
        joint.add_back(1, &second, factors[1]);
        Some(joint.free_in_both([&first, &second], prior_of_difference(quantity)))
    };
    let shared = groups.iter().flat_map(|group| &group.numbers).map(&mut share).collect();
    InCommon { joint, own, constants, shared }
}

/// Both sets with all groups in common; differences are columns to be added.
pub(super) fn joint<'a>(
    sets: [&'a Examination; 2],
    choice: &'a Choice,
    groups: &[Group],
    moved: Option<&[Gradients; 2]>,
) -> Joint<'a> {
    in_common(sets, choice, groups, moved).joint
}

/// Columns of what the second set has more, a group each.
fn more(joint: &Joint, fits: Fits, groups: &[Group]) -> Vec<Vec<(Column, Prior)>> {
    let of = |quantity: &Quantity| {
        let column = joint.alone(1, &fits.of(1, quantity.number)?);
        Some((column, prior_of_difference(quantity)))
    };
    groups.iter().map(|group| group.numbers.iter().filter_map(of).collect()).collect()
}

/// Two independent numbers with this prior differ by √2 of its deviation.
pub(super) fn prior_of_difference(quantity: &Quantity) -> Prior {
    Prior::normal(0.0, 2.0_f64.sqrt() * quantity.prior.deviation)
}

/// Both sets with all groups in common but some of them, which are free in each.
pub(super) fn joint_beside<'a, 'b>(
    sets: [&'a Examination; 2],
    choice: &'a Choice,
    groups: &[Group],
    moved: Option<&[Gradients; 2]>,
    free: impl Iterator<Item = &'b Group>,
) -> Joint<'a> {
    let mut joint = joint(sets, choice, groups, moved);
    let fits = Fits { fits: [&choice.fits[0].fit, &choice.fits[1].fit], moved };
    for quantity in free.flat_map(|group| &group.numbers) {
        if let Some(column) = fits.of(1, quantity.number) {
            joint.free_in(1, &column, prior_of_difference(quantity));
        }
    }
    joint
}

/// Judges all groups: as one family, each beside the differences of all others.
pub(super) fn judge(
    sets: [&Examination; 2],
    choice: &Choice,
    groups: Vec<Group>,
    moved: Option<&[Gradients; 2]>,
    resampling: Resampling,
) -> Vec<Difference> {
    let joint = joint(sets, choice, &groups, moved);
    let fits = Fits { fits: [&choice.fits[0].fit, &choice.fits[1].fit], moved };
    let equations = joint.equations(more(&joint, fits, &groups));
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
    let judged = groups.into_iter().zip(&equations.groups).zip(beside).zip(tests);
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

/// Which set has it, by the evidence: an interval misses none in one case of twenty.
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

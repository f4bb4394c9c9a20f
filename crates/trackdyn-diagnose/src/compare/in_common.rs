//! Both sets in one set of normal equations, with what they have in common.

use super::choice::{Choice, is_constant, sizes};
use super::joint::Joint;
use super::quantity::{Gradients, Group, Number, Quantity};
use crate::base::OFFSETS;
use crate::diagnosis::Examination;
use crate::equations::{Column, at_right_angles};
use crate::fit::Fit;
use crate::hypothesis::Unknown;
use crate::mechanics::is_instrument;
use crate::normal::Prior;
use crate::prior::{prior, priors};

/// Two sets with the numbers that are compared.
#[derive(Clone, Copy)]
pub(super) struct Sets<'a> {
    /// The sets.
    pub sets: [&'a Examination; 2],
    /// The effects that either has, with the fit of each set.
    pub choice: &'a Choice,
    /// What is compared.
    pub groups: &'a [Group],
    /// By how much the unknowns of each fit move its constant ICRs.
    pub moved: Option<&'a [Gradients; 2]>,
}

impl<'a> Sets<'a> {
    /// Both fits.
    pub fn fits(&self) -> Fits<'a> {
        let [first, second] = &self.choice.fits;
        Fits { fits: [&first.fit, &second.fit], moved: self.moved }
    }

    /// All compared numbers.
    pub fn numbers(&self) -> impl Iterator<Item = &'a Quantity> + use<'a> {
        self.groups.iter().flat_map(|group| &group.numbers)
    }
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
            let acts = is_constant(sets, effect);
            let is_own = first
                .hypothesis
                .effect(effect)
                .is_some_and(|active| is_instrument(&first.hypothesis.vehicle, active));
            let is_compared = choice.compared.contains(&effect);
            acts && !is_own && !is_compared && second.unknowns.contains(unknown)
        }
        Unknown::Offset(_) | Unknown::FrictionLevel | Unknown::Cog(_) => false,
    };
    first.unknowns.iter().filter(is_one).copied().collect()
}

/// Both sets with all groups in common.
pub(super) fn in_common(both: Sets) -> InCommon {
    let Sets { sets, choice, groups, .. } = both;
    let in_icrs = both.fits();
    let fits = in_icrs.fits;
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
        let compared = both.numbers().filter_map(|of| in_icrs.of(k, of.number));
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
        let mean = (a * values[0] + b * values[1]) / (a + b);
        let common = if mean.is_finite() { mean } else { values[0] };
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
    let shared = both.numbers().map(&mut share).collect();
    InCommon { joint, own, constants, shared }
}

impl InCommon<'_> {
    /// Frees a number of the second set from that of the first; the index of its column, none where
    /// the fit has none.
    pub fn free(&mut self, fits: Fits, quantity: &Quantity) -> Option<usize> {
        let column = fits.of(1, quantity.number)?;
        Some(self.joint.free_in(1, &column, prior_of_difference(quantity)))
    }
}

/// Both sets with all groups in common but some of them, which are free in each.
pub(super) fn joint_beside<'a, 'b>(
    both: Sets<'a>,
    free: impl Iterator<Item = &'b Group>,
) -> Joint<'a> {
    let mut common = in_common(both);
    for quantity in free.flat_map(|group| &group.numbers) {
        common.free(both.fits(), quantity);
    }
    common.joint
}

/// Columns of what the second set has more, a group each.
pub(super) fn more(joint: &Joint, both: Sets) -> Vec<Vec<(Column, Prior)>> {
    let of = |quantity: &Quantity| {
        let column = joint.alone(1, &both.fits().of(1, quantity.number)?);
        Some((column, prior_of_difference(quantity)))
    };
    both.groups.iter().map(|group| group.numbers.iter().filter_map(of).collect()).collect()
}

/// Two independent numbers with this prior differ by √2 of its deviation.
fn prior_of_difference(quantity: &Quantity) -> Prior {
    Prior::normal(0.0, 2.0_f64.sqrt() * quantity.prior.deviation)
}

//! The model of both sets in which nothing differs but what is claimed.
//!
//! What a simulator and a robot have in common is estimated from the recordings of both. With each
//! set's own estimates, an error that correlates with a claimed number would make the claim seem to
//! predict worse.

use super::in_common::{InCommon, Sets, in_common};
use super::quantity::{Group, Number, Quantity, Subject};
use crate::fit::{Fit, at_bound};
use crate::hypothesis::{Hypothesis, Unknown};

/// The second set's model. All its numbers but these are estimated from both sets.
pub(super) struct Shared {
    /// With these numbers as in the first set.
    pub as_first: Hypothesis,
    /// With them as in the second set.
    pub as_second: Hypothesis,
}

impl Sets<'_> {
    /// The second set's model, where nothing differs but these.
    ///
    /// # Law
    /// The normal equations of both sets, with a second factor for each claimed number in the
    /// second set; the model is moved by their solution.
    pub fn model(&self, claimed: &[Subject]) -> Shared {
        let fits = self.fits();
        let mut common = in_common(*self);
        let is_claimed = |group: &Group| claimed.contains(&group.subject);
        let groups = self.groups.iter();
        let numbers: Vec<(&Quantity, bool)> = groups
            .flat_map(|group| group.numbers.iter().map(move |one| (one, is_claimed(group))))
            .collect();
        let free = |(quantity, is_claimed): &(&Quantity, bool)| {
            if *is_claimed { common.free(fits, quantity) } else { None }
        };
        let more: Vec<Option<usize>> = numbers.iter().map(free).collect();
        let InCommon { joint, own, constants, shared } = common;
        let fit = fits.fits[1];
        // An unknown at a bound that its step would cross is held there.
        let crosses = |column: usize, by: f64| {
            own.iter().any(|&(set, place, own)| {
                let Fit { hypothesis, unknowns, .. } = fits.fits[set];
                own == column && at_bound(hypothesis, unknowns[place], by)
            })
        };
        let factors = joint.factors(crosses);
        let factor = |column: Option<usize>| column.map_or(0.0, |column| factors[column]);
        let mut second = Moved::new(&fit.hypothesis);
        let gradient = |place: usize| self.moved.map_or([0.0; 3], |moved| moved[1][place]);
        for &(_, place, column) in own.iter().filter(|(set, ..)| *set == 1) {
            second.by(fit.unknowns[place], factors[column], gradient(place));
        }
        for (places, common, column) in constants {
            let unknown = fit.unknowns[places[1]];
            let by = common + factors[column] - fit.hypothesis.get(unknown);
            second.by(unknown, by, gradient(places[1]));
        }
        let places = |number: Number| {
            let places = 0..fit.unknowns.len();
            places.filter(move |&place| number.moves(fit.unknowns[place]))
        };
        let shift = |moved: &mut Moved, number: Number, by: f64| match number {
            Number::Icr(n) => moved.icrs[n] += by,
            Number::Unknown(unknown) => {
                for place in places(number) {
                    moved.by(unknown, by, gradient(place));
                }
            }
            Number::Level => {
                for place in places(number) {
                    // k = e^(−λ)
                    let strength = moved.hypothesis.get(fit.unknowns[place]);
                    let change = strength * ((-by).exp() - 1.0);
                    moved.by(fit.unknowns[place], change, gradient(place));
                }
            }
        };
        for ((quantity, _), column) in numbers.iter().zip(&shared).filter(|(_, one)| one.is_some())
        {
            let now = quantity.common() + factor(*column);
            shift(&mut second, quantity.number, now - quantity.each[1].value);
        }
        let first = second.clone();
        for ((quantity, _), column) in numbers.iter().zip(more) {
            shift(&mut second, quantity.number, factor(column));
        }
        Shared { as_first: first.finished(), as_second: second.finished() }
    }
}

/// A hypothesis on its way, with the change of its constant ICRs.
#[derive(Clone)]
struct Moved {
    hypothesis: Hypothesis,
    /// Change of the middle, the half distance and y, m.
    icrs: [f64; 3],
}

impl Moved {
    fn new(hypothesis: &Hypothesis) -> Self {
        Self { hypothesis: hypothesis.clone(), icrs: [0.0; 3] }
    }

    /// Moves an unknown and keeps the constant ICRs where they are: by itself it would move them by
    /// `gradient`.
    fn by(&mut self, unknown: Unknown, change: f64, gradient: [f64; 3]) {
        let before = self.hypothesis.get(unknown);
        self.hypothesis = self.hypothesis.with(unknown, before + change);
        if matches!(unknown, Unknown::Offset(_)) {
            return;
        }
        let change = self.hypothesis.get(unknown) - before;
        for (icr, by) in self.icrs.iter_mut().zip(gradient) {
            *icr -= by * change;
        }
    }

    /// The hypothesis with its constant ICRs where they belong.
    fn finished(self) -> Hypothesis {
        let [middle, half, y] = self.icrs;
        let [left, right, along] = self.hypothesis.offset;
        let offset = [left + middle - half, right + middle + half, along + y];
        Hypothesis { offset, ..self.hypothesis }
    }
}

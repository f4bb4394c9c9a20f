//! What differs between two sets of recordings of nominally the same robot: a simulator's and the
//! robot's.
//!
//! Each set is diagnosed against the same vehicle file, with its own noise, clock, instruments and
//! constants. All effects that either has are then fitted to both. A claim is about the difference
//! of their sizes: what both sets have in common is no difference, even if the file lacks it.

mod bayes;
mod choice;
mod closer;
mod constants;
mod difference;
pub mod document;
mod in_common;
mod joint;
mod level;
mod quantity;
mod remainder;
mod shared;
pub mod words;

pub use bayes::Alternatives;
pub use closer::Closer;
pub use constants::Member;
pub use difference::{Difference, NoDifference, Which};
pub use quantity::{Estimate, Group, Number, Quantity, Subject};
pub use remainder::Remainder;

use crate::diagnosis::{Diagnosis, Examination};
use crate::locate::cells::Cell;
use crate::progress::{Cancelled, Stage, Watch};
use crate::resampling::Resampling;
use crate::uncertainty::Uncertainty;
use choice::Choice;
use in_common::Sets;
use shared::Shared;
use std::collections::{BTreeMap, BTreeSet};
use trackdyn_model::effect::Symmetry;
use trackdyn_model::{ActiveEffect, EffectId, VehicleFile};

/// Stages of a comparison, after the diagnoses of both sets.
pub const STAGES: usize = 4;

/// What a comparison says in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Nothing differs that these recordings could have shown.
    NothingDiffers,
    /// What differs is named.
    Explained,
    /// Something differs, and more than one effect explains it.
    Ambiguous,
    /// They differ in a way that nothing named explains; what was named stays named.
    Unexplained,
}

impl Status {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::NothingDiffers => "nothing-differs",
            Self::Explained => "explained",
            Self::Ambiguous => "ambiguous",
            Self::Unexplained => "unexplained",
        }
    }
}

/// Smallest difference of a size that both sets together would have shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smallest {
    /// The effect.
    pub effect: EffectId,
    /// Index of the size among its parameters.
    pub parameter: usize,
    /// The difference, in the parameter's unit; none where one set can show no physical size.
    pub size: Option<f64>,
}

/// What differs between two sets of recordings.
pub struct Comparison {
    /// The diagnosis of each set.
    pub diagnoses: [Diagnosis; 2],
    /// Effects that either set has.
    pub effects: Vec<EffectId>,
    /// Effects of the vehicle file.
    pub filed: Vec<EffectId>,
    /// What differs.
    pub differences: Vec<Difference>,
    /// What was compared and is not claimed to differ.
    pub alike: Vec<Difference>,
    /// Effects of one set that the other (0 or 1) cannot show.
    pub not_shown: Vec<(EffectId, usize)>,
    /// Encoders and pose sensor in each set: instruments, not physics.
    pub instruments: Vec<Group>,
    /// Where they differ beside constant ICRs, whatever the reason: with all sizes in common.
    pub before: Remainder,
    /// Where they differ beside what is named: with all other numbers in common.
    pub beside_named: Remainder,
    /// Where they differ in a way that no size explains.
    pub after: Remainder,
    /// ICRs by cells of driving in each set, against what both have in common.
    pub cells: [Vec<Cell>; 2],
    /// How much closer the first set's model comes to the second set.
    pub closer: Closer,
    /// Smallest differences that would have shown.
    pub smallest: Vec<Smallest>,
}

/// Compares two examined sets of recordings: the first is the simulator's.
///
/// # Errors
/// [`Cancelled`], by the observer of the watch.
pub fn compare(
    both: [&Examination; 2],
    file: &VehicleFile,
    resampling: Resampling,
    watch: &Watch,
) -> Result<Comparison, Cancelled> {
    let choice = watch.try_stage(Stage::Differences, || Choice::best(both, watch))?;
    let uncertainties = [0, 1].map(|k| Uncertainty::of(&both[k].search, &choice.fits[k]));
    let (groups, moved) = watch.stage(Stage::Differences, || {
        let (groups, moved) = quantity::groups(both, &choice, &uncertainties);
        (level::with_level(groups, both, &choice), moved)
    })?;
    let compared = Sets { sets: both, choice: &choice, groups: &groups, moved: moved.as_ref() };
    let (judged, shared) = watch.stage(Stage::Differences, || {
        closer::judge(compared, difference::judge(compared, resampling))
    })?;
    watch.stage(Stage::Differences, || {
        let instruments = quantity::instruments(both, &choice, &uncertainties);
        concluded(compared, (judged, &shared), instruments, file, resampling)
    })
}

/// The comparison, from its judged groups.
fn concluded(
    compared: Sets,
    (judged, shared): (Vec<Difference>, &Shared),
    instruments: Vec<Group>,
    file: &VehicleFile,
    resampling: Resampling,
) -> Comparison {
    let Sets { sets: both, choice, groups, .. } = compared;
    let (differences, alike): (Vec<_>, Vec<_>) =
        judged.into_iter().partition(|one| one.refused.is_none());
    let icrs = remainder::icrs(both, choice);
    let beside = |is_free: &dyn Fn(Subject) -> bool| {
        let free = groups.iter().filter(|group| is_free(group.subject));
        in_common::joint_beside(compared, free)
    };
    let is_named = |subject: Subject| differences.iter().any(|one| one.group.subject == subject);
    let is_constants = |subject: Subject| subject == Subject::Constants;
    let beside_named = beside(&is_named);
    // constants of slow driving are exact: the form of laws is that of all other differences
    let of_laws = remainder::misfit(&beside(&|one| is_constants(one) && is_named(one)))
        - remainder::misfit(&beside_named);
    let of =
        |joint, explained| remainder::remainder(both, choice, joint, &icrs, explained, resampling);
    let before = of(beside(&is_constants), 0.0);
    let beside_named = of(beside_named, of_laws.max(0.0));
    let after = of(remainder::apart(both, choice), 0.0);
    let left = in_common::in_common(compared).joint.left();
    let cells = remainder::cells(both, &icrs, &left);
    let closer = Closer::of(compared, shared, file);
    let not_shown = choice.effects.iter().flat_map(|&effect| {
        let lacking = [0, 1].into_iter();
        let lacking = lacking.filter(|&k| !choice.fits[k].effects.contains(&effect));
        lacking.map(|k| (effect, k)).collect::<Vec<_>>()
    });
    let not_shown = not_shown.collect();
    let diagnoses = both.map(|set| set.diagnosis.clone());
    let constants = groups.iter().find(|group| is_constants(group.subject));
    let by_icrs = constants.map_or(Vec::new(), |group| constants::smallest(both, group));
    let smallest = smallest(&diagnoses, &by_icrs);
    Comparison {
        smallest,
        effects: choice.effects.clone(),
        filed: file.effects.iter().map(ActiveEffect::effect).collect(),
        diagnoses,
        differences,
        alike,
        not_shown,
        instruments,
        before,
        beside_named,
        after,
        cells,
        closer,
    }
}

/// Smallest difference of each size that would have shown: the variances of both sets add. An
/// effect that acts as constant ICRs shows in a comparison by those ICRs. A diagnosis shows it only
/// by what it does beside them.
fn smallest(diagnoses: &[Diagnosis; 2], by_icrs: &[Smallest]) -> Vec<Smallest> {
    let of = |diagnosis: &Diagnosis| -> BTreeMap<(EffectId, usize), Option<f64>> {
        let detectable = diagnosis.limits.detectable.iter();
        detectable.map(|one| ((one.effect, one.parameter), one.size)).collect()
    };
    let [first, second] = [0, 1].map(|k| of(&diagnoses[k]));
    let both = first.into_iter().filter_map(|(key, a)| Some((key, a, *second.get(&key)?)));
    both.map(|((effect, parameter), a, b)| {
        let is_same = |one: &&Smallest| (one.effect, one.parameter) == (effect, parameter);
        let apart = Smallest { effect, parameter, size: a.zip(b).map(|(a, b)| a.hypot(b)) };
        *by_icrs.iter().find(is_same).unwrap_or(&apart)
    })
    .collect()
}

impl Comparison {
    /// What it says in a word.
    pub fn status(&self) -> Status {
        if !self.left().is_empty() || self.is_closer_apart() {
            Status::Unexplained
        } else if self.differences.iter().any(|one| one.one_of.len() > 1) {
            Status::Ambiguous
        } else if self.differences.is_empty() {
            Status::NothingDiffers
        } else {
            Status::Explained
        }
    }

    /// Whether the second set's own model explains its runs better than the first set's model with
    /// the named differences, by more than [`Self::closer_tolerated`].
    pub fn is_closer_apart(&self) -> bool {
        self.closer.left > self.closer_tolerated()
    }

    /// Largest excess of twice the log-likelihood by which the second set's own model may explain
    /// its runs better. The form of the laws, what both sets have in common, and the noise explain
    /// as much.
    pub fn closer_tolerated(&self) -> f64 {
        self.beside_named.tolerated
    }

    /// Whether the second set's own model is better although no symmetry differs: the comparison
    /// cannot say where.
    pub fn is_not_told_apart(&self) -> bool {
        self.is_closer_apart() && self.left().is_empty()
    }

    /// Effects that both sets have alike and the vehicle file lacks.
    pub fn common(&self) -> impl Iterator<Item = EffectId> {
        let filed = &self.filed;
        let of_level = |one: &&Difference| one.group.subject == Subject::FrictionLevel;
        let both = self.differences.iter().filter(of_level).chain(&self.alike);
        let effects = both.flat_map(|one| {
            // strengths that show a level are there
            let has = |k: usize| {
                one.group.subject == Subject::FrictionLevel
                    || one.group.numbers.iter().any(|of| !of.each[k].holds(of.prior.mean))
            };
            one.group.effects.iter().copied().filter(move |_| has(0) && has(1))
        });
        effects.filter(|effect| !filed.contains(effect))
    }

    /// Symmetries in which the sets differ beside constant ICRs, ascending.
    pub fn broken(&self) -> Vec<Symmetry> {
        both_of(self.before.broken(), self.left())
    }

    /// Symmetries in which they surely differ beside what is named, ascending.
    pub fn left(&self) -> Vec<Symmetry> {
        both_of(self.beside_named.surely_broken(), self.after.surely_broken())
    }

    /// One sentence on where they differ: the driving, and what the difference depends on.
    pub fn place(&self) -> String {
        let broken = self.broken();
        if self.differences.is_empty() && broken.is_empty() && !self.is_closer_apart() {
            return "nowhere: one model with the instruments of each explains both".to_owned();
        }
        let are_constants = !self.differences.is_empty()
            && self.differences.iter().all(|one| !matches!(one.group.subject, Subject::Effect(_)));
        let on = if broken.is_empty() {
            are_constants.then(|| "it is the same in all driving".to_owned())
        } else {
            let on: Vec<&str> = broken.into_iter().map(words::depends_on).collect();
            Some(format!("it depends on {}", on.join(", ")))
        };
        self.largest().into_iter().chain(on).collect::<Vec<_>>().join("; ")
    }

    /// The cell of driving whose ICRs differ most surely, in words.
    fn largest(&self) -> Option<String> {
        let [first, second] = &self.cells;
        let mut best: Option<(f64, String)> = None;
        for cell in first {
            let is_same = |other: &&Cell| {
                (other.manoeuvre, other.speed, other.forward)
                    == (cell.manoeuvre, cell.speed, cell.forward)
            };
            let Some(other) = second.iter().find(is_same) else { continue };
            for ((a, s), (b, t)) in cell.departure.into_iter().zip(other.departure) {
                let z = (b - a).abs() / s.hypot(t);
                if best.as_ref().is_none_or(|(most, _)| z > *most) && z.is_finite() {
                    let way = cell.way();
                    let words = format!(
                        "the ICRs differ most surely in {} {way} at {:.2} m/s, by {:.0} mm",
                        cell.manoeuvre.name(),
                        cell.mean_speed,
                        1e3 * (b - a).abs()
                    );
                    best = Some((z, words));
                }
            }
        }
        best.map(|(_, words)| words)
    }
}

/// All symmetries of two lists, ascending.
fn both_of(first: Vec<Symmetry>, second: Vec<Symmetry>) -> Vec<Symmetry> {
    let all: BTreeSet<Symmetry> = first.into_iter().chain(second).collect();
    all.into_iter().collect()
}

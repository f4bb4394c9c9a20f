//! What could be found: how strongly an effect shows, and how far it is from the next other effect.

use crate::alternatives::{Alternative, alternatives};
use crate::dose::{Dose, Scene};
use crate::driving::Drive;
use crate::ground::Ground;
use crate::signature::Bench;
use crate::subspace::Subspace;
use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use trackdyn_core::real;
use trackdyn_drive::Sensors;
use trackdyn_estimate::Observations;

/// z from which on an effect can be detected.
pub const DETECTABLE: f64 = 5.0;
/// z from which on an effect can be told from every other one.
pub const DISTINCT: f64 = 4.0;
/// Alternatives that may together stand for an effect, as many as a diagnosis names laws.
const TOGETHER: usize = 3;
/// Smallest z at which sizes are found: above what the phases of shoes make of any change, one or two. Only strengths of
/// smaller sizes are taken in proportion: between z = 10 and 40 laws of the slip speed are anything but linear, and sheared
/// soil changes the sign of what it shows.
const CLEAR: f64 = 5.0;
/// Logarithm of the ratio of two strengths that count as one: what is stated is the z that the size leaves, not what was wanted.
const CLOSE_ENOUGH: f64 = 0.15;
/// Logarithm of the ratio of z to the wanted one from which on a size that few runs gave is looked for on all of them.
const FAR_OFF: f64 = 0.5;
/// Sizes that are tried on few runs.
const SEARCHES: usize = 5;
/// Powers of the strength with which z is taken to go.
const POWERS: [f64; 2] = [0.5, 3.0];
/// Smallest z per unit of strength by which a size can be set.
const VISIBLE: f64 = 0.5;
/// Runs on which sizes are searched for and effects are told from each other, where they show there.
const FEW_RUNS: usize = 4;
/// Part of what a few runs show of an effect that is alike in all of them, below which all runs are looked at: the others
/// pass its place.
const MISSED: f64 = 0.5;

/// The runs and sensors by which effects are judged.
pub(crate) struct Judge<'a> {
    pub(crate) bench: &'a Bench,
    pub(crate) ground: &'a Ground<'a>,
    pub(crate) runs: &'a [Drive],
    pub(crate) sensors: &'a Sensors,
}

/// An effect at its size, with what it leaves in the recording.
#[derive(Clone, Debug)]
pub(crate) struct Sized {
    pub(crate) dose: Dose,
    pub(crate) strength: f64,
    pub(crate) signature: Vec<f64>,
}

/// How an effect stands among the others.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Standing {
    /// Length of the signature outside the nuisances.
    pub(crate) z_det: f64,
    /// Length outside the nuisances and the alternative that comes closest.
    pub(crate) z_iso: f64,
    /// Length outside the nuisances and the three alternatives that take most of it, one after the other.
    pub(crate) z_beyond: f64,
    /// The alternative that comes closest.
    pub(crate) nearest: &'static str,
    /// All alternatives that leave less than [`DISTINCT`].
    pub(crate) class: Vec<&'static str>,
}

impl Judge<'_> {
    /// An effect of a strength.
    pub(crate) fn at(&self, dose: Dose, strength: f64) -> Result<Sized, String> {
        let signature = self.signature(&dose, strength, self.runs)?;
        Ok(Sized { dose, strength, signature })
    }

    /// An effect at about the wanted z, with what it really leaves; at its smallest or largest strength where that shows
    /// more or less; or at `otherwise` where it does not show at all.
    pub(crate) fn sized(&self, dose: Dose, wanted: f64, otherwise: f64) -> Result<Sized, String> {
        let few = FEW_RUNS.min(self.runs.len());
        let clear = wanted.max(CLEAR);
        let off = |sized: &Sized| (self.z(&sized.signature) / clear).ln().abs();
        let mut best: Option<Sized> = None;
        // a place may lie off the ways of the first runs, or be grazed by them and crossed by the others
        for runs in [few, self.runs.len()] {
            if best.as_ref().is_some_and(|best| off(best) < FAR_OFF) {
                break;
            }
            let Some(strength) = self.strength(&dose, clear, &self.runs[..runs])? else { continue };
            let sized = self.at(dose.clone(), strength)?;
            if best.as_ref().is_none_or(|best| off(&sized) < off(best)) {
                best = Some(sized);
            }
        }
        let Some(sized) = best else {
            let strength = otherwise.min(dose.largest());
            return self.at(dose, strength);
        };
        let shown = self.z(&sized.signature);
        if shown < VISIBLE {
            return Err(format!("{} shows nothing at the size for z = {clear:.1}", dose.id()));
        }
        if wanted >= CLEAR {
            return Ok(sized);
        }
        let share = wanted / shown;
        let least = dose.smallest() / sized.strength;
        self.at(dose, sized.strength * share.max(least).min(1.0))
    }

    /// The strength at which an effect shows with about this z, by what some runs show of it; none where it does not show.
    fn strength(&self, dose: &Dose, clear: f64, runs: &[Drive]) -> Result<Option<f64>, String> {
        let more_runs = (real(self.runs.len()) / real(runs.len())).sqrt();
        let z = |strength: f64| -> Result<f64, String> {
            Ok(more_runs * self.z(&self.signature(dose, strength, runs)?))
        };
        let mut strength = dose.largest().min(1.0);
        let mut shown = z(strength)?;
        if shown < VISIBLE * strength {
            return Ok(None);
        }
        let (mut power, mut bracket) = (1.0, [0.0, dose.largest()]);
        for _ in 0..SEARCHES {
            bracket[usize::from(shown > clear)] = strength;
            let [low, high] = bracket;
            let next = strength * (clear / shown).powf(1.0 / power);
            // a law that sets in at once is met by halves
            let next =
                if low > 0.0 && !(low..high).contains(&next) { (low * high).sqrt() } else { next };
            let next = next.clamp(dose.smallest(), dose.largest());
            if (next / strength).ln().abs() < CLOSE_ENOUGH {
                break;
            }
            // a size beyond what the robot can do is met half-way
            let (there, found) = match z(next) {
                Ok(found) => (next, found),
                Err(_) => ((strength * next).sqrt(), z((strength * next).sqrt())?),
            };
            power = ((found / shown).ln() / (there / strength).ln()).clamp(POWERS[0], POWERS[1]);
            (strength, shown) = (there, found);
        }
        Ok(Some(strength))
    }

    /// How effects stand, each with those beside it that are concealed too taken for known.
    pub(crate) fn standings(
        &self,
        concealed: &[Sized],
        known: &[&str],
        scene: Scene,
        random: &mut ChaCha8Rng,
    ) -> Result<Vec<Standing>, String> {
        let ids: Vec<&str> = concealed.iter().map(|sized| sized.dose.id()).collect();
        let excluded: Vec<&str> = known.iter().chain(&ids).copied().collect();
        let others = alternatives(&excluded, scene, random);
        let shapes_in = |still: &Still| -> Result<Vec<Vec<f64>>, String> {
            concealed.iter().map(|sized| still.column(&sized.dose, sized.strength)).collect()
        };
        let mut still = self.still(FEW_RUNS)?;
        let mut shapes = shapes_in(&still)?;
        let part = (real(still.runs.len()) / real(self.runs.len())).sqrt();
        let is_missed = |(sized, shape): (&Sized, &Vec<f64>)| {
            self.z(shape) < MISSED * part * self.z(&sized.signature)
        };
        if concealed.iter().zip(&shapes).any(is_missed) {
            still = self.still(self.runs.len())?;
            shapes = shapes_in(&still)?;
        }
        let columns = still.columns(&others)?;
        let rows = shapes.iter().chain(columns.iter().flatten()).map(Vec::len).min();
        let rows = rows.unwrap_or_default();
        let signatures: Vec<&[f64]> = concealed.iter().map(|one| &one.signature[..]).collect();
        let shapes: Vec<&[f64]> = shapes.iter().map(|shape| &shape[..rows]).collect();
        let standings = concealed.iter().enumerate().map(|(index, sized)| {
            let taken = |rows: usize, all: &[&[f64]]| {
                let beside = all.iter().enumerate().filter(|(other, _)| *other != index);
                self.taken(rows, &beside.map(|(_, other)| *other).collect::<Vec<_>>())
            };
            let z_det = taken(self.bench.rows(), &signatures).outside(&sized.signature);
            // what is compared was driven alike: without inertia, in the same runs
            let (space, part) = (taken(rows, &shapes), shapes[index]);
            let whole = space.outside(part);
            let scaled = |left: f64| if whole > 0.0 { z_det * left / whole } else { 0.0 };
            let left: Vec<_> = others
                .iter()
                .zip(&columns)
                .map(|(other, columns)| (other.id, scaled(space.with(columns).outside(part))))
                .collect();
            let z_beyond = scaled(beyond(space, part, &others, &columns));
            standing(z_det, z_beyond, &left)
        });
        Ok(standings.collect())
    }

    /// What nuisances and further signatures span in the first rows.
    fn taken(&self, rows: usize, beside: &[&[f64]]) -> Subspace {
        let mut space = self.bench.nuisances(rows);
        for column in beside {
            space.add(column[..rows].to_vec());
        }
        space
    }

    fn signature(&self, dose: &Dose, strength: f64, runs: &[Drive]) -> Result<Vec<f64>, String> {
        let ground = self.ground.and(dose.at(strength));
        self.bench.signature(&ground.observe(runs, self.sensors)?)
    }

    /// Length of a signature outside the nuisances.
    fn z(&self, signature: &[f64]) -> f64 {
        self.bench.nuisances(signature.len()).outside(signature)
    }

    /// So many first runs of the robot without the inertia that its owner knows.
    fn still(&self, runs: usize) -> Result<Still<'_>, String> {
        let runs = &self.runs[..runs.min(self.runs.len())];
        let ground = Ground { active: Vec::new(), ..*self.ground };
        let without = ground.observe(runs, self.sensors)?;
        let residuals = self.bench.residuals(&without)?;
        Ok(Still { bench: self.bench, ground, runs, sensors: self.sensors, without, residuals })
    }
}

/// Some of the first runs without inertia: signatures there are cheap, and shaped as those with it.
struct Still<'a> {
    bench: &'a Bench,
    ground: Ground<'a>,
    runs: &'a [Drive],
    sensors: &'a Sensors,
    without: Observations,
    residuals: Vec<Vector3<f64>>,
}

impl Still<'_> {
    fn column(&self, dose: &Dose, strength: f64) -> Result<Vec<f64>, String> {
        let with = self.ground.and(dose.at(strength)).observe(self.runs, self.sensors)?;
        self.bench.difference(&with, &self.without, &self.residuals)
    }

    fn columns(&self, others: &[Alternative]) -> Result<Vec<Vec<Vec<f64>>>, String> {
        let column = |(dose, strength): &(Dose, f64)| self.column(dose, *strength);
        let all = others.par_iter().map(|alternative| {
            alternative.members.par_iter().map(column).collect::<Result<Vec<_>, String>>()
        });
        all.collect()
    }
}

/// What the alternatives that take most of a signature leave of it, one after the other, each effect once.
fn beyond(
    mut space: Subspace,
    signature: &[f64],
    others: &[Alternative],
    columns: &[Vec<Vec<f64>>],
) -> f64 {
    let mut taken: Vec<&str> = Vec::new();
    for _ in 0..TOGETHER {
        let free = others.iter().zip(columns).filter(|(other, _)| !taken.contains(&other.id));
        let with = free.map(|(other, columns)| {
            let space = space.with(columns);
            (space.outside(signature), other.id, space)
        });
        let Some((_, id, next)) = with.min_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        taken.push(id);
        space = next;
    }
    space.outside(signature)
}

fn standing(z_det: f64, z_beyond: f64, left: &[(&'static str, f64)]) -> Standing {
    let nearest = left.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1));
    let (nearest, z_iso) = nearest.unwrap_or(("", z_det));
    let mut class: Vec<_> = left.iter().filter(|(_, z)| *z < DISTINCT).map(|(id, _)| *id).collect();
    class.sort_unstable();
    class.dedup();
    Standing { z_det, z_iso, z_beyond, nearest, class }
}

#[cfg(test)]
mod tests;

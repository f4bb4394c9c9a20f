//! What could be found: how strongly an effect shows, and how far it is from the next other effect.

use crate::alternatives::{Alternative, alternatives};
use crate::dose::{Dose, Scene};
use crate::driving::Drive;
use crate::failure::Failure;
use crate::forms::Forms;
use crate::ground::Ground;
use crate::signature::Bench;
use crate::subspace::Subspace;
use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use trackdyn_core::real;
use trackdyn_drive::Sensors;
use trackdyn_estimate::Observations;

/// Smallest z of an effect that can be detected.
pub const MIN_DETECTABLE_Z: f64 = 5.0;
/// Smallest z that an effect leaves beside every other one where it can be told from all of them.
pub const MIN_DISTINCT_Z: f64 = 4.0;
/// Largest number of alternatives that together stand for an effect: as many laws as a diagnosis
/// names.
const MAX_ALTERNATIVES: usize = 3;
/// Smallest z for which a size is searched: above one or two, which the phases of shoes make of any
/// change. Strengths of smaller sizes are taken in proportion. Larger ones cannot be: between z =
/// 10 and 40 laws of the slip speed are not linear, and sheared soil changes the sign of its trace.
const MIN_SEARCHED_Z: f64 = 5.0;
/// Logarithm of the ratio of two strengths that count as one. What is stated is the z that the size
/// leaves, not the one that was wanted.
const STRENGTH_TOLERANCE: f64 = 0.15;
/// Logarithm of the ratio of z to the wanted one above which a size that was found on few runs is
/// searched for on all of them.
const MAX_Z_ERROR: f64 = 0.5;
/// Largest number of sizes that are tried on few runs.
const MAX_SEARCHES: usize = 5;
/// Limits of the power of the strength that z is taken to grow with.
const POWER_LIMITS: [f64; 2] = [0.5, 3.0];
/// Smallest z per unit of strength by which a size can be set.
const MIN_Z_PER_STRENGTH: f64 = 0.5;
/// Number of runs on which sizes are searched for and effects are told from each other, where they
/// show there.
const FEW_RUNS: usize = 4;
/// Share of an effect's z, were it alike in all runs, that few runs have to show. Below it all runs
/// are used: the others pass its place.
const MIN_SHARE_IN_FEW_RUNS: f64 = 0.5;

/// The runs and sensors by which effects are judged.
pub(crate) struct Judge<'a> {
    pub(crate) bench: &'a Bench,
    pub(crate) ground: &'a Ground<'a>,
    pub(crate) runs: &'a [Drive],
    pub(crate) sensors: &'a Sensors,
    /// Which forms alternatives may have.
    pub(crate) forms: Forms,
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
    /// Length outside the nuisances and the three alternatives that take most of it, one after the
    /// other.
    pub(crate) z_beyond: f64,
    /// The alternative that comes closest.
    pub(crate) nearest: &'static str,
    /// All alternatives that leave less than [`MIN_DISTINCT_Z`].
    pub(crate) class: Vec<&'static str>,
}

impl Judge<'_> {
    /// An effect of a strength.
    pub(crate) fn at(&self, dose: Dose, strength: f64) -> Result<Sized, Failure> {
        let signature = self.signature(&dose, strength, self.runs)?;
        Ok(Sized { dose, strength, signature })
    }

    /// An effect at about the wanted z, with what it really leaves; at its smallest or largest
    /// strength where that shows more or less; or at `otherwise` where it does not show at all.
    pub(crate) fn sized(&self, dose: Dose, wanted: f64, otherwise: f64) -> Result<Sized, Failure> {
        let few = FEW_RUNS.min(self.runs.len());
        let clear = wanted.max(MIN_SEARCHED_Z);
        let off = |sized: &Sized| (self.z(&sized.signature) / clear).ln().abs();
        let mut best: Option<Sized> = None;
        // a place may lie off the ways of the first runs, or be grazed by them and crossed by the
        // others
        for runs in [few, self.runs.len()] {
            if best.as_ref().is_some_and(|best| off(best) < MAX_Z_ERROR) {
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
        if shown < MIN_Z_PER_STRENGTH {
            return Err(Failure::Invisible { mechanism: dose.sheet().id, wanted: clear });
        }
        if wanted >= MIN_SEARCHED_Z {
            return Ok(sized);
        }
        let share = wanted / shown;
        let least = dose.smallest() / sized.strength;
        self.at(dose, sized.strength * share.max(least).min(1.0))
    }

    /// The strength at which an effect shows with about this z, by what some runs show of it; none
    /// where it does not show.
    fn strength(&self, dose: &Dose, clear: f64, runs: &[Drive]) -> Result<Option<f64>, Failure> {
        let more_runs = (real(self.runs.len()) / real(runs.len())).sqrt();
        let z = |strength: f64| -> Result<f64, Failure> {
            Ok(more_runs * self.z(&self.signature(dose, strength, runs)?))
        };
        let mut strength = dose.largest().min(1.0);
        let mut shown = z(strength)?;
        if shown < MIN_Z_PER_STRENGTH * strength {
            return Ok(None);
        }
        let (mut power, mut bracket) = (1.0, [0.0, dose.largest()]);
        for _ in 0..MAX_SEARCHES {
            bracket[usize::from(shown > clear)] = strength;
            let [low, high] = bracket;
            let next = strength * (clear / shown).powf(1.0 / power);
            // a law that sets in at once is met by halves
            let next =
                if low > 0.0 && !(low..high).contains(&next) { (low * high).sqrt() } else { next };
            let next = next.clamp(dose.smallest(), dose.largest());
            if (next / strength).ln().abs() < STRENGTH_TOLERANCE {
                break;
            }
            // a size beyond what the robot can do is met half-way
            let (there, found) = match z(next) {
                Ok(found) => (next, found),
                Err(_) => ((strength * next).sqrt(), z((strength * next).sqrt())?),
            };
            power = ((found / shown).ln() / (there / strength).ln())
                .clamp(POWER_LIMITS[0], POWER_LIMITS[1]);
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
    ) -> Result<Vec<Standing>, Failure> {
        let ids: Vec<&str> = concealed.iter().map(|sized| sized.dose.sheet().id).collect();
        let excluded: Vec<&str> = known.iter().chain(&ids).copied().collect();
        let others = alternatives(&excluded, self.forms, scene, random);
        let shapes_in = |still: &Still| -> Result<Vec<Vec<f64>>, Failure> {
            concealed.iter().map(|sized| still.column(&sized.dose, sized.strength)).collect()
        };
        let mut still = self.still(FEW_RUNS)?;
        let mut shapes = shapes_in(&still)?;
        let part = (real(still.runs.len()) / real(self.runs.len())).sqrt();
        let is_missed = |(sized, shape): (&Sized, &Vec<f64>)| {
            self.z(shape) < MIN_SHARE_IN_FEW_RUNS * part * self.z(&sized.signature)
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
                .map(|(other, columns)| {
                    (
                        other.sheet.id,
                        scaled(space.with(columns.iter().map(Vec::as_slice)).outside(part)),
                    )
                })
                .collect();
            let z_beyond = scaled(beyond(space, part, &others, &columns));
            standing(z_det, z_beyond, &left)
        });
        Ok(standings.collect())
    }

    /// What nuisances and further signatures span in the first rows.
    fn taken(&self, rows: usize, beside: &[&[f64]]) -> Subspace {
        self.bench.nuisances(rows).with(beside.iter().map(|column| &column[..rows]))
    }

    fn signature(&self, dose: &Dose, strength: f64, runs: &[Drive]) -> Result<Vec<f64>, Failure> {
        let ground = self.ground.and(dose.at(strength));
        self.bench.signature(&ground.observe(runs, self.sensors)?)
    }

    /// Length of a signature outside the nuisances.
    fn z(&self, signature: &[f64]) -> f64 {
        self.bench.nuisances(signature.len()).outside(signature)
    }

    /// So many first runs of the robot without the inertia that its owner knows.
    fn still(&self, runs: usize) -> Result<Still<'_>, Failure> {
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
    fn column(&self, dose: &Dose, strength: f64) -> Result<Vec<f64>, Failure> {
        let with = self.ground.and(dose.at(strength)).observe(self.runs, self.sensors)?;
        self.bench.difference(&with, &self.without, &self.residuals)
    }

    fn columns(&self, others: &[Alternative]) -> Result<Vec<Vec<Vec<f64>>>, Failure> {
        let column = |(dose, strength): &(Dose, f64)| self.column(dose, *strength);
        let all = others.par_iter().map(|alternative| {
            alternative.members.par_iter().map(column).collect::<Result<Vec<_>, Failure>>()
        });
        all.collect()
    }
}

/// What the alternatives that take most of a signature leave of it, one after the other, each
/// effect once.
fn beyond(
    mut space: Subspace,
    signature: &[f64],
    others: &[Alternative],
    columns: &[Vec<Vec<f64>>],
) -> f64 {
    let mut taken: Vec<&str> = Vec::new();
    for _ in 0..MAX_ALTERNATIVES {
        let free = others.iter().zip(columns).filter(|(other, _)| !taken.contains(&other.sheet.id));
        let with = free.map(|(other, columns)| {
            let space = space.with(columns.iter().map(Vec::as_slice));
            (space.outside(signature), other.sheet.id, space)
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
    let mut class: Vec<_> =
        left.iter().filter(|(_, z)| *z < MIN_DISTINCT_Z).map(|(id, _)| *id).collect();
    class.sort_unstable();
    class.dedup();
    Standing { z_det, z_iso, z_beyond, nearest, class }
}

#[cfg(test)]
mod tests;

//! The corrected vehicle file of a diagnosis.

use crate::answer::{Kind, Missing};
use crate::base::{correct_constants, spin_with};
use crate::hypothesis::{Hypothesis, with_friction};
use crate::proposal::Proposal;
use crate::search::Found;
use crate::uncertainty::Level;
use nalgebra::Vector3;
use trackdyn_model::VehicleFile;

/// The filed vehicle with all claims, with the friction level where it clearly differs, and with a
/// proposed law. Where constant ICRs were wrong, friction ratio, centre of gravity and the place of
/// the pose sensor stand for everything that could have moved them. `min_icr_difference` is in
/// gauges.
pub(crate) fn corrected(
    file: &VehicleFile,
    best: &Found,
    friction_level: Option<Level>,
    missing: &[Missing],
    proposed: Option<&Proposal>,
    min_icr_difference: f64,
) -> VehicleFile {
    let tolerated = min_icr_difference * file.vehicle.gauge;
    let level = friction_level.filter(|level| level.is_sure).map_or(0.0, |level| level.value);
    let vehicle = with_friction(&file.vehicle, level);
    let claimed =
        with_claims(VehicleFile { vehicle, ..file.clone() }, best, missing, level, tolerated);
    let Some(Proposal { found, effect, .. }) = proposed else { return claimed };
    // insert the law first: its shift of the ICRs is no constant
    let mut with_law = claimed;
    if let Some(law) = found.fit.hypothesis.effect(*effect) {
        with_law.effects.insert(law.clone());
    }
    with_claims(with_law, found, missing, level, tolerated)
}

/// A vehicle file with the claimed effects as fitted, at the friction level `level`. Constant ICRs
/// of the fit may be missed by `tolerated`, m.
fn with_claims(
    file: VehicleFile,
    found: &Found,
    missing: &[Missing],
    level: f64,
    tolerated: f64,
) -> VehicleFile {
    let mut corrected = file;
    let hypothesis = &found.fit.hypothesis;
    let (constants, effects): (Vec<_>, Vec<_>) =
        missing.iter().partition(|missing| missing.kind == Kind::Constant);
    for missing in effects {
        if let Some(effect) = hypothesis.effect(missing.verdict.effect) {
            corrected.effects.insert(effect.clone());
        }
    }
    // Even where no constant is claimed, the claimed effects may move the ICRs away from those of
    // the fit.
    if !constants.is_empty() || is_elsewhere(&corrected, hypothesis, tolerated) {
        correct_constants(&mut corrected, hypothesis, level, tolerated);
    }
    corrected
}

/// Whether the constant ICRs of a vehicle file differ from those of a hypothesis by more than this,
/// m.
fn is_elsewhere(file: &VehicleFile, hypothesis: &Hypothesis, tolerated: f64) -> bool {
    let there = spin_with(&file.vehicle, file.effects.clone());
    let here = spin_with(&hypothesis.vehicle, hypothesis.effects.clone());
    let away = |there, here| there - (here + Vector3::from(hypothesis.offset));
    there.zip(here).is_some_and(|(there, here)| away(there, here).amax() > tolerated)
}

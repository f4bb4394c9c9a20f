//! The corrected vehicle file of a diagnosis.

use crate::answer::{Kind, Missing};
use crate::base::correct_constants;
use crate::hypothesis::with_friction;
use crate::proposal::Proposal;
use crate::search::Found;
use crate::uncertainty::Level;
use trackdyn_model::VehicleFile;

/// The filed vehicle with all claims, with the friction level where it clearly differs, and with a
/// proposed law. Where constant ICRs were wrong, friction ratio and centre of gravity stand for
/// everything that could have moved them.
pub(crate) fn corrected(
    file: &VehicleFile,
    best: &Found,
    friction_level: Option<Level>,
    missing: &[Missing],
    proposed: Option<&Proposal>,
) -> VehicleFile {
    let level = friction_level.filter(|level| level.is_sure).map_or(0.0, |level| level.value);
    let vehicle = with_friction(&file.vehicle, level);
    let claimed = with_claims(VehicleFile { vehicle, ..file.clone() }, best, missing, level);
    let Some(Proposal { found, effect, .. }) = proposed else { return claimed };
    // insert the law first: its shift of the ICRs is no constant
    let mut with_law = claimed;
    if let Some(law) = found.fit.hypothesis.effect(*effect) {
        with_law.effects.insert(law.clone());
    }
    with_claims(with_law, found, missing, level)
}

/// A vehicle file with the claimed effects as fitted, at the friction level `level`.
fn with_claims(file: VehicleFile, found: &Found, missing: &[Missing], level: f64) -> VehicleFile {
    let mut corrected = file;
    let hypothesis = &found.fit.hypothesis;
    let (constants, effects): (Vec<_>, Vec<_>) =
        missing.iter().partition(|missing| missing.kind == Kind::Constant);
    for missing in effects {
        if let Some(effect) = hypothesis.effect(missing.verdict.effect) {
            corrected.effects.insert(effect.clone());
        }
    }
    if !constants.is_empty() {
        correct_constants(&mut corrected, hypothesis, &found.effects, level);
    }
    corrected
}

//! The vehicle that a diagnosis leads to.

use crate::answer::{Kind, Missing};
use crate::base::correct_constants;
use crate::hypothesis::with_friction;
use crate::search::Found;
use crate::uncertainty::Level;
use trackdyn_model::VehicleFile;

/// The vehicle that explains the evidence: the filed one, with what is claimed and the level of friction where it
/// surely differs. Where the constant ICRs were wrong, friction ratio and centre of gravity stand for all that could
/// move them.
pub(crate) fn corrected(
    file: &VehicleFile,
    best: &Found,
    friction_level: Option<Level>,
    missing: &[Missing],
) -> VehicleFile {
    let level = sure(friction_level);
    let vehicle = with_friction(&file.vehicle, level);
    let mut corrected = VehicleFile { vehicle, ..file.clone() };
    correct(&mut corrected, best, missing, level);
    corrected
}

/// The level of friction where it surely differs from the filed one.
pub(crate) fn sure(friction_level: Option<Level>) -> f64 {
    friction_level.filter(Level::is_sure).map_or(0.0, |level| level.value)
}

/// Puts what is claimed into a vehicle file, as a hypothesis has it, with friction at a level.
pub(crate) fn correct(corrected: &mut VehicleFile, found: &Found, missing: &[Missing], level: f64) {
    let hypothesis = &found.fit.hypothesis;
    let (constants, effects): (Vec<_>, Vec<_>) =
        missing.iter().partition(|missing| missing.kind == Kind::Constant);
    for missing in effects {
        if let Some(effect) = hypothesis.effect(missing.verdict.effect) {
            corrected.effects.insert(effect.clone());
        }
    }
    if !constants.is_empty() {
        correct_constants(corrected, hypothesis, &found.effects, level);
    }
}

//! Which terms the broken and kept symmetries admit.

use crate::locate::Location;
use crate::settings;
use trackdyn_model::effect::{Symmetry, Term};

/// Symmetries that the evidence clearly keeps beside all three predictions.
pub fn kept(locations: [&Location; 3], settings: &settings::Proposal) -> Vec<Symmetry> {
    let keeps = |symmetry: &Symmetry| {
        locations.iter().all(|location| {
            let test = location.tests.iter().find(|test| test.symmetry == *symmetry);
            test.is_some_and(|test| test.test.p > settings.min_p_kept)
        })
    };
    Symmetry::ALL.into_iter().filter(keeps).collect()
}

/// Whether a term breaks a symmetry that is left broken, and none that the evidence clearly keeps
/// or cannot test.
pub fn is_admissible(
    term: &Term,
    location: &Location,
    left_over: &[Symmetry],
    kept: &[Symmetry],
) -> bool {
    let shown = shown(term);
    let tested = |symmetry: &Symmetry| location.tests.iter().any(|one| one.symmetry == *symmetry);
    shown.iter().all(tested)
        && shown.iter().any(|symmetry| left_over.contains(symmetry))
        && !shown.iter().any(|symmetry| kept.contains(symmetry))
}

/// Symmetries in which a term must show. Effects of place or time may average out in all others
/// over a long drive, and effects of heading in those of the speeds.
fn shown(term: &Term) -> Vec<Symmetry> {
    let of = |asked: &[Symmetry]| -> Vec<Symmetry> {
        term.breaks.iter().filter(|symmetry| asked.contains(symmetry)).copied().collect()
    };
    let shown = [of(&[Symmetry::Place, Symmetry::Time]), of(&[Symmetry::Heading])];
    shown.into_iter().find(|shown| !shown.is_empty()).unwrap_or_else(|| term.breaks.clone())
}

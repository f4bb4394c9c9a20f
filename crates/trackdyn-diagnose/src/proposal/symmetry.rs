//! Which terms the symmetries of the evidence admit.

use crate::locate::Location;
use crate::settings;
use trackdyn_model::effect::{Symmetry, Term};

/// The symmetries that the evidence clearly keeps beside all of these predictions.
pub fn kept(locations: [&Location; 3], settings: &settings::Proposal) -> Vec<Symmetry> {
    let keeps = |symmetry: &Symmetry| {
        locations.iter().all(|location| {
            let test = location.tests.iter().find(|test| test.symmetry == *symmetry);
            test.is_some_and(|test| test.test.p > settings.min_p_kept)
        })
    };
    Symmetry::ALL.into_iter().filter(keeps).collect()
}

/// Whether a term breaks a symmetry that is left over, and none that the evidence clearly keeps, or
/// cannot show.
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

/// The symmetries by which a term must show. What changes with place or time may cancel in all
/// others over a drive that goes about, and what changes with the heading in those of the speeds.
fn shown(term: &Term) -> Vec<Symmetry> {
    let of = |asked: &[Symmetry]| -> Vec<Symmetry> {
        term.breaks.iter().filter(|symmetry| asked.contains(symmetry)).copied().collect()
    };
    let shown = [of(&[Symmetry::Place, Symmetry::Time]), of(&[Symmetry::Heading])];
    shown.into_iter().find(|shown| !shown.is_empty()).unwrap_or_else(|| term.breaks.clone())
}

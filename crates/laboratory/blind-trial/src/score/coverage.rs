//! Whether intervals hold the true sizes.

use super::rate::Rate;
use super::verdict::Judged;
use crate::diagnosis::{Missing, Size};
use std::collections::BTreeMap;
use trackdyn_second_simulator::sheet_of;

/// How often 95 % intervals hold the true sizes, effect by effect in the order of their ids.
pub fn coverage(judged: &[Judged]) -> Vec<Rate> {
    let mut by_effect: BTreeMap<&str, Vec<bool>> = BTreeMap::new();
    for (effect, holds) in outcomes(judged) {
        by_effect.entry(effect).or_default().push(holds);
    }
    by_effect.into_iter().map(|(effect, outcomes)| Rate::of(effect, outcomes)).collect()
}

/// Effect by effect whether the 95 % interval holds the true size, over all parameters that mean
/// what they mean in the catalogue.
pub(super) fn outcomes(judged: &[Judged]) -> Vec<(&str, bool)> {
    judged.iter().flat_map(of_case).collect()
}

/// Whether the intervals of one case hold the true sizes.
pub(super) fn of_case(case: &Judged) -> Vec<(&str, bool)> {
    let claims = case.diagnosis().map_or(&[][..], |diagnosis| &diagnosis.missing);
    let alone = claims.iter().filter(|claim| claim.members().len() == 1);
    let outcomes = alone.flat_map(|claim| {
        covered(case, claim).into_iter().map(|holds| (claim.effect.as_str(), holds))
    });
    outcomes.collect()
}

fn covered(case: &Judged, claim: &Missing) -> Vec<bool> {
    let concealed = case.answer.concealed.iter().filter(|c| c.in_catalogue);
    let concealed = concealed.map(|c| (&c.mechanism, &c.parameters, c.form));
    let shown = case.answer.shown_errors();
    let instruments = shown.iter().map(|i| (&i.mechanism, &i.parameters, None));
    let truth = concealed.chain(instruments).find(|(id, ..)| **id == claim.effect);
    let Some((id, parameters, _)) = truth.filter(|(id, _, form)| shares_size(id, *form)) else {
        return Vec::new();
    };
    let inside = |size: &Size| {
        let truth = parameters.get(&size.name)?;
        let (low, high) = (size.low95?, size.high95?);
        // directions come back after a whole turn
        let turns = if comes_round(id, &size.name) { [-360.0, 0.0, 360.0] } else { [0.0; 3] };
        Some(turns.iter().any(|turn| (low..=high).contains(&(truth + turn))))
    };
    claim.parameters.iter().filter_map(inside).collect()
}

/// Whether a size of the second simulator is that of the catalogue, in the form that it has.
fn shares_size(id: &str, form: Option<u32>) -> bool {
    sheet_of(id).is_some_and(|sheet| match (form, sheet.family) {
        (Some(_), Some(family)) => family.shares_size,
        _ => sheet.shares_size,
    })
}

/// Whether a parameter is an angle that comes back after a whole turn.
fn comes_round(id: &str, key: &str) -> bool {
    let parameter = sheet_of(id).and_then(|sheet| sheet.parameter(key));
    parameter.is_some_and(|one| one.unit == "deg" && one.range[1] >= 180.0)
}

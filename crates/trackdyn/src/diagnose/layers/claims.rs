//! What is claimed, as words at the beginning of each run.

use super::Drive;
use crate::viewer::ROOT;
use crate::{Claim, Diagnosis};
use trackdyn_export::viewer::TextLayer;

impl Drive<'_> {
    /// The status, and a line for each claim and each refusal.
    pub(super) fn claims(&self, diagnosis: &Diagnosis) -> TextLayer {
        let mut lines = vec![diagnosis.status().name().to_owned()];
        lines.extend(diagnosis.claims().map(|claim| said(&claim)));
        let refused = diagnosis.found.answer.refused.iter();
        lines.extend(refused.map(|verdict| {
            let effects: Vec<&str> = verdict.one_of.iter().map(|effect| effect.name()).collect();
            let reason = verdict.refused.as_ref().map_or_else(String::new, ToString::to_string);
            format!("not claimed: {}: {reason}", effects.join(" or "))
        }));
        let text = lines.join("\n");
        let mut layer = TextLayer { topic: format!("{ROOT}/claims"), ..TextLayer::default() };
        for run in self.runs() {
            let first = &self.evidence.samples()[run.start];
            layer.stamps.push(self.stamp(first.run, first.start));
            layer.texts.push(text.clone());
        }
        layer
    }
}

/// A claim with its sizes.
fn said(claim: &Claim) -> String {
    let sizes = claim.sizes().into_iter().map(|size| {
        format!(", {} = {:.4} [{:.4}, {:.4}]", size.key, size.value, size.low, size.high)
    });
    format!("missing: {}{}", claim.one_of().join(" or "), sizes.collect::<String>())
}

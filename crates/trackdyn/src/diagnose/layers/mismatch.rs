//! Where a model and the drive differ: whitened residuals, and the regime of driving.

use super::Drive;
use crate::Diagnosis;
use crate::viewer::{Actor, ROOT, plot};
use nalgebra::Vector3;
use trackdyn_diagnose::Weighted;
use trackdyn_diagnose::mismatch::{Regime, worst_regime};
use trackdyn_export::viewer::{Plot, Tab, TextLayer, Trace};
use trackdyn_report::figure::entry_colour;

impl Drive<'_> {
    /// Whitened residuals before and after, of fitted and of held-out runs: noise alone makes 1.
    pub(super) fn residuals(&self, diagnosis: &Diagnosis) -> Tab {
        let found = &diagnosis.found;
        let fits = [found.fit_before(), &found.models.best.fit];
        let mut views = vec![(&found.evidence.seen, fits.map(|fit| fit.residual.as_slice()))];
        if let Some(unseen) = &found.evidence.unseen {
            views.push((&unseen.evidence, [&unseen.before, &unseen.after]));
        }
        let names = ["before", "after"];
        let (_, actors) = Actor::all(names.into_iter().zip([0, 1].map(entry_colour)));
        let plots = ["forward", "left", "yaw"].into_iter().enumerate().map(|(channel, name)| {
            let curves = actors.iter().enumerate().map(|(state, actor)| {
                let of_view = |(evidence, residuals): &(&Weighted, [&[Vector3<f64>]; 2])| {
                    self.whitened(evidence, residuals[state], channel)
                };
                let mut values: Vec<(u64, f64)> = views.iter().flat_map(of_view).collect();
                values.sort_by_key(|(stamp, _)| *stamp);
                let (stamps, values) = values.into_iter().unzip();
                actor.curve(&format!("whitened_residual/{name}"), Trace { stamps, values })
            });
            plot(&format!("Whitened residual, {name} [standard deviations]"), curves)
        });
        Tab { title: "Residuals".to_owned(), plots: plots.collect::<Vec<Plot>>() }
    }

    /// Stamp and value of a channel of whitened residuals, where it was measured.
    fn whitened(
        &self,
        evidence: &Weighted,
        residual: &[Vector3<f64>],
        channel: usize,
    ) -> Vec<(u64, f64)> {
        let samples = evidence.samples().iter().zip(residual).enumerate();
        let measured = samples.filter(|(index, _)| evidence.is_measured(*index, channel));
        measured.map(|(_, (sample, z))| (self.middle(sample), z[channel])).collect()
    }

    /// How the robot drives, where that changes, and whether it is where the model before fails
    /// most.
    pub(super) fn regimes(&self, diagnosis: &Diagnosis) -> TextLayer {
        let seen = &diagnosis.found.evidence.seen;
        let worst = worst_regime(seen, &diagnosis.found.models.base.fit.residual);
        let worst = worst.map(|(regime, _)| regime);
        let (fastest, settings) = (seen.fastest(), &self.evidence.settings().location);
        let mut layer = TextLayer { topic: format!("{ROOT}/driving"), ..TextLayer::default() };
        for sample in self.evidence.samples() {
            let regime = Regime::of(sample, fastest, settings);
            let text = match regime {
                None => "at rest".to_owned(),
                Some(regime) if Some(regime) == worst => {
                    format!("{}: largest residuals", regime.name())
                }
                Some(regime) => regime.name(),
            };
            if layer.texts.last() != Some(&text) {
                layer.stamps.push(self.stamp(sample.run, sample.start));
                layer.texts.push(text);
            }
        }
        layer
    }
}

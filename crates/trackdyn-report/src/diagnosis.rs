//! The figures and the report of a diagnosis.

mod answer;
mod candidates;
pub(crate) mod cells;
mod errors;
mod evidence;
mod first;
mod html;
mod isolability;
mod live;
mod log;
mod parity;
mod path;
mod plane;
mod signature;
mod timeline;
mod words;

use crate::figure::Figure;
use crate::sheet;
use nalgebra::Vector3;
use trackdyn_diagnose::diagnosis::{Diagnosis, Kind, Unseen};
use trackdyn_diagnose::fit::Fit;
use trackdyn_diagnose::locate::cells::Cell;
use trackdyn_diagnose::locate::icr_columns;
use trackdyn_diagnose::{DiagnosisFile, Weighted};
use trackdyn_model::VehicleFile;

pub use html::diagnosis_html;

/// What is reported.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The diagnosis.
    pub diagnosis: &'a Diagnosis,
    /// The vehicle as filed.
    pub vehicle: &'a VehicleFile,
    /// The diagnosis as written to its file.
    pub file: &'a DiagnosisFile,
    /// Name of the recording.
    pub name: &'a str,
    /// Stands below every figure: what it was made from.
    pub caption: &'a str,
}

/// Evidence with whitened residuals before and after.
#[derive(Clone, Copy)]
struct View<'a> {
    evidence: &'a Weighted,
    residuals: [&'a [Vector3<f64>]; 2],
    is_held_out: bool,
}

impl<'a> Subject<'a> {
    /// Whether nothing but perhaps wrong constants is claimed.
    fn claims_nothing(&self) -> bool {
        self.diagnosis.answer.missing.iter().all(|missing| missing.kind == Kind::Constant)
    }

    /// What it was made from.
    fn evidence(&self) -> &'a Weighted {
        &self.diagnosis.evidence.seen
    }

    /// The fit before.
    fn fit_before(&self) -> &'a Fit {
        self.diagnosis.fit_before()
    }

    /// Cells of driving before and after.
    fn cells(&self) -> [Vec<Cell>; 2] {
        let [before, after] = &self.diagnosis.evidence.cells;
        if !self.diagnosis.blames_instruments() {
            return [before.clone(), after.clone()];
        }
        let fit = self.fit_before();
        let icrs = icr_columns(self.evidence(), fit);
        let filed = trackdyn_diagnose::locate::cells::cells(self.evidence(), &fit.residual, &icrs);
        [filed, after.clone()]
    }

    /// What was left, of the fit and of the held-out runs.
    fn views(&self) -> Vec<View<'a>> {
        let diagnosis = self.diagnosis;
        let residuals =
            [self.fit_before(), &diagnosis.models.best.fit].map(|fit| fit.residual.as_slice());
        let mut views = vec![View { evidence: self.evidence(), residuals, is_held_out: false }];
        if let Some(Unseen { evidence, before, after }) = &diagnosis.evidence.unseen {
            views.push(View { evidence, residuals: [before, after], is_held_out: true });
        }
        views
    }

    /// What was left of the runs that judge: the held-out ones where there are any.
    fn judging(&self) -> View<'a> {
        self.views().pop().expect("that of the fit at least")
    }
}

/// All figures of a diagnosis, in the order of the report. A table of steady motions has no paths.
pub fn diagnosis_figures(subject: &Subject) -> Vec<Figure> {
    let candidates = candidates::candidates(subject);
    let mut figures = vec![plane::figure(subject).explained(
        "Where observation and model differ",
        "Each spot is a pair of track speeds: left track to the right, right track upwards, so \
             that straight driving lies on the rising diagonal and spins on the falling one. Red: \
             the robot moved further forward, further to the left or turned further to the left \
             than predicted; blue: less far. What the model lacks shows as a pattern; noise has \
             none.",
    )];
    figures.extend(timeline::figure(subject).map(|figure| {
        figure.explained(
            "When observation and model differ",
            "What the model lacks comes back whenever the robot drives alike; a residual that \
             stands out once has a cause of that moment, such as a pose that jumped.",
        )
    }));
    figures.extend([
        cells::figure(subject).explained(
            "How the centres of rotation move",
            "Every row is a way of driving. Marks away from zero mean that the robot turns about \
             other points there than elsewhere, so constant ICRs cannot describe it.",
        ),
        parity::figure(subject).explained(
            "Which symmetries of driving are broken",
            "Each kind of missing physics breaks its own set of symmetries. p is the probability \
             that chance alone makes the largest of all these statistics as large; it is counted \
             by blocks of time, so that a large departure in few blocks may still be chance.",
        ),
        signature::figure(subject).explained(
            "The effect against the evidence",
            "If the means follow the line, the effect predicts the sign and the size of what was \
             seen, sample by sample. A slope other than one, or a curve, is a hint at another law.",
        ),
        evidence::figure(subject, &candidates).explained(
            "What speaks for each effect",
            "Screened one by one beside the vehicle as filed. Effects that resemble the right one \
             also gain; the search leaves each one out again and exchanges it before it claims \
             any.",
        ),
        isolability::figure(subject).explained(
            "Which effects this evidence can tell apart",
            "Dark squares off the diagonal are pairs that this way of driving cannot separate: the \
             answer would be the same for both. Arrows mark what is claimed, by itself or as one \
             of a set; clock and sensor, which are fitted beside everything, have no row.",
        ),
        errors::figure(subject).explained(
            "Error against the noise floor",
            "After the correction the error should lie on the floor, on every channel and in every \
             run. What stays above it is unexplained.",
        ),
    ]);
    figures.extend(path::figure(subject).map(|figure| {
        figure.explained(
            "One run replayed",
            "What the correction is worth in dead reckoning: the path that follows from the track \
             speeds alone, without any further observation.",
        )
    }));
    figures
}

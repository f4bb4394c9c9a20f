//! The figures and the report of a diagnosis.

mod answer;
mod base64;
mod candidates;
mod cells;
mod errors;
mod evidence;
mod html;
mod isolability;
mod parity;
mod path;
mod plane;
mod signature;
mod words;

use crate::Error;
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

/// A figure of a diagnosis.
pub struct Figure {
    /// Name of its file.
    pub file: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// How to read it.
    pub reading: &'static str,
    /// Its bytes.
    pub png: Vec<u8>,
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
        self.diagnosis.missing.iter().all(|missing| missing.kind == Kind::Constant)
    }

    /// What it was made from.
    fn evidence(&self) -> &'a Weighted {
        &self.diagnosis.evidence
    }

    /// The fit before.
    fn fit_before(&self) -> &'a Fit {
        self.diagnosis.fit_before()
    }

    /// Cells of driving before and after.
    fn cells(&self) -> [Vec<Cell>; 2] {
        let [before, after] = &self.diagnosis.cells;
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
        let residuals = [self.fit_before(), &diagnosis.best.fit].map(|fit| fit.residual.as_slice());
        let mut views = vec![View { evidence: self.evidence(), residuals, is_held_out: false }];
        if let Some(Unseen { evidence, before, after }) = &diagnosis.unseen {
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
///
/// The bytes depend on the argument only.
///
/// # Errors
/// [`Error`] where a part cannot be drawn; no result is the cause of one.
pub fn diagnosis_figures(subject: &Subject) -> Result<Vec<Figure>, Error> {
    let candidates = candidates::candidates(subject);
    let mut figures = vec![
        Figure {
            file: "plane.png",
            title: "Where observation and model differ",
            reading: "Each spot is a pair of track speeds: left track to the right, right track upwards, so \
                      that straight driving lies on the rising diagonal and spins on the falling one. Red: the \
                      robot moved further forward, further to the left or turned further to the left than \
                      predicted; blue: less far. What the model lacks shows as a pattern; noise has none.",
            png: plane::draw(subject)?,
        },
        Figure {
            file: "cells.png",
            title: "How the centres of rotation move",
            reading: "Every row is a way of driving. Marks away from zero mean that the robot turns about \
                      other points there than elsewhere, so constant ICRs cannot describe it.",
            png: cells::draw(subject)?,
        },
        Figure {
            file: "symmetries.png",
            title: "Which symmetries of driving are broken",
            reading: "Each kind of missing physics breaks its own set of symmetries. p is the probability \
                      that chance alone makes the largest of all these statistics as large; it is counted by blocks of \
                      time, so that a large departure in few blocks may still be chance.",
            png: parity::draw(subject)?,
        },
        Figure {
            file: "signatures.png",
            title: "The effect against the evidence",
            reading: "If the means follow the line, the effect predicts the sign and the size of what was \
                      seen, sample by sample. A slope other than one, or a curve, is a hint at another law.",
            png: signature::draw(subject)?,
        },
        Figure {
            file: "evidence.png",
            title: "What speaks for each effect",
            reading: "Screened one by one beside the vehicle as filed. Effects that resemble the right one \
                      also gain; the search leaves each one out again and exchanges it before it claims any.",
            png: evidence::draw(subject, &candidates)?,
        },
        Figure {
            file: "isolability.png",
            title: "Which effects this evidence can tell apart",
            reading: "Dark squares off the diagonal are pairs that this way of driving cannot separate: the \
                      answer would be the same for both. Arrows mark what is claimed, by itself or as one of a \
                      set; clock and sensor, which are fitted beside everything, have no row.",
            png: isolability::draw(subject)?,
        },
        Figure {
            file: "errors.png",
            title: "Error against the noise floor",
            reading: "After the correction the error should lie on the floor, on every channel and in every \
                      run. What stays above it is unexplained.",
            png: errors::draw(subject)?,
        },
    ];
    if let Some(png) = path::draw(subject)? {
        figures.push(Figure {
            file: "path.png",
            title: "One run replayed",
            reading: "What the correction is worth in dead reckoning: the path that follows from the track \
                      speeds alone, without any further observation.",
            png,
        });
    }
    Ok(figures)
}

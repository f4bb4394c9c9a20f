//! How the residuals of constant ICRs scatter.
//!
//! Constant ICRs leave more than noise: slip that changes with speed, slides, stamps. Weights by
//! the noise alone would follow what they do not describe. The variances of [`SegmentNoise`]
//! describe the scatter as a whole; they follow from the residuals of a fit by restricted
//! likelihood.

use crate::least_squares::{Estimate, residuals};
use crate::observations::Observations;
use crate::restricted_likelihood::{Search, taken};
use crate::weighting::{Seen, SegmentNoise, Weighting, Whitener};
use nalgebra::Vector3;

/// Most segments that are looked at, by which a variance is known to 5 %, and how many of them in a
/// row.
const MAX_SEGMENTS: usize = 800;
const STRETCH: usize = 50;

/// Rounds of finding the scatter, and what the fit took of it.
const ROUNDS: usize = 2;

/// The scatter of the residuals of an estimate, starting from the `measured` noise.
pub(crate) fn scatter(
    observations: &Observations,
    of: &Estimate,
    measured: SegmentNoise,
) -> SegmentNoise {
    let motions = Seen::all(observations.segments());
    let (left, columns) = residuals(observations, of);
    // Stretches from all over the recording.
    let stride = motions.len().div_ceil(MAX_SEGMENTS);
    let is_chosen = |k: &usize| (k / STRETCH).is_multiple_of(stride);
    let chosen: Vec<usize> = (0..motions.len()).filter(is_chosen).collect();
    let of = |column: &[Vector3<f64>]| chosen.iter().map(|&k| column[k]).collect::<Vec<_>>();
    let motion = |&k: &usize| {
        let begins = k.is_multiple_of(STRETCH) && stride > 1;
        Seen { follows: motions[k].follows && !begins, ..motions[k] }
    };
    let motions: Vec<Seen> = chosen.iter().map(motion).collect();
    let columns: Vec<_> = columns.iter().map(|column| of(column)).collect();
    let (left, search) = (of(&left), Search::default());
    let mut noise = search.regular(&measured);
    for _ in 0..ROUNDS {
        let whitener = Whitener::of_motions(&Weighting::Noise(noise), motions.iter().copied());
        let white = |column: &Vec<Vector3<f64>>| {
            let mut column = column.clone();
            whitener.whiten(&mut column);
            column
        };
        let white: Vec<_> = columns.iter().map(white).collect();
        let taken = taken(&noise, &motions, &white, |column| whitener.whiten_transposed(column));
        noise = search.most_likely(&motions, &left, noise, &taken);
    }
    noise
}

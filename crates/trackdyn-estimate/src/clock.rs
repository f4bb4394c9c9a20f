//! How late the poses are against the encoders.
//!
//! # Law
//! Between neighbouring poses, Δψᵢ = k Dᵢ(τ) + b Δtᵢ + noise, where Dᵢ(τ) = ∫ (Vᵣ − Vₗ) dt over the
//! pose interval moved back by τ. k is the inverse of the distance between the ICRs, b takes up a
//! constant yaw rate.
//!
//! The correlation of Δψ and D (b removed) is searched for its peak. The peak itself is not the
//! estimate: encoder noise averages better where D cuts readings in two, which pulls the peak by up
//! to half a reading. From there on, the residual is made orthogonal to D before and after the
//! interval (lead minus lag for τ, lead plus lag for k, Δt for b). These instruments share no
//! reading with Dᵢ, so that white encoder noise drops out.
//!
//! # Assumes
//! k may be any constant: no kinematic model is needed. A belt that lags behind its encoder shows
//! as a clock offset just so; the two are told apart elsewhere, if at all. τ goes with readings
//! that are held ([`hold`](trackdyn_recording::hold)): where a reading stands for the time before
//! or around its stamp, the delay itself is a whole or half an interval of the readings longer.
//!
//! # Sources
//! Instrumental variables: Wooldridge, Econometric Analysis of Cross Section and Panel Data, 2nd
//! ed., chapter 5 and section 14.1.

use crate::Error;
use trackdyn_core::real;
use trackdyn_recording::Recording;

mod intervals;
mod moments;
mod regression;

use intervals::Intervals;
use moments::{Estimate, Moments};
use regression::Fit;

/// Where to look for the clock offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockSearch {
    /// Smallest offset, s.
    pub earliest: f64,
    /// Largest offset, s.
    pub latest: f64,
}

impl Default for ClockSearch {
    fn default() -> Self {
        Self { earliest: -0.5, latest: 1.0 }
    }
}

/// The clock offset of a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockOffset {
    /// τ, s: positive where poses are late ([`hold`](trackdyn_recording::hold)).
    pub tau: f64,
    /// Standard error of τ, s, by leaving out blocks of time: it includes correlated noise and
    /// noise of changing size.
    pub standard_error: f64,
    /// Correlation of yaw increments and encoders at its peak.
    pub correlation: f64,
    /// k, rad/m: the inverse of the distance between the ICRs.
    pub yaw_per_difference: f64,
    /// Pose intervals that were used.
    pub intervals: usize,
}

/// The clock offset to work with, and where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Clock {
    /// Given, s.
    Given(f64),
    /// Estimated from the recording.
    Estimated(ClockOffset),
    /// Taken as zero, with the reason why the recording does not show it.
    Unknown(String),
}

impl Clock {
    /// The given offset, s, or else the one that is estimated from the recording.
    pub fn of(recording: &Recording, given: Option<f64>) -> Self {
        match given {
            Some(tau) => Self::Given(tau),
            None => match clock_offset(recording, &ClockSearch::default()) {
                Ok(offset) => Self::Estimated(offset),
                Err(reason) => Self::Unknown(reason.to_string()),
            },
        }
    }

    /// τ, s.
    pub fn tau(&self) -> f64 {
        match self {
            Self::Given(tau) => *tau,
            Self::Estimated(offset) => offset.tau,
            Self::Unknown(_) => 0.0,
        }
    }

    /// Standard error of τ, s, where it was estimated.
    pub fn standard_error(&self) -> Option<f64> {
        match self {
            Self::Estimated(offset) => Some(offset.standard_error),
            Self::Given(_) | Self::Unknown(_) => None,
        }
    }

    /// Why τ could not be estimated, where it could not.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Unknown(reason) => Some(reason),
            Self::Given(_) | Self::Estimated(_) => None,
        }
    }

    /// Where it comes from, in a word or two for files.
    pub fn origin(&self) -> &'static str {
        match self {
            Self::Given(_) => "given",
            Self::Estimated(_) => "estimated",
            Self::Unknown(_) => "not estimable",
        }
    }
}

/// Step of the first search, s.
const SEARCH_STEP: f64 = 0.02;

/// Smallest number of pose intervals for an estimate.
const MIN_INTERVALS: usize = 20;

/// Smallest correlation of encoders and poses that show the same turning.
const MIN_CORRELATION: f64 = 0.5;

/// Estimates the clock offset.
///
/// # Errors
/// [`Error::NotEstimable`] without enough turning that changes, with the best offset at an end of
/// the search, or with left and right swapped.
pub fn clock_offset(recording: &Recording, search: &ClockSearch) -> Result<ClockOffset, Error> {
    let refuse = |reason: String| Error::NotEstimable { what: "the clock offset", reason };
    let intervals = Intervals::new(recording);
    let steps = (0..).map(|step| search.earliest + SEARCH_STEP * real(step));
    let mut best: Option<(f64, Fit)> = None;
    let mut most = 0;
    for tau in steps.take_while(|tau| *tau <= search.latest + SEARCH_STEP / 2.0) {
        let fit = intervals.fit(tau);
        most = most.max(fit.count);
        let better = best.is_none_or(|(_, best)| fit.correlation.abs() > best.correlation.abs());
        if fit.count >= MIN_INTERVALS && better {
            best = Some((tau, fit));
        }
    }
    let Some((coarse, fit)) = best else {
        return Err(refuse(format!("{most} pose intervals with readings, {MIN_INTERVALS} needed")));
    };
    let Fit { correlation, count, .. } = fit;
    if correlation.abs() < MIN_CORRELATION {
        return Err(refuse(format!(
            "no turning that encoders and poses both show: their best correlation is \
             {correlation:.2} over {count} pose intervals, {MIN_CORRELATION} needed"
        )));
    }
    if correlation < 0.0 {
        return Err(refuse(format!(
            "yaw falls where the right track is faster (correlation {correlation:.2}): left and \
             right are swapped, or the sign of yaw is"
        )));
    }
    if coarse < search.earliest + SEARCH_STEP / 2.0 || coarse > search.latest - SEARCH_STEP / 2.0 {
        return Err(refuse(format!(
            "the best offset, {coarse:.2} s, lies at an end of the search from {} to {} s",
            search.earliest, search.latest
        )));
    }
    let Some(moments) = Moments::new(&intervals, coarse) else {
        return Err(refuse("the readings end too close to the pose intervals".to_owned()));
    };
    let Some(tau) = moments.root() else {
        return Err(refuse(format!("the correlation has no clear peak around {coarse:.2} s")));
    };
    let Estimate { gain, standard_error } = moments.estimate(tau);
    Ok(ClockOffset {
        tau,
        standard_error,
        correlation,
        yaw_per_difference: gain,
        intervals: moments.count(),
    })
}

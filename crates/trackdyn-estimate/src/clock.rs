//! How late the poses are against the encoders.
//!
//! # Law
//! Between neighbouring poses, Δψᵢ = k Dᵢ(τ) + b Δtᵢ + noise, where Dᵢ(τ) = ∫ (Vᵣ − Vₗ) dt over the
//! pose interval moved back by τ. k is the inverse of the distance between the ICRs, b takes up a
//! constant yaw rate.
//!
//! The correlation of Δψ and D (b removed) is searched for its peak: first where offsets usually
//! are, then uphill from there, and ever farther where no clear peak is found. The peak itself is
//! not the estimate: encoder noise averages better where D cuts readings in two, which pulls the
//! peak by up to half a reading. So, from the peak on, the residual is made orthogonal to D before
//! and after the interval (lead minus lag for τ, lead plus lag for k, Δt for b). These instruments
//! share no reading with Dᵢ, so that white encoder noise drops out.
//!
//! # Assumes
//! k may be any constant: no kinematic model is needed. A belt that lags behind its encoder looks
//! like a clock offset; the two are separated elsewhere, if at all. τ goes with readings that are
//! held ([`hold`](trackdyn_recording::hold)): where a reading stands for the time before or around
//! its stamp, the delay itself is a whole or half an interval of the readings longer.
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
mod settings;

pub use settings::Settings;

use intervals::Intervals;
use moments::{Estimate, Moments};
use regression::Fit;

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
    /// Taken as zero: the recording does not show it.
    Unknown {
        /// Why.
        reason: String,
        /// The best correlation of encoders and poses, where it is too small to determine an
        /// offset.
        correlation: Option<f64>,
    },
}

impl Clock {
    /// The given offset, s, or else the one that is estimated from the recording; unknown where
    /// there is too little turning to tell.
    ///
    /// # Errors
    /// [`Error::ClockFar`] and [`Error::Swapped`]: they show that no offset of the search is right,
    /// and zero is one of these.
    pub fn of(
        recording: &Recording,
        given: Option<f64>,
        settings: &Settings,
    ) -> Result<Self, Error> {
        match given {
            Some(tau) => Ok(Self::Given(tau)),
            None => match clock_offset(recording, settings) {
                Ok(offset) => Ok(Self::Estimated(offset)),
                Err(reason @ Error::NotEstimable { .. }) => {
                    Ok(Self::Unknown { reason: reason.to_string(), correlation: None })
                }
                Err(unlike @ Error::Unlike { correlation, .. }) => {
                    let (reason, correlation) = (unlike.to_string(), Some(correlation));
                    Ok(Self::Unknown { reason, correlation })
                }
                Err(reason) => Err(reason),
            },
        }
    }

    /// τ, s.
    pub fn tau(&self) -> f64 {
        match self {
            Self::Given(tau) => *tau,
            Self::Estimated(offset) => offset.tau,
            Self::Unknown { .. } => 0.0,
        }
    }

    /// Standard error of τ, s, where it was estimated.
    pub fn standard_error(&self) -> Option<f64> {
        match self {
            Self::Estimated(offset) => Some(offset.standard_error),
            Self::Given(_) | Self::Unknown { .. } => None,
        }
    }

    /// Why τ could not be estimated, where it could not.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Unknown { reason, .. } => Some(reason),
            Self::Given(_) | Self::Estimated(_) => None,
        }
    }

    /// Where it comes from, in a word or two for files.
    pub fn origin(&self) -> &'static str {
        match self {
            Self::Given(_) => "given",
            Self::Estimated(_) => "estimated",
            Self::Unknown { .. } => "not estimable",
        }
    }
}

/// An offset of a search with the fit there.
#[derive(Clone, Copy)]
struct Peak {
    tau: f64,
    fit: Fit,
    is_at_end: bool,
}

impl Peak {
    /// The offset with the largest correlation of those with enough pose intervals; without any,
    /// the largest number of these.
    fn within(
        intervals: &Intervals,
        [first, last]: [f64; 2],
        step: f64,
        needed: usize,
    ) -> Result<Self, usize> {
        Self::of_every(1, intervals, [first, last], step, needed)
    }

    /// As [`Peak::within`], of a wide range: in longer steps, and by a part of the pose intervals
    /// where they are many.
    fn of_some(
        intervals: &Intervals,
        range: [f64; 2],
        needed: usize,
        by: &Settings,
    ) -> Result<Self, usize> {
        let stride = intervals.count().div_ceil(by.max_intervals).max(1);
        Self::of_every(stride, intervals, range, by.far_step, needed.div_ceil(stride))
    }

    /// As [`Peak::within`], by every so many of the pose intervals.
    fn of_every(
        stride: usize,
        intervals: &Intervals,
        [first, last]: [f64; 2],
        step: f64,
        needed: usize,
    ) -> Result<Self, usize> {
        let (mut best, mut most): (Option<Self>, usize) = (None, 0);
        let taus =
            (0..).map(|k| first + step * real(k)).take_while(|tau| *tau <= last + step / 2.0);
        for tau in taus {
            let fit = intervals.fit(tau, stride);
            most = most.max(fit.count);
            let is_better =
                best.is_none_or(|best| fit.correlation.abs() > best.fit.correlation.abs());
            if fit.count >= needed && is_better {
                let is_at_end = tau < first + step / 2.0 || tau > last - step / 2.0;
                best = Some(Self { tau, fit, is_at_end });
            }
        }
        best.ok_or(most)
    }

    /// 1 − r², the part of the variance of Δψ that is left.
    fn left(&self) -> f64 {
        1.0 - self.fit.correlation.powi(2)
    }
}

/// The highest peak of the correlation: of the first range, if it is clear or no other is higher by
/// far.
fn highest(intervals: &Intervals, by: &Settings) -> Result<Peak, usize> {
    let near = Peak::within(intervals, [by.earliest, by.latest], by.step, by.min_intervals)?;
    // A peak of a small part of the poses may be one of chance.
    let is_of_most =
        |peak: &Peak| real(peak.fit.count) >= by.min_clear_share * real(intervals.count());
    let is_clear =
        |peak: &Peak| peak.fit.correlation.abs() >= by.min_clear_correlation && is_of_most(peak);
    if !near.is_at_end && is_clear(&near) {
        return Ok(near);
    }
    let needed = share(near.fit.count, by);
    let far = Peak::of_some(intervals, [-by.farthest, by.farthest], needed, by)
        .ok()
        .filter(|far| far.left() <= by.max_left_by_far_peak * near.left());
    let best = match far {
        Some(far) => around(intervals, far, needed, by)?,
        None => uphill(intervals, near, by)?,
    };
    if best.fit.correlation > 0.0 && is_clear(&best) {
        return Ok(best);
    }
    let farther = |far: &Peak| {
        best.fit.correlation < by.min_clear_correlation || far.fit.count > 2 * best.fit.count
    };
    Ok(farthest(intervals, by).filter(farther).unwrap_or(best))
}

/// Least number of pose intervals, of so many, that a far offset must use.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of them")]
fn share(count: usize, by: &Settings) -> usize {
    ((by.min_share * real(count)) as usize).max(by.min_intervals)
}

/// The peak near one of a coarse search.
fn around(
    intervals: &Intervals,
    coarse: Peak,
    needed: usize,
    by: &Settings,
) -> Result<Peak, usize> {
    let around = [coarse.tau - by.far_step, coarse.tau + by.far_step];
    let fine = Peak::within(intervals, around, by.step, needed)?;
    Ok(Peak { is_at_end: coarse.is_at_end, ..fine })
}

/// The peak that the correlation rises to from an end of the first range.
fn uphill(intervals: &Intervals, near: Peak, by: &Settings) -> Result<Peak, usize> {
    let within = |tau: f64| tau.clamp(-by.farthest, by.farthest);
    let mut peak = near;
    while peak.is_at_end {
        let around = [within(peak.tau - by.uphill_reach), within(peak.tau + by.uphill_reach)];
        let next = Peak::within(intervals, around, by.step, by.min_intervals)?;
        let rises = next.fit.correlation.abs() > peak.fit.correlation.abs();
        peak = Peak { is_at_end: next.is_at_end, ..if rises { next } else { peak } };
        if !rises {
            break;
        }
    }
    Ok(peak)
}

/// A clear peak beyond the search: of clocks that were set by hand, or in another time zone.
fn farthest(intervals: &Intervals, by: &Settings) -> Option<Peak> {
    let needed = share(intervals.count(), by);
    let far = Peak::of_some(intervals, [-by.last, by.last], needed, by).ok()?;
    let fine = around(intervals, far, needed, by).ok()?;
    (fine.fit.correlation >= by.min_clear_correlation && !fine.is_at_end).then_some(fine)
}

/// Part of the variance of the turning of a recording, 1 − r², that a clock offset leaves, s.
pub fn left_at(recording: &Recording, tau: f64, settings: &Settings) -> f64 {
    let intervals = Intervals::new(recording, settings);
    1.0 - intervals.fit(tau, 1).correlation.powi(2)
}

/// Estimates the clock offset.
///
/// # Errors
/// [`Error::NotEstimable`] without enough turning that changes, [`Error::ClockFar`] with the best
/// offset at an end of the search, [`Error::Swapped`] with left and right swapped.
pub fn clock_offset(recording: &Recording, settings: &Settings) -> Result<ClockOffset, Error> {
    let refuse = |reason: String| Error::NotEstimable { what: "the clock offset", reason };
    let &Settings { min_intervals, min_correlation, max_error, farthest, last, .. } = settings;
    let intervals = Intervals::new(recording, settings);
    let Peak { tau: coarse, fit, is_at_end } = highest(&intervals, settings).map_err(|most| {
        refuse(format!("{most} pose intervals with readings, {min_intervals} needed"))
    })?;
    let Fit { correlation, count, .. } = fit;
    if correlation.abs() < min_correlation {
        return Err(Error::Unlike { correlation, count, needed: min_correlation });
    }
    if correlation < 0.0 {
        return Err(Error::Swapped { correlation, farthest: last });
    }
    if is_at_end {
        return Err(Error::ClockFar { tau: coarse, farthest });
    }
    let Some(moments) = Moments::new(&intervals, coarse, settings) else {
        return Err(refuse("the readings end too close to the pose intervals".to_owned()));
    };
    let Some(tau) = moments.root() else {
        return Err(refuse(format!("the correlation has no clear peak around {coarse:.2} s")));
    };
    let Estimate { gain, standard_error } = moments.estimate(tau);
    let is_known = standard_error < max_error;
    if !is_known {
        return Err(refuse(format!(
            "turning changes too rarely: {tau:.2} s would be open by more than {max_error} s"
        )));
    }
    Ok(ClockOffset {
        tau,
        standard_error,
        correlation,
        yaw_per_difference: gain,
        intervals: moments.count(),
    })
}

//! Evidence before the search: split into fitted and held-out runs, its noise, and readings cleaned
//! of recorder errors.

use crate::base::Base;
use crate::error::Error;
use crate::evidence::{Evidence, Origin, check_number};
use crate::fit::Fit;
use crate::noise::with_remaining_noise;
use crate::progress::{Cancelled, Watch};
use crate::settings;
use crate::weighted::Weighted;
use std::sync::Arc;
use trackdyn_model::VehicleFile;

/// Evidence of the fitted and of the held-out runs.
pub(super) struct Split {
    /// Runs on which everything is fitted and chosen.
    pub seen: Evidence,
    /// Held-out runs; none where none were held out.
    pub unseen: Option<Evidence>,
}

impl Split {
    /// Splits evidence by the indices of held-out runs.
    ///
    /// # Errors
    /// Too few segments to fit, or none in the held-out runs.
    pub fn new(evidence: &Evidence, held_out: &[usize]) -> Result<Self, Error> {
        let is_held_out: Vec<bool> =
            (0..evidence.runs().len()).map(|run| held_out.contains(&run)).collect();
        let is_seen: Vec<bool> = is_held_out.iter().map(|held_out| !held_out).collect();
        let seen = evidence.of_runs(&is_seen);
        let is_drive = matches!(seen.origin(), Origin::Drive(_));
        let needed = evidence.settings().evidence.min_segments;
        if is_drive {
            check_number(seen.samples(), needed)?;
        }
        let unseen = (!held_out.is_empty()).then(|| evidence.of_runs(&is_held_out));
        if unseen.as_ref().is_some_and(|unseen| unseen.samples().is_empty()) {
            return Err(Error::NothingHeldOut);
        }
        Ok(Self { seen, unseen })
    }
}

/// Evidence with the noise that remains beside a base model.
pub(super) struct InNoise {
    /// The evidence.
    pub seen: Weighted,
    /// The base, fitted with the noise that was measured without a model.
    pub base: Base,
}

impl InNoise {
    /// Estimates the noise of evidence from the residuals of a vehicle's base model.
    ///
    /// # Errors
    /// Evidence without turning, or a vehicle for which no motion exists.
    pub fn of(seen: Evidence, file: &VehicleFile, watch: &Watch) -> Result<Self, Error> {
        let measured = Weighted::new(seen);
        let base = Base::new(file, &measured, watch)?;
        if let Some(reason) = base.as_filed.mechanics.failure() {
            return Err(reason.clone().into());
        }
        if !turns(&base.as_filed, &measured.settings().base) {
            return Err(Error::NoTurning);
        }
        Ok(Self { seen: with_remaining_noise(&measured, &base.fit, watch)?, base })
    }
}

/// Evidence with cleaned readings, where cleaning helped.
pub(super) struct Cleaned {
    /// Evidence of the fitted runs.
    pub seen: Weighted,
    /// Evidence of the held-out runs.
    pub unseen: Option<Evidence>,
    /// The base, fitted to the readings as they are now.
    pub base: Base,
}

impl Cleaned {
    /// Removes late stamps, then held speeds, then encoder ticks: a fit would mistake each for a
    /// drive lag. A cleaning is kept unless the fit becomes worse. Noise is estimated anew at the
    /// end, where one was kept.
    ///
    /// # Errors
    /// [`Cancelled`], by the observer of the watch.
    pub fn of(
        seen: Weighted,
        unseen: Option<Evidence>,
        base: Base,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let steps = seen.steps();
        let read = Arc::clone(seen.tracks());
        let as_read = Self { seen, unseen, base };
        let even = as_read.unless_worse(Evidence::with_regular_stamps, watch)?;
        let joined = even.unless_worse(Evidence::with_held_readings_joined, watch)?;
        let smooth =
            joined.unless_worse(|evidence| evidence.with_speeds_between_ticks(steps), watch)?;
        if *smooth.seen.tracks() == read {
            return Ok(smooth);
        }
        let seen = with_remaining_noise(&smooth.seen, &smooth.base.fit, watch)?;
        Ok(Self { seen, ..smooth })
    }

    /// Evidence with cleaned readings, unless the base fits worse.
    fn unless_worse(
        self,
        cleaned: impl Fn(&Evidence) -> Evidence,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        watch.go_on()?;
        let tried = self.seen.with_readings(&cleaned);
        if tried.tracks() == self.seen.tracks() {
            return Ok(self);
        }
        let fit = self.base.fit.refitted(&self.seen);
        let again = fit.refitted(&tried);
        let most = self.seen.settings().evidence.max_rise_by_cleaning;
        if again.objective < fit.objective + most {
            let base = Base { fit: again, ..self.base };
            Ok(Self { seen: tried, unseen: self.unseen.as_ref().map(cleaned), base })
        } else {
            Ok(Self { base: Base { fit, ..self.base }, ..self })
        }
    }
}

/// Whether the constant ICRs are determined: needs turning.
fn turns(fit: &Fit, settings: &settings::Base) -> bool {
    let gauge = fit.hypothesis.vehicle.gauge;
    let covariance = &fit.solution.covariance;
    let gap = covariance[(0, 0)] + covariance[(1, 1)] - 2.0 * covariance[(0, 1)];
    gap.sqrt() < settings.max_gap_deviation * gauge
}

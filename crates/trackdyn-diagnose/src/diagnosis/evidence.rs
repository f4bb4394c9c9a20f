//! Evidence before the search: the runs of the fit and those that judge, their noise, and readings
//! without the errors of a recorder.

use crate::base::Base;
use crate::error::Error;
use crate::evidence::{Evidence, Origin};
use crate::fit::Fit;
use crate::noise::with_remaining_noise;
use crate::settings;
use crate::weighted::Weighted;
use trackdyn_model::VehicleFile;

/// Evidence of the fit, and of the runs that judge it.
pub(super) struct Split {
    /// Runs that everything is fitted and chosen on.
    pub seen: Evidence,
    /// Runs that were held out; none where none were.
    pub unseen: Option<Evidence>,
}

impl Split {
    /// Evidence without the runs that are held out, by their indices, and these apart.
    ///
    /// # Errors
    /// Too few segments to fit, or none in runs that are held out.
    pub fn new(evidence: &Evidence, held_out: &[usize]) -> Result<Self, Error> {
        let is_held_out: Vec<bool> =
            (0..evidence.runs().len()).map(|run| held_out.contains(&run)).collect();
        let is_seen: Vec<bool> = is_held_out.iter().map(|held_out| !held_out).collect();
        let seen = evidence.of_runs(&is_seen);
        let is_drive = matches!(seen.origin(), Origin::Drive(_));
        let needed = evidence.settings().evidence.min_segments;
        if is_drive && seen.samples().len() < needed {
            let durations = seen.samples().iter().map(|sample| sample.duration);
            return Err(Error::too_few_segments(durations, needed));
        }
        let unseen = (!held_out.is_empty()).then(|| evidence.of_runs(&is_held_out));
        if unseen.as_ref().is_some_and(|unseen| unseen.samples().is_empty()) {
            return Err(Error::NothingHeldOut);
        }
        Ok(Self { seen, unseen })
    }
}

/// Evidence in the noise that is left beside a base.
pub(super) struct InNoise {
    /// The evidence.
    pub seen: Weighted,
    /// The base, as it is in the noise that was measured without a model.
    pub base: Base,
}

impl InNoise {
    /// The evidence in the noise that a vehicle's base leaves.
    ///
    /// # Errors
    /// Evidence without turning, or a vehicle that cannot move so.
    pub fn of(seen: Evidence, file: &VehicleFile) -> Result<Self, Error> {
        let measured = Weighted::new(seen);
        let base = Base::new(file, &measured);
        if let Some(reason) = base.as_filed.mechanics.failure() {
            return Err(Error::NoMotion(reason.to_owned()));
        }
        if !turns(&base.as_filed, &measured.settings().base) {
            return Err(Error::NoTurning);
        }
        Ok(Self { seen: with_remaining_noise(&measured, &base.fit), base })
    }
}

/// Evidence with the readings that stand.
pub(super) struct Cleaned {
    /// The evidence of the fit.
    pub seen: Weighted,
    /// That of the runs that judge.
    pub unseen: Option<Evidence>,
}

impl Cleaned {
    /// Readings without late stamps, then without ticks: both are noise that a lag of the drive
    /// would smooth. Readings changed so stand unless they explain less.
    pub fn of(seen: Weighted, unseen: Option<Evidence>, base: &Base) -> Self {
        let steps = seen.steps();
        let as_read = Self { seen, unseen };
        let even = as_read.unless_worse(base, Evidence::with_regular_stamps);
        even.unless_worse(base, |evidence| evidence.with_speeds_between_ticks(steps))
    }

    /// The evidence with other readings, in the noise that is left beside them, unless they explain
    /// less.
    fn unless_worse(self, base: &Base, cleaned: impl Fn(&Evidence) -> Evidence) -> Self {
        let base = base.refitted(&self.seen);
        let tried = self.seen.with_readings(&cleaned);
        let again = base.refitted(&tried);
        let most = self.seen.settings().evidence.max_rise_by_cleaning;
        if again.fit.objective < base.fit.objective + most {
            let seen = with_remaining_noise(&tried, &again.fit);
            Self { seen, unseen: self.unseen.as_ref().map(cleaned) }
        } else {
            self
        }
    }
}

/// Whether the constant ICRs are determined at all.
fn turns(fit: &Fit, settings: &settings::Base) -> bool {
    let gauge = fit.hypothesis.vehicle.gauge;
    let covariance = &fit.solution.covariance;
    let gap = covariance[(0, 0)] + covariance[(1, 1)] - 2.0 * covariance[(0, 1)];
    gap.sqrt() < settings.max_gap_deviation * gauge
}

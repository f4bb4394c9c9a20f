//! Departure of the transient from the stationary motion.
//!
//! # Law
//! Transient minus stationary motion over each sample. Around the parameters θ₀ that were simulated
//! it is linear in the free ones, d(θ) = d(θ₀) + Σ (θ − θ₀) ∂d/∂θ, used within `mechanics.reach`,
//! and over any distance during a fit.

use super::simulated::{Case, Inertia, are_same, size};
use super::slope::{self, Slope};
use crate::evidence::Sample;
use crate::hypothesis::Unknown;
use crate::settings;
use crate::surface::Surface;
use std::sync::Arc;
use trackdyn_core::{Stopped, Twist};
use trackdyn_model::effect::Card;
use trackdyn_model::{ActiveEffect, Drive, Effects};

/// Largest distances to the simulated parameters over which a departure is extrapolated, in typical
/// sizes.
#[derive(Clone, Copy)]
pub struct Within {
    /// For parameters with a known slope.
    known: f64,
    /// For all others.
    unknown: f64,
    /// For the lag of the belts, s.
    late: f64,
}

impl Within {
    /// Near enough for the end of a fit.
    pub fn reach(settings: &settings::Mechanics) -> Self {
        let settings::Mechanics { reach, max_lag_change, .. } = *settings;
        Self { known: reach, unknown: reach, late: max_lag_change }
    }

    /// During a fit: any distance where slopes are known.
    pub fn the_way(settings: &settings::Mechanics) -> Self {
        Self { known: f64::MAX, unknown: settings.reach_without_slope, late: f64::MAX }
    }

    /// A finite-difference step of any size.
    pub const A_STEP: Self = Self { known: f64::MAX, unknown: f64::MAX, late: f64::MAX };

    /// Whether any distance is a step of a difference quotient.
    pub fn is_a_step(self) -> bool {
        self.unknown == f64::MAX
    }

    /// Whether a departure is extrapolated over this distance in a parameter with a known slope.
    pub fn knows(self, distance: f64) -> bool {
        distance.abs() <= self.known
    }
}

/// Inertial departure, valid near the simulated parameters.
#[derive(Clone)]
pub struct InertiaNear {
    at: Arc<Inertia>,
    /// Its derivatives by the free parameters.
    slopes: Vec<Arc<Slope>>,
    /// Extrapolated change of each sample; none at the simulated parameters themselves.
    shift: Option<Arc<Vec<Twist>>>,
}

impl InertiaNear {
    /// Departure simulated for this case, without derivatives. `inert` are the effects of inertia.
    pub fn here(inert: Vec<ActiveEffect>, case: &Case) -> Result<Self, Stopped> {
        let at = Inertia::new(inert, case)?;
        at.forget_steps();
        Ok(Self { at: Arc::new(at), slopes: Vec::new(), shift: None })
    }

    /// Departure of a hypothesis: extrapolated from `before` where it is near and all slopes are
    /// known, otherwise simulated. `inert` are the effects of inertia; slopes by the `free`
    /// unknowns are computed where missing, at a pose delay of `delay`, s.
    pub fn beside(
        before: Option<&Self>,
        inert: Vec<ActiveEffect>,
        case: &Case,
        free: &[Unknown],
        delay: f64,
        within: Within,
    ) -> Result<Self, Stopped> {
        let knows = |near: &Self| free.iter().all(|by| near.slope(*by).is_some());
        let known = before.filter(|before| knows(before));
        if let Some(near) = known.and_then(|known| known.moved(&inert, case, within)) {
            return Ok(near);
        }
        let known = before.filter(|before| before.at.is_for(&inert, case));
        let at = match known {
            Some(known) => Arc::clone(&known.at),
            None => Arc::new(Inertia::new(inert, case)?),
        };
        // Slopes of a clearly different robot mislead: moments of inertia are quadratic in a
        // radius.
        let alike = |slope: &&Arc<Slope>| slope.at.is_alike(&at);
        let before = before.map_or(&[][..], |before| &before.slopes);
        let mut slopes: Vec<Arc<Slope>> = before.iter().filter(alike).cloned().collect();
        let is_missing = |by: &&Unknown| slopes.iter().all(|slope| slope.by != **by);
        let missing: Vec<Unknown> = free.iter().filter(is_missing).copied().collect();
        if !missing.is_empty() {
            let steps = at.fine_steps()?;
            let found = slope::slopes(&missing, (&at, &steps), case, delay);
            slopes.extend(found.into_iter().map(Arc::new));
        }
        Ok(Self { at, slopes, shift: None })
    }

    /// Forgets the steps of the simulation, which slopes and the search for starts need.
    pub fn forget_steps(&self) {
        self.at.forget_steps();
    }

    /// Departure extrapolated to a hypothesis; none where its inertial effects differ, or it is
    /// farther away than `within` allows.
    pub fn moved(&self, inert: &[ActiveEffect], case: &Case, within: Within) -> Option<Self> {
        let late = self.at.lag_change(case.drive);
        let is_near = are_same(&self.at.inert, inert) && self.at.is_close(case.vehicle);
        if !is_near || !self.at.drives_as(case) || late > within.late {
            return None;
        }
        let settings = case.settings();
        let size = |by: Unknown| size(by, case.vehicle, settings);
        let nearly = |by: Unknown, change: f64| match by {
            Unknown::Cog(_) => change.abs() < settings.max_vehicle_change * case.vehicle.gauge,
            _ => change.abs() <= within.unknown * size(by) && !needs_slope(by, inert),
        };
        let mut shift: Option<Vec<Twist>> = None;
        for (by, change) in self.at.changes(case.vehicle, case.model.effects()) {
            match self.slope(by) {
                Some(slope) if within.knows(change / size(by)) => {
                    let still = || vec![Twist::zero(); slope.change.len()];
                    let sums = shift.get_or_insert_with(still);
                    for (sum, slope) in sums.iter_mut().zip(&slope.change) {
                        *sum += *slope * change;
                    }
                }
                None if nearly(by, change) => {}
                _ => return None,
            }
        }
        Some(Self { shift: shift.map(Arc::new), ..self.clone() })
    }

    fn slope(&self, by: Unknown) -> Option<&Slope> {
        self.slopes.iter().map(Arc::as_ref).find(|slope| slope.by == by)
    }

    /// The departure at the simulated parameters.
    pub fn unmoved(&self) -> Self {
        Self { shift: None, ..self.clone() }
    }

    /// Change of the departure by shear-stress laws, at each reading, at the simulated parameters.
    /// `with` is the table of stationary motions with the laws, `case` the robot without.
    pub fn sheared(&self, laws: &Effects, with: &Surface, case: &Case) -> Vec<Vec<Twist>> {
        let range = case.settings().speed_range;
        let without = Surface::new(case.model, case.largest, range, Some(with));
        self.at.sheared(laws, [with, &without])
    }

    /// Change of the twist (paper's frame) during each sample by each axis of the twist with which
    /// its run begins, at a pose delay, s.
    ///
    /// # Errors
    /// The simulation fails.
    pub fn changes_by_starts(
        &self,
        samples: &[Sample],
        delay: f64,
    ) -> Result<[Vec<Twist>; 3], Stopped> {
        let changes = self.at.changes_by_starts()?;
        let of = |twists: &Vec<Vec<Twist>>| {
            samples.iter().map(|sample| self.at.mean_over(sample, delay, twists)).collect()
        };
        Ok(changes.each_ref().map(of))
    }

    /// Departure of the twist (paper's frame) from the stationary one with which each run begins.
    pub fn starts(&self) -> Option<&[Twist]> {
        self.at.starts.as_deref()
    }

    /// Whether slopes beside one serve beside the other.
    pub fn is_alike(&self, other: &Self) -> bool {
        self.at.is_alike(&other.at)
    }

    /// Whether both come from one transient simulation.
    pub fn is_from(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.at, &other.at)
    }

    /// Departure of the twist (paper's frame) during each sample, for the belt lag of `drive` and a
    /// pose delay, s.
    pub fn departures(&self, samples: &Arc<[Sample]>, drive: &Drive, delay: f64) -> Arc<[Twist]> {
        let departures = self.at.departures(samples, delay + self.at.later(drive));
        let Some(shift) = &self.shift else { return departures };
        departures.iter().zip(&**shift).map(|(departure, shift)| *departure + *shift).collect()
    }
}

/// Whether any change of a parameter, however small, needs a slope: it belongs to one of these
/// effects, to one that moves the load as the robot accelerates, or to the vehicle.
fn needs_slope(by: Unknown, effects: &[ActiveEffect]) -> bool {
    let is_one = |card: &Card| effects.iter().any(|effect| effect.card().id == card.id);
    by.card().is_none_or(|card| is_one(card) || card.moves_load())
}

#[cfg(test)]
mod tests {
    use crate::evidence::Evidence;
    use crate::evidence::planned::{PlannedRun, READINGS};
    use crate::hypothesis::Hypothesis;
    use crate::mechanics::{Instruments, Mechanics};
    use crate::plan::assumed_noise;
    use crate::settings::Settings;
    use nalgebra::Vector3;
    use trackdyn_core::{Pose, real};
    use trackdyn_model::VehicleFile;
    use trackdyn_recording::TrackSample;

    /// Turns with speeds up to `most`, m/s.
    fn turning(most: f64) -> Evidence {
        let reading = |k: usize| {
            let t = 0.03 * real(k);
            TrackSample { t, v_left: most * (3.0 * t).sin(), v_right: most * (2.0 * t).cos() }
        };
        let tracks = (0..=20 * READINGS).map(reading).collect();
        let run = PlannedRun { tracks, pose: Pose::default(), blocks: vec![0] };
        let (noise, settings) = (assumed_noise(1e-3, 1e-3), Settings::default());
        Evidence::planned(&[run], noise, 0.0, &settings, |evidence| {
            vec![Vector3::zeros(); evidence.samples().len()]
        })
    }

    /// A motion in time is that of its readings: cleaned ones have another.
    #[test]
    fn a_departure_is_not_reused_for_other_readings() {
        let [before, cleaned] = [0.7, 0.5].map(turning);
        let file = VehicleFile::auriga_alpha();
        let robot = Hypothesis::filed(&file, &Settings::default().prior);
        let robot = robot.with_effect("yaw-inertia".parse().expect("an effect"));
        let predicted = |mechanics: Mechanics| {
            let predicted = mechanics.predict(&Instruments::of(&robot), &cleaned);
            assert!(mechanics.failure().is_none());
            predicted
        };
        let known = Mechanics::new(&robot, &before);
        let beside = predicted(Mechanics::beside(Some(&known), &robot, &cleaned));
        let anew = predicted(Mechanics::new(&robot, &cleaned));
        for (beside, anew) in beside.iter().zip(&anew) {
            assert!((beside - anew).norm() < 1e-6, "{beside} {anew}");
        }
    }
}

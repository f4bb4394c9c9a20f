//! How noise is told from what driving could explain.

use trackdyn_core::settings_group;
use trackdyn_estimate::restricted_likelihood::Search;
use trackdyn_estimate::variances::Climb;

settings_group! {
    /// How noise is told from what driving could explain.
    Noise {
        /// Degrees of freedom of the noise's heavy tails.
        t_degrees: f64 = 5.0, "", [1.0, 1e6],
            "Outliers then count little.",
            "Higher: outliers raise the noise.";
        /// Smallest deviations of a pose, and of a second's walk.
        min_deviations: [f64; 2] = [3e-4, 1e-4], "m, rad", [0.0, 1.0],
            "Motions in time err by a third.",
            "Lower: arithmetic looks like physics; higher: power is lost.";
        /// Squared whitened residual from which a pose may be an outlier.
        min_outlier_square: f64 = 30.7, "", [3.0, 1e6],
            "Chance: 1e-6.",
            "Lower: physics is thrown away; higher: bad poses stay.";
        /// Joint square of both samples beside it up to which it is one.
        max_pair_square: f64 = 11.3, "", [0.0, 1e6],
            "Chance: 1 %.",
            "Higher: slip is thrown away.";
        /// Samples behind an outlier that wait for the next round.
        outlier_distance: usize = 3, "", [0.0, 100.0],
            "Its error reaches them.",
            "Lower: good samples fall with it.";
        /// Part of the residuals that contrasts may fit.
        max_fitted_share: f64 = 0.5, "", [0.01, 0.99],
            "Noise needs the rest.",
            "Lower: physics passes for noise.";
        /// Slip, over twice the largest speed, in which friction may settle.
        friction_scales: [f64; 2] = [0.06, 0.2], "", [1e-3, 10.0],
            "As in the catalogue.",
            "Friction of another scale passes for a walk.";
        /// Factor by which a run's variance must fall to renew its noise.
        min_variance_ratio: f64 = 1.3, "", [1.0, 1e6],
            "A clear fall.",
            "Higher: a walk hides physics.";
        /// Residuals over noise up to which the noise stays.
        max_residual_scale: f64 = 1.1, "", [1.0, 1e6],
            "A tenth is tolerated.",
            "Higher: unknown physics makes false claims sure.";
        /// First walk variance per second, over the white one.
        start_walk: f64 = 0.03, "1/s", [1e-9, 1e3],
            "Less has no slope.",
            "Lower: no walk is found.";
        /// First heading variance, over the walk's in yaw.
        start_heading: f64 = 0.5, "", [1e-9, 1e3],
            "Less has no slope.",
            "Lower: no heading is found.";
        /// First variance by stamps at the mean speed, over the white one.
        start_stamp: f64 = 0.3, "", [1e-6, 1e6],
            "Less has no slope.",
            "Lower: no stamp error is found.";
        /// Gain of ln likelihood from which stamps have errors.
        min_stamp_gain: f64 = 7.6, "", [0.0, 1e6],
            "Chance: 1e-4.",
            "Higher: jitter passes for waves of the ground.";
        /// Smallest walk, in the unit of start_walk.
        min_walk: f64 = 1e-5, "1/s", [0.0, 1.0],
            "Keeps the filter regular.";
        /// Rounds of fitting columns and finding noise.
        rounds: usize = 3, "", [1.0, 100.0],
            "Each depends on the other.";
        /// Most steps to the likeliest noise.
        max_steps: usize = 60, "", [1.0, 1e4],
            "A cap: the gain ends them.";
        /// Gain of ln likelihood that ends them.
        min_gain: f64 = 0.005, "", [0.0, 10.0],
            "At ten times that, a walk is open by a tenth, and depends on the order of the runs.";
        /// Largest step of a ln variance.
        max_step: f64 = 1.5, "", [0.01, 100.0],
            "Longer ones overshoot.";
        /// Difference step of a ln variance.
        difference: f64 = 1e-3, "", [1e-6, 0.5],
            "Between rounding and curvature.";
    }
}

impl Noise {
    /// How the most likely noise is looked for.
    pub(crate) fn search(&self) -> Search {
        let &Self { max_steps, min_gain, max_step, difference, .. } = self;
        Search {
            climb: Climb { max_steps, min_gain, max_step, difference },
            tails: self.t_degrees,
            start_walk: self.start_walk,
            start_heading: self.start_heading,
            start_stamp: self.start_stamp,
            min_stamp_gain: self.min_stamp_gain,
            min_walk: self.min_walk,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Identification and diagnosis look for noise in one way.
    #[test]
    fn noise_is_looked_for_as_by_default() {
        assert_eq!(Noise::default().search(), Search::default());
    }
}

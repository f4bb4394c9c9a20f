//! Means and standard deviations of ICRs.

use crate::icr::Icrs;

/// Means and standard deviations of a set of ICRs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Number of motions.
    pub count: usize,
    /// Mean ICRs, m.
    pub mean: Icrs,
    /// Standard deviations of x_l, x_r and y, m.
    pub spread: Icrs,
    /// χ of the mean ICRs, eq. (12).
    pub steering_efficiency: f64,
    /// e of the mean ICRs, eq. (13).
    pub eccentricity: f64,
    /// Mean of χ over the motions.
    pub mean_steering_efficiency: f64,
    /// Mean of e over the motions.
    pub mean_eccentricity: f64,
}

impl Statistics {
    /// Statistics of these ICRs for a vehicle with this gauge; none for an empty set.
    pub fn of(icrs: impl Iterator<Item = Icrs>, gauge: f64) -> Option<Self> {
        let all: Vec<Icrs> = icrs.collect();
        #[expect(clippy::cast_precision_loss, reason = "at most four million pairs")]
        let per_motion = 1.0 / all.len() as f64;
        if all.is_empty() {
            return None;
        }
        let mean_of = |of: &dyn Fn(&Icrs) -> f64| all.iter().map(of).sum::<f64>() * per_motion;
        let mean = [0, 1, 2].map(|k| mean_of(&|icrs| icrs.to_array()[k]));
        let variance = [0, 1, 2].map(|k| mean_of(&|icrs| (icrs.to_array()[k] - mean[k]).powi(2)));
        let mean = Icrs::from_array(mean);
        Some(Self {
            count: all.len(),
            mean,
            spread: Icrs::from_array(variance.map(f64::sqrt)),
            steering_efficiency: mean.steering_efficiency(gauge),
            eccentricity: mean.eccentricity(),
            mean_steering_efficiency: mean_of(&|icrs| icrs.steering_efficiency(gauge)),
            mean_eccentricity: mean_of(&Icrs::eccentricity),
        })
    }
}

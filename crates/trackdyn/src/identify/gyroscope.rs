//! What a gyroscope adds to an identification.

use trackdyn_estimate::gyroscope::Unfit;
use trackdyn_estimate::identification::{Options, icrs_alone};
use trackdyn_estimate::{Gyroscope, Interval};
use trackdyn_recording::Recording as Motion;

/// What a gyroscope adds to an identification.
#[derive(Clone, Debug)]
pub struct GyroscopeUse {
    /// What it tells of the yaw of the poses, or why it does not serve.
    pub found: Result<Gyroscope, Unfit>,
    /// x_r − x_l without it, m; none where the recording does not determine it.
    pub gap_without_it: Option<Interval>,
}

impl GyroscopeUse {
    pub(super) fn new(found: Result<Gyroscope, Unfit>, raw: &Motion, options: &Options) -> Self {
        let without = found.is_ok().then(|| icrs_alone(raw, options).ok()).flatten();
        Self { found, gap_without_it: without.map(|estimate| estimate.gap()) }
    }
}

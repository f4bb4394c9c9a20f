//! A recording whose gyroscope corrects the yaw of its poses.

use super::{Recording, Seen};
use std::borrow::Cow;
use trackdyn_estimate::gyroscope::{self, Unfit};
use trackdyn_estimate::{Clock, Gyroscope, clock, with_gyroscope};
use trackdyn_recording::Recording as Motion;

impl Recording {
    /// This recording with the yaw of its poses corrected by its gyroscope, where it has one that
    /// serves; `tau` is the time by which poses lag behind the track speeds, s, where it is known.
    /// Its fingerprint stays.
    pub fn with_gyroscope(&self, tau: Option<f64>) -> Self {
        let usable = self.motion().filter(|motion| motion.has_positions());
        let (Some(motion), None) = (usable, &self.gyroscope) else { return self.clone() };
        let Ok(clock) = Clock::of(motion, tau, &clock::Settings::default()) else {
            return self.clone();
        };
        match with_gyroscope(motion, clock.tau(), &gyroscope::Settings::default()) {
            Ok(corrected) => {
                let seen = Seen::Motion(corrected.recording);
                let gyroscope = Some(Ok(corrected.gyroscope));
                Self { seen, gyroscope, path: self.path.clone(), time: self.time }
            }
            Err(unfit) => Self { gyroscope: Some(Err(unfit)), ..self.clone() },
        }
    }

    /// This recording, or where it is wanted [the one that its gyroscope
    /// corrects](Recording::with_gyroscope).
    pub(crate) fn corrected(&self, by_gyroscope: bool, tau: Option<f64>) -> Cow<'_, Self> {
        if by_gyroscope { Cow::Owned(self.with_gyroscope(tau)) } else { Cow::Borrowed(self) }
    }

    /// Relative error that all yaw of its poses shares, 1: the standard deviation of the scale of
    /// the gyroscope that corrects or makes them.
    pub(crate) fn yaw_scale(&self) -> f64 {
        let served = self.gyroscope().and_then(|found| found.as_ref().ok());
        let made = self.motion().map_or(0.0, Motion::yaw_scale_deviation);
        served.map_or(0.0, |found| found.scale_deviation).hypot(made)
    }

    /// What its gyroscope tells of the yaw of its poses, or why it does not serve; none where it
    /// was not asked ([`Recording::with_gyroscope`]).
    pub fn gyroscope(&self) -> Option<&Result<Gyroscope, Unfit>> {
        self.gyroscope.as_ref()
    }
}

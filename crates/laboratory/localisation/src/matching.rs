//! The motion between two scans.
//!
//! One scan is turned into lines ([`Reference`]), and each return of the other is held against the
//! line it looks at: residual ρ − h, along the beam, where the noise is. What the lines do not know
//! about themselves is taken into account exactly: they are unknowns beside the motion, and are
//! eliminated from the normal equations.
//!
//! The match stands on the scans alone. The guess opens the search, and takes the place of the
//! scans in directions about which they say less than it does.

use crate::error::{Error, positive};
use crate::estimate::PoseEstimate;
use crate::reference::Reference;
use crate::scan::Scan;
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::Pose;

mod association;
mod descent;
mod normal;
mod observable;

/// How scans are matched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatchOptions {
    /// Standard deviation of a range, m.
    pub range_noise: f64,
    /// Standard deviation of the guess.
    pub guess: Deviation,
}

/// Standard deviation of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Of x and of y, m.
    pub position: f64,
    /// Of the yaw, rad.
    pub yaw: f64,
}

impl Default for MatchOptions {
    /// A laser with 10 mm noise, and the guess of a robot that slips by a third at 1 m/s and 1
    /// rad/s, over 0.27 s.
    fn default() -> Self {
        Self { range_noise: 0.01, guess: Deviation { position: 0.1, yaw: 0.1 } }
    }
}

impl MatchOptions {
    pub(crate) fn check(&self) -> Result<(), Error> {
        positive("range_noise", self.range_noise)?;
        positive("guess.position", self.guess.position)?;
        positive("guess.yaw", self.guess.yaw)?;
        Ok(())
    }

    /// Standard deviations of the guess, along (x, y, yaw).
    fn deviations(&self) -> Vector3<f64> {
        Vector3::new(self.guess.position, self.guess.position, self.guess.yaw)
    }
}

/// What became of a match.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Status {
    /// The scans determine the motion.
    Converged,
    /// The scans say less than the guess in some direction, as along a corridor: there the motion
    /// and its covariance are those of the guess.
    Degenerate {
        /// The displacement (m, m, rad) that the scans see least, one standard deviation of the
        /// guess long.
        direction: [f64; 3],
    },
    /// Fewer than half of the returns that look at a known line agree with it, or fewer than a
    /// quarter of all returns do: the scans do not show the same place, the guess was too far off,
    /// or there is little that is straight. The motion and its covariance are those of the guess.
    Unmatched,
    /// The residuals have more than twice the variance that the noise explains: the range noise is
    /// understated, or small steps in the walls were mistaken for each other. The motion and its
    /// covariance are those of the guess.
    Inconsistent,
    /// The iteration did not come to rest. The motion and its covariance are those of the guess.
    NotConverged,
}

/// The motion of a sensor between two scans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Match {
    /// Pose of the scan in the reference's frame, with covariance.
    pub motion: PoseEstimate,
    /// What it is worth.
    pub status: Status,
    /// Returns that agree with a line.
    pub matched: usize,
    /// Returns that look at a known line.
    pub candidates: usize,
    /// All returns of the scan.
    pub returns: usize,
    /// Squared residuals over their variance, per degree of freedom: near 1 where the range noise
    /// is as stated and the lines are straight.
    pub reduced_chi_square: f64,
}

impl Match {
    /// Share of the returns that agree with a line, 0 to 1.
    #[expect(clippy::cast_precision_loss, reason = "returns are few")]
    pub fn overlap(&self) -> f64 {
        self.matched as f64 / self.returns.max(1) as f64
    }
}

impl Reference {
    /// Matches a scan whose pose in the reference's frame is about `guess`.
    ///
    /// # Assumes
    /// Range noise that is normal and independent from beam to beam, snapshots, and surfaces that
    /// are straight. What does not fit, such as a person walking by, is left out.
    ///
    /// # Errors
    /// [`Error::Value`] for options, or a guess, that cannot be.
    ///
    /// # Sources
    /// Residuals to lines: Censi, An ICP variant using a point-to-line metric, ICRA 2008.
    /// Covariance that counts the noise of both scans: Censi, An accurate closed-form estimate of
    /// ICP's covariance, ICRA 2007. Degenerate directions: Zhang, Kaess and Singh, On degeneracy of
    /// optimization-based state estimation problems, ICRA 2016.
    pub fn locate(
        &self,
        scan: &Scan,
        guess: &Pose,
        options: &MatchOptions,
    ) -> Result<Match, Error> {
        options.check()?;
        crate::error::finite("guess, x", guess.x)?;
        crate::error::finite("guess, y", guess.y)?;
        crate::error::finite("guess, yaw", guess.yaw)?;
        let returns: Vec<_> = scan.returns().collect();
        let first = descent::descend(self, &returns, guess, guess, options);
        if first.is_good() {
            return Ok(first);
        }
        // A wrong valley: start again to both sides, as far as the guess may be off.
        let yaw = options.guess.yaw;
        let again = [1.0, -1.0, 2.0, -2.0].map(|off| {
            let start = Pose::new(guess.x, guess.y, guess.yaw + off * yaw);
            descent::descend(self, &returns, guess, &start, options)
        });
        let all = std::iter::once(first).chain(again);
        let good = all.filter(Match::is_good);
        Ok(good.max_by_key(|found| found.matched).unwrap_or(first))
    }
}

impl Match {
    /// Whether motion and covariance come from the scans.
    pub fn is_good(&self) -> bool {
        matches!(self.status, Status::Converged | Status::Degenerate { .. })
    }

    /// The guess, where nothing better was found.
    fn guess(guess: &Pose, options: &MatchOptions, status: Status, returns: usize) -> Self {
        let deviations = options.deviations();
        let covariance = Matrix3::from_diagonal(&deviations.component_mul(&deviations));
        Self {
            motion: PoseEstimate { pose: *guess, covariance },
            status,
            matched: 0,
            candidates: 0,
            returns,
            reduced_chi_square: f64::NAN,
        }
    }
}

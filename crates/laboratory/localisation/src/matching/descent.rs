//! From a start to the best pose.
//!
//! First wide: the pose has the covariance of the guess, which shrinks from step to step, and with
//! it the window in which lines are looked for and the gate. Then close: each return belongs to the
//! line it looks at. At last the pairs are kept, and the pose is polished on them.

use crate::PoseEstimate;
use crate::matching::association::{self, Association, Normals};
use crate::matching::normal::{self, Normal};
use crate::matching::observable::{self, Weak};
use crate::matching::{Match, MatchOptions, Status};
use crate::reference::Reference;
use crate::scan::Return;
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::Pose;

/// Number of wide steps; each halves the deviations, at last to a hundredth of the guess's, about
/// what a match is exact to.
const WIDE_STEPS: usize = 7;
/// Largest number of close steps; where pairs still come and go after them, the pose moves by less
/// than its deviation.
const MAX_CLOSE_STEPS: usize = 20;
/// Largest number of steps on kept pairs. Newton's method gains digits twofold, so that four
/// suffice.
const MAX_POLISH_STEPS: usize = 10;

/// Largest squared residual per degree of freedom. With 100 returns noise reaches 1.4 in one of
/// 1000 matches; twice the variance leaves room for a range noise that is stated too small by 40 %.
const MAX_REDUCED_CHI_SQUARE: f64 = 2.0;

struct Problem<'a> {
    reference: &'a Reference,
    normals: Normals,
    returns: &'a [Return],
    guess: &'a Pose,
    options: &'a MatchOptions,
}

/// Matches from `start`.
pub(super) fn descend(
    reference: &Reference,
    returns: &[Return],
    guess: &Pose,
    start: &Pose,
    options: &MatchOptions,
) -> Match {
    let normals = association::normals(reference.lines());
    let problem = Problem { reference, normals, returns, guess, options };
    let failed = |status| Match::guess(guess, options, status, returns.len());
    let Some(near) = problem.wide(*start) else { return failed(Status::NotConverged) };
    let (pose, association) = match problem.close(near) {
        Ok(found) => found,
        Err(status) => return failed(status),
    };
    match problem.polish(pose, &association) {
        None => failed(Status::NotConverged),
        Some(found) if found.reduced_chi_square > MAX_REDUCED_CHI_SQUARE => {
            let Match { matched, candidates, reduced_chi_square, .. } = found;
            Match { matched, candidates, reduced_chi_square, ..failed(Status::Inconsistent) }
        }
        Some(found) => found,
    }
}

impl Problem<'_> {
    fn wide(&self, start: Pose) -> Option<Pose> {
        let deviations = self.options.deviations();
        let mut covariance = Matrix3::from_diagonal(&deviations.component_mul(&deviations));
        let mut pose = start;
        for _ in 0..WIDE_STEPS {
            let pairs = association::wide(
                self.reference,
                &self.normals,
                self.returns,
                &pose,
                &covariance,
                self.options.range_noise,
            );
            // Beside the pairs stands the pose itself, with its covariance: what no pair sees
            // stays.
            let mut information = covariance.try_inverse()?;
            let mut gradient = Vector3::zeros();
            for (pair, beam, variance) in pairs {
                let residual = self.returns[pair.hit].range - beam.range;
                information += beam.by_pose * beam.by_pose.transpose() / variance;
                gradient += beam.by_pose * (residual / variance);
            }
            pose = moved(&pose, &(information.cholesky()?.solve(&gradient)));
            covariance /= 4.0;
        }
        Some(pose)
    }

    /// Steps until the pose moves by less than a hundredth of its deviation.
    fn close(&self, mut pose: Pose) -> Result<(Pose, Association), Status> {
        for step in 0.. {
            let association = association::close(
                self.reference,
                &self.normals,
                self.returns,
                &pose,
                self.options.range_noise,
            );
            let (matched, returns) = (association.pairs.len(), self.returns.len());
            if matched == 0 || 2 * matched < association.candidates || 4 * matched < returns {
                return Err(Status::Unmatched);
            }
            let normal = self.equations(&association, &pose).ok_or(Status::NotConverged)?;
            let weak = self.weak(&normal);
            let (information, gradient) = self.with_guess(&normal, weak.as_ref(), &pose);
            let cholesky = information.cholesky().ok_or(Status::NotConverged)?;
            let delta = cholesky.solve(&gradient);
            pose = moved(&pose, &delta);
            let size = delta.dot(&(information * delta)).sqrt();
            if size < 0.01 || (step >= MAX_CLOSE_STEPS && size < 1.0) {
                return Ok((pose, association));
            }
            if step >= MAX_CLOSE_STEPS {
                break;
            }
        }
        Err(Status::NotConverged)
    }

    fn polish(&self, mut pose: Pose, association: &Association) -> Option<Match> {
        let weak = self.weak(&self.equations(association, &pose)?);
        for _ in 0..MAX_POLISH_STEPS {
            let normal = self.equations(association, &pose)?;
            let (information, gradient) = self.with_guess(&normal, weak.as_ref(), &pose);
            let cholesky = information.cholesky()?;
            let delta = cholesky.solve(&gradient);
            pose = moved(&pose, &delta);
            // A millionth of the deviation.
            if delta.dot(&(information * delta)) < 1e-12 {
                let status = weak.map_or(Status::Converged, |weak| Status::Degenerate {
                    direction: weak.least.into(),
                });
                return Some(Match {
                    motion: PoseEstimate { pose, covariance: cholesky.inverse() },
                    status,
                    matched: association.pairs.len(),
                    candidates: association.candidates,
                    returns: self.returns.len(),
                    reduced_chi_square: reduced(normal.chi_square, association.pairs.len()),
                });
            }
        }
        None
    }

    fn equations(&self, association: &Association, pose: &Pose) -> Option<Normal> {
        normal::equations(
            self.reference,
            &self.normals,
            self.returns,
            &association.pairs,
            pose,
            self.options.range_noise,
        )
    }

    fn weak(&self, normal: &Normal) -> Option<Weak> {
        observable::weak(normal, &self.options.deviations())
    }

    /// The normal equations, and the guess in the weak directions.
    fn with_guess(
        &self,
        normal: &Normal,
        weak: Option<&Weak>,
        pose: &Pose,
    ) -> (Matrix3<f64>, Vector3<f64>) {
        let Some(weak) = weak else { return (normal.information, normal.gradient) };
        let off =
            Vector3::new(self.guess.x - pose.x, self.guess.y - pose.y, self.guess.yaw - pose.yaw);
        (normal.information + weak.information, normal.gradient + weak.information * off)
    }
}

fn moved(pose: &Pose, delta: &Vector3<f64>) -> Pose {
    Pose::new(pose.x + delta[0], pose.y + delta[1], pose.yaw + delta[2])
}

/// Per degree of freedom: one of each return, three of the motion.
#[expect(clippy::cast_precision_loss, reason = "returns are few")]
fn reduced(chi_square: f64, matched: usize) -> f64 {
    chi_square / matched.saturating_sub(3).max(1) as f64
}

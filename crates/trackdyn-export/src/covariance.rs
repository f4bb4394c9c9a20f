//! Covariances of odometry, from the residuals of a replay (schema `trackdyn.odometry/1`).
//!
//! Derivation: `docs/theory/export.md`.

use crate::{EquivalentDrive, Error};
use serde::Deserialize;
use toml::Spanned;
use trackdyn_core::document::{Document, DocumentError};

const SCHEMA: &str = "trackdyn.odometry/1";

/// Time over which residuals are taken, s: noise of the recorded poses counts once in it, and it is
/// shorter than most manoeuvres.
const HORIZON: f64 = 1.0;

/// Smallest number of pieces of that time; with fewer, segments are used.
const MIN_PIECES: usize = 20;

/// Variance of what a robot on the ground does not measure: up and down, roll, pitch; m² and rad².
const UNKNOWN_VARIANCE: f64 = 1e6;

/// Smallest variance, m² and rad²: zero would claim certainty.
const MIN_VARIANCE: f64 = 1e-12;

/// Largest residual, time or distance that is accepted, in m, rad and s.
const MAX_RESIDUAL: f64 = 1e9;

/// Root mean squares of what odometry with one parameter set got wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Residuals {
    /// Path of the file.
    pub source: String,
    /// Whether the parameters were not fitted to the driving that was replayed.
    pub held_out: bool,
    /// Number of pieces behind the residuals.
    pub pieces: usize,
    /// Mean time of a piece, s.
    pub duration: f64,
    /// Of the motion over a piece: along (m), across (m), yaw (rad).
    pub motion: [f64; 3],
    /// Number of runs.
    pub runs: usize,
    /// Mean distance of a run, m.
    pub distance: f64,
    /// Of the place at the end of a run, m.
    pub end_position: f64,
    /// Of the yaw at the end of a run, rad.
    pub end_yaw: f64,
}

/// What is read of an odometry file.
#[derive(Deserialize)]
struct File {
    runs: Vec<i64>,
    distance_m: Spanned<f64>,
    set: Vec<Set>,
    span: Vec<Span>,
}

#[derive(Deserialize)]
struct Set {
    name: String,
    fingerprint: Option<String>,
    held_out: bool,
    end_position_rms_m: Spanned<f64>,
    end_yaw_rms_rad: Spanned<f64>,
}

#[derive(Deserialize)]
struct Span {
    kind: String,
    length_s: Option<f64>,
    count: usize,
    mean_duration_s: Spanned<f64>,
    set: Vec<SetErrors>,
}

#[derive(Deserialize)]
struct SetErrors {
    name: String,
    along_m: Component,
    across_m: Component,
    yaw_rad: Component,
}

#[derive(Deserialize)]
struct Component {
    rms: Estimate,
}

#[derive(Deserialize)]
struct Estimate {
    value: Spanned<f64>,
}

impl Residuals {
    /// Those of the kinematics file with this fingerprint.
    ///
    /// # Errors
    /// A [`DocumentError`] that points at the line and key, or [`Error::NoResiduals`].
    pub fn from_document(
        document: &Document,
        kinematics: &str,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let file: File = document.parse_as(SCHEMA)?;
        let missing = || Error::NoResiduals {
            residuals: document.name().to_owned(),
            fingerprint: kinematics.to_owned(),
        };
        // The first of a file's sets is the whole of it; one without its alphas comes after.
        let is_wanted = |set: &&Set| set.fingerprint.as_deref() == Some(kinematics);
        let set = file.set.iter().find(is_wanted).ok_or_else(missing)?;
        let over = |span: &&Span| span.length_s == Some(HORIZON) && span.count >= MIN_PIECES;
        let span = file.span.iter().find(over);
        let span = span.or_else(|| file.span.iter().find(|span| span.kind == "segment"));
        let span = span.ok_or_else(missing)?;
        let errors = span.set.iter().find(|errors| errors.name == set.name).ok_or_else(missing)?;
        let number = |key, value| checked(document, key, value);
        let duration = number("mean_duration_s", &span.mean_duration_s)?;
        if duration == 0.0 {
            let place = span.mean_duration_s.span();
            return Err(document.value_error(place, "mean_duration_s", "a time above zero").into());
        }
        #[expect(clippy::cast_precision_loss, reason = "a number of runs")]
        let runs = file.runs.len().max(1) as f64;
        Ok(Self {
            source: document.name().to_owned(),
            held_out: set.held_out,
            pieces: span.count,
            duration,
            motion: [
                number("along_m.rms.value", &errors.along_m.rms.value)?,
                number("across_m.rms.value", &errors.across_m.rms.value)?,
                number("yaw_rad.rms.value", &errors.yaw_rad.rms.value)?,
            ],
            runs: file.runs.len(),
            distance: number("distance_m", &file.distance_m)? / runs,
            end_position: number("end_position_rms_m", &set.end_position_rms_m)?,
            end_yaw: number("end_yaw_rms_rad", &set.end_yaw_rms_rad)?,
        })
    }

    /// Diagonal of the twist's covariance in the frame midway between the ICRs, for messages at a
    /// rate, Hz: x, y, z ((m/s)²), roll, pitch, yaw ((rad/s)²).
    ///
    /// # Law
    /// σ² = r²/(T Δt): N = T/Δt messages with independent errors σ Δt add up to r² over T.
    /// Residuals at a point (p_x, p_y) are at most r_along + |p_y| r_yaw and r_across + |p_x|
    /// r_yaw.
    pub fn twist_diagonal(&self, drive: &EquivalentDrive, rate: f64) -> [f64; 6] {
        let [along, across, yaw] = self.motion;
        let [forward, left] = drive.point;
        let variance = |rms: f64| (rms * rms * rate / self.duration).max(MIN_VARIANCE);
        let x = variance(along + left.abs() * yaw);
        let y = variance(across + forward.abs() * yaw);
        [x, y, UNKNOWN_VARIANCE, UNKNOWN_VARIANCE, UNKNOWN_VARIANCE, variance(yaw)]
    }

    /// Diagonal of the pose's covariance at the end of a run of mean length: x, y, z (m²), roll,
    /// pitch, yaw (rad²).
    pub fn pose_diagonal(&self) -> [f64; 6] {
        // Two axes share the distance.
        let place = (self.end_position * self.end_position / 2.0).max(MIN_VARIANCE);
        let yaw = (self.end_yaw * self.end_yaw).max(MIN_VARIANCE);
        [place, place, UNKNOWN_VARIANCE, UNKNOWN_VARIANCE, UNKNOWN_VARIANCE, yaw]
    }
}

/// A number that is not negative, and whose square is a variance.
fn checked(document: &Document, key: &str, value: &Spanned<f64>) -> Result<f64, DocumentError> {
    let number = *value.get_ref();
    if (0.0..=MAX_RESIDUAL).contains(&number) {
        return Ok(number);
    }
    Err(document.value_error(value.span(), key, format!("a number from 0 to {MAX_RESIDUAL:e}")))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::drive::tests::drive;

    /// Residuals with these figures.
    pub(crate) fn residuals() -> Residuals {
        Residuals {
            source: "odometry.toml".to_owned(),
            held_out: true,
            pieces: 100,
            duration: 1.0,
            motion: [0.02, 0.03, 0.04],
            runs: 4,
            distance: 25.0,
            end_position: 0.6,
            end_yaw: 0.3,
        }
    }

    /// An odometry file with one segment of these figures.
    fn file(distance: &str, end: &str, along: &str) -> Document {
        let text = format!(
            "schema = \"{SCHEMA}\"\nruns = [0]\ndistance_m = {distance}\n\
             [[set]]\nname = \"a\"\nfingerprint = \"f\"\nheld_out = true\n\
             end_position_rms_m = {end}\nend_yaw_rms_rad = 0.1\n\
             [[span]]\nkind = \"segment\"\ncount = 100\nmean_duration_s = 0.3\n\
             [[span.set]]\nname = \"a\"\nalong_m.rms.value = {along}\n\
             across_m.rms.value = 0.01\nyaw_rad.rms.value = 0.01\n"
        );
        Document::new("odometry.toml", text)
    }

    #[test]
    fn residuals_are_numbers_whose_squares_are_variances() {
        let read = |document: &Document| Residuals::from_document(document, "f");
        let residuals = read(&file("12.5", "0.6", "0.02")).expect("fine");
        assert_eq!((residuals.distance, residuals.end_position), (12.5, 0.6));
        for (document, key) in [
            (file("-1.0", "0.6", "0.02"), "distance_m = -1.0"),
            (file("nan", "0.6", "0.02"), "distance_m = nan"),
            (file("12.5", "1e200", "0.02"), "end_position_rms_m = 1e200"),
            (file("12.5", "0.6", "-inf"), "along_m.rms.value = -inf"),
        ] {
            let error = read(&document).expect_err(key).to_string();
            assert!(error.contains(key) && error.contains("expected a number from 0"), "{error}");
        }
    }

    #[test]
    fn messages_with_independent_errors_add_up_to_the_residual() {
        let drive = EquivalentDrive { point: [0.0, 0.0], ..drive() };
        for rate in [10.0, 50.0] {
            let [x, y, .., yaw] = residuals().twist_diagonal(&drive, rate);
            // After 1 s: as many messages as the rate, each with a motion of the variance σ²/rate².
            for (variance, rms) in [(x, 0.02), (y, 0.03), (yaw, 0.04)] {
                assert!((rate * variance / (rate * rate) - rms * rms).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn a_point_beside_the_origin_swings_with_the_yaw() {
        let at = |point| EquivalentDrive { point, ..drive() };
        let [x, y, .., yaw] = residuals().twist_diagonal(&at([0.5, -0.25]), 1.0);
        assert!((x - 0.03_f64.powi(2)).abs() < 1e-15 && (y - 0.05_f64.powi(2)).abs() < 1e-15);
        assert!((yaw - 0.04_f64.powi(2)).abs() < 1e-15);
    }

    #[test]
    fn two_axes_share_the_error_at_the_end() {
        let [x, y, .., yaw] = residuals().pose_diagonal();
        assert!((x + y - 0.36).abs() < 1e-15 && (yaw - 0.09).abs() < 1e-15);
    }
}

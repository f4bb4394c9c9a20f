//! The ideal differential drive that a tracked robot is, seen at one point.

use trackdyn_core::PerSide;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_core::frames::ros_from_paper;
use trackdyn_core::rounding::Digits;
use trackdyn_model::icr::Icrs;
use trackdyn_model::kinematics::{KinematicsFile, SeparationFile};

/// The ideal differential drive that a tracked robot is, seen midway between the ICRs of its
/// tracks.
///
/// # Law
/// At the point ((x_l + x_r)/2, y) the twist (7)-(9) is forward (V_l + V_r)/2, lateral 0, yaw rate
/// (V_r − V_l)/(x_r − x_l): that of two wheels x_r − x_l apart.
///
/// # Assumes
/// Constant ICRs.
///
/// # Sources
/// Equations (7)-(9), (12), (20)-(21) of the paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquivalentDrive {
    /// Gauge L of the tracks, m.
    pub gauge: f64,
    /// Separation x_r − x_l of the drive's wheels, m.
    pub separation: f64,
    /// Factors α_l, α_r from measured to true track speeds.
    pub alpha: PerSide<f64>,
    /// The point midway between the ICRs, m from the centre of the contact area, in ROS axes:
    /// forward, left.
    pub point: [f64; 2],
    /// Whether the distance of the ICRs alone is known: [`point`](Self::point) is the origin then.
    pub is_separation_alone: bool,
    /// Whether other parts of the answer contradict these numbers.
    pub is_doubtful: bool,
    /// Sectors of the map for which these constants stand; 0 where the map is not piecewise.
    pub sectors: usize,
}

impl EquivalentDrive {
    /// The drive of a kinematics file (schema `trackdyn.kinematics/1`, or `trackdyn.separation/1`).
    ///
    /// # Errors
    /// A [`DocumentError`] that points at the line and key.
    pub fn from_document(document: &Document) -> Result<Self, DocumentError> {
        if SeparationFile::is_schema_of(document) {
            let file = SeparationFile::from_document(document)?;
            return Ok(Self {
                gauge: *file.gauge_m.get_ref(),
                separation: *file.icr_separation_m.get_ref(),
                alpha: PerSide::new(1.0, 1.0),
                point: [0.0, 0.0],
                is_separation_alone: true,
                is_doubtful: false,
                sectors: 0,
            });
        }
        let file = KinematicsFile::from_document(document)?;
        let kinematics = file.kinematics();
        let Icrs { x_left, x_right, y } = kinematics.icrs;
        let separation = x_right - x_left;
        Ok(Self {
            // L = χ (x_r − x_l), eq. (12)
            gauge: to_nanometres(file.steering_efficiency * separation),
            separation,
            alpha: kinematics.alpha,
            point: ros_from_paper([f64::midpoint(x_left, x_right), y]),
            is_separation_alone: false,
            is_doubtful: file.doubtful,
            sectors: file.sector.len(),
        })
    }

    /// Steering efficiency χ: [`Self::gauge`] over [`Self::separation`], eq. (12).
    pub fn steering_efficiency(&self) -> f64 {
        self.gauge / self.separation
    }
}

/// The length to 1e-9 m: files give χ and the ICRs to twelve decimals, and the gauge shall read
/// 0.42 and not 0.420000000000039. Gauges below that scale keep their digits.
fn to_nanometres(length: f64) -> f64 {
    let rounded = Digits::Decimals(9).round(length);
    if rounded > 0.0 { rounded } else { length }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use trackdyn_core::Twist;
    use trackdyn_core::frames::paper_from_ros;

    /// A file with these numbers; χ belongs to a gauge of 0.42 m.
    pub(crate) const FILE: &str = "schema = \"trackdyn.kinematics/1\"\nframe = \"paper\"\n\
        x_icr_left_m = -0.375377\nx_icr_right_m = 0.457353\ny_icr_m = 0.049235\n\
        steering_efficiency = 0.504365160376\neccentricity = 0.098442\n\
        alpha_left = 0.97\nalpha_right = 1.02\n\
        [source]\ncommand = \"\"\nversion = \"\"\nvehicle = \"\"\nfingerprint = \"\"\n";

    pub(crate) fn drive() -> EquivalentDrive {
        EquivalentDrive::from_document(&Document::new("k.toml", FILE)).expect("a valid file")
    }

    #[test]
    fn the_gauge_comes_out_as_it_went_in() {
        assert_eq!(drive().gauge, 0.42);
        assert!((drive().steering_efficiency() - 0.504_365_160_376).abs() < 1e-12);
    }

    #[test]
    fn at_the_point_the_robot_is_an_ideal_differential_drive() {
        let file = KinematicsFile::from_document(&Document::new("k.toml", FILE)).expect("valid");
        let (kinematics, drive) = (file.kinematics(), drive());
        for (left, right) in [(0.3, 0.9), (-0.5, 0.5), (0.4, 0.4), (0.0, -1.0)] {
            let (v_l, v_r) = (0.97 * left, 1.02 * right);
            let twist: Twist = kinematics.twist(PerSide::new(left, right));
            let [lateral, forward] = twist.velocity_at(paper_from_ros(drive.point));
            assert!(lateral.abs() < 1e-15, "{lateral}");
            assert!((forward - f64::midpoint(v_l, v_r)).abs() < 1e-15);
            assert!((twist.w - (v_r - v_l) / drive.separation).abs() < 1e-15);
        }
    }

    #[test]
    fn factors_that_cannot_be_divided_by_are_refused_with_their_line() {
        for (from, to, start) in [
            ("= 0.504365160376", "= 0.0", "k.toml:6: steering_efficiency = 0.0: expected"),
            ("alpha_left = 0.97", "alpha_left = -1.0", "k.toml:8: alpha_left = -1.0: expected"),
            ("alpha_right = 1.02", "alpha_right = inf", "k.toml:9: alpha_right = inf: expected"),
            ("y_icr_m = 0.049235", "y_icr_m = nan", "k.toml:5: y_icr_m = nan: expected"),
        ] {
            let document = Document::new("k.toml", FILE.replace(from, to));
            let error = EquivalentDrive::from_document(&document).expect_err(to).to_string();
            assert!(error.starts_with(start), "{error}");
        }
    }
}

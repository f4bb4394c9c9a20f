//! The kinematics file, schema `trackdyn.kinematics/1`.

use crate::icr::Icrs;
use crate::kinematics::Kinematics;
use crate::map::{Sector, Statistics};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toml::Spanned;
use trackdyn_core::PerSide;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_core::rounding::Digits;

const SCHEMA: &str = "trackdyn.kinematics/1";
const FRAME: &str = "paper";

/// Digits of the numbers of a file, apart from covariances.
const DIGITS: Digits = Digits::Decimals(12);

/// Provenance of the numbers in a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// The command line.
    pub command: String,
    /// Version of the program.
    pub version: String,
    /// Name of the vehicle.
    pub vehicle: String,
    /// Fingerprint of the vehicle file with its effects, or of the recording.
    pub fingerprint: String,
    /// Fingerprint of the recorded poses, which identifies the fitted drive.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose_fingerprint: Option<String>,
    /// Those of each recording, where several were joined.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joined: Vec<String>,
    /// Name of the recording; none for a map.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recording: Option<String>,
    /// Runs that were used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub runs: Option<String>,
    /// Time used of each of these runs, s from its first reading; none where all was used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_s: Option<[f64; 2]>,
    /// Grid of the map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<GridSource>,
    /// Active effects with their parameters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub effects: Vec<String>,
    /// Seed of the random numbers, if any were drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Bootstrap draws behind probabilities of chance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub draws: Option<usize>,
    /// Number of motions of each kind in the map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motions: Option<BTreeMap<String, usize>>,
    /// What the recording calls the parts of the robot, where it is a bag.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bag: Option<BagSource>,
}

/// What a bag calls the parts of the robot, as they were taken from it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BagSource {
    /// Joints on the left, with a `-` before those that count backwards; empty where track speeds
    /// come from something else.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_joints: Vec<String>,
    /// Joints on the right.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub right_joints: Vec<String>,
    /// Belt travel per radian of these, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wheel_radius_m: Option<f64>,
    /// Topics of the track speeds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub track_topics: Vec<String>,
    /// Topic of the poses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose_topic: Option<String>,
    /// Frame that the poses are expressed in.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parent_frame: Option<String>,
    /// Frame whose poses they are: that of the ICRs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub child_frame: Option<String>,
}

/// The grid of a map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridSource {
    /// Speeds per track.
    pub points: usize,
    /// Largest speed, m/s.
    pub max_speed_m_s: f64,
}

/// A kinematics file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KinematicsFile {
    schema: Spanned<String>,
    frame: Spanned<String>,
    /// x_l, m.
    pub x_icr_left_m: Spanned<f64>,
    /// x_r, m.
    pub x_icr_right_m: Spanned<f64>,
    /// y, m.
    pub y_icr_m: f64,
    /// Whether other parts of the answer contradict these numbers.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub doubtful: bool,
    /// χ of the mean ICRs.
    pub steering_efficiency: f64,
    /// e of the mean ICRs.
    pub eccentricity: f64,
    /// Mean of χ over the map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_steering_efficiency: Option<f64>,
    /// Mean of e over the map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_eccentricity: Option<f64>,
    /// α_l, where fitted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alpha_left: Option<f64>,
    /// α_r, where fitted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alpha_right: Option<f64>,
    /// Covariance of x_l, x_r, y and, where fitted, α_l, α_r, by rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub covariance: Option<Vec<Vec<f64>>>,
    /// Standard deviations over the map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spread: Option<Spread>,
    /// Provenance of the numbers.
    pub source: Source,
    /// One set per sector, for a piecewise constant map.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sector: Vec<SectorTable>,
}

/// Standard deviations of the ICRs over a map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spread {
    /// Of x_l, m.
    pub x_icr_left_m: f64,
    /// Of x_r, m.
    pub x_icr_right_m: f64,
    /// Of y, m.
    pub y_icr_m: f64,
}

/// The parameters of one sector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SectorTable {
    /// Sign of V_l.
    pub sign_left: i8,
    /// Sign of V_r.
    pub sign_right: i8,
    /// Sign of |V_r| − |V_l|.
    pub sign_difference: i8,
    /// x_l, m.
    pub x_icr_left_m: f64,
    /// x_r, m.
    pub x_icr_right_m: f64,
    /// y, m.
    pub y_icr_m: f64,
    /// χ.
    pub steering_efficiency: f64,
    /// e.
    pub eccentricity: f64,
}

impl KinematicsFile {
    /// The file of a map.
    pub fn of_map(statistics: &Statistics, sectors: &[Sector], source: Source) -> Self {
        let Statistics { mean, spread, .. } = *statistics;
        Self {
            mean_steering_efficiency: Some(DIGITS.round(statistics.mean_steering_efficiency)),
            mean_eccentricity: Some(DIGITS.round(statistics.mean_eccentricity)),
            spread: Some(Spread {
                x_icr_left_m: DIGITS.round(spread.x_left),
                x_icr_right_m: DIGITS.round(spread.x_right),
                y_icr_m: DIGITS.round(spread.y),
            }),
            sector: sectors.iter().map(SectorTable::of).collect(),
            ..Self::of_icrs(&mean, statistics.steering_efficiency, source)
        }
    }

    /// The file with α, the ratio of belt to encoder speeds; unchanged where both are 1.
    pub fn with_alpha(self, alpha: PerSide<f64>) -> Self {
        if alpha == PerSide::new(1.0, 1.0) {
            return self;
        }
        let (left, right) = (DIGITS.round(alpha.left), DIGITS.round(alpha.right));
        Self { alpha_left: Some(left), alpha_right: Some(right), ..self }
    }

    /// The file of a fit on a vehicle with this gauge, m; `with_alphas` where α was fitted.
    pub fn of_fit(
        kinematics: &Kinematics,
        gauge: f64,
        with_alphas: bool,
        covariance: Vec<Vec<f64>>,
        source: Source,
    ) -> Self {
        let Kinematics { icrs, alpha } = *kinematics;
        Self {
            alpha_left: with_alphas.then_some(DIGITS.round(alpha.left)),
            alpha_right: with_alphas.then_some(DIGITS.round(alpha.right)),
            covariance: Some(covariance),
            ..Self::of_icrs(&icrs, icrs.steering_efficiency(gauge), source)
        }
    }

    /// Fields common to all files.
    fn of_icrs(icrs: &Icrs, steering_efficiency: f64, source: Source) -> Self {
        let unplaced = |value| Spanned::new(0..0, DIGITS.round(value));
        Self {
            schema: Spanned::new(0..0, SCHEMA.to_owned()),
            frame: Spanned::new(0..0, FRAME.to_owned()),
            x_icr_left_m: unplaced(icrs.x_left),
            x_icr_right_m: unplaced(icrs.x_right),
            y_icr_m: DIGITS.round(icrs.y),
            doubtful: false,
            steering_efficiency: DIGITS.round(steering_efficiency),
            eccentricity: DIGITS.round(icrs.eccentricity()),
            mean_steering_efficiency: None,
            mean_eccentricity: None,
            alpha_left: None,
            alpha_right: None,
            covariance: None,
            spread: None,
            source,
            sector: Vec::new(),
        }
    }

    /// Reads and checks a file.
    ///
    /// # Errors
    /// A [`DocumentError`] that points at the line and key.
    pub fn from_document(document: &Document) -> Result<Self, DocumentError> {
        let file: Self = document.parse_as(SCHEMA)?;
        if file.frame.get_ref() != FRAME {
            return Err(document.value_error(file.frame.span(), "frame", format!("\"{FRAME}\"")));
        }
        separated(document, &file.x_icr_left_m, &file.x_icr_right_m)?;
        document.parse::<Divisors>()?.check(document)?;
        Ok(file)
    }

    /// The file as TOML text.
    ///
    /// # Panics
    /// Never: all values can be written as TOML.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("numbers, texts and tables are TOML")
    }

    /// The kinematic model with the parameters of the whole map.
    pub fn kinematics(&self) -> Kinematics {
        self.with_icrs(Icrs {
            x_left: *self.x_icr_left_m.get_ref(),
            x_right: *self.x_icr_right_m.get_ref(),
            y: self.y_icr_m,
        })
    }

    /// Kinematic model for these track speeds, m/s: that of their sector where the map is
    /// piecewise, or else that of the whole map.
    pub fn kinematics_at(&self, speed: PerSide<f64>) -> Kinematics {
        let signs = Sector::signs_of(speed);
        let sector = self.sector.iter().find(|sector| sector.signs() == signs);
        sector.map_or_else(|| self.kinematics(), |sector| self.with_icrs(sector.icrs()))
    }

    /// Track speeds, m/s, for a forward speed and a yaw rate, with the model used: that of the
    /// sector that holds the speeds, or else that of the whole map.
    pub fn track_speeds(&self, forward: f64, yaw_rate: f64) -> (PerSide<f64>, Kinematics) {
        let of = |kinematics: Kinematics| (kinematics.track_speeds(forward, yaw_rate), kinematics);
        self.sector
            .iter()
            .map(|sector| (sector.signs(), of(self.with_icrs(sector.icrs()))))
            .find(|(signs, (speed, _))| Sector::signs_of(*speed) == *signs)
            .map_or_else(|| of(self.kinematics()), |(_, found)| found)
    }

    fn with_icrs(&self, icrs: Icrs) -> Kinematics {
        Kinematics {
            icrs,
            alpha: PerSide::new(self.alpha_left.unwrap_or(1.0), self.alpha_right.unwrap_or(1.0)),
        }
    }
}

/// Numbers that a reader divides or multiplies by, with their positions in the file.
#[derive(Deserialize)]
struct Divisors {
    steering_efficiency: Spanned<f64>,
    alpha_left: Option<Spanned<f64>>,
    alpha_right: Option<Spanned<f64>>,
    y_icr_m: Spanned<f64>,
    covariance: Option<Spanned<Vec<Vec<f64>>>>,
    #[serde(default)]
    sector: Vec<SectorDivisors>,
}

/// Divisors of a sector.
#[derive(Deserialize)]
struct SectorDivisors {
    x_icr_left_m: Spanned<f64>,
    x_icr_right_m: Spanned<f64>,
    y_icr_m: Spanned<f64>,
}

impl Divisors {
    fn check(&self, document: &Document) -> Result<(), DocumentError> {
        let factors = [
            (Some(&self.steering_efficiency), "steering_efficiency"),
            (self.alpha_left.as_ref(), "alpha_left"),
            (self.alpha_right.as_ref(), "alpha_right"),
        ];
        for (factor, key) in factors {
            if let Some(factor) = factor
                && !(*factor.get_ref() > 0.0 && factor.get_ref().is_finite())
            {
                return Err(document.value_error(factor.span(), key, "a positive number"));
            }
        }
        if let Some(covariance) = &self.covariance
            && covariance.get_ref().iter().flatten().any(|element| !element.is_finite())
        {
            return Err(document.value_error(covariance.span(), "covariance", "finite numbers"));
        }
        for sector in &self.sector {
            separated(document, &sector.x_icr_left_m, &sector.x_icr_right_m)?;
        }
        let sectors = self.sector.iter().map(|sector| &sector.y_icr_m);
        let mut all = std::iter::once(&self.y_icr_m).chain(sectors);
        all.try_for_each(|y| near(document, y, "y_icr_m"))
    }
}

/// Largest distance of an ICR from the robot, m.
const MAX_ICR_DISTANCE: f64 = 1e4;

/// Rejects an ICR coordinate too far from the robot, m.
fn near(document: &Document, value: &Spanned<f64>, key: &str) -> Result<(), DocumentError> {
    if value.get_ref().abs() <= MAX_ICR_DISTANCE {
        return Ok(());
    }
    let expected = format!("a number of m, at most {MAX_ICR_DISTANCE} from the robot");
    Err(document.value_error(value.span(), key, expected))
}

/// Rejects ICRs where the right one is not right of the left one, m.
fn separated(
    document: &Document,
    left: &Spanned<f64>,
    right: &Spanned<f64>,
) -> Result<(), DocumentError> {
    near(document, left, "x_icr_left_m")?;
    near(document, right, "x_icr_right_m")?;
    if right.get_ref() > left.get_ref() {
        return Ok(());
    }
    let expected = format!("a number of m above x_icr_left_m = {}", left.get_ref());
    Err(document.value_error(right.span(), "x_icr_right_m", expected))
}

impl SectorTable {
    fn signs(&self) -> [i8; 3] {
        [self.sign_left, self.sign_right, self.sign_difference]
    }

    fn icrs(&self) -> Icrs {
        Icrs { x_left: self.x_icr_left_m, x_right: self.x_icr_right_m, y: self.y_icr_m }
    }

    fn of(sector: &Sector) -> Self {
        let [sign_left, sign_right, sign_difference] = sector.signs;
        let Statistics { mean, .. } = sector.statistics;
        Self {
            sign_left,
            sign_right,
            sign_difference,
            x_icr_left_m: DIGITS.round(mean.x_left),
            x_icr_right_m: DIGITS.round(mean.x_right),
            y_icr_m: DIGITS.round(mean.y),
            steering_efficiency: DIGITS.round(sector.statistics.steering_efficiency),
            eccentricity: DIGITS.round(sector.statistics.eccentricity),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{Grid, IcrMap};
    use crate::{Circumstance, Model, VehicleFile};

    fn file(effect: &str) -> KinematicsFile {
        let effects = effect.split_whitespace().map(|e| e.parse().expect("an effect")).collect();
        let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects);
        let grid = Grid::new(9, 1.0).expect("a grid");
        let map = IcrMap::solve(&model, grid, &Circumstance::default(), &|_| ());
        KinematicsFile::of_map(
            &map.statistics().expect("it turns"),
            &map.sectors(),
            Source::default(),
        )
    }

    #[test]
    fn a_written_file_reads_back() {
        for effect in ["", "motion-resistance"] {
            let file = file(effect);
            assert_eq!(file.sector.is_empty(), effect.is_empty());
            let back = KinematicsFile::from_document(&Document::new("k.toml", file.to_toml()));
            assert_eq!(back.expect("valid").to_toml(), file.to_toml());
        }
    }

    #[test]
    fn sectors_are_found_both_ways() {
        let file = file("motion-resistance");
        for speed in [PerSide::new(0.2, 0.9), PerSide::new(-0.9, 0.3), PerSide::new(-0.5, 0.5)] {
            let twist = file.kinematics_at(speed).twist(speed);
            let (back, _) = file.track_speeds(twist.v_y, twist.w);
            assert!((back.left - speed.left).abs() < 1e-12, "{speed:?} {back:?}");
            assert!((back.right - speed.right).abs() < 1e-12, "{speed:?} {back:?}");
        }
    }

    #[test]
    fn exchanged_icrs_are_refused_with_their_line() {
        let text = file("").to_toml().replace("x_icr_right_m = 0.4", "x_icr_right_m = -0.4");
        let error = KinematicsFile::from_document(&Document::new("k.toml", text))
            .expect_err("right of left")
            .to_string();
        assert!(error.starts_with("k.toml:4: x_icr_right_m = -0.4"), "{error}");
    }

    #[test]
    fn numbers_that_nobody_can_drive_by_are_refused_with_their_line() {
        let whole = file("motion-resistance").with_alpha(PerSide::new(0.97, 1.02)).to_toml();
        let last = |key: &str| {
            let place = whole.rfind(key).expect("it is there");
            let line = whole[..place].matches('\n').count() + 1;
            (place, line, whole[place..].lines().next().expect("a line").to_owned())
        };
        for (key, value) in [
            ("alpha_left", "0.0"),
            ("alpha_right", "nan"),
            ("x_icr_right_m", "-9.0"),
            ("y_icr_m", "inf"),
        ] {
            let (place, line, old) = last(key);
            let mut text = whole.clone();
            text.replace_range(place..place + old.len(), &format!("{key} = {value}"));
            let error = KinematicsFile::from_document(&Document::new("k.toml", text))
                .expect_err(key)
                .to_string();
            let expected = format!("k.toml:{line}: {key} = {value}: expected");
            assert!(error.starts_with(&expected), "{error}");
        }
    }
}

//! What a replay is made from.

use super::Options;
use crate::options::read_vehicle;
use std::error::Error;
use std::path::{Path, PathBuf};
use trackdyn_core::document::Document;
use trackdyn_core::output::fingerprint;
use trackdyn_motion::Kinematics;
use trackdyn_motion::kinematics::KinematicsFile;
use trackdyn_odometry::ParameterSet;
use trackdyn_recording::Recording;
use trackdyn_recording::clock::{ClockSearch, clock_offset};

/// Files, read and checked.
pub struct Inputs {
    /// The recording.
    pub recording: Recording,
    /// Name of the vehicle.
    pub vehicle: String,
    /// Fingerprint of the vehicle file.
    pub vehicle_fingerprint: String,
    /// Gauge of the ideal drive, m.
    pub gauge: f64,
    /// The kinematics files.
    pub files: Vec<ParameterFile>,
}

/// A kinematics file.
pub struct ParameterFile {
    /// As given on the command line.
    pub path: PathBuf,
    /// Of its text.
    pub fingerprint: String,
    /// What it holds, under a name that no other set has.
    pub set: ParameterSet,
}

impl Inputs {
    /// Reads all files.
    ///
    /// # Errors
    /// A message that names the file and, where there is one, the line.
    pub fn read(options: &Options) -> Result<Self, Box<dyn Error>> {
        let vehicle = read_vehicle(&options.vehicle)?;
        let names = names(&options.kinematics);
        let files = options
            .kinematics
            .iter()
            .zip(names)
            .map(|(path, name)| ParameterFile::read(path, &name))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            recording: options.recording.read()?,
            vehicle_fingerprint: fingerprint(vehicle.to_toml().as_bytes()),
            gauge: vehicle.vehicle.gauge,
            vehicle: vehicle.vehicle.name,
            files,
        })
    }

    /// The ideal drive, and each file as it is and without its alphas.
    pub fn sets(&self) -> Vec<ParameterSet> {
        let of_file = |file: &ParameterFile| [Some(file.set.clone()), file.set.without_alpha()];
        let files = self.files.iter().flat_map(of_file).flatten();
        std::iter::once(ParameterSet::ideal(self.gauge)).chain(files).collect()
    }
}

/// Largest coordinate of an ICR, m, and largest alpha, 1, that a replay takes for meant.
const LARGEST: f64 = 1e3;

impl ParameterFile {
    fn read(path: &Path, name: &str) -> Result<Self, Box<dyn Error>> {
        let document = Document::read(path)?;
        let file = KinematicsFile::from_document(&document)?;
        let set = ParameterSet::of_file(name, &file);
        let Kinematics { icrs, alpha } = set.kinematics();
        let numbers = [
            ("x_icr_left_m", icrs.x_left),
            ("x_icr_right_m", icrs.x_right),
            ("y_icr_m", icrs.y),
            ("alpha_left", alpha.left),
            ("alpha_right", alpha.right),
        ];
        let meant = |value: f64| value.is_finite() && value.abs() <= LARGEST;
        if let Some((key, value)) = numbers.into_iter().find(|(_, value)| !meant(*value)) {
            let name = document.name();
            let message = format!("{name}: {key} = {value}: expected at most {LARGEST} in size");
            return Err(message.into());
        }
        let fingerprint = fingerprint(document.text().as_bytes());
        Ok(Self { path: path.to_owned(), fingerprint, set })
    }
}

/// Names for files: their stems, with the folder before them where two are alike, and a number
/// where these are alike too.
fn names(paths: &[PathBuf]) -> Vec<String> {
    let text = |part: Option<&std::ffi::OsStr>| {
        let name = part.unwrap_or_default().to_string_lossy();
        name.chars()
            .map(|c| if c.is_alphanumeric() || "._-".contains(c) { c } else { '_' })
            .collect()
    };
    let stems: Vec<String> = paths.iter().map(|path| text(path.file_stem())).collect();
    let mut names: Vec<String> = Vec::new();
    for (path, stem) in paths.iter().zip(&stems) {
        let alike = stems.iter().filter(|other| *other == stem).count() > 1;
        let folder: String = text(path.parent().and_then(Path::file_name));
        let name =
            if alike && !folder.is_empty() { format!("{folder}-{stem}") } else { stem.clone() };
        let taken = |name: &str| {
            [ParameterSet::IDEAL, "recorded"].contains(&name)
                || name.ends_with("-no-alpha")
                || names.iter().any(|n| n == name)
        };
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        let free = std::iter::once(name.clone()).chain(numbered).find(|name| !taken(name));
        names.push(free.unwrap_or(name));
    }
    names
}

/// The clock offset and where it is from.
pub struct Clock {
    /// τ, s.
    pub tau: f64,
    /// Its standard error, where it was estimated, s.
    pub standard_error: Option<f64>,
    /// Why it could not be estimated.
    pub note: Option<String>,
}

impl Clock {
    /// The offset given, or that of the recording.
    pub fn new(recording: &Recording, given: Option<f64>) -> Self {
        if let Some(tau) = given {
            return Self { tau, standard_error: None, note: None };
        }
        match clock_offset(recording, &ClockSearch::default()) {
            Ok(offset) => {
                let standard_error = Some(offset.standard_error);
                Self { tau: offset.tau, standard_error, note: None }
            }
            Err(error) => Self { tau: 0.0, standard_error: None, note: Some(error.to_string()) },
        }
    }

    /// In one word, for files.
    pub fn origin(&self) -> &'static str {
        match (self.standard_error, &self.note) {
            (Some(_), _) => "estimated",
            (None, Some(_)) => "not estimable",
            (None, None) => "given",
        }
    }
}

/// Seconds of a clock offset.
///
/// # Errors
/// What was expected.
pub fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.abs() <= 3600.0 => Ok(value),
        _ => Err("expected a number of seconds, such as 0.25".to_owned()),
    }
}

/// Numbers of runs; a type of its own, for `clap` takes a vector for an option that is repeated.
#[derive(Clone, Debug)]
pub struct RunList(Vec<i64>);

impl RunList {
    /// The numbers, as given.
    pub fn numbers(&self) -> &[i64] {
        &self.0
    }
}

/// Numbers of runs and ranges of them, separated by commas.
///
/// # Errors
/// What was expected.
pub fn runs(text: &str) -> Result<RunList, String> {
    const MOST: i64 = 1_000_000;
    let expected = || "expected numbers of runs, such as 7,8,20-29".to_owned();
    let number = |text: &str| text.trim().parse::<i64>().map_err(|_| expected());
    let mut numbers = Vec::new();
    for part in text.split(',') {
        match part.trim().split_once('-').filter(|(first, _)| !first.is_empty()) {
            Some((first, last)) => {
                let (first, last) = (number(first)?, number(last)?);
                if !(first..first.saturating_add(MOST)).contains(&last) {
                    return Err(expected());
                }
                numbers.extend(first..=last);
            }
            None => numbers.push(number(part)?),
        }
    }
    Ok(RunList(numbers))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_runs() {
        assert_eq!(runs("7, 9,20-22").expect("numbers").numbers(), [7, 9, 20, 21, 22]);
        assert_eq!(runs("-3").expect("a number").numbers(), [-3]);
        for bad in ["", "x", "1,,2", "9-7", "1-", "0-9999999999"] {
            assert!(runs(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn every_set_has_a_name_of_its_own() {
        let of = |paths: &[&str]| names(&paths.iter().map(PathBuf::from).collect::<Vec<_>>());
        assert_eq!(of(&["a/fit.toml", "b/map.toml"]), ["fit", "map"]);
        assert_eq!(of(&["a/k.toml", "b/k.toml", "b/k.toml"]), ["a-k", "b-k", "b-k-2"]);
        assert_eq!(of(&["ideal.toml", "my robot.toml"]), ["ideal-2", "my_robot"]);
    }
}

//! What a replay is made from.

use super::Options;
use crate::options::read_vehicle;
use std::error::Error;
use std::path::{Path, PathBuf};
use trackdyn::crates::core::document::Document;
use trackdyn::crates::core::output::fingerprint;
use trackdyn::crates::estimate::odometry::{Comparison, ParameterSet};
use trackdyn::crates::model::Kinematics;
use trackdyn::crates::model::kinematics::{KinematicsFile, Source};
use trackdyn::crates::recording::{Recording, RunList};

/// Files, read and checked.
pub struct Inputs {
    /// The recording, all of it.
    pub recording: Recording,
    /// The time of each run that is replayed, s; none: all of it.
    pub time: Option<[f64; 2]>,
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
    /// Where its numbers come from.
    pub source: Source,
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
            recording: options.driving.recording()?,
            time: options.driving.time(),
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

    /// Whether the numbers of a file were fitted to other runs, or another time of them, than the result
    /// replays.
    pub fn is_held_out(&self, file: &ParameterFile, result: &Comparison) -> bool {
        const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
        let replayed = RunList::new(result.paths.iter().map(|path| path.run));
        let fitted = file.source.runs.as_ref().and_then(|runs| runs.parse::<RunList>().ok());
        let [from, until] = self.time.unwrap_or(ALL);
        let [fitted_from, fitted_until] = file.source.time_s.unwrap_or(ALL);
        let is_other = match &file.source.pose_fingerprint {
            Some(poses) => poses != self.recording.pose_fingerprint(),
            None => file.source.fingerprint != self.recording.fingerprint(),
        };
        is_other
            || fitted.is_some_and(|fitted| !fitted.overlaps(&replayed))
            || from >= fitted_until
            || until <= fitted_from
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
        Ok(Self { path: path.to_owned(), fingerprint, set, source: file.source })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_set_has_a_name_of_its_own() {
        let of = |paths: &[&str]| names(&paths.iter().map(PathBuf::from).collect::<Vec<_>>());
        assert_eq!(of(&["a/fit.toml", "b/map.toml"]), ["fit", "map"]);
        assert_eq!(of(&["a/k.toml", "b/k.toml", "b/k.toml"]), ["a-k", "b-k", "b-k-2"]);
        assert_eq!(of(&["ideal.toml", "my robot.toml"]), ["ideal-2", "my_robot"]);
    }
}

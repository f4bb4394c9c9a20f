//! The folder of a trial.
//!
//! ```text
//! DIR/commitment.txt
//! DIR/case-0001/vehicle.toml
//! DIR/case-0001/recording/{recording.toml,tracks.csv,poses.csv}
//! KEY                    the key, which lies elsewhere
//! KEY.75cbaebc.toml      the answers, called by the first digits of their hash
//! ```
//!
//! What a diagnosis writes goes to `DIR/case-0001/diagnosis`, and why a process failed to
//! `DIR/case-0001/failure.txt`; those of another program NAME to `diagnosis.NAME` and
//! `failure.NAME.txt`. Names, layout, rounding and stamps of the files are the same in all cases.
//!
//! Trials until November 2026 have their answers in `DIR/answers.sealed`.

use crate::answer::{Answer, Answers};
use crate::case::Case;
use crate::diagnosis::Diagnosis;
use crate::entry::Entry;
use crate::error::Error;
use crate::key::Key;
use crate::old_seal;
use crate::score::{Judged, Reply};
use crate::seal::{self, Commitment};
use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use trackdyn_core::document::Document;
use trackdyn_core::input;
use trackdyn_core::output::{fingerprint, write_file, write_private};
use trackdyn_model::{Vehicle, VehicleFile};
use trackdyn_recording::folder;
use trackdyn_second_simulator::MECHANISMS;
use trackdyn_second_simulator::sheet::{Filed, Trial};

/// The sealed answers of older trials.
const SEALED_ANSWERS: &str = "answers.sealed";
/// The published hash.
pub const COMMITMENT: &str = "commitment.txt";
/// The recording of a case.
pub const RECORDING: &str = "recording";
/// The vehicle of a case.
pub const VEHICLE: &str = "vehicle.toml";
/// Largest file of a trial, bytes: the answers of a thousand cases take 2 MB, a recording 3 MB.
const MAX_FILE_SIZE: u64 = 256 << 20;
/// Stamp of all files: 1 December 2005, when the paper's issue had appeared, s of Unix time.
const STAMP: u64 = 1_133_395_200;

/// Writes what a diagnosis gets of a case to a folder.
///
/// # Errors
/// [`Error::Output`], [`Error::Recording`].
pub(crate) fn write_case(home: &Path, case: &Case) -> Result<(), Error> {
    folder::write(&case.recording, &home.join(RECORDING))?;
    Ok(write_file(&home.join(VEHICLE), case.vehicle.to_toml().as_bytes())?)
}

/// Copies what a diagnosis gets of a case from one folder to another. All files get one stamp.
///
/// # Errors
/// [`Error::File`].
pub(crate) fn copy_case(from: &Path, to: &Path) -> Result<(), Error> {
    let recording = to.join(RECORDING);
    fs::create_dir(&recording).map_err(Error::file(&recording))?;
    for (source, copy) in files(from).iter().zip(files(to)) {
        fs::copy(source, copy).map_err(Error::file(source))?;
    }
    files(to).iter().chain([&recording, &to.to_owned()]).try_for_each(|path| stamp(path))
}

/// Makes a folder of this name: filled under another one, and renamed when it is complete.
///
/// # Errors
/// Those of `fill`; [`Error::File`].
pub(crate) fn place(
    parent: &Path,
    name: &str,
    fill: impl FnOnce(&Path) -> Result<(), Error>,
) -> Result<(), Error> {
    let partial = parent.join(format!(".{name}"));
    if partial.exists() {
        fs::remove_dir_all(&partial).map_err(Error::file(&partial))?;
    }
    fs::create_dir(&partial).map_err(Error::file(&partial))?;
    fill(&partial)?;
    let complete = parent.join(name);
    fs::rename(&partial, &complete).map_err(Error::file(complete))
}

/// Whether a trial was made in a folder, or may have been.
pub fn is_made(trial: &Path) -> bool {
    trial.join(COMMITMENT).exists() || trial.join(SEALED_ANSWERS).exists()
}

/// Writes the answers beside the file of the key, where nobody but its owner reads them, and
/// publishes the commitment in the folder of the trial.
///
/// # Errors
/// [`Error::Output`].
///
/// # Panics
/// Never: hashes are TOML.
pub fn write_answers(trial: &Path, answers: &Answers, key: &Path) -> Result<Commitment, Error> {
    let text = seal::text(answers);
    let commitment = Commitment::to(&text);
    write_private(&answers_file(key, &commitment), text.as_bytes())?;
    let text = toml::to_string(&commitment).expect("texts are TOML");
    write_file(&trial.join(COMMITMENT), text.as_bytes())?;
    Ok(commitment)
}

/// Opens the answers of a trial with the key in a file. With them comes their text.
///
/// # Errors
/// [`Error::NoAnswers`] where they do not lie beside the key; [`Error::Broken`] where they are not
/// those that were committed to; [`Error::File`], [`Error::Key`], [`Error::Document`].
pub fn open_answers(trial: &Path, key: &Path) -> Result<(Answers, String), Error> {
    let commitment = commitment(trial)?;
    let sealed = trial.join(SEALED_ANSWERS);
    let text = if sealed.exists() {
        let bytes = input::bytes(&sealed, MAX_FILE_SIZE).map_err(Error::file(sealed))?;
        old_seal::unseal(&bytes, &Key::read(key)?, &commitment)?
    } else {
        let path = answers_file(key, &commitment);
        if !path.exists() {
            return Err(Error::NoAnswers { path, committed: commitment.answers_sha256 });
        }
        let bytes = input::bytes(&path, MAX_FILE_SIZE).map_err(Error::file(&path))?;
        String::from_utf8(bytes).map_err(io::Error::other).map_err(Error::file(path))?
    };
    Ok((commitment.open(&text)?, text))
}

/// Where the answers of a trial lie until they are opened.
pub fn answers_file(key: &Path, commitment: &Commitment) -> PathBuf {
    let hash: String = commitment.answers_sha256.chars().take(8).collect();
    let mut path = OsString::from(key);
    path.push(format!(".{hash}.toml"));
    PathBuf::from(path)
}

/// What is committed to: there as soon as the trial is complete.
///
/// # Errors
/// [`Error::Document`].
pub fn commitment(trial: &Path) -> Result<Commitment, Error> {
    Ok(Document::read(&trial.join(COMMITMENT))?.parse()?)
}

/// The cases of a trial, in the order of their names.
///
/// # Errors
/// [`Error::File`], or [`Error::NoCases`].
pub fn cases(trial: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut found = Vec::new();
    for entry in fs::read_dir(trial).map_err(Error::file(trial))? {
        let path = entry.map_err(Error::file(trial))?.path();
        let is_case =
            path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("case-"));
        if is_case && path.join(RECORDING).is_dir() {
            found.push(path);
        }
    }
    if found.is_empty() {
        return Err(Error::NoCases { path: trial.to_owned() });
    }
    found.sort();
    Ok(found)
}

/// Puts what came back of every case from a program beside its answer.
///
/// # Errors
/// [`Error::OtherFiles`] or [`Error::OtherRecording`] where files were changed after the answers
/// were committed to; files that cannot be read.
pub fn judge(trial: &Path, answers: &Answers, entry: &Entry) -> Result<Vec<Judged>, Error> {
    answers.cases.iter().map(|answer| judge_case(trial, answer, entry)).collect()
}

fn judge_case(trial: &Path, answer: &Answer, entry: &Entry) -> Result<Judged, Error> {
    let home = trial.join(&answer.id);
    if !answer.files.is_empty() {
        let found = fingerprint_of(&home)?;
        if found != answer.files {
            let (case, sealed) = (answer.id.clone(), answer.files.clone());
            return Err(Error::OtherFiles { case, found, sealed });
        }
    }
    let recording = folder::read(&home.join(RECORDING))?;
    if recording.fingerprint() != answer.recording {
        return Err(Error::OtherRecording {
            case: answer.id.clone(),
            found: recording.fingerprint().to_owned(),
            sealed: answer.recording.clone(),
        });
    }
    let owned = VehicleFile::from_document(&Document::read(&home.join(VEHICLE))?)?;
    let truth = Document::new(format!("{}, sealed vehicle", answer.id), &answer.vehicle);
    let truth = VehicleFile::from_document(&truth)?;
    let reply = if entry.has_diagnosed(&home) {
        match Diagnosis::read(&entry.diagnosis(&home)) {
            Ok(diagnosis) => Reply::Diagnosed(Box::new(diagnosis)),
            Err(error) => Reply::Failed(error.to_string()),
        }
    } else if entry.has_failed(&home) {
        let failure = entry.failure(&home);
        Reply::Failed(input::text(&failure).map_err(Error::file(failure))?)
    } else {
        Reply::Absent
    };
    let owner_errors = owner_errors(&owned.vehicle, &truth.vehicle);
    let outside = outside(&home)?;
    Ok(Judged { answer: answer.clone(), owner_errors, outside, reply })
}

/// The files that a diagnosis gets of a case.
fn files(home: &Path) -> [PathBuf; 4] {
    let recording = home.join(RECORDING);
    let [manifest, tracks, poses] =
        ["recording.toml", "tracks.csv", "poses.csv"].map(|name| recording.join(name));
    [manifest, tracks, poses, home.join(VEHICLE)]
}

/// Fingerprint of the files that a diagnosis gets of a case.
///
/// # Errors
/// [`Error::File`].
pub(crate) fn fingerprint_of(home: &Path) -> Result<String, Error> {
    let mut bytes = Vec::new();
    for path in files(home) {
        bytes.extend(input::bytes(&path, MAX_FILE_SIZE).map_err(Error::file(path))?);
    }
    Ok(fingerprint(&bytes))
}

/// Sizes (bytes) and stamps (s of Unix time) of the files of a case.
fn outside(home: &Path) -> Result<Vec<f64>, Error> {
    let mut shown = Vec::new();
    for path in files(home) {
        let file = fs::metadata(&path).map_err(Error::file(&path))?;
        let stamp = file.modified().map_err(Error::file(&path))?;
        let stamp = stamp.duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        #[expect(clippy::cast_precision_loss, reason = "sizes stay far below 2⁵³")]
        shown.extend([file.len() as f64, stamp.as_secs_f64()]);
    }
    Ok(shown)
}

/// Effects of the class of constants by which a vehicle file is off.
fn owner_errors(owned: &Vehicle, truth: &Vehicle) -> Vec<&'static str> {
    let is_wrong = |filed: Filed| match filed {
        Filed::CentreOfGravity => owned.cog != truth.cog,
        Filed::FrictionRatio => owned.friction != truth.friction,
    };
    let wrong = MECHANISMS.iter().filter(|sheet| match sheet.trial {
        Trial::Law(law) => law.filed.is_some_and(is_wrong),
        Trial::Instrument(_) => false,
    });
    wrong.map(|sheet| sheet.id).collect()
}

fn stamp(path: &Path) -> Result<(), Error> {
    let time = SystemTime::UNIX_EPOCH + Duration::from_secs(STAMP);
    File::open(path).and_then(|file| file.set_modified(time)).map_err(Error::file(path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::SCHEMA;
    use crate::forms::Forms;

    #[test]
    fn trials_open_whose_answers_are_sealed_in_their_folder() {
        let fixture = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/old-seal");
        assert!(is_made(&fixture));
        let (answers, text) = open_answers(&fixture, &fixture.join("answers.key")).expect("opens");
        assert_eq!(answers.cases[0].id, "case-0001");
        assert!(text.contains("plain-null"));
    }

    #[test]
    fn answers_lie_beside_the_key_and_open_with_it() {
        let (trial, elsewhere) = (tempfile::tempdir(), tempfile::tempdir());
        let (trial, elsewhere) = (trial.expect("a folder"), elsewhere.expect("a folder"));
        let key = elsewhere.path().join("x.key");
        let of_seed = |seed| Answers {
            salt: Key::new().salt(seed),
            schema: SCHEMA.to_owned(),
            version: "1".to_owned(),
            seed,
            root: None,
            run_time_s: None,
            forms: Forms::Plain,
            cases: Vec::new(),
        };
        // a key that is used twice loses no answers
        write_answers(elsewhere.path(), &of_seed(1), &key).expect("written");
        write_answers(trial.path(), &of_seed(2), &key).expect("written");
        let [first, second] = [elsewhere.path(), trial.path()]
            .map(|folder| open_answers(folder, &key).expect("opens").0.seed);
        assert_eq!([first, second], [1, 2]);
        let names = fs::read_dir(trial.path()).expect("a folder").count();
        assert_eq!(names, 1, "the commitment and nothing else");
        let error = open_answers(trial.path(), &elsewhere.path().join("y.key")).expect_err("none");
        assert!(error.to_string().contains("beside the key"), "{error}");
    }
}

//! Which physics a model of the robot lacks, from recordings.

mod claim;
mod examined;
mod held_out;
mod layers;

pub use claim::{Claim, Size};
pub use held_out::{HeldOut, every_fourth};

use crate::change::Folder;
use crate::document::GyroscopeTable;
use crate::law::guarded;
use crate::recording::joined;
use crate::viewer::{self, Layers};
use crate::{
    Change, Error, Limits, MethodSettings, Observer, Progress, Provenance, Recording, Vehicle,
    unobserved,
};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use trackdyn_diagnose::{DiagnosisFile, Evidence, Options, Resampling, Status};
use trackdyn_estimate::{Contradiction, identification};
use trackdyn_model::kinematics::Source;
use trackdyn_model::{EffectId, VehicleFile};
use trackdyn_recording::{Recording as Motion, RunList};
use trackdyn_report::{Figure, Subject, diagnosis_figures, diagnosis_html};

/// Name of the report.
const REPORT: &str = "report.html";

/// Name of the files for viewers, without extension.
const LAYERS: &str = "diagnosis";

/// The figures that not every diagnosis has: points have no time and no path.
const DRIVE_FIGURES: [&str; 2] = ["time.png", "path.png"];

/// How to diagnose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DiagnoseSettings {
    /// Runs that nothing is fitted or chosen on: the result is judged on them.
    pub held_out: HeldOut,
    /// Time by which poses lag behind the track speeds, s. Default: estimated.
    pub tau: Option<f64>,
    /// Correct the yaw of the poses by the gyroscope of the recordings. Default: poses as they are.
    pub gyroscope: bool,
    /// Draws and seed of the bootstrap behind the tests. Default: 2000 draws, seed 1.
    pub resampling: Resampling,
    /// All numbers that decide an answer: thresholds, priors, step sizes.
    pub method: MethodSettings,
    /// Laws of a user that are candidates beside the catalogue, see [`crate::law`]. Those of
    /// the vehicle are candidates anyway.
    pub laws: Vec<EffectId>,
}

impl DiagnoseSettings {
    /// Limits of the number of draws of the bootstrap.
    pub const DRAWS_LIMITS: Limits = Limits { least: 1000.0, most: 1e5, unit: "" };

    /// How poses are found that are no reference, of a vehicle with this gauge, m.
    fn of_reference(&self, gauge: f64) -> identification::Options {
        let method = &self.method;
        identification::Options {
            tau: self.tau,
            clock: method.clock.clone(),
            noise: method.measured_noise.clone(),
            spin: method.spin.clone(),
            computed: method.reference.clone(),
            ..identification::Options::new(gauge)
        }
    }
}

/// Diagnoses recordings of one robot: where its model and they differ, and what physics was left
/// out.
///
/// # Errors
/// Those of [`Prepared::new`] and [`Prepared::run`].
pub fn diagnose(
    recordings: &[Recording],
    vehicle: &Vehicle,
    settings: &DiagnoseSettings,
) -> Result<Diagnosis, Error> {
    Prepared::new(recordings, vehicle, settings)?.run(&unobserved)
}

/// A diagnosis whose inputs and settings go together: what was seen, and what is held out of it.
pub struct Prepared {
    evidence: Evidence,
    contradictions: Vec<Contradiction>,
    options: Options,
    vehicle: Vehicle,
    name: String,
    place: String,
    fingerprint: String,
    /// Fingerprint of its poses, and those of the recordings that were joined.
    poses: Option<String>,
    joined: Vec<String>,
    runs: Option<String>,
    /// The time of each run that counts, s.
    time: Option<[f64; 2]>,
    /// What viewers need of the log; none of a table of steady operating points.
    log: Option<layers::Log>,
}

impl Prepared {
    /// Takes the evidence out of recordings of one robot, or of one table of steady operating
    /// points. The effects of the vehicle are part of the model, and what its file says of
    /// uncertainties is taken as known.
    ///
    /// # Errors
    /// [`Error::NoRecording`]; [`Error::RecordingTwice`], for runs count as evidence of their own;
    /// [`Error::PointsNotAlone`]; [`Error::HeldOut`] for runs that are not there,
    /// [`Error::AllHeldOut`], [`Error::NoRunsToHoldOut`] for runs of a table;
    /// [`Error::NoPositions`]; [`Error::NoReference`] for poses that are computed from the tracks;
    /// [`Error::Diagnose`] for too little driving, or noise that is not known.
    pub fn new(
        recordings: &[Recording],
        vehicle: &Vehicle,
        settings: &DiagnoseSettings,
    ) -> Result<Self, Error> {
        let prepared = Self::of_any(recordings, vehicle, settings)?;
        let options = settings.of_reference(vehicle.gauge());
        let found = recordings.iter().map(|one| one.expect_reference(&options));
        let contradictions = found.collect::<Result<Vec<_>, _>>()?.concat();
        Ok(Self { contradictions, ..prepared })
    }

    /// As [`Prepared::new`], of poses that may be computed from the tracks: so a simulator without
    /// slip moves its robot.
    ///
    /// # Errors
    /// The other ones of [`Prepared::new`].
    pub(crate) fn of_any(
        recordings: &[Recording],
        vehicle: &Vehicle,
        settings: &DiagnoseSettings,
    ) -> Result<Self, Error> {
        let recording = joined(recordings)?;
        let driven = recording.motion().map(Motion::as_driven);
        let named = |cause| Error::Diagnose { recording: recording.place(), cause };
        let (evidence, held_out, runs) = match (recording.points(), driven.as_deref()) {
            (Some(points), _) => {
                settings.held_out.refuse_runs()?;
                let evidence =
                    Evidence::of_points(points.points(), &settings.method).map_err(named)?;
                let held_out = settings.held_out.of_points(evidence.runs().len(), &settings.method);
                (evidence, held_out, None)
            }
            (None, Some(motion)) => {
                let runs = recording.expect_positions()?.run_list().to_string();
                let held_out = settings.held_out.of_motion(motion, &settings.method)?;
                let (gauge, by_gyroscope) = (vehicle.gauge(), settings.gyroscope);
                let evidence =
                    Evidence::of_drive(motion, gauge, &settings.method, by_gyroscope, settings.tau);
                let evidence = evidence.map_err(named)?;
                (evidence, held_out, Some(runs))
            }
            (None, None) => return Err(Error::NoRecording),
        };
        let of_poses = |one: &Recording| Some(one.motion()?.pose_fingerprint().to_owned());
        let joined = if recordings.len() > 1 { recordings } else { &[] };
        Ok(Self {
            poses: of_poses(&recording),
            joined: joined.iter().filter_map(of_poses).collect(),
            evidence,
            contradictions: Vec::new(),
            options: Options {
                held_out,
                resampling: settings.resampling,
                laws: settings.laws.clone(),
            },
            vehicle: vehicle.clone(),
            name: recording.name().to_owned(),
            place: recording.place(),
            fingerprint: recording.fingerprint().to_owned(),
            runs,
            time: recording.time(),
            log: driven.as_deref().map(layers::Log::of),
        })
    }

    /// What was seen.
    pub fn evidence(&self) -> &Evidence {
        &self.evidence
    }

    /// What contradicts itself in the recordings, as
    /// [`Recording::contradictions`](crate::Recording::contradictions) finds it.
    pub fn contradictions(&self) -> &[Contradiction] {
        &self.contradictions
    }

    /// Indices of the runs that are held out.
    pub fn held_out(&self) -> &[usize] {
        &self.options.held_out
    }

    /// Diagnoses, observed: a part is a stage of the method, and the
    /// observer is also told before each refit within one.
    ///
    /// # Errors
    /// [`Error::Diagnose`] for driving without turns, or a vehicle that cannot move as recorded;
    /// [`Error::Law`], [`Error::Cancelled`].
    pub fn run(self, observer: &Observer) -> Result<Diagnosis, Error> {
        let progress = |at: trackdyn_diagnose::Progress| {
            observer(Progress { stage: at.stage.name(), done: at.done, total: at.total })
        };
        let Self { evidence, vehicle, options, .. } = &self;
        let found = guarded(|| {
            trackdyn_diagnose::diagnose(evidence, vehicle.file(), options, &progress)
                .map_err(|cause| self.failed(cause))
        })?;
        let source = Some(self.source_of_correction());
        let corrected = VehicleFile { source, ..found.answer.corrected.clone() }.into();
        Ok(Diagnosis { found, corrected, of: self })
    }

    /// Why the recordings cannot be diagnosed.
    fn failed(&self, cause: trackdyn_diagnose::Error) -> Error {
        match cause {
            trackdyn_diagnose::Error::Cancelled => Error::Cancelled,
            cause => Error::Diagnose { recording: self.place.clone(), cause },
        }
    }

    /// What a corrected vehicle was fitted to: all that is not held out.
    fn source_of_correction(&self) -> Source {
        let runs = self.evidence.runs().iter().enumerate();
        let fitted = runs.filter(|(index, _)| !self.options.held_out.contains(index));
        let fitted = RunList::new(fitted.map(|(_, run)| *run));
        Source {
            pose_fingerprint: self.poses.clone(),
            joined: self.joined.clone(),
            runs: self.runs.is_some().then(|| fitted.to_string()),
            ..self.source(&Provenance::default())
        }
    }

    /// What was seen.
    fn source(&self, provenance: &Provenance) -> Source {
        Source {
            vehicle: self.vehicle.name().to_owned(),
            fingerprint: self.fingerprint.clone(),
            recording: Some(self.name.clone()),
            runs: self.runs.clone(),
            time_s: self.time,
            ..provenance.source()
        }
    }
}

/// What a model of the robot lacks.
pub struct Diagnosis {
    found: trackdyn_diagnose::Diagnosis,
    corrected: Vehicle,
    of: Prepared,
}

impl Diagnosis {
    /// What it says in a word.
    pub fn status(&self) -> Status {
        self.found.answer.status
    }

    /// What was left out, with its sizes.
    pub fn claims(&self) -> impl Iterator<Item = Claim<'_>> {
        self.found.answer.missing.iter().map(Claim::of)
    }

    /// The vehicle that explains the recordings.
    pub fn corrected_vehicle(&self) -> &Vehicle {
        &self.corrected
    }

    /// All that was found.
    pub fn found(&self) -> &trackdyn_diagnose::Diagnosis {
        &self.found
    }

    /// What was seen, all runs of it.
    pub fn evidence(&self) -> &Evidence {
        &self.of.evidence
    }

    /// The vehicle as filed.
    pub fn vehicle(&self) -> &Vehicle {
        &self.of.vehicle
    }

    /// Name of what was diagnosed.
    pub fn name(&self) -> &str {
        &self.of.name
    }

    /// The diagnosis as a file (schema `trackdyn.diagnosis/1`).
    pub fn file(&self, provenance: &Provenance) -> DiagnosisFile {
        let gyroscope = self.of.evidence.gyroscope().map(|found| GyroscopeTable::of(found).into());
        DiagnosisFile::new(&self.found, &self.of.seen(provenance)).with_gyroscope(gyroscope)
    }

    /// The text of `vehicle.corrected.toml`: the corrected vehicle, and in its first line where it
    /// comes from.
    pub fn corrected_toml(&self, provenance: &Provenance) -> String {
        let head = format!(
            "{} as a diagnosis of {} corrects it (trackdyn {}, vehicle {}, recording {}).",
            self.of.vehicle.name(),
            self.of.name,
            provenance.version,
            self.of.vehicle.fingerprint(),
            self.of.fingerprint,
        );
        // a name may hold a line break, which would end the comment
        let head = head.replace(char::is_control, " ");
        let mut file = self.corrected.file().clone();
        if let Some(source) = &mut file.source {
            (source.command, source.version) =
                (provenance.command.clone(), provenance.version.clone());
        }
        format!("# {head}\n{}", file.to_toml())
    }

    /// The figures, and the page that carries them.
    ///
    /// # Errors
    /// [`Error::Figure`]; no result is the cause of one.
    pub fn report(&self, provenance: &Provenance) -> Result<Report, Error> {
        let caption = format!(
            "trackdyn {}, recording {} {}, vehicle {} {}",
            provenance.version,
            self.of.name,
            self.of.fingerprint,
            self.of.vehicle.name(),
            self.of.vehicle.fingerprint()
        );
        let subject = Subject {
            diagnosis: &self.found,
            vehicle: self.of.vehicle.file(),
            file: &self.file(provenance),
            name: &self.of.name,
            caption: &caption,
        };
        guarded(|| {
            let figures = diagnosis_figures(&subject);
            let html = diagnosis_html(&subject, &figures)?;
            Ok(Report { figures, html })
        })
    }

    /// What Foxglove, Rerun and PlotJuggler show of it: paths and ICRs as observed, as the vehicle
    /// file has them and as it is corrected, whitened residuals before and after, and how the robot
    /// drives.
    ///
    /// # Errors
    /// [`Error::NoMotion`] of a table of steady operating points.
    pub fn layers(&self, provenance: &Provenance) -> Result<Layers, Error> {
        guarded(|| layers::of(self, provenance))
    }

    /// Writes `diagnosis.mcap` with these [layers](Self::layers), and layouts beside it.
    ///
    /// # Errors
    /// Those of [`layers`](Self::layers), [`Error::Output`].
    pub fn write_layers(
        &self,
        folder: impl AsRef<Path>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        viewer::write(&self.layers(provenance)?, folder, LAYERS)
    }

    /// Writes `diagnosis.toml`, `vehicle.corrected.toml`, `report.html` and its figures. The
    /// [layers](Self::write_layers) of an earlier diagnosis go; they are written after this.
    ///
    /// # Errors
    /// [`Error::Output`], [`Error::NotRemoved`], [`Error::Figure`].
    pub fn write(
        &self,
        folder: impl AsRef<Path>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        let mut folder = Folder::prepare(folder.as_ref())?;
        folder.write("diagnosis.toml", self.file(provenance).to_toml().as_bytes())?;
        folder.write(CORRECTED_VEHICLE, self.corrected_toml(provenance).as_bytes())?;
        let Report { figures, html } = self.report(provenance)?;
        let drawn: Vec<Result<Vec<u8>, _>> = figures.par_iter().map(Figure::to_small_png).collect();
        for (figure, drawn) in figures.iter().zip(drawn) {
            folder.write(&figure.file(), &drawn?)?;
        }
        viewer::remove_earlier(&mut folder, REPORT, LAYERS)?;
        let is_drawn = |file: &str| figures.iter().any(|figure| figure.file() == file);
        let earlier = DRIVE_FIGURES.into_iter().filter(|file| !is_drawn(file));
        let earlier: Vec<_> = earlier.map(|file| folder.file(file)).collect();
        folder.remove_earlier(REPORT, earlier)?;
        folder.write(REPORT, html.as_bytes())?;
        Ok(folder.changes())
    }
}

/// Name of the file of the corrected vehicle.
const CORRECTED_VEHICLE: &str = "vehicle.corrected.toml";

/// The file of the corrected vehicle that a diagnosis wrote beside its own file.
pub fn corrected_beside(diagnosis: &Path) -> PathBuf {
    diagnosis.with_file_name(CORRECTED_VEHICLE)
}

/// A report: a page that carries its figures.
pub struct Report {
    /// The figures, in the order of the page.
    pub figures: Vec<Figure>,
    /// The page, HTML.
    pub html: String,
}

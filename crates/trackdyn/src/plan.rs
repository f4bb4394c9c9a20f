//! The driving that tells apart what a diagnosis could not.

use crate::change::Folder;
use crate::law::guarded;
use crate::progress::Counter;
use crate::{Change, Diagnosis, Error, MethodSettings, Observer, Provenance, Vehicle, unobserved};
use std::path::Path;
use trackdyn_core::Schedule;
use trackdyn_core::document::Document;
use trackdyn_core::output::fingerprint;
use trackdyn_diagnose::document::NoiseTable;
use trackdyn_diagnose::plan::{Question, STAGES};
use trackdyn_diagnose::{DiagnosisFile, Plan as Planned, PlanFile};
use trackdyn_drive::schedules::{self, ScheduledRun};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_model::kinematics::Source;

/// How to plan: fastest speed, time, and noise of the poses.
pub type PlanSettings = trackdyn_diagnose::plan::Options;

pub use trackdyn_diagnose::plan::assumed_noise;

/// Names of the files of a plan: the plan, and the driving as a schedule.
const FILES: [&str; 2] = ["plan.toml", "plan.csv"];

/// What a diagnosis left open between several effects.
#[derive(Clone, Debug)]
pub struct OpenQuestions {
    questions: Vec<Question>,
    file: DiagnosisFile,
    document: Document,
}

impl OpenQuestions {
    /// The questions of a diagnosis file (schema `trackdyn.diagnosis/1`).
    ///
    /// # Errors
    /// [`Error::Document`], which names file, line and key.
    pub fn open(diagnosis: impl AsRef<Path>) -> Result<Self, Error> {
        Self::from_document(Document::read(diagnosis.as_ref())?)
    }

    /// The questions of a diagnosis.
    ///
    /// # Errors
    /// None: a diagnosis writes what can be read.
    pub fn of(diagnosis: &Diagnosis) -> Result<Self, Error> {
        let text = diagnosis.file(&Provenance::default()).to_toml();
        Self::from_document(Document::new(diagnosis.name(), text))
    }

    /// The questions of the text of a diagnosis file.
    ///
    /// # Errors
    /// [`Error::Document`], which names line and key.
    pub fn from_document(document: Document) -> Result<Self, Error> {
        let questions = Question::of(&document)?;
        let file = DiagnosisFile::from_document(&document)?;
        Ok(Self { questions, file, document })
    }

    /// Whether nothing is open.
    pub fn is_empty(&self) -> bool {
        self.questions.is_empty()
    }

    /// The numbers by which the diagnosis was made, for the plan to go by.
    pub fn method(&self) -> &MethodSettings {
        &self.file.settings
    }

    /// The noise of the poses as the diagnosis measured it; none in older files, and of tables of
    /// steady points.
    pub fn noise(&self) -> Option<SegmentNoise> {
        self.file.noise.as_ref().map(NoiseTable::noise)
    }

    /// The command line that made the diagnosis; none where its file does not tell.
    pub fn command(&self) -> Option<&str> {
        self.of_source("command")
    }

    /// The name of the vehicle that was diagnosed; none where its file does not tell.
    pub fn vehicle(&self) -> Option<&str> {
        self.of_source("vehicle")
    }

    fn of_source(&self, key: &str) -> Option<&str> {
        let source = self.file.source.as_ref()?;
        source.get(key)?.as_str().filter(|text| !text.is_empty())
    }

    /// The questions.
    pub fn questions(&self) -> &[Question] {
        &self.questions
    }
}

/// What to drive next, and what it separates.
#[derive(Clone, Debug)]
pub struct Plan {
    found: Planned,
    settings: PlanSettings,
    vehicle: String,
    fingerprint: String,
}

/// Plans the driving that separates what is open; `vehicle` is the one that the diagnosis
/// corrected.
///
/// # Errors
/// Those of [`Plan::new`].
pub fn plan(
    questions: &OpenQuestions,
    vehicle: &Vehicle,
    settings: &PlanSettings,
) -> Result<Plan, Error> {
    Plan::new(questions, vehicle, settings, &unobserved)
}

impl Plan {
    /// Plans, observed: a part is a stage.
    ///
    /// # Errors
    /// [`Error::Plan`] for a vehicle that cannot move so, or a time in which no manoeuvre can be
    /// driven; [`Error::Cancelled`].
    pub fn new(
        questions: &OpenQuestions,
        vehicle: &Vehicle,
        settings: &PlanSettings,
        observer: &Observer,
    ) -> Result<Self, Error> {
        let counter = Counter::new(observer, STAGES.len());
        let progress = |stage| counter.advance(stage, 1);
        let name = vehicle.name().to_owned();
        let found = guarded(|| {
            trackdyn_diagnose::plan(questions.questions(), vehicle.file(), settings, &progress)
                .map_err(|cause| match cause {
                    trackdyn_diagnose::Error::Cancelled => Error::Cancelled,
                    cause => Error::Plan { vehicle: name.clone(), cause },
                })
        })?;
        let made_from = format!("{}{}", questions.document.text(), vehicle.to_toml());
        Ok(Self {
            found,
            settings: settings.clone(),
            vehicle: name,
            fingerprint: fingerprint(made_from.as_bytes()),
        })
    }

    /// Name of the vehicle.
    pub fn vehicle(&self) -> &str {
        &self.vehicle
    }

    /// How it was planned.
    pub fn settings(&self) -> &PlanSettings {
        &self.settings
    }

    /// All that was found.
    pub fn found(&self) -> &Planned {
        &self.found
    }

    /// The driving; none where no driving decides.
    pub fn schedule(&self) -> Option<Schedule> {
        self.found.schedule()
    }

    /// The plan as a file (schema `trackdyn.plan/1`).
    pub fn file(&self, provenance: &Provenance) -> PlanFile {
        let source = Source {
            vehicle: self.vehicle.clone(),
            fingerprint: self.fingerprint.clone(),
            ..provenance.source()
        };
        PlanFile::new(&self.found, &self.settings, source)
    }

    /// Writes `plan.csv`, a schedule for the simulator and the robot, and `plan.toml`. Where there
    /// is nothing to drive, the plan of an earlier run goes.
    ///
    /// # Errors
    /// [`Error::Output`], [`Error::NotRemoved`].
    pub fn write(
        &self,
        folder: impl AsRef<Path>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        let Some(schedule) = self.schedule() else { return remove_earlier(folder.as_ref()) };
        let mut folder = Folder::prepare(folder.as_ref())?;
        let [plan, table] = FILES;
        let csv = schedules::text(&[ScheduledRun { id: 0, schedule }]);
        folder.write(table, csv.as_bytes())?;
        folder.write(plan, self.file(provenance).to_toml().as_bytes())?;
        Ok(folder.changes())
    }
}

/// Removes the plan of an earlier run, where this one has none.
///
/// # Errors
/// [`Error::NotRemoved`].
pub fn remove_earlier(folder: &Path) -> Result<Vec<Change>, Error> {
    let mut folder = Folder::existing(folder);
    let [plan, table] = FILES;
    let files = [table, plan].map(|name| folder.file(name));
    folder.remove_earlier(plan, files)?;
    Ok(folder.changes())
}

//! The driving that tells apart what a diagnosis could not.

use crate::change::Folder;
use crate::law::guarded;
use crate::progress::Counter;
use crate::{
    Change, Diagnosis, Error, Limits, MethodSettings, Observer, Provenance, Vehicle, unobserved,
};
use std::path::Path;
use trackdyn_core::Schedule;
use trackdyn_core::document::Document;
use trackdyn_core::output::fingerprint;
use trackdyn_diagnose::document::NoiseTable;
use trackdyn_diagnose::plan::{Options, Question, STAGES, assumed_noise};
use trackdyn_diagnose::{DiagnosisFile, Plan as Planned, PlanFile};
use trackdyn_drive::schedules::{self, ScheduledRun};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_model::kinematics::Source;

/// Names of the files of a plan: the plan, and the driving as a schedule.
const FILES: [&str; 2] = ["plan.toml", "plan.csv"];

/// How to plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanSettings {
    /// Largest track speed, m/s. Default: 1.
    pub fastest: f64,
    /// Time for all manoeuvres together, s. Default: 60.
    pub duration: f64,
    /// Standard deviation of a pose along each axis, m. Default: as the diagnosis measured it, else
    /// 0.001.
    pub noise_xy: Option<f64>,
    /// Standard deviation of the yaw of a pose, rad. Default: as the diagnosis measured it, else
    /// 0.001.
    pub noise_yaw: Option<f64>,
}

/// Where the noise of a plan comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseOrigin {
    /// The settings, along the axes or in yaw.
    Given,
    /// The diagnosis.
    Measured,
    /// What a laboratory has: neither tells it.
    Assumed,
}

impl PlanSettings {
    /// Limits of the largest track speed.
    pub const SPEED_LIMITS: Limits = Limits { least: 0.05, most: 10.0, unit: "m/s" };
    /// Limits of the time.
    pub const DURATION_LIMITS: Limits = Limits { least: 1.0, most: 3600.0, unit: "s" };
    /// Limits of both standard deviations.
    pub const NOISE_LIMITS: Limits = Limits { least: 1e-6, most: 10.0, unit: "m or rad" };

    /// The noise to plan for, by what is given here, and what the diagnosis measured.
    fn noise(&self, questions: &OpenQuestions) -> (SegmentNoise, NoiseOrigin) {
        let measured = questions.noise();
        let mut noise = measured.unwrap_or_else(|| Options::default().noise);
        if let Some(xy) = self.noise_xy {
            let given = assumed_noise(xy, 0.0);
            noise.pose[..2].copy_from_slice(&given.pose[..2]);
            noise.walk[..2].copy_from_slice(&given.walk[..2]);
        }
        if let Some(yaw) = self.noise_yaw {
            let given = assumed_noise(0.0, yaw);
            (noise.pose[2], noise.walk[2]) = (given.pose[2], given.walk[2]);
            noise.heading = given.heading;
        }
        let origin = match (self.noise_xy.or(self.noise_yaw), measured) {
            (Some(_), _) => NoiseOrigin::Given,
            (None, Some(_)) => NoiseOrigin::Measured,
            (None, None) => NoiseOrigin::Assumed,
        };
        (noise, origin)
    }

    fn check(&self) -> Result<(), Error> {
        let given = [
            ("fastest", Some(self.fastest), Self::SPEED_LIMITS),
            ("duration", Some(self.duration), Self::DURATION_LIMITS),
            ("noise_xy", self.noise_xy, Self::NOISE_LIMITS),
            ("noise_yaw", self.noise_yaw, Self::NOISE_LIMITS),
        ];
        for (setting, value, limits) in given {
            value.map_or(Ok(0.0), |value| limits.check(setting, value))?;
        }
        Ok(())
    }
}

impl Default for PlanSettings {
    fn default() -> Self {
        let Options { fastest, duration, .. } = Options::default();
        Self { fastest, duration, noise_xy: None, noise_yaw: None }
    }
}

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
    options: Options,
    noise_origin: NoiseOrigin,
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
    /// [`Error::OutOfLimits`]; [`Error::Plan`] for a vehicle that cannot move so, or a time in
    /// which no manoeuvre can be driven; [`Error::Cancelled`].
    pub fn new(
        questions: &OpenQuestions,
        vehicle: &Vehicle,
        settings: &PlanSettings,
        observer: &Observer,
    ) -> Result<Self, Error> {
        settings.check()?;
        let PlanSettings { fastest, duration, .. } = *settings;
        let (noise, noise_origin) = settings.noise(questions);
        let options = Options { fastest, duration, noise, method: questions.method().clone() };
        let counter = Counter::new(observer, STAGES.len());
        let progress = |stage| counter.advance(stage, 1);
        let name = vehicle.name().to_owned();
        let found = guarded(|| {
            trackdyn_diagnose::plan(questions.questions(), vehicle.file(), &options, &progress)
                .map_err(|cause| match cause {
                    trackdyn_diagnose::Error::Cancelled => Error::Cancelled,
                    cause => Error::Plan { vehicle: name.clone(), cause },
                })
        })?;
        let made_from = format!("{}{}", questions.document.text(), vehicle.to_toml());
        Ok(Self {
            found,
            options,
            noise_origin,
            vehicle: name,
            fingerprint: fingerprint(made_from.as_bytes()),
        })
    }

    /// Name of the vehicle.
    pub fn vehicle(&self) -> &str {
        &self.vehicle
    }

    /// The noise of the poses that it is planned for, and where that comes from.
    pub fn noise(&self) -> (&SegmentNoise, NoiseOrigin) {
        (&self.options.noise, self.noise_origin)
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
        PlanFile::new(&self.found, &self.options, source)
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

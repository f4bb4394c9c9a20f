//! What differs between two sets of recordings of nominally the same robot.

use crate::change::Folder;
use crate::diagnose::{HeldOut, Prepared as Set};
use crate::law::guarded;
use crate::{
    Change, DiagnoseSettings, Error, MethodSettings, Observer, Progress, Provenance, Recording,
    Vehicle, unobserved,
};
use std::path::Path;
use trackdyn_diagnose::compare::document::ComparisonFile;
use trackdyn_diagnose::compare::{Comparison as Found, STAGES, Status, compare as compared};
use trackdyn_diagnose::progress::Watch;
use trackdyn_diagnose::{Evidence, Resampling};
use trackdyn_estimate::Contradiction;
use trackdyn_model::EffectId;
use trackdyn_report::{Compared, comparison_figures, comparison_html};

/// Name of the report.
const REPORT: &str = "compare.html";

/// How to compare.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CompareSettings {
    /// Runs of the robot that nothing is fitted or chosen on: the result is judged on them. With
    /// [`HeldOut::None`] none of the simulator are held out either, otherwise every fourth.
    pub held_out: HeldOut,
    /// Correct the yaw of the poses of each set by its gyroscope. Default: poses as they are.
    pub gyroscope: bool,
    /// Draws and seed of the bootstrap behind the tests. Default: 2000 draws, seed 1.
    pub resampling: Resampling,
    /// All numbers that decide an answer: thresholds, priors, step sizes.
    pub method: MethodSettings,
    /// Laws of a user that are candidates beside the catalogue.
    pub laws: Vec<EffectId>,
}

/// Compares recordings of a simulator with those of the robot: where they differ, what one has and
/// the other lacks, and what to set in the simulator. Their schedules may differ.
///
/// # Errors
/// Those of [`Prepared::new`] and [`Prepared::run`].
pub fn compare(
    sim: &[Recording],
    real: &[Recording],
    vehicle: &Vehicle,
    settings: &CompareSettings,
) -> Result<Comparison, Error> {
    Prepared::new(sim, real, vehicle, settings)?.run(&unobserved)
}

/// A comparison whose inputs and settings go together.
pub struct Prepared {
    sets: [Set; 2],
    vehicle: Vehicle,
    resampling: Resampling,
}

impl Prepared {
    /// Takes the evidence out of both sets of recordings.
    ///
    /// # Errors
    /// Those of [`diagnose::Prepared::new`](crate::diagnose::Prepared::new), for either set (a
    /// simulator may move its robot without slip, so its poses may be those of the tracks);
    /// [`Error::ComparedWithItself`] for a recording that is in both.
    pub fn new(
        sim: &[Recording],
        real: &[Recording],
        vehicle: &Vehicle,
        settings: &CompareSettings,
    ) -> Result<Self, Error> {
        if let Some(both) =
            sim.iter().find(|one| real.iter().any(|other| other.fingerprint() == one.fingerprint()))
        {
            return Err(Error::ComparedWithItself { recording: both.place() });
        }
        let of_set = |held_out: HeldOut| DiagnoseSettings {
            held_out,
            tau: None,
            gyroscope: settings.gyroscope,
            resampling: settings.resampling,
            method: settings.method.clone(),
            laws: settings.laws.clone(),
        };
        let of_sim = match settings.held_out {
            HeldOut::None => HeldOut::None,
            HeldOut::ByRule | HeldOut::Runs(_) => HeldOut::ByRule,
        };
        let sets = [
            Set::of_any(sim, vehicle, &of_set(of_sim))?,
            Set::new(real, vehicle, &of_set(settings.held_out.clone()))?,
        ];
        Ok(Self { sets, vehicle: vehicle.clone(), resampling: settings.resampling })
    }

    /// Names of both sets: the simulator's and the robot's.
    pub fn names(&self) -> [&str; 2] {
        self.sets.each_ref().map(Set::name)
    }

    /// What was seen of the simulator and of the robot.
    pub fn evidence(&self) -> [&Evidence; 2] {
        self.sets.each_ref().map(Set::evidence)
    }

    /// What contradicts the recordings of the simulator and of the robot, as
    /// [`Recording::contradictions`] finds it; poses of a simulator may be those of its tracks, so
    /// of these nothing is asked.
    pub fn contradictions(&self) -> [&[Contradiction]; 2] {
        self.sets.each_ref().map(Set::contradictions)
    }

    /// Compares, observed: a part is a stage of the method.
    ///
    /// # Errors
    /// [`Error::Diagnose`] for driving without turns, or a vehicle that cannot move as recorded;
    /// [`Error::Law`], [`Error::Cancelled`].
    pub fn run(self, observer: &Observer) -> Result<Comparison, Error> {
        let found = guarded(|| self.compared(observer))?;
        Ok(Comparison { found, of: self })
    }

    fn compared(&self, observer: &Observer) -> Result<Found, Error> {
        let total = 2 * Set::PARTS + STAGES;
        let sim = self.sets[0].examined(observer, 0, total)?;
        let real = self.sets[1].examined(observer, Set::PARTS, total)?;
        let progress = |at: trackdyn_diagnose::Progress| {
            let done = 2 * Set::PARTS + at.done;
            observer(Progress { stage: at.stage.name(), done, total })
        };
        let watch = &Watch::new(&progress, STAGES);
        let found = compared([&sim, &real], self.vehicle.file(), self.resampling, watch);
        found.map_err(|_| Error::Cancelled)
    }
}

/// What differs between two sets of recordings.
pub struct Comparison {
    found: Found,
    of: Prepared,
}

impl Comparison {
    /// What it says in a word.
    pub fn status(&self) -> Status {
        self.found.status()
    }

    /// All that was found.
    pub fn found(&self) -> &Found {
        &self.found
    }

    /// The vehicle as filed.
    pub fn vehicle(&self) -> &Vehicle {
        &self.of.vehicle
    }

    /// Names of both sets: the simulator's and the robot's.
    pub fn names(&self) -> [&str; 2] {
        self.of.names()
    }

    /// The comparison as a file (schema `trackdyn.comparison/1`).
    pub fn file(&self, provenance: &Provenance) -> ComparisonFile {
        let [sim, real] = self.of.sets.each_ref().map(|set| set.seen(provenance));
        ComparisonFile::new(&self.found, [&sim, &real])
    }

    /// Writes `compare.toml` and the page `compare.html`.
    ///
    /// # Errors
    /// [`Error::Output`], [`Error::Figure`].
    pub fn write(
        &self,
        folder: impl AsRef<Path>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        let mut folder = Folder::prepare(folder.as_ref())?;
        let caption = format!(
            "trackdyn {}; vehicle {} ({}); SIM {}; REAL {}",
            provenance.version,
            self.vehicle().name(),
            self.vehicle().fingerprint(),
            self.names()[0],
            self.names()[1],
        );
        let subject = Compared {
            comparison: &self.found,
            vehicle: self.vehicle().name(),
            names: self.names(),
            caption: &caption,
        };
        let html = comparison_html(&subject, &comparison_figures(&subject))?;
        folder.write("compare.toml", self.file(provenance).to_toml().as_bytes())?;
        folder.write(REPORT, html.as_bytes())?;
        Ok(folder.changes())
    }
}

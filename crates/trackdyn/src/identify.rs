//! Kinematic parameters from a recording.

mod document;
mod gyroscope;
mod motion;
mod points;
mod sourced;
mod turning;

pub use gyroscope::GyroscopeUse;
pub use motion::MotionFit;
pub use points::PointsFit;
pub use turning::TurningFit;

use crate::change::Folder;
use crate::progress::Counter;
use crate::{
    Change, Error, Gauge, Limits, Observer, Parameters, Provenance, Recording, unobserved,
};
use sourced::Sourced;
use std::path::Path;
use trackdyn_estimate::genetic::GeneticOptions;
use trackdyn_estimate::identification::Options;
use trackdyn_estimate::{Contradiction, Nuisance, Separation, Turning, identify_unless_stopped};
use trackdyn_model::kinematics::{SeparationFile, Source};
use trackdyn_recording::Recording as Motion;

/// Names of the kinematics files of the two fits: the ICRs alone, and with the factors on the track
/// speeds.
pub const FILES: [&str; 2] = ["kinematics.toml", "kinematics_alpha.toml"];

/// Name of the document of a recording of motion.
const DOCUMENT: &str = "identification.toml";

/// How to identify.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IdentifySettings {
    /// Time by which poses lag behind the track speeds, s. Default: estimated.
    pub tau: Option<f64>,
    /// Use only segments before which the tracks ran steadily for this time, s. Default: all.
    pub settle: Option<f64>,
    /// Properties of the pose sensor to fit beside the ICRs, where the recording shows them.
    /// Default: none.
    pub nuisances: Vec<Nuisance>,
    /// The genetic algorithm.
    pub genetic: GeneticOptions,
    /// Correct the yaw of the poses by the recording's gyroscope. Default: poses as they are.
    pub gyroscope: bool,
    /// Give and write parameters that other parts of the answer contradict as well, marked as
    /// doubtful. Default: they are withheld.
    pub force: bool,
}

impl IdentifySettings {
    /// Limits of the number of individuals of the genetic algorithm.
    pub const POPULATION_LIMITS: Limits = Limits { least: 4.0, most: 1e5, unit: "" };
    /// Limits of the number of its generations.
    pub const GENERATIONS_LIMITS: Limits = Limits { least: 1.0, most: 1e5, unit: "" };
    /// Limits of the time for which the tracks ran steadily.
    pub const SETTLE_LIMITS: Limits = Limits { least: 0.0, most: 3600.0, unit: "s" };

    /// Names of the settings that count for recordings of motion only, where they are set.
    fn of_motion(&self) -> Vec<&'static str> {
        let given = [
            ("tau", self.tau.is_some()),
            ("settle", self.settle.is_some()),
            ("nuisances", !self.nuisances.is_empty()),
            ("gyroscope", self.gyroscope),
        ];
        given.into_iter().filter_map(|(name, given)| given.then_some(name)).collect()
    }

    /// What to fit beside the ICRs, each once and in order.
    fn nuisances(&self) -> Vec<Nuisance> {
        let mut nuisances = self.nuisances.clone();
        nuisances.sort_unstable();
        nuisances.dedup();
        nuisances
    }
}

/// What a recording says of the kinematic parameters.
#[derive(Clone, Debug)]
pub enum Identification {
    /// From a recording of motion: spin test, genetic algorithm and least squares.
    Motion(Box<MotionFit>),
    /// From a table of steady operating points: least squares.
    Points(Box<PointsFit>),
    /// From a recording whose poses have a yaw alone: the distance of the ICRs.
    Turning(Box<TurningFit>),
}

/// Identifies the kinematic parameters of a robot: of the vehicle, its gauge counts.
///
/// # Errors
/// Those of [`Prepared::new`] and [`Prepared::run`].
pub fn identify(
    recording: &Recording,
    vehicle: impl Into<Gauge>,
    settings: &IdentifySettings,
) -> Result<Identification, Error> {
    Prepared::new(recording, vehicle, settings)?.run(&unobserved)
}

/// An identification whose inputs and settings go together.
#[derive(Clone, Debug)]
pub struct Prepared<'a> {
    recording: &'a Recording,
    gauge: Gauge,
    settings: &'a IdentifySettings,
}

impl<'a> Prepared<'a> {
    /// Checks that inputs and settings go together.
    ///
    /// # Errors
    /// [`Error::MotionOnly`] for settings that a table of steady operating points has no use for.
    pub fn new(
        recording: &'a Recording,
        vehicle: impl Into<Gauge>,
        settings: &'a IdentifySettings,
    ) -> Result<Self, Error> {
        if let Some(points) = recording.points() {
            points.refuse(settings.of_motion())?;
        }
        Ok(Self { recording, gauge: vehicle.into(), settings })
    }

    /// Identifies, observed: a part is a generation of the genetic algorithm, which runs twice.
    ///
    /// # Errors
    /// [`Error::Identify`] for a recording with too little in it, [`Error::Cancelled`].
    pub fn run(&self, observer: &Observer) -> Result<Identification, Error> {
        let Self { recording, gauge, settings } = self;
        let sourced = Sourced::new(recording, gauge, settings);
        if let Some(points) = recording.points() {
            return Ok(Identification::Points(Box::new(PointsFit::new(points, sourced))));
        }
        let raw: &Motion = recording.expect_motion()?;
        let corrected = recording.corrected(settings.gyroscope, settings.tau);
        let motion = corrected.expect_motion()?;
        let refuse = |cause| Error::Identify { recording: recording.place(), cause };
        if !motion.has_positions() {
            let found = Turning::of(motion, settings.tau).map_err(refuse)?;
            return Ok(Identification::Turning(Box::new(TurningFit { found, sourced })));
        }
        let options = Options {
            tau: settings.tau,
            settle: settings.settle,
            nuisances: settings.nuisances(),
            yaw_scale: corrected.yaw_scale(),
            genetic: settings.genetic,
            ..Options::new(gauge.metres())
        };
        let counter = Counter::new(observer, 2 * options.genetic.generations);
        let progress = |_| counter.advance("genetic algorithm", 1);
        let found =
            identify_unless_stopped(motion, &options, &progress).map_err(|cause| match cause {
                trackdyn_estimate::Error::Cancelled => Error::Cancelled,
                cause => refuse(cause),
            })?;
        let sourced = sourced.with_seed(settings.genetic.seed);
        let gyroscope = corrected.gyroscope().cloned().map(|of| {
            let options = Options { yaw_scale: 0.0, ..options.clone() };
            GyroscopeUse::new(of, raw, &options)
        });
        let fit = MotionFit::new(found, gyroscope, motion, gauge, sourced);
        Ok(Identification::Motion(Box::new(fit)))
    }
}

impl Identification {
    /// The parameters of the ICRs alone, and with the factors on the track speeds; none where the
    /// recording does not determine them.
    pub fn fits(&self, provenance: &Provenance) -> [Option<Parameters>; 2] {
        let files = match self {
            Self::Motion(fit) => fit.files(provenance),
            Self::Points(fit) => fit.files(provenance),
            Self::Turning(_) => [None, None],
        };
        let [icrs, with_alphas] = files;
        [(icrs, FILES[0]), (with_alphas, FILES[1])]
            .map(|(file, name)| file.map(|file| Parameters::of(name, file)))
    }

    /// The parameters of the ICRs, with the track speeds as measured; none where the recording does
    /// not determine them.
    pub fn parameters(&self) -> Option<Parameters> {
        let [icrs, _] = self.fits(&Provenance::default());
        icrs
    }

    /// What contradicts each of the fits, and keeps it from being given or written unless forced.
    pub fn contradictions(&self) -> [Vec<Contradiction>; 2] {
        match self {
            Self::Motion(fit) => fit.found.fits.each_ref().map(|fit| fit.contradictions.clone()),
            Self::Points(points) => points.fits.each_ref().map(|(_, fit)| {
                fit.as_ref().map_or(Vec::new(), |fit| fit.contradictions(points.gauge()))
            }),
            Self::Turning(fit) => [fit.contradictions(), Vec::new()],
        }
    }

    /// For each of the fits, the first reason why the recording does not determine it, or why it is
    /// withheld.
    pub fn reasons(&self) -> [Option<String>; 2] {
        let doubts: [Option<String>; 2] = match self {
            Self::Motion(fit) => fit.found.fits.each_ref().map(|fit| match &fit.least_squares {
                Ok(_) => fit.doubts.first().map(ToString::to_string),
                Err(reason) => Some(reason.to_string()),
            }),
            Self::Points(points) => points.fits.each_ref().map(|(_, fit)| match fit {
                Ok(fit) => fit.doubts(points.gauge()).first().map(ToString::to_string),
                Err(reason) => Some(reason.to_string()),
            }),
            Self::Turning(fit) => {
                let contradiction = fit.contradictions().first().map(ToString::to_string);
                let reason = contradiction.or_else(|| Some("poses have a yaw alone".to_owned()));
                [reason.clone(), reason]
            }
        };
        let mut contradictions = self.contradictions().into_iter();
        doubts.map(|doubt| {
            let contradicted = contradictions.next().unwrap_or_default();
            doubt.or_else(|| contradicted.first().map(ToString::to_string))
        })
    }

    /// The distance of the ICRs alone, where the recording determines nothing else and nothing
    /// contradicts it.
    pub fn separation(&self, provenance: &Provenance) -> Option<SeparationFile> {
        let has_fit = self.fits(provenance).iter().any(Option::is_some);
        let is_contradicted = self.contradictions().iter().any(|found| !found.is_empty());
        if has_fit || is_contradicted {
            return None;
        }
        let (found, sourced) = self.turning()?;
        let efficiency = found.steering_efficiency(sourced.gauge);
        let is_possible = Contradiction::of_efficiency(&efficiency).is_none();
        is_possible.then(|| sourced.separation(found, provenance))
    }

    /// The distance of the ICRs from turning alone, whatever contradicts it.
    fn turning(&self) -> Option<(&Separation, &Sourced)> {
        Some(match self {
            Self::Motion(fit) => (fit.separation()?, &fit.sourced),
            Self::Points(fit) => (fit.separation.as_ref().ok()?, &fit.sourced),
            Self::Turning(fit) => (&fit.found.separation, &fit.sourced),
        })
    }

    /// Why not even the distance of the ICRs is determined. None where it is, where the
    /// [reasons](Self::reasons) of the fits say why, and where poses have a yaw alone, of which
    /// [`contradictions`](Self::contradictions) say why.
    pub fn reason_without_separation(&self) -> Option<String> {
        if let Self::Turning(_) = self {
            return None;
        }
        if let Some((found, sourced)) = self.turning() {
            let efficiency = found.steering_efficiency(sourced.gauge);
            return Contradiction::of_efficiency(&efficiency).map(|one| one.to_string());
        }
        match self {
            Self::Points(fit) => fit.separation.as_ref().err().map(ToString::to_string),
            Self::Motion(_) | Self::Turning(_) => None,
        }
    }

    /// Whether the recording determines the parameters, or the distance of the ICRs at least.
    pub fn is_determined(&self) -> bool {
        let provenance = Provenance::default();
        let has_fit = self.fits(&provenance).iter().any(Option::is_some);
        has_fit || self.separation(&provenance).is_some()
    }

    /// Writes `kinematics.toml` and `kinematics_alpha.toml`, each where the recording determines
    /// it, and of a recording of motion `identification.toml`. Where all that it determines is the
    /// distance of the ICRs, `kinematics.toml` holds that (schema
    /// `trackdyn.separation/1`). A file of an earlier fit goes where this one has none.
    ///
    /// # Errors
    /// Those of [`refuse_other`]; [`Error::Output`], [`Error::NotRemoved`].
    pub fn write(
        &self,
        folder: impl AsRef<Path>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        refuse_other(folder.as_ref())?;
        let mut folder = Folder::prepare(folder.as_ref())?;
        match self {
            Self::Motion(fit) => folder.write(DOCUMENT, fit.to_toml(provenance).as_bytes())?,
            Self::Points(_) | Self::Turning(_) => folder.remove_if_there(DOCUMENT)?,
        }
        let [icrs, with_alphas] = self.fits(provenance);
        let text = |parameters: Parameters| parameters.document().text().to_owned();
        let icrs = icrs.map(text);
        let icrs = icrs.or_else(|| Some(self.separation(provenance)?.to_toml()));
        for (text, name) in [icrs, with_alphas.map(text)].into_iter().zip(FILES) {
            match text {
                Some(text) => folder.write(name, text.as_bytes())?,
                None => folder.remove_if_there(name)?,
            }
        }
        Ok(folder.changes())
    }
}

/// Refuses a folder with a kinematics file that is of no recording, such as that of a map: an
/// identification would replace it.
///
/// # Errors
/// [`Error::OtherOrigin`].
pub fn refuse_other(folder: &Path) -> Result<(), Error> {
    let folder = Folder::existing(folder);
    let is_own = |source: &Source| source.recording.is_some();
    FILES.into_iter().try_for_each(|name| folder.refuse_other(name, is_own))
}

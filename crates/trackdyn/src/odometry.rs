//! Dead reckoning of a recording with several sets of parameters.

mod advice;
mod document;
mod layers;
mod names;
mod runs_table;

pub use advice::{Advice, Compared};

use crate::change::Folder;
use crate::law::guarded;
use crate::viewer::{self, Layers};
use crate::{Change, Error, Figure, Gauge, Parameters, Part, Provenance, Recording};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use trackdyn_estimate::identification::Options;
use trackdyn_estimate::odometry::{self, Comparison, ParameterSet, tum};
use trackdyn_estimate::{Clock, Contradiction, clock};
use trackdyn_model::kinematics::Source;
use trackdyn_model::{Kinematics, VehicleFile};
use trackdyn_recording::RunList;

/// Name of the document that every replay writes.
const FILE: &str = "odometry.toml";

/// Name of the files for viewers, without extension.
const LAYERS: &str = "odometry";

/// Largest coordinate of an ICR, m, and largest alpha, 1, that a replay takes for meant.
const MAX_PARAMETER: f64 = 1e3;

/// How to replay.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OdometrySettings {
    /// The part of the recording to replay. Its clock is estimated from all of it. Default: all.
    pub part: Part,
    /// Time by which poses lag behind the track speeds, s. Default: estimated.
    pub tau: Option<f64>,
    /// Correct the yaw of the poses by the recording's gyroscope. Default: poses as they are.
    pub gyroscope: bool,
}

/// Where the robot would be if parameters were true, against where it was: for the ideal
/// differential drive and several sets of parameters.
#[derive(Clone, Debug)]
pub struct Odometry {
    /// The replays and their errors. Its first set is the ideal drive.
    pub comparison: Comparison,
    /// The clock offset, and where it comes from.
    pub clock: Clock,
    /// What contradicts itself in all of the recording.
    pub contradictions: Vec<Contradiction>,
    replayed: Vec<Replayed>,
    physics_stopped: Option<String>,
    recording: Recording,
    gauge: Gauge,
    part: Part,
    time: Option<[f64; 2]>,
}

/// Parameters that were replayed, under a name that no other set has.
#[derive(Clone, Debug)]
struct Replayed {
    parameters: Parameters,
    set: ParameterSet,
}

/// Replays a recording with the ideal drive of the gauge, be it that of a `&Vehicle` or alone; with
/// each of these parameters, as they are and without their factors on the track speeds; and with
/// the forces on the vehicle, where there is one.
///
/// # Errors
/// [`Error::NoMotion`] for a table of steady operating points, [`Error::NoReference`] for poses
/// that are computed from the tracks, [`Error::TooLarge`] for parameters that no robot has,
/// [`Error::Runs`], [`Error::Time`], [`Error::Odometry`], [`Error::Law`].
pub fn odometry(
    recording: &Recording,
    gauge: impl Into<Gauge>,
    parameters: &[Parameters],
    settings: &OdometrySettings,
) -> Result<Odometry, Error> {
    let gauge = gauge.into();
    guarded(|| replay(recording, gauge, parameters, settings))
}

fn replay(
    recording: &Recording,
    gauge: Gauge,
    parameters: &[Parameters],
    settings: &OdometrySettings,
) -> Result<Odometry, Error> {
    recording.expect_positions()?;
    let corrected = recording.corrected(settings.gyroscope, settings.tau);
    let motion = corrected.expect_positions()?;
    let names = names::names(parameters.iter().map(|one| Path::new(one.name())));
    let replayed: Vec<Replayed> = parameters
        .iter()
        .zip(names)
        .map(|(parameters, name)| Replayed::new(parameters, name))
        .collect::<Result<_, _>>()?;
    let part = corrected.part(&settings.part)?;
    // All of the recording tells most of its clocks.
    let clock = Clock::of(motion, settings.tau, &clock::Settings::default())
        .map_err(|cause| Error::Identify { recording: recording.place(), cause })?;
    let options = Options { tau: settings.tau, ..Options::new(gauge.metres()) };
    let contradictions = corrected.expect_reference(&options)?;
    let of_file = |one: &Replayed| [Some(one.set.clone()), one.set.without_alpha()];
    let sets = replayed.iter().flat_map(of_file).flatten();
    let sets: Vec<_> = std::iter::once(ParameterSet::ideal(gauge.metres())).chain(sets).collect();
    let physics = gauge.file().map(|vehicle| {
        let delay = odometry::in_time::delay(motion, vehicle, &clock);
        ParameterSet::of_vehicle(ParameterSet::PHYSICS_NAME, vehicle, delay)
    });
    let driven = part.expect_motion()?;
    let compared = |physics: Option<ParameterSet>| {
        Comparison::new(driven, sets.iter().cloned().chain(physics).collect(), clock.tau())
    };
    let (comparison, physics_stopped) = match compared(physics) {
        Err(error @ odometry::Error::Stopped { .. }) => (compared(None), Some(error.to_string())),
        comparison => (comparison, None),
    };
    let comparison =
        comparison.map_err(|cause| Error::Odometry { recording: recording.place(), cause })?;
    Ok(Odometry {
        comparison,
        clock,
        contradictions,
        replayed,
        physics_stopped,
        recording: corrected.into_owned(),
        gauge,
        part: settings.part.clone(),
        time: part.time(),
    })
}

impl Odometry {
    /// The recording, all of it, with poses that its gyroscope corrects.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// The gauge of the ideal drive, and the vehicle that has it.
    pub fn gauge(&self) -> &Gauge {
        &self.gauge
    }

    /// Parameters that were fitted to some of the driving that is replayed here, which makes their
    /// errors look smaller.
    pub fn fitted_to_it(&self) -> impl Iterator<Item = &Parameters> {
        let fitted = |one: &&Replayed| !self.is_held_out(one.parameters.source());
        self.replayed.iter().filter(fitted).map(|one| &one.parameters)
    }

    /// Why the forces on the vehicle are not among the sets, though there is a vehicle: they do not
    /// move it as its tracks were driven.
    pub fn physics_stopped(&self) -> Option<&str> {
        self.physics_stopped.as_deref()
    }

    /// The vehicle whose forces are replayed.
    fn physics(&self) -> Option<&VehicleFile> {
        self.comparison.sets.last()?.vehicle()
    }

    /// Whether the vehicle whose forces are replayed was corrected by some of the driving that is
    /// replayed here, which makes its errors look smaller.
    pub fn is_physics_fitted_to_it(&self) -> bool {
        let source = self.physics().and_then(|vehicle| vehicle.source.as_ref());
        source.is_some_and(|source| !self.is_held_out(source))
    }

    /// Which of the parameters to take.
    pub fn advice(&self) -> Advice {
        advice::of(self)
    }

    /// Root mean square over runs of the errors of place, m, and yaw, rad, at the end, of a set.
    pub fn error_at_end(&self, set: usize) -> [f64; 2] {
        let paths = self.comparison.paths.iter();
        let last: Vec<_> =
            paths.filter_map(|path| path.errors(set)).map(|errors| errors.last).collect();
        #[expect(clippy::cast_precision_loss, reason = "a number of runs")]
        let count = last.len().max(1) as f64;
        let places: f64 = last.iter().map(|last| last.position().powi(2)).sum();
        let yaws: f64 = last.iter().map(|last| last.yaw * last.yaw).sum();
        [(places / count).sqrt(), (yaws / count).sqrt()]
    }

    /// The text of `odometry.toml` (schema `trackdyn.odometry/1`).
    pub fn to_toml(&self, provenance: &Provenance) -> String {
        document::text(self, provenance)
    }

    /// Errors run by run, CSV.
    pub fn runs_csv(&self) -> String {
        runs_table::text(&self.comparison)
    }

    /// The replay as a figure.
    pub fn figure(&self, provenance: &Provenance) -> Figure {
        let caption = format!(
            "trackdyn {}, {}, recording {}",
            provenance.version,
            self.gauge.caption(),
            self.recording.fingerprint()
        );
        trackdyn_report::odometry(&self.comparison, self.recording.name(), &caption)
    }

    /// What Foxglove, Rerun and PlotJuggler show of it: the recorded path, those of the ideal drive
    /// and of each set of parameters as given, the ICRs, track speeds, and residuals by segments.
    ///
    /// # Errors
    /// None for a replay that this library made.
    pub fn layers(&self, provenance: &Provenance) -> Result<Layers, Error> {
        layers::of(self, provenance)
    }

    /// Writes `odometry.mcap` with these [layers](Self::layers), and layouts beside it.
    ///
    /// # Errors
    /// [`Error::Output`].
    pub fn write_layers(
        &self,
        folder: impl AsRef<Path>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        viewer::write(&self.layers(provenance)?, folder, LAYERS)
    }

    /// Writes `odometry.png`, `runs.csv`, `odometry.toml` and the paths into `trajectories`. Paths
    /// of an earlier replay go where this one has none, and so do its [layers](Self::write_layers),
    /// which are written after this.
    ///
    /// # Errors
    /// [`Error::Output`], [`Error::NotRemoved`], [`Error::Unreadable`], [`Error::Figure`].
    pub fn write(
        &self,
        folder: impl AsRef<Path>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        let mut folder = Folder::prepare(folder.as_ref())?;
        folder.write("odometry.png", &self.figure(provenance).to_png()?)?;
        folder.write("runs.csv", self.runs_csv().as_bytes())?;
        self.write_trajectories(&mut folder)?;
        viewer::remove_earlier(&mut folder, FILE, LAYERS)?;
        folder.write(FILE, self.to_toml(provenance).as_bytes())?;
        Ok(folder.changes())
    }

    /// Writes recorded and predicted paths, each as a trajectory of the TUM benchmark.
    fn write_trajectories(&self, folder: &mut Folder) -> Result<(), Error> {
        let place = folder.file(TRAJECTORIES);
        crate::prepare_folder(&place)?;
        let mut files = BTreeSet::new();
        let comparison = &self.comparison;
        for path in &comparison.paths {
            let predicted = comparison.sets.iter().zip(&path.trajectories);
            let named = predicted.map(|(set, trajectory)| (set.name(), &trajectory.poses));
            for (name, poses) in std::iter::once(("recorded", &path.recorded)).chain(named) {
                let file = format!("{name}-run{}.tum", path.run);
                let text = tum::text(&path.stamps, poses);
                folder.write(&format!("{TRAJECTORIES}/{file}"), text.as_bytes())?;
                files.insert(place.join(file));
            }
        }
        let there = std::fs::read_dir(&place)
            .map_err(|cause| Error::Unreadable { path: place.clone(), cause })?;
        let there = there.filter_map(|entry| Some(entry.ok()?.path()));
        let is_other = |file: &PathBuf| {
            file.extension().is_some_and(|extension| extension == "tum") && !files.contains(file)
        };
        folder.remove_earlier(FILE, there.filter(is_other))
    }

    /// Whether the numbers of parameters were fitted to other runs, or another time of them, than
    /// are replayed.
    fn is_held_out(&self, source: &Source) -> bool {
        const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
        let here = RunList::new(self.comparison.paths.iter().map(|path| path.run));
        let fitted = source.runs.as_ref().and_then(|runs| runs.parse::<RunList>().ok());
        let [from, until] = self.time.unwrap_or(ALL);
        let [fitted_from, fitted_until] = source.time_s.unwrap_or(ALL);
        let poses = self.recording.motion().map(trackdyn_recording::Recording::pose_fingerprint);
        // Numbers of runs change where recordings are joined.
        if poses.is_some_and(|poses| source.joined.iter().any(|of_fit| of_fit == poses)) {
            return false;
        }
        let is_other = match source.pose_fingerprint.as_deref() {
            Some(of_fit) => poses != Some(of_fit),
            None => source.fingerprint != self.recording.fingerprint(),
        };
        is_other
            || fitted.is_some_and(|fitted| !fitted.overlaps(&here))
            || from >= fitted_until
            || until <= fitted_from
    }
}

/// Name of the folder of the paths.
const TRAJECTORIES: &str = "trajectories";

impl Replayed {
    fn name(&self) -> &str {
        self.set.name()
    }

    fn new(parameters: &Parameters, name: String) -> Result<Self, Error> {
        let set = ParameterSet::of_file(name, parameters.file());
        let Kinematics { icrs, alpha } = parameters.file().kinematics();
        let numbers = [
            ("x_icr_left_m", icrs.x_left),
            ("x_icr_right_m", icrs.x_right),
            ("y_icr_m", icrs.y),
            ("alpha_left", alpha.left),
            ("alpha_right", alpha.right),
        ];
        let meant = |value: f64| value.is_finite() && value.abs() <= MAX_PARAMETER;
        if let Some((key, value)) = numbers.into_iter().find(|(_, value)| !meant(*value)) {
            let file = parameters.name().to_owned();
            return Err(Error::TooLarge { file, key, value, most: MAX_PARAMETER });
        }
        Ok(Self { parameters: parameters.clone(), set })
    }
}

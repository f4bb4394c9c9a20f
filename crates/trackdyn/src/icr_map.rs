//! The ICR map of a vehicle: its stationary motion over track speeds.

use crate::change::Folder;
use crate::law::guarded;
use crate::progress::Counter;
use crate::{Change, Error, Figure, Observer, Parameters, Provenance, Vehicle, unobserved};
use std::path::Path;
use trackdyn_model::kinematics::{GridSource, KinematicsFile, Source};
use trackdyn_model::map::{IcrMap as Solved, Statistics};
use trackdyn_model::{Circumstance, Grid, Status};

/// Name of the kinematics file of a map.
const FILE: &str = "kinematics.toml";

/// Largest standard deviation of an ICR over a map, m, up to which its mean tells all.
const MAX_TOLD_SPREAD: f64 = 1e-3;

/// How a map is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapSettings {
    /// The track speeds. Default: 21 per track up to 1 m/s, as in Martínez et al. (2005).
    pub grid: Grid,
    /// Place, heading and time, for effects that know them. Default: the origin, 0, 0.
    pub circumstance: Circumstance,
}

impl MapSettings {
    /// Speeds per track of the default.
    pub const POINTS: usize = 21;
}

impl Default for MapSettings {
    fn default() -> Self {
        Self {
            grid: Grid::new(Self::POINTS, Grid::PAPER_SPEED).expect("numbers in range"),
            circumstance: Circumstance::default(),
        }
    }
}

/// The stationary motion of a vehicle for every pair of track speeds of a grid.
#[derive(Clone, Debug)]
pub struct IcrMap {
    solved: Solved,
    vehicle: Vehicle,
    statistics: Option<Statistics>,
}

/// Solves the ICR map of a vehicle.
///
/// # Panics
/// Only where a law of a user fails, see [`IcrMap::solve`].
pub fn icr_map(vehicle: &Vehicle, settings: &MapSettings) -> IcrMap {
    IcrMap::solve(vehicle, settings, &unobserved).expect("laws that do not fail")
}

impl IcrMap {
    /// Solves a map, on all threads, observed: a part is a pair of track speeds.
    ///
    /// # Errors
    /// [`Error::Law`], [`Error::Cancelled`].
    pub fn solve(
        vehicle: &Vehicle,
        settings: &MapSettings,
        observer: &Observer,
    ) -> Result<Self, Error> {
        let MapSettings { grid, circumstance } = settings;
        let counter = Counter::new(observer, grid.points() * grid.points());
        let progress = |pairs| counter.advance("map", pairs);
        let solved = guarded(|| {
            let model = vehicle.model();
            let solved = Solved::solve_unless_stopped(&model, *grid, circumstance, &progress);
            solved.ok_or(Error::Cancelled)
        })?;
        let statistics = solved.statistics();
        Ok(Self { solved, vehicle: vehicle.clone(), statistics })
    }

    /// All solutions.
    pub fn solved(&self) -> &Solved {
        &self.solved
    }

    /// Means and spreads of the ICRs; none where no motion turns.
    pub fn statistics(&self) -> Option<&Statistics> {
        self.statistics.as_ref()
    }

    /// Largest standard deviation of an ICR over the map, m, where the means do not tell all: they
    /// stand for the ICRs at all speeds to a millimetre, or for those of each sector.
    pub fn untold_spread(&self) -> Option<f64> {
        let spread = self.statistics.as_ref()?.spread.to_array().into_iter().fold(0.0, f64::max);
        (spread > MAX_TOLD_SPREAD && self.solved.sectors().is_empty()).then_some(spread)
    }

    /// The parameters to drive with; none where no motion turns.
    pub fn parameters(&self, provenance: &Provenance) -> Option<Parameters> {
        let statistics = self.statistics.as_ref()?;
        let source = self.source(provenance);
        let file = KinematicsFile::of_map(statistics, &self.solved.sectors(), source);
        Some(Parameters::of(FILE, file.with_alpha(self.vehicle.model().drive().gain)))
    }

    /// The map as a figure.
    pub fn figure(&self, provenance: &Provenance) -> Figure {
        let (version, vehicle) = (&provenance.version, self.vehicle.fingerprint());
        let caption = format!("trackdyn {version}, vehicle and effects {vehicle}");
        trackdyn_report::icr_map(&self.solved, &self.vehicle.model(), &caption)
    }

    /// Refuses a folder whose `kinematics.toml` is not of a map: a map would replace it.
    ///
    /// # Errors
    /// [`Error::OtherOrigin`].
    pub fn refuse_other(folder: &Path) -> Result<(), Error> {
        Folder::existing(folder).refuse_other(FILE, |source| source.grid.is_some())
    }

    /// Writes `icr_map.png` and, where the robot turns, `kinematics.toml`.
    ///
    /// # Errors
    /// Those of [`IcrMap::refuse_other`]; [`Error::Output`], [`Error::NotRemoved`],
    /// [`Error::Figure`].
    pub fn write(
        &self,
        folder: impl AsRef<Path>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        Self::refuse_other(folder.as_ref())?;
        let mut folder = Folder::prepare(folder.as_ref())?;
        folder.write("icr_map.png", &self.figure(provenance).to_png()?)?;
        match self.parameters(provenance) {
            Some(parameters) => folder.write(FILE, parameters.document().text().as_bytes())?,
            None => folder.remove_if_there(FILE)?,
        }
        Ok(folder.changes())
    }

    /// Where the numbers come from.
    fn source(&self, provenance: &Provenance) -> Source {
        let grid = self.solved.grid;
        let motions = Status::NAMES
            .iter()
            .zip(self.solved.counts())
            .filter(|(_, count)| *count > 0)
            .map(|(name, count)| (name.replace(' ', "_"), count))
            .collect();
        Source {
            vehicle: self.vehicle.name().to_owned(),
            fingerprint: self.vehicle.fingerprint(),
            grid: Some(GridSource { points: grid.points(), max_speed_m_s: grid.max_speed() }),
            effects: self.vehicle.effects().iter().map(ToString::to_string).collect(),
            motions: Some(motions),
            ..provenance.source()
        }
    }
}

//! What a table of steady operating points says of the kinematic parameters.

use crate::recording::PointsTable;
use crate::{IdentifySettings, Provenance, Vehicle};
use trackdyn_estimate::least_squares::Loss;
use trackdyn_estimate::steady::{Lagging, SteadyEstimate, lagging};
use trackdyn_estimate::{Error, Free, Parameters, fit_points};
use trackdyn_model::Kinematics;
use trackdyn_model::kinematics::{KinematicsFile, Source};

/// What a table of steady operating points says of the kinematic parameters.
#[derive(Clone, Debug)]
pub struct PointsFit {
    /// With the ICRs free, and with the ICRs and the factors on the track speeds free, by Huber's
    /// loss; or why not.
    pub fits: [(Free, Result<SteadyEstimate, Error>); 2],
    /// With the ICRs free, by plain squares; or why not.
    pub squares: Result<SteadyEstimate, Error>,
    /// Points that turn less than others that are driven less: a track did not run at its speed.
    pub lagging: Vec<Lagging>,
    source: Source,
    gauge: f64,
    force: bool,
}

impl PointsFit {
    pub(super) fn new(table: &PointsTable, vehicle: &Vehicle, settings: &IdentifySettings) -> Self {
        let gauge = vehicle.gauge();
        let start = Parameters::of(&Kinematics::ideal(gauge));
        let points = table.points();
        let squares = fit_points(points, &start, Free::Icrs, Loss::Squares);
        let fits = [Free::Icrs, Free::IcrsAndAlphas]
            .map(|free| (free, fit_points(points, &start, free, Loss::Huber)));
        let source = Source {
            vehicle: vehicle.name().to_owned(),
            fingerprint: table.fingerprint().to_owned(),
            recording: Some(table.name().to_owned()),
            ..Source::default()
        };
        let force = settings.force;
        Self { fits, squares, lagging: lagging(points), source, gauge, force }
    }

    /// Gauge of the vehicle, m.
    pub fn gauge(&self) -> f64 {
        self.gauge
    }

    /// The kinematics files of the fits, where the table determines them and nothing contradicts
    /// them, or where the settings force them.
    pub(super) fn files(&self, provenance: &Provenance) -> [Option<KinematicsFile>; 2] {
        self.fits.each_ref().map(|(free, fit)| {
            let fit = fit.as_ref().ok().filter(|fit| fit.doubts(self.gauge).is_empty())?;
            let doubtful = !fit.contradictions(self.gauge).is_empty();
            if doubtful && !self.force {
                return None;
            }
            let Provenance { command, version } = provenance.clone();
            let source = Source { command, version, ..self.source.clone() };
            let rows = fit.covariance_of_parameters();
            let kinematics = fit.parameters.kinematics();
            let with_alphas = *free == Free::IcrsAndAlphas;
            let mut file =
                KinematicsFile::of_fit(&kinematics, self.gauge, with_alphas, rows, source);
            file.doubtful = doubtful;
            Some(file)
        })
    }
}

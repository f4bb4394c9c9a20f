//! What a table of steady operating points says of the kinematic parameters.

use super::sourced::{Fitted, Sourced};
use crate::Provenance;
use crate::recording::PointsTable;
use trackdyn_estimate::least_squares::Loss;
use trackdyn_estimate::steady::{Lagging, SteadyEstimate, lagging};
use trackdyn_estimate::{Error, Free, Parameters, Separation, fit_points};
use trackdyn_model::Kinematics;
use trackdyn_model::kinematics::KinematicsFile;

/// What a table of steady operating points says of the kinematic parameters.
#[derive(Clone, Debug)]
pub struct PointsFit {
    /// With the ICRs free, and with the ICRs and the factors on the track speeds free, by Huber's
    /// loss; or why not.
    pub fits: [(Free, Result<SteadyEstimate, Error>); 2],
    /// With the ICRs free, by plain squares; or why not.
    pub squares: Result<SteadyEstimate, Error>,
    /// The distance of the ICRs from the yaw rates alone, or why not.
    pub separation: Result<Separation, Error>,
    /// Points that turn less than others that are driven less: a track did not run at its speed.
    pub lagging: Vec<Lagging>,
    pub(super) sourced: Sourced,
}

impl PointsFit {
    pub(super) fn new(table: &PointsTable, sourced: Sourced) -> Self {
        let gauge = sourced.gauge;
        let start = Parameters::of(&Kinematics::ideal(gauge));
        let points = table.points();
        let squares = fit_points(points, &start, Free::Icrs, Loss::Squares);
        let fits = [Free::Icrs, Free::IcrsAndAlphas]
            .map(|free| (free, fit_points(points, &start, free, Loss::Huber)));
        let separation = Separation::of_points(points);
        Self { fits, squares, separation, lagging: lagging(points), sourced }
    }

    /// Gauge of the vehicle, m.
    pub fn gauge(&self) -> f64 {
        self.sourced.gauge
    }

    /// The kinematics files of the fits, where the table determines them and nothing contradicts
    /// them, or where the settings force them.
    pub(super) fn files(&self, provenance: &Provenance) -> [Option<KinematicsFile>; 2] {
        let gauge = self.sourced.gauge;
        self.fits.each_ref().map(|(free, fit)| {
            let fit = fit.as_ref().ok().filter(|fit| fit.doubts(gauge).is_empty())?;
            let fitted = Fitted {
                parameters: fit.parameters,
                free: *free,
                covariance: fit.covariance_of_parameters(),
            };
            self.sourced.file(&fitted, &fit.contradictions(gauge), provenance)
        })
    }
}

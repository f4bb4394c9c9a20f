//! A measured map of ICRs: steady points of a tracked robot on an indoor floor.
//!
//! Source: mfocchi/tracked_robot_simulator, ident_wheels_real_indoor.csv (Apache-2.0), and an
//! independent regression of its yaw rates on V_r − V_l and of its lateral speeds on its yaw rates.
//! Goal: by least squares the regression's D = 0.728 m and y = 0.044 m to 1 mm, because it is the
//! same problem; points that lag are those of the motor at its limit, 0.398 m/s. The project does
//! not carry the table: without it the test says that it skips.

use std::path::{Path, PathBuf};
use trackdyn_estimate::least_squares::Loss;
use trackdyn_estimate::steady::{fit_points, lagging};
use trackdyn_estimate::{Free, Parameters};
use trackdyn_model::Kinematics;
use trackdyn_recording::OperatingPoints;

/// Speed of a track whose motor is at its limit, m/s.
const LIMIT: f64 = 0.397;

#[test]
fn squares_agree_with_the_regression_and_the_limit_is_noticed() {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let folder = std::env::var_os("TRACKDYN_DATA").map_or_else(beside, PathBuf::from);
    let path = folder.join("maxxii-map/operating_points.csv");
    if !path.is_file() {
        println!("skipped: maxxii-map is not there (TRACKDYN_DATA names the folder of recordings)");
        return;
    }
    let table = OperatingPoints::read(&path).expect("accepted");
    let start = Parameters::of(&Kinematics::ideal(0.606));
    let squares = fit_points(&table.points, &start, Free::Icrs, Loss::Squares).expect("settles");
    let y = squares.parameters.0[2];
    assert!((squares.gap().value - 0.728).abs() < 1e-3, "{:?}", squares.gap());
    assert!((y - 0.044).abs() < 1e-3, "{y}");
    let robust = fit_points(&table.points, &start, Free::Icrs, Loss::Huber).expect("settles");
    let alone = &robust.covariance_of_scatter;
    let alone = (alone[(0, 0)] + alone[(1, 1)] - 2.0 * alone[(0, 1)]).sqrt();
    println!("Huber: {:?}; {alone} if points were independent", robust.gap());

    let lags = lagging(&table.points);
    assert!(!lags.is_empty());
    for lag in lags {
        let point = table.points[lag.point];
        assert!(point.v_left.abs().max(point.v_right.abs()) > LIMIT, "{point:?}");
    }
}

//! Errors run by run, as CSV.

use std::fmt::Write;
use trackdyn_estimate::odometry::Comparison;

const COLUMNS: &str = "run,set,duration_s,distance_m,final_along_m,final_across_m,final_yaw_rad,\
    ape_rmse_m,ape_max_m,ape_yaw_rmse_rad,ape_aligned_rmse_m,rpe_1m_rmse_m,rpe_1m_yaw_rmse_rad,\
    rpe_1m_pairs";

/// One row per run and parameter set; empty where a run is too short for pairs over 1 m.
pub(super) fn text(result: &Comparison) -> String {
    let mut text = format!("{COLUMNS}\n");
    for path in &result.paths {
        for (index, set) in result.sets.iter().enumerate() {
            let Some(errors) = path.errors(index) else { continue };
            let numbers = [
                path.duration(),
                path.length(),
                errors.last.along,
                errors.last.across,
                errors.last.yaw,
                errors.absolute.rmse,
                errors.absolute.max,
                errors.absolute_yaw.rmse,
                errors.aligned.rmse,
            ];
            let _ = write!(text, "{},{}", path.run, set.name());
            for number in numbers {
                let _ = write!(text, ",{number:.6}");
            }
            let _ = match (errors.relative, errors.relative_yaw) {
                (Some(place), Some(yaw)) => {
                    writeln!(text, ",{:.6},{:.6},{}", place.rmse, yaw.rmse, place.count)
                }
                _ => writeln!(text, ",,,0"),
            };
        }
    }
    text
}

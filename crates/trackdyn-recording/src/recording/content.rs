//! The numbers of a recording as bytes.

use super::Run;
use crate::sample::{Cells, Sample, Series};
use trackdyn_core::output;

/// Fingerprint of ids, samples and further columns; the name, the robot and the format do not
/// count.
pub(super) fn fingerprint(runs: &[Run]) -> String {
    fingerprint_of(runs, |run, bytes| {
        push(run.track_series(), bytes);
        push(run.pose_series(), bytes);
        push(run.imu_series(), bytes);
    })
}

/// Fingerprint of ids and poses: of the driving, however its track speeds are read.
pub(super) fn pose_fingerprint(runs: &[Run]) -> String {
    fingerprint_of(runs, |run, bytes| push(run.pose_series(), bytes))
}

fn fingerprint_of(runs: &[Run], push_series: impl Fn(&Run, &mut Vec<u8>)) -> String {
    let mut bytes = Vec::new();
    for run in runs {
        bytes.extend(run.id().to_le_bytes());
        push_series(run, &mut bytes);
    }
    output::fingerprint(&bytes)
}

fn push<S: Sample>(series: &Series<S>, bytes: &mut Vec<u8>) {
    let mut row = Vec::new();
    bytes.extend((series.samples.len() as u64).to_le_bytes());
    for sample in &series.samples {
        row.clear();
        sample.push_columns(&mut row);
        for value in &row {
            push_number(*value, bytes);
        }
    }
    for column in &series.extra {
        bytes.extend(column.name.as_bytes());
        bytes.push(0);
        match &column.cells {
            Cells::Numbers(cells) => {
                for value in cells {
                    push_number(*value, bytes);
                }
            }
            Cells::Texts(cells) => {
                for text in cells {
                    bytes.extend(text.as_bytes());
                    bytes.push(0);
                }
            }
        }
    }
}

/// Zeros of both signs are the same number, and so are all NaNs.
fn push_number(value: f64, bytes: &mut Vec<u8>) {
    let value = if value.is_nan() { f64::NAN } else { value + 0.0 };
    bytes.extend(value.to_le_bytes());
}

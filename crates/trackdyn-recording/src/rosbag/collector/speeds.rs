//! Joint signals as track speeds, and stamps as seconds.

use super::{Collected, Reading, RosbagOptions, Stamped, turns};
use crate::Error;
use crate::recording::{Cleaning, UncheckedRun, Warning, clean};
use crate::sample::{ImuSample, PoseSample, Series, TrackSample};
use std::path::Path;
use trackdyn_core::Pose;

/// The run of these sources; t = 0 at the earliest stamp.
pub(super) fn run(
    path: &Path,
    options: &RosbagOptions,
    joints: &[String],
    mut readings: Vec<Stamped<Reading>>,
    poses: Vec<Stamped<[f64; 3]>>,
    imu: Vec<Stamped<[f64; 3]>>,
    mut warnings: Vec<Warning>,
) -> Result<Collected, Error> {
    let Some(radius) = options.wheel_radius else {
        return Err(Error::Topic {
            path: path.to_owned(),
            what: "track speeds",
            problem: "joints turn in rad/s: expected the radius of wheel or sprocket, \
                      --wheel-radius METRES"
                .to_owned(),
            available: format!("{} readings of the joints", readings.len()),
        });
    };
    let stamps = readings.iter().map(|(stamp, _)| *stamp);
    let stamps = stamps.chain(poses.iter().chain(&imu).map(|(stamp, _)| *stamp));
    let epoch_ns = stamps.min().unwrap_or_default();
    let seconds = |stamp| seconds_between(epoch_ns, stamp);

    warnings.extend(turns::unwrap(&mut readings, joints, seconds));
    // The first messages of a driver may lack what it does not know yet.
    let positions = readings.iter().filter(|(_, reading)| reading.is_position).count();
    let are_positions = 2 * positions > readings.len();
    let joint = |(stamp, reading): &Stamped<Reading>| TrackSample {
        t: seconds(*stamp),
        v_left: reading.sides.left * radius,
        v_right: reading.sides.right * radius,
    };
    let same_signal = readings.iter().filter(|(_, reading)| reading.is_position == are_positions);
    let mut tracks: Series<TrackSample> = same_signal.map(joint).collect::<Vec<_>>().into();
    let other_signal = readings.len() - tracks.samples.len();
    if other_signal > 0 {
        warnings.push(Warning::MessagesSkipped {
            topic: options.tracks_topic.clone().unwrap_or_else(|| "joints".to_owned()),
            count: other_signal as u64,
            reason: "it has another signal than most messages".to_owned(),
        });
    }
    if are_positions {
        let mut cleanings: Vec<Cleaning> = Vec::new();
        clean(&mut tracks, 0, &mut cleanings);
        cleanings.retain(|cleaning| cleaning.finding.changes_rows());
        warnings.extend(cleanings.into_iter().map(Warning::Cleaned));
        tracks = speeds_of_positions(&tracks.samples).into();
    }

    let poses = poses
        .into_iter()
        .map(|(stamp, [x, y, yaw])| PoseSample { t: seconds(stamp), pose: Pose::new(x, y, yaw) });
    let imu = imu.into_iter().map(|(stamp, [gyro_z, acc_x, acc_y])| ImuSample {
        t: seconds(stamp),
        gyro_z,
        acc_x,
        acc_y,
    });
    let (poses, imu) = (poses.collect::<Vec<_>>().into(), imu.collect::<Vec<_>>().into());
    Ok(Collected { run: UncheckedRun { id: 0, tracks, poses, imu }, epoch_ns, warnings })
}

/// The difference quotient up to the next position, from the earlier stamp on: held until then, it
/// adds up to the distance travelled. The last position gives no speed.
fn speeds_of_positions(positions: &[TrackSample]) -> Vec<TrackSample> {
    positions
        .windows(2)
        .map(|pair| {
            let interval = pair[1].t - pair[0].t;
            TrackSample {
                t: pair[0].t,
                v_left: (pair[1].v_left - pair[0].v_left) / interval,
                v_right: (pair[1].v_right - pair[0].v_right) / interval,
            }
        })
        .collect()
}

/// Seconds from one stamp to another, without losing nanoseconds to the size of Unix time.
#[expect(clippy::cast_precision_loss, reason = "recordings last less than 2⁵³ ns, 104 days")]
fn seconds_between(epoch_ns: i64, stamp_ns: i64) -> f64 {
    stamp_ns.saturating_sub(epoch_ns) as f64 / 1e9
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_core::PerSide;

    /// A driver that does not know its speeds yet sends none in its first messages.
    #[test]
    fn most_messages_say_what_the_signal_is() {
        let reading = |is_position: bool, k: i64| {
            let sides = PerSide::new(2.0, 4.0);
            (k * 50_000_000, Reading { sides, angles: Vec::new(), is_position })
        };
        let readings = (0..20).map(|k| reading(k < 2, k)).collect();
        let options = RosbagOptions { wheel_radius: Some(0.1), ..RosbagOptions::default() };
        let bag = Path::new("bag.mcap");
        let found = run(bag, &options, &[], readings, Vec::new(), Vec::new(), Vec::new());
        let found = found.expect("a run");
        assert_eq!(found.run.tracks.samples.len(), 18);
        assert!(found.run.tracks.samples.iter().all(|sample| sample.v_right == 0.4));
        let skipped =
            |warning: &Warning| matches!(warning, Warning::MessagesSkipped { count: 2, .. });
        assert!(found.warnings.iter().any(skipped));
    }
}

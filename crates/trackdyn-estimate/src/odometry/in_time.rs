//! Dead reckoning by the forces on a vehicle.
//!
//! # Law
//! The body obeys the forces on it ([`Transient`]): stationary motion without inertia in the file,
//! Newton's second law with it. Drive, mount and delay of the pose sensor are the file's.
//!
//! # Assumes
//! A run begins in the stationary motion of its first reading. Laws of place and heading act at the
//! pose of the dead reckoning. Laws of time count from the beginning of the recording.
//!
//! # Clock
//! The clock offset of a recording is the delay of its pose sensor plus the time by which lag and
//! inertia delay its robot. So where a file states no delay, the delay is the offset less the
//! response time of the forces, found from the path that they predict ([`delay`]).

use super::covered::covered;
use crate::clock::{self, Clock, clock_offset};
use trackdyn_core::{Plant, Pose, Stopped, Trajectory};
use trackdyn_model::contact::Resolution;
use trackdyn_model::{Model, Sensor, Transient, VehicleFile};
use trackdyn_recording::{PoseSample, Recording, Run, Source, UncheckedRun, hold, smoothed};

/// Slip velocity below which a track sticks, m/s: no pose sensor sees it.
const CREEP_SPEED: f64 = 1e-4;

/// Delay of the poses in a replay by the forces on a vehicle, s: that of the file, where it has
/// one; else the clock offset. An estimated offset includes the response time of the robot. The
/// forces repeat that, so it is subtracted.
pub fn delay(recording: &Recording, file: &VehicleFile, clock: &Clock) -> f64 {
    let own = model(file).sensor().delay;
    match clock {
        _ if own != 0.0 => own,
        Clock::Estimated(offset) => offset.tau - answer(recording, file).unwrap_or(0.0),
        Clock::Given(_) | Clock::Unknown { .. } => clock.tau(),
    }
}

/// Response time of the forces on a vehicle to the track speeds of a recording, as a clock offset
/// shows it, s; none where it shows none.
fn answer(recording: &Recording, file: &VehicleFile) -> Option<f64> {
    let moved = |run: &Run| {
        let seen = &run.poses()[covered(run, 0.0)];
        let moved = poses(run, seen, file, 0.0, recording.begin()).ok()?;
        let poses = seen.iter().zip(moved).map(|(seen, pose)| PoseSample { t: seen.t, pose });
        Some(UncheckedRun {
            id: run.id(),
            tracks: run.tracks().to_vec().into(),
            poses: poses.collect::<Vec<_>>().into(),
            imu: Vec::new().into(),
        })
    };
    let runs = recording.runs().iter().map(moved).collect::<Option<Vec<_>>>()?;
    let of_forces = Recording::new("forces", "forces", runs, Source::computed(), Vec::new());
    Some(clock_offset(&of_forces.ok()?, &clock::Settings::default()).ok()?.tau)
}

fn model(file: &VehicleFile) -> Model {
    file.model().with_resolution(Resolution::Coarse)
}

/// The poses at the stamps of these poses of a run, from the first of them on, with poses that come
/// late by `delay`, s; `begin` is the start of the recording, s.
///
/// # Errors
/// [`Stopped`], at a time of the run's track speeds.
pub(super) fn poses(
    run: &Run,
    seen: &[PoseSample],
    file: &VehicleFile,
    delay: f64,
    begin: f64,
) -> Result<Vec<Pose>, Stopped> {
    let ([first, .., last], [reading, ..]) = (seen, run.tracks()) else { return Ok(Vec::new()) };
    let model = model(file);
    let sensor = Sensor { delay, ..*model.sensor() };
    // Without inertia ticks average out, and smoothing would only blur changes of speed.
    let has_inertia = Transient::feels_inertia(&model);
    let readings = if has_inertia { smoothed(run.tracks()) } else { run.tracks().to_vec() };
    let pieces: Vec<(usize, f64)> = hold::pieces(run.tracks(), first.t, last.t, delay).collect();
    let speeds = |reading: usize| readings[reading].speeds();
    let start = pieces.first().map_or(reading.speeds(), |&(reading, _)| speeds(reading));
    // world_from_body = world_from_sensor (body_from_sensor)⁻¹
    let body = first.pose.compose(&sensor.mount().inverse());
    let mut until = first.t - delay - begin;
    let robot = Transient::at_rest(&model, until, body).with_creep(CREEP_SPEED);
    let mut robot = robot.moving_at(start);
    let mut path = Trajectory::default();
    path.push(robot.moment());
    for (reading, duration) in pieces {
        until += duration;
        robot
            .drive(speeds(reading), until, &mut path)
            .map_err(|stopped| Stopped { t: stopped.t + begin, ..stopped })?;
    }
    let reported = sensor.reported_path(&path);
    Ok(seen.iter().map(|pose| reported.pose_at(pose.t - begin)).collect())
}

#[cfg(test)]
mod tests {
    use crate::odometry::{Comparison, ParameterSet};
    use crate::synthetic::{ConstantIcr, Stretch, Synthetic};
    use trackdyn_core::PerSide;
    use trackdyn_model::{ActiveEffect, Circumstance, Effects, Icrs, Stationary, VehicleFile};

    /// A vehicle with these effects.
    fn vehicle(effects: &[&str]) -> VehicleFile {
        let effects: Effects =
            effects.iter().map(|text| text.parse::<ActiveEffect>().expect("an effect")).collect();
        VehicleFile { effects, ..VehicleFile::auriga_alpha() }
    }

    /// The error at the end of a drive with constant ICRs, of the forces on a vehicle: place, yaw.
    fn error(file: &VehicleFile, kinematics: ConstantIcr, tau: f64) -> [f64; 2] {
        let drive = |left, right| Stretch { duration: 6.0, speeds: PerSide::new(left, right) };
        let schedules = vec![vec![drive(0.5, 0.5), drive(-0.3, 0.3), drive(-0.4, -0.6)]];
        let synthetic = Synthetic { kinematics, schedules, tau, ..Synthetic::default() };
        let recording = synthetic.recording().expect("runs");
        let sets = vec![ParameterSet::ideal(0.42), ParameterSet::of_vehicle("physics", file, tau)];
        let found = Comparison::new(&recording, sets, tau).expect("it moves");
        let last = found.paths[0].errors(1).expect("a path").last;
        [last.position(), last.yaw.abs()]
    }

    /// The constant ICRs of the vehicle without effects, seen from `aside` m to the right of its
    /// origin and `ahead` m in front of it.
    fn own_icrs(aside: f64, ahead: f64) -> ConstantIcr {
        let model = super::model(&vehicle(&[]));
        let spin = PerSide::new(-0.3, 0.3);
        let icrs = Stationary::new(&model, &Circumstance::default()).solve(spin).icrs;
        let Icrs { x_left, x_right, y } = icrs.expect("it turns");
        let alpha = PerSide::new(1.0, 1.0);
        ConstantIcr { x_left: x_left - aside, x_right: x_right - aside, y: y - ahead, alpha }
    }

    /// Without effects all stationary motions have the same ICRs (the constancy theorem).
    #[test]
    fn without_effects_the_forces_lead_where_their_constant_icrs_lead() {
        let truth = own_icrs(0.0, 0.0);
        for tau in [0.0, 0.07] {
            let [place, yaw] = error(&vehicle(&[]), truth, tau);
            assert!(place < 1e-4 && yaw < 1e-5, "{tau}: {place} m, {yaw} rad");
        }
        let [place, yaw] = error(&vehicle(&["encoder-scale:left=1.05,right=1.05"]), truth, 0.0);
        assert!(place > 0.05 && yaw > 0.05, "{place} m, {yaw} rad");
    }

    /// A sensor beside the origin sees all ICRs shifted.
    #[test]
    fn the_mount_of_the_pose_sensor_counts() {
        let truth = own_icrs(0.05, 0.25);
        let [place, yaw] = error(&vehicle(&["sensor-lever-arm:x_m=0.05,y_m=0.25"]), truth, 0.0);
        assert!(place < 1e-4 && yaw < 1e-5, "{place} m, {yaw} rad");
        assert!(error(&vehicle(&[]), truth, 0.0)[0] > 0.05);
    }
}

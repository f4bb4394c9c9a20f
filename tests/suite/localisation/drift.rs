//! How far whole paths are off.

use super::course;
use std::time::{Duration, Instant};
use trackdyn_core::Pose;
use trackdyn_core::pose::wrap_angle;
use trackdyn_localisation::{
    Error, Localisation, LocalisedPose, MatchAgainst, Room, Scan, Scanner, Status, localise,
};

/// Sums over all scans of paths of 20 m.
#[derive(Default)]
struct Drift {
    scans: f64,
    converged: f64,
    /// Squared distance from the truth, m², yaw, rad², and normalised.
    position: f64,
    yaw: f64,
    normalised: f64,
    /// Squared error of the motion from scan to scan, m² and rad².
    step_position: f64,
    step_yaw: f64,
    time: Duration,
}

fn mounted(seed: u64, robot_from_sensor: Pose) -> Scanner {
    Scanner { robot_from_sensor, seed, ..Scanner::default() }
}

fn drift(against: MatchAgainst, paths: u64) -> Drift {
    let mut sums = Drift::default();
    for seed in 0..paths {
        let scanner = mounted(seed, Pose::default());
        let truth = course::path(seed, 20.0, scanner.period);
        let scans = course::scans(&Room::furnished(), &scanner, &truth);
        let odometry = course::odometry(&truth, seed);
        let options = Localisation { against, ..Localisation::default() };
        let start = Instant::now();
        let poses = localise(&scans, &odometry, &options).expect("poses");
        sums.time += start.elapsed();
        sums.add(&poses, &truth);
    }
    sums
}

impl Drift {
    fn add(&mut self, poses: &[LocalisedPose], truth: &[Pose]) {
        for (pair, truths) in poses.windows(2).zip(truth.windows(2)) {
            let (found, at) = (&pair[1].estimate, truth[0].relative(&truths[1]));
            self.scans += 1.0;
            self.converged += f64::from(u8::from(pair[1].status == Status::Converged));
            let off = at.relative(&found.pose);
            self.position += off.x.powi(2) + off.y.powi(2);
            self.yaw += wrap_angle(off.yaw).powi(2);
            self.normalised += found.normalised_error_squared(&at).expect("regular");
            let step = pair[0].estimate.pose.relative(&found.pose);
            let off = truths[0].relative(&truths[1]).relative(&step);
            self.step_position += off.x.powi(2) + off.y.powi(2);
            self.step_yaw += wrap_angle(off.yaw).powi(2);
        }
    }

    fn rms(&self, squares: f64) -> f64 {
        (squares / self.scans).sqrt()
    }
}

#[test]
fn keyframes_hold_the_drift_and_know_it() {
    let previous = drift(MatchAgainst::Previous, 4);
    let keyframes = drift(Localisation::default().against, 4);
    assert!(keyframes.position < previous.position, "keyframes drift more");
    // Few matches in a chain, each exact to 2 mm and 0.02 degrees.
    assert!(keyframes.rms(keyframes.position) < 0.006);
    assert!(keyframes.rms(keyframes.yaw).to_degrees() < 0.08);
    for drift in [previous, keyframes] {
        assert_eq!(drift.converged, drift.scans);
        // Errors along a chain cancel in part, and the covariance leaves that out: at most 3, apart
        // from the scatter of few paths.
        assert!(drift.normalised / drift.scans < 4.0, "{}", drift.normalised / drift.scans);
    }
}

#[test]
fn poses_are_those_of_the_robot_wherever_the_sensor_sits() {
    let mount = Pose::new(0.35, -0.12, 0.4);
    let scanner = mounted(3, mount);
    let truth = course::path(3, 5.0, scanner.period);
    let scans = course::scans(&Room::furnished(), &scanner, &truth);
    let options = Localisation { robot_from_sensor: mount, ..Localisation::default() };
    let poses = localise(&scans, &course::odometry(&truth, 3), &options).expect("poses");
    for (pose, at) in poses.iter().zip(&truth).skip(1) {
        let at = truth[0].relative(at);
        let squared = pose.estimate.normalised_error_squared(&at).expect("regular");
        assert!(squared < 30.7, "{squared} {pose:?} {at:?}");
    }
}

#[test]
fn a_dropped_scan_is_bridged_and_a_blind_one_is_named() {
    let scanner = mounted(4, Pose::default());
    let mut truth = course::path(4, 8.0, scanner.period);
    let mut scans = course::scans(&Room::furnished(), &scanner, &truth);
    truth.remove(10);
    scans.remove(10);
    let blind = vec![f64::INFINITY; 361];
    let before = &scans[20];
    scans[20] = Scan::new(before.stamp(), before.first_angle(), before.angle_step(), blind)
        .expect("a scan");
    let odometry = course::odometry(&truth, 4);
    let poses = localise(&scans, &odometry, &Localisation::default()).expect("poses");
    for (index, (pose, at)) in poses.iter().zip(&truth).enumerate().skip(1) {
        let squared = pose.estimate.normalised_error_squared(&truth[0].relative(at));
        assert!(squared.expect("regular") < 30.7, "{index} {pose:?}");
        // Nothing can be matched against the blind scan either; an earlier keyframe takes over.
        assert_eq!(pose.status == Status::Unmatched, index == 20, "{index} {:?}", pose.status);
    }
}

#[test]
fn along_a_corridor_the_uncertainty_grows_with_the_odometry() {
    let scanner = mounted(6, Pose::default());
    let truth: Vec<Pose> =
        (0..20_u32).map(|index| Pose::new(0.1 * f64::from(index) - 1.0, 0.0, 0.0)).collect();
    let scans = course::scans(&Room::corridor(), &scanner, &truth);
    let odometry = course::odometry(&truth, 6);
    let poses = localise(&scans, &odometry, &Localisation::default()).expect("poses");
    let last = &poses[19].estimate;
    // 19 guesses with a standard deviation of 0.1 m each; the scans may feign a part.
    let deviation = last.covariance[(0, 0)].sqrt();
    let walk = 0.1 * 19.0_f64.sqrt();
    assert!((0.5 * walk..1.01 * walk).contains(&deviation), "{deviation}");
    // Across, two walls are seen all the time.
    assert!(last.covariance[(1, 1)].sqrt() < 0.01, "{last:?}");
    let squared = last.normalised_error_squared(&truth[0].relative(&truth[19]));
    assert!(squared.expect("regular") < 16.3, "{last:?}");
}

#[test]
fn equal_input_gives_equal_poses() {
    let scanner = mounted(5, Pose::default());
    let truth = course::path(5, 5.0, scanner.period);
    let poses = || {
        let scans = course::scans(&Room::furnished(), &scanner, &truth);
        let odometry = course::odometry(&truth, 5);
        format!("{:?}", localise(&scans, &odometry, &Localisation::default()).expect("poses"))
    };
    assert_eq!(poses(), poses());
}

#[test]
fn nonsense_is_refused() {
    let scan = |stamp| Scan::new(stamp, 0.0, 0.1, vec![1.0; 9]).expect("a scan");
    let poses = [Pose::default(); 2];
    let options = Localisation::default();
    let error = localise(&[scan(0.0)], &poses, &options).expect_err("too many poses");
    assert!(matches!(error, Error::Odometry { found: 2, expected: 1 }));
    let error = localise(&[scan(1.0), scan(1.0)], &poses, &options).expect_err("out of order");
    assert!(error.to_string().contains("scan 1 is stamped 1 s"));
    let against = MatchAgainst::Keyframes { overlap: 60.0 };
    let options = Localisation { against, ..options };
    let error = localise(&[scan(0.0), scan(1.0)], &poses, &options).expect_err("a per cent");
    assert!(error.to_string().contains("overlap = 60"));
    assert!(localise(&[], &[], &Localisation::default()).expect("nothing").is_empty());
}

/// The figures of `README.md`, and those of other overlaps: run with
/// `--release -- --ignored --nocapture`.
#[test]
#[ignore = "drives 77 paths"]
fn paths_are_off_by_what_is_documented() {
    let overlaps = [0.6, 0.3, 0.4, 0.5, 0.7, 0.8];
    let keyframes = overlaps.map(|overlap| MatchAgainst::Keyframes { overlap });
    println!("against | position mm | yaw deg | step mm | step deg | normalised | us per scan");
    let found: Vec<[f64; 3]> = std::iter::once(MatchAgainst::Previous)
        .chain(keyframes)
        .map(|against| {
            let drift = drift(against, 11);
            let position = drift.rms(drift.position) * 1e3;
            let yaw = drift.rms(drift.yaw).to_degrees();
            let step = drift.rms(drift.step_position) * 1e3;
            println!(
                "{against:?} | {position:.1} | {yaw:.3} | {step:.2} | {:.4} | {:.2} | {:.0}",
                drift.rms(drift.step_yaw).to_degrees(),
                drift.normalised / drift.scans,
                drift.time.as_secs_f64() / drift.scans * 1e6
            );
            [position, yaw, step]
        })
        .collect();
    // the documented digits
    let digits = [0.05, 5e-4, 5e-3];
    for (found, documented) in found.iter().zip([[5.9, 0.062, 1.60], [2.7, 0.037, 2.03]]) {
        for ((found, documented), digit) in found.iter().zip(documented).zip(digits) {
            assert!((found - documented).abs() < 1.01 * digit, "{found} for {documented}");
        }
    }
}

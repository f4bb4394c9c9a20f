//! How far matches are off, and whether their covariance says so.

use super::course::{self, between};
use nalgebra::Vector3;
use trackdyn_core::Pose;
use trackdyn_localisation::{Match, MatchOptions, Outline, Reference, Room, Scanner, Status};

/// Matches in the furnished room at the paper's motion, each with its truth.
fn matches(scanner: &Scanner, stated_noise: f64, seed: u64, count: u64) -> Vec<(Match, Pose)> {
    let room = Room::furnished();
    let mut random = course::random(seed);
    let options = MatchOptions { range_noise: stated_noise, ..MatchOptions::default() };
    (0..count)
        .map(|trial| {
            let before = course::free_pose(&mut random);
            let truth = course::motion(&mut random, scanner.period);
            let poses = [before, before.compose(&truth)];
            let (reference, scan) =
                course::reference_and_scan(&room, scanner, trial, poses, stated_noise);
            let mut off = || between(&mut random, -0.1, 0.1);
            let guess = Pose::new(truth.x + off(), truth.y + off(), truth.yaw + off());
            (reference.locate(&scan, &guess, &options).expect("a match"), truth)
        })
        .collect()
}

fn error(found: &Match, truth: &Pose) -> Vector3<f64> {
    let pose = found.motion.pose;
    Vector3::new(pose.x - truth.x, pose.y - truth.y, pose.yaw - truth.yaw)
}

#[test]
fn matches_are_exact_to_millimetres_and_know_how_exact() {
    let matches = matches(&Scanner::default(), 0.01, 1, 1000);
    let (mut beyond, mut squares, mut chi_square) = (0, 0.0, 0.0);
    let mut whitened = Vector3::zeros();
    for (found, truth) in &matches {
        assert_eq!(found.status, Status::Converged);
        let error = error(found, truth);
        beyond += usize::from(error.xy().norm() > 0.005);
        // The worst of a thousand yaw errors of 0.02 degrees is a tenth of a degree.
        assert!(error[2].abs() < 0.2_f64.to_radians(), "{error}");
        squares += found.motion.normalised_error_squared(truth).expect("regular");
        chi_square += found.reduced_chi_square;
        let root = found.motion.covariance.cholesky().expect("regular").l();
        whitened += root.solve_lower_triangular(&error).expect("regular");
    }
    // 5 mm are three standard deviations where the room shows least.
    assert!(beyond <= 3, "{beyond} of 1000 beyond 5 mm");
    // Means of 1000 draws of χ² with three degrees of freedom, and of standard normals, lie within
    // three standard errors: √(6/1000) and √(1/1000).
    assert!((squares / 1000.0 - 3.0).abs() < 3.0 * 0.0775, "{squares}");
    assert!((whitened / 1000.0).amax() < 3.0 * 0.0316, "{whitened}");
    // About 250 returns in each match: standard error √(2/250/1000) = 0.003, and a hundredth less
    // for what the gate cuts off.
    assert!((chi_square / 1000.0 - 1.0).abs() < 0.02, "{chi_square}");
}

#[test]
fn without_noise_the_motion_is_recovered() {
    let scanner = Scanner { range_noise: 0.0, ..Scanner::default() };
    for (found, truth) in matches(&scanner, 1e-5, 2, 100) {
        assert_eq!(found.status, Status::Converged);
        // Rounding of ranges of 8 m, and of the fit.
        assert!(error(&found, &truth).amax() < 1e-9, "{found:?} {truth:?}");
    }
}

#[test]
fn a_scan_lies_on_itself() {
    let scanner = Scanner { range_noise: 0.0, ..Scanner::default() };
    let pose = Pose::new(4.0, 3.0, 1.0);
    let scan = scanner.scan(&Room::furnished(), 0.0, 0, |_| pose).expect("a scan");
    let reference = Reference::new(&scan, 1e-5).expect("lines");
    let options = MatchOptions { range_noise: 1e-5, ..MatchOptions::default() };
    let found = reference.locate(&scan, &Pose::new(0.05, -0.05, 0.05), &options).expect("a match");
    assert_eq!(found.status, Status::Converged);
    assert!(error(&found, &Pose::default()).amax() < 1e-10, "{found:?}");
}

#[test]
fn in_a_symmetric_room_the_guess_decides() {
    // From the middle of a square, headings a quarter turn apart look the same; at half a turn, a
    // laser that sees half the room has seen nothing of it before.
    let corners = vec![[-3.0, -3.0], [3.0, -3.0], [3.0, 3.0], [-3.0, 3.0]];
    let walls = Outline { name: "walls".to_owned(), corners, closed: true };
    let room = Room::new("square", vec![walls]).expect("a room");
    let scanner = Scanner::default();
    let scan =
        |index, yaw| scanner.scan(&room, 0.0, index, |_| Pose::new(0.0, 0.0, yaw)).expect("a scan");
    let reference = Reference::new(&scan(0, 0.0), 0.01).expect("lines");
    let turned = scan(1, 0.3);
    for quarter in [-1.0, 0.0, 1.0] {
        let truth = Pose::new(0.0, 0.0, 0.3 + quarter * std::f64::consts::FRAC_PI_2);
        let guess = Pose::new(0.05, 0.05, truth.yaw - 0.1);
        let found = reference.locate(&turned, &guess, &MatchOptions::default()).expect("a match");
        let squared = found.motion.normalised_error_squared(&truth).expect("regular");
        assert!(found.status == Status::Converged && squared < 16.3, "{quarter} {found:?}");
    }
}

/// The table of `README.md`: run with `--release -- --ignored --nocapture`.
#[test]
#[ignore = "matches 6000 scans"]
fn matches_are_off_by_what_is_documented() {
    println!(
        "noise mm | rms mm | 99 % mm | worst mm | rms deg | worst deg | normalised | converged"
    );
    for (noise, documented) in [(0.003, 0.50), (0.01, 1.67), (0.03, 5.23)] {
        let matches =
            matches(&Scanner { range_noise: noise, ..Scanner::default() }, noise, 1, 2000);
        let converged: Vec<_> =
            matches.iter().filter(|(found, _)| found.status == Status::Converged).collect();
        let count = f64::from(u16::try_from(converged.len()).expect("2000 at most"));
        let errors = converged.iter().map(|(found, truth)| error(found, truth));
        let mut distances: Vec<f64> = errors.clone().map(|error| error.xy().norm()).collect();
        distances.sort_by(f64::total_cmp);
        let rms = (distances.iter().map(|d| d * d).sum::<f64>() / count).sqrt();
        let yaw_rms = (errors.clone().map(|error| error[2].powi(2)).sum::<f64>() / count).sqrt();
        let yaw_worst = errors.map(|error| error[2].abs()).fold(0.0, f64::max);
        let squares = converged
            .iter()
            .filter_map(|(found, truth)| found.motion.normalised_error_squared(truth));
        println!(
            "{:.0} | {:.2} | {:.2} | {:.2} | {:.4} | {:.3} | {:.2} | {}",
            noise * 1e3,
            rms * 1e3,
            distances[distances.len() * 99 / 100] * 1e3,
            distances[distances.len() - 1] * 1e3,
            yaw_rms.to_degrees(),
            yaw_worst.to_degrees(),
            squares.sum::<f64>() / count,
            converged.len()
        );
        let rms = rms * 1e3;
        assert!((rms - documented).abs() < 5.05e-3, "{rms} mm for {documented} mm");
        assert!(converged.len() >= 1999, "{} converged", converged.len());
    }
}

/// Times on one core: run with `--release -- --ignored --nocapture`.
#[test]
#[ignore = "measures time"]
fn times() {
    let (room, scanner) = (Room::furnished(), Scanner::default());
    let mut random = course::random(3);
    let count = 2000;
    let mut times = [0.0; 3];
    for trial in 0..count {
        let before = course::free_pose(&mut random);
        let truth = course::motion(&mut random, scanner.period);
        let scan = |index, pose: Pose| scanner.scan(&room, 0.0, index, |_| pose).expect("a scan");
        let (first, second) = (scan(2 * trial, before), before.compose(&truth));
        let guess = Pose::new(truth.x + 0.05, truth.y - 0.05, truth.yaw + 0.05);
        let start = std::time::Instant::now();
        let second = scan(2 * trial + 1, second);
        times[0] += start.elapsed().as_secs_f64();
        let start = std::time::Instant::now();
        let reference = Reference::new(&first, 0.01).expect("lines");
        times[1] += start.elapsed().as_secs_f64();
        let start = std::time::Instant::now();
        let found = reference.locate(&second, &guess, &MatchOptions::default());
        times[2] += start.elapsed().as_secs_f64();
        assert!(found.expect("a match").is_good());
    }
    let [scan, lines, matching] = times.map(|time| time / 2000.0 * 1e6);
    println!("scan {scan:.0} us | lines {lines:.0} us | match {matching:.0} us");
}

//! The path tracker, with right and wrong kinematics.

use crate::driving::plant::{AURIGA, auriga};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use trackdyn_core::{Moment, PerSide, Plant, Pose, Stopped, Trajectory};
use trackdyn_drive::tracking::{DriveOptions, Ending, Estimate, Steering, Summary};
use trackdyn_drive::{Journey, Path, Rolling, Tracker, drive};
use trackdyn_model::kinematics::{KinematicsFile, Source};
use trackdyn_model::{Icrs, Kinematics};
use trackdyn_tests::circle;

/// Distance between the track centre-lines of Auriga-alpha, m.
const GAUGE: f64 = 0.42;

/// A tracker of the point that does not slip aside in turns.
fn at_pivot() -> Tracker {
    Tracker { point: [AURIGA.y, 0.0], ..Tracker::default() }
}

fn driven(path: &Path, tracker: &Tracker, model: Kinematics, estimate: Estimate) -> Journey {
    let start = path.start().compose(&Pose::new(-tracker.point[0], -tracker.point[1], 0.0));
    let mut robot = Rolling::new(Kinematics::new(AURIGA), start);
    let options = DriveOptions { estimate, ..DriveOptions::default() };
    drive(&mut robot, path, tracker, &model, &options, &|_| ()).expect("valid options")
}

fn arrived(path: &Path, tracker: &Tracker, model: Kinematics, estimate: Estimate) -> Summary {
    let journey = driven(path, tracker, model, estimate);
    assert_eq!(journey.ending, Ending::Arrived);
    let summary = journey.summary(path, tracker.point);
    println!("{estimate:?} {model:?}\n  {summary:?}");
    summary
}

#[test]
fn with_its_own_kinematics_the_robot_stays_on_the_path() {
    let right = Kinematics::new(AURIGA);
    for left in [true, false] {
        let square = Path::square(3.0, left, 1).expect("a square");
        let circle = circle(1.5, left, 1);
        for estimate in [Estimate::Truth, Estimate::Odometry] {
            let found = arrived(&square, &at_pivot(), right, estimate);
            // a corner is reached within a millimetre and a turn ends within 2 mrad, which is
            // corrected over a look-ahead of half a metre
            assert!(found.max < 2e-3 && found.end_distance < 2e-3, "{found:?}");
            let found = arrived(&circle, &at_pivot(), right, estimate);
            // commands hold for 30 ms, in which the robot goes 15 mm
            assert!(found.max < 1e-3 && found.end_distance < 2e-3, "{found:?}");
            // dead reckoning by the true constants is true
            assert!(found.end_belief < 1e-5, "{found:?}");
        }
    }
}

#[test]
fn a_point_that_slips_aside_stays_on_the_circle_too() {
    let circle = circle(1.5, true, 2);
    for point in [[0.0, 0.0], [0.3, 0.0], [0.0, 0.15], [-0.1, -0.1]] {
        let tracker = Tracker { point, ..Tracker::default() };
        let journey = driven(&circle, &tracker, Kinematics::new(AURIGA), Estimate::Truth);
        assert_eq!(journey.ending, Ending::Arrived);
        // The hull starts along the circle and has to turn by asin(0.3/1.5) until the point runs
        // along it: after the first lap nothing of that is left.
        let later = journey.cross_track.iter().filter(|error| error.travelled > 9.0);
        let settled = later.clone().filter(|error| error.along < 18.0);
        let worst = settled.map(|error| error.offset.abs()).fold(0.0, f64::max);
        assert!(later.count() > 100 && worst < 1e-3, "{point:?}: {worst}");
    }
}

#[test]
fn a_turn_on_the_spot_brings_any_point_onto_the_next_leg() {
    let path = Path::new(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [3.5, 3.0]]).expect("a path");
    let corners = path.corners(0.1);
    for point in [[0.0, 0.0], [0.2, 0.0], [AURIGA.y, 0.1], [-0.1, -0.1]] {
        let tracker = Tracker { point, ..Tracker::default() };
        let journey = driven(&path, &tracker, Kinematics::new(AURIGA), Estimate::Truth);
        assert_eq!(journey.ending, Ending::Arrived);
        // The pivot turns where its own lines meet, at most √2 |p_y| from a square corner, and the
        // point goes round it; further away the point is on the path.
        let radius = (point[0] - AURIGA.y).hypot(point[1]);
        let reach = radius + 2.0_f64.sqrt() * point[1].abs() + 2e-3;
        for error in &journey.cross_track {
            let away = corners.iter().map(|corner| (error.along - corner).abs());
            let allowed = if away.fold(f64::MAX, f64::min) < reach { reach } else { 2e-3 };
            assert!(error.offset.abs() < allowed, "{point:?}: {error:?}");
        }
    }
}

#[test]
fn wrong_kinematics_strays_a_little_with_true_poses_and_far_with_its_own() {
    let square = Path::square(3.0, true, 1).expect("a square");
    let circle = circle(1.5, true, 1);
    let [right, ideal] = [Kinematics::new(AURIGA), Kinematics::ideal(GAUGE)];
    for path in [&square, &circle] {
        let of = |model, estimate| arrived(path, &at_pivot(), model, estimate);
        let told = [of(right, Estimate::Truth), of(ideal, Estimate::Truth)];
        // Half of the curvature is missing, until the error makes up for it: millimetres to some
        // centimetres within a look-ahead of half a metre.
        assert!(told[1].rms > 10.0 * told[0].rms && told[0].rms < 1e-3, "{told:?}");
        assert!(told[1].max < 0.15 && told[1].end_distance < 0.1, "{told:?}");
        let reckoned = [of(right, Estimate::Odometry), of(ideal, Estimate::Odometry)];
        // A robot that takes its turns for twice as large ends a metre away.
        assert!(reckoned[0].max < 2e-3 && reckoned[1].end_belief > 0.5, "{reckoned:?}");
    }
}

#[test]
fn the_ideal_drive_circles_wide_by_what_geometry_says() {
    let (tracker, radius) = (at_pivot(), 1.5);
    let circle = circle(radius, true, 2);
    let journey = driven(&circle, &tracker, Kinematics::ideal(GAUGE), Estimate::Truth);
    let steady = journey.cross_track.iter().filter(|error| (9.0..18.0).contains(&error.along));
    let offsets: Vec<f64> = steady.map(|error| error.offset).collect();
    // The point runs on a circle of radius ρ about the same centre, its goal L away on the path:
    // Δ_y = (L² + ρ² − R²)/(2 ρ). The ideal drive asks for ω/v = Δ_y/(L²/2 + p_x Δ_x) and sets the
    // tracks G/2 apart; they turn the hull with x_r − x_l and move its middle with (x_r + x_l)/2:
    // ρ = (v/ω)(x_r − x_l)/G − (x_r + x_l)/2.
    let look_ahead = tracker.look_ahead;
    let residual = |rho: f64| {
        let left = (look_ahead * look_ahead + rho * rho - radius * radius) / (2.0 * rho);
        let ahead = (look_ahead * look_ahead - left * left).sqrt();
        let asked = (look_ahead * look_ahead / 2.0 + AURIGA.y * ahead) / left;
        let middle = f64::midpoint(AURIGA.x_right, AURIGA.x_left);
        rho - (asked * (AURIGA.x_right - AURIGA.x_left) / GAUGE - middle)
    };
    let (mut low, mut high) = (radius, radius + look_ahead);
    for _ in 0..60 {
        let rho = f64::midpoint(low, high);
        *(if residual(rho) < 0.0 { &mut low } else { &mut high }) = rho;
    }
    println!("ρ = {low:.4} m");
    // to the right of a path that turns left; a millimetre for commands that hold for 15 mm
    assert!(offsets.len() > 400);
    for offset in offsets {
        assert!((offset + low - radius).abs() < 1e-3, "{offset} instead of {}", radius - low);
    }
}

#[test]
fn a_kinematics_file_steers_as_its_constants_do() {
    let kinematics = Kinematics { icrs: AURIGA, alpha: PerSide::new(0.98, 1.01) };
    let file = KinematicsFile::of_fit(&kinematics, GAUGE, true, Vec::new(), Source::default());
    let square = Path::square(2.0, false, 1).expect("a square");
    let of = |steering: &dyn Steering| {
        let mut robot = Rolling::new(kinematics, Pose::default());
        let estimate = Estimate::Odometry;
        let options = DriveOptions { estimate, time_limit: None };
        let tracker = Tracker::default();
        drive(&mut robot, &square, &tracker, steering, &options, &|_| ()).expect("valid")
    };
    let (by_file, by_constants) = (of(&file), of(&kinematics));
    assert_eq!(by_file.ending, Ending::Arrived);
    assert_eq!(by_file.commands, by_constants.commands);
}

#[test]
fn wrong_scale_shows_in_dead_reckoning_only() {
    let square = Path::square(2.0, true, 1).expect("a square");
    let truth = Kinematics { icrs: AURIGA, alpha: PerSide::new(0.98, 0.98) };
    let of = |model, estimate| {
        let start = Pose::new(-AURIGA.y, 0.0, 0.0);
        let mut robot = Rolling::new(truth, start);
        let options = DriveOptions { estimate, ..DriveOptions::default() };
        let journey =
            drive(&mut robot, &square, &at_pivot(), &model, &options, &|_| ()).expect("valid");
        assert_eq!(journey.ending, Ending::Arrived);
        journey.summary(&square, at_pivot().point)
    };
    // it goes 2 % less than its encoders show, and its kinematics knows or not
    let right = of(truth, Estimate::Odometry);
    let wrong = of(Kinematics::new(AURIGA), Estimate::Odometry);
    let told = of(Kinematics::new(AURIGA), Estimate::Truth);
    assert!(right.max < 2e-3 && told.max < 5e-3, "{right:?} {told:?}");
    assert!(wrong.max > 0.02, "{wrong:?}");
}

#[test]
fn a_robot_beside_the_path_comes_to_it() {
    let line = Path::new(vec![[0.0, 0.0], [6.0, 0.0]]).expect("a path");
    for (y, yaw) in [(0.4, 0.0), (-0.8, 0.5), (0.3, 3.0), (0.0, -1.4)] {
        let mut robot = Rolling::new(Kinematics::new(AURIGA), Pose::new(0.0, y, yaw));
        let model = Kinematics::new(AURIGA);
        let options = DriveOptions::default();
        let journey = drive(&mut robot, &line, &Tracker::default(), &model, &options, &|_| ());
        let journey = journey.expect("valid options");
        assert_eq!(journey.ending, Ending::Arrived);
        let last = journey.cross_track.last().expect("errors");
        assert!(last.offset.abs() < 2e-3, "{y} {yaw}: {last:?}");
    }
}

#[test]
fn commands_keep_the_limits_and_can_be_driven_again() {
    let square = Path::square(2.0, true, 1).expect("a square");
    let tracker = Tracker { belt_speed: 0.3, ..at_pivot() };
    let journey = driven(&square, &tracker, Kinematics::new(AURIGA), Estimate::Truth);
    assert_eq!(journey.ending, Ending::Arrived);
    let fastest = |of: fn(&PerSide<f64>) -> f64| {
        journey.commands.iter().map(|command| of(&command.speeds).abs()).fold(0.0, f64::max)
    };
    assert!(fastest(|v| v.left) <= 0.3 && fastest(|v| v.right) <= 0.3);
    let schedule = journey.schedule().expect("commands");
    let start = Pose::new(-AURIGA.y, 0.0, 0.0);
    let again = Rolling::new(Kinematics::new(AURIGA), start).follow(&schedule).expect("it rolls");
    assert_eq!(again.moments().last(), journey.trajectory.moments().last());
    assert_eq!(journey.commands.len() + 1, journey.cross_track.len());
    let table = journey.cross_track_csv();
    assert!(table.starts_with("t,travelled,along,offset,heading\n0,0,0,0,0\n"));
    assert_eq!(table.lines().count(), journey.cross_track.len() + 1);
}

/// A robot that loses a track after two seconds.
struct Breaking(Rolling);

impl Plant for Breaking {
    fn moment(&self) -> Moment {
        self.0.moment()
    }

    fn drive(&mut self, v: PerSide<f64>, until: f64, to: &mut Trajectory) -> Result<(), Stopped> {
        if until > 2.0 {
            return Err(Stopped { t: self.moment().t, reason: "a track is off".to_owned() });
        }
        self.0.drive(v, until, to)
    }
}

#[test]
fn drives_that_end_early_say_so() {
    let line = Path::new(vec![[0.0, 0.0], [6.0, 0.0]]).expect("a path");
    let model = Kinematics::new(AURIGA);
    let options = DriveOptions { time_limit: Some(3.0), ..DriveOptions::default() };
    let journey = drive(&mut auriga(), &line, &Tracker::default(), &model, &options, &|_| ());
    assert_eq!(journey.expect("valid").ending, Ending::OutOfTime);

    let mut robot = Breaking(auriga());
    let journey =
        drive(&mut robot, &line, &Tracker::default(), &model, &DriveOptions::default(), &|_| ());
    let journey = journey.expect("valid");
    assert!(
        matches!(&journey.ending, Ending::Stopped(stopped) if stopped.reason.contains("track"))
    );
    assert!(journey.summary(&line, [0.0, 0.0]).end_distance > 4.0);

    let tracker = Tracker { look_ahead: f64::NAN, ..Tracker::default() };
    let error = drive(&mut robot, &line, &tracker, &model, &DriveOptions::default(), &|_| ());
    assert!(error.expect_err("refused").to_string().starts_with("look-ahead = NaN"));

    // 0.2492 m behind the ICRs
    let tracker = Tracker { look_ahead: 0.45, point: [-0.2, 0.0], ..Tracker::default() };
    let error = drive(&mut robot, &line, &tracker, &model, &DriveOptions::default(), &|_| ());
    assert!(error.expect_err("unstable").to_string().contains("expected more than 0.498"));
}

#[test]
fn paths_are_read_with_the_place_of_errors() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("p.csv");
    let square = Path::square(1.5, false, 2).expect("a square");
    std::fs::write(&file, square.to_csv()).expect("written");
    assert_eq!(Path::read(&file).expect("readable"), square);
    for (text, expected) in [
        ("x,y\n0,0\n1,NaN\n", "p.csv:3:2: y = \"NaN\": expected a finite number"),
        ("x,y\n0,0\n0,0\n", "p.csv:3:1: x = \"0\": expected a point away from"),
        ("x,y\n0,0\n1e9,0\n", "p.csv:3:1: x = \"1e9\": expected at most"),
        ("x,y\n0,0\n", "p.csv: 1 points: expected two points or more"),
        ("x\n0\n", "p.csv:1: columns x: expected x,y"),
    ] {
        std::fs::write(&file, text).expect("written");
        let error = Path::read(&file).expect_err("refused").to_string();
        assert!(error.contains(expected), "{error}");
    }
}

/// Legs from millimetres to metres, turns of any angle, and a robot of any ICRs.
#[test]
fn drives_arrive_on_any_path_with_any_robot() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for case in 0..300 {
        let mut points = vec![[0.0, 0.0]];
        let mut direction = 0.0_f64;
        for left in (0..random.random_range(1..8)).rev() {
            let length =
                if left == 0 { 5.0 } else { 10.0_f64.powf(random.random_range(-3.0..0.5)) };
            let [x, y] = points[points.len() - 1];
            points.push([x + length * direction.cos(), y + length * direction.sin()]);
            direction += if random.random::<f64>() < 0.1 {
                std::f64::consts::PI
            } else {
                random.random_range(-2.5..2.5)
            };
        }
        let path = Path::new(points).expect("a path");
        let y = random.random_range(-0.1..0.1);
        let icrs = Icrs {
            x_left: -random.random_range(0.1..0.8),
            x_right: random.random_range(0.1..0.8),
            y,
        };
        let mut constants = || random.random_range(0.6..1.6);
        let (wide, model_y) = (constants(), 0.1 * (constants() - 1.0));
        let wrong = Icrs { x_left: wide * icrs.x_left, x_right: wide * icrs.x_right, y: model_y };
        for (model, estimate) in
            [(icrs, Estimate::Truth), (icrs, Estimate::Odometry), (wrong, Estimate::Truth)]
        {
            let mut robot = Rolling::new(Kinematics::new(icrs), path.start());
            let options = DriveOptions { estimate, ..DriveOptions::default() };
            let (tracker, model) = (Tracker::default(), Kinematics::new(model));
            let journey = drive(&mut robot, &path, &tracker, &model, &options, &|share| {
                assert!((0.0..=1.0).contains(&share));
            });
            let journey = journey.expect("valid options");
            assert_eq!(journey.ending, Ending::Arrived, "case {case}: {path:?} {icrs:?} {model:?}");
            let end = journey.summary(&path, tracker.point).end_distance;
            // Offsets decay as e^(−s/L), with constants that turn too little more slowly; the last
            // leg is ten look-aheads long, and the end is reached within a millimetre.
            assert!(end < 2e-3, "case {case}: {end} m from the end");
        }
    }
}

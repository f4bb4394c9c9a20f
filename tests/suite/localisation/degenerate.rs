//! What scans cannot tell.

use super::course::{self, between};
use nalgebra::Vector3;
use rand_distr::{Distribution, StandardNormal};
use trackdyn_core::Pose;
use trackdyn_localisation::{Match, MatchOptions, Outline, Room, Scanner, Status};

struct Trial {
    found: Match,
    truth: Pose,
    /// Heading of the reference in the room, rad.
    heading: f64,
}

/// Matches about the middle of a room, with guesses that are off as they are said to be.
fn trials(room: &Room, count: u64) -> Vec<Trial> {
    let scanner = Scanner::default();
    let mut random = course::random(7);
    let trial = |trial| {
        let heading = between(&mut random, -3.1, 3.1);
        let x = between(&mut random, -5.0, 5.0);
        let before = Pose::new(x, between(&mut random, -0.4, 0.4), heading);
        let truth = course::motion(&mut random, scanner.period);
        let poses = [before, before.compose(&truth)];
        let (reference, scan) = course::reference_and_scan(room, &scanner, trial, poses, 0.01);
        let mut off = || -> f64 { 0.1 * Distribution::<f64>::sample(&StandardNormal, &mut random) };
        let guess = Pose::new(truth.x + off(), truth.y + off(), truth.yaw + off());
        let found = reference.locate(&scan, &guess, &MatchOptions::default()).expect("a match");
        Trial { found, truth, heading }
    };
    (0..count).map(trial).collect()
}

#[test]
fn along_a_corridor_the_guess_stands() {
    let trials = trials(&Room::corridor(), 500);
    let (mut degenerate, mut converged, mut squares) = (0.0, 0, 0.0);
    for Trial { found, truth, heading } in &trials {
        match found.status {
            Status::Degenerate { direction } => {
                let along = Vector3::new(heading.cos(), -heading.sin(), 0.0);
                let direction = Vector3::from(direction);
                // One standard deviation of the guess, along the corridor to a degree.
                assert!((direction.norm() - 0.1).abs() < 1e-3, "{direction}");
                assert!(direction.normalize().dot(&along).abs() > 1.0_f64.to_radians().cos());
                // What the scans feign along the corridor takes at most four fifths off.
                let deviation = along.dot(&(found.motion.covariance * along)).sqrt();
                assert!((0.02..0.1001).contains(&deviation), "{deviation}");
                squares += found.motion.normalised_error_squared(truth).expect("regular");
                degenerate += 1.0;
            }
            Status::Converged => converged += 1,
            _ => {}
        }
    }
    // The rest looks at an end of its field of view, where less than a quarter returns.
    assert!(degenerate > 400.0, "{degenerate}");
    // Two standard deviations of two walls' directions are passed by one match in hundreds.
    assert!(converged <= 3, "{converged}");
    let mean = squares / degenerate;
    assert!((mean - 3.0).abs() < 3.0 * (6.0_f64 / degenerate).sqrt(), "{mean}");
}

#[test]
fn a_round_room_is_no_room_of_lines() {
    // Corners every two degrees, 0.1 m apart: from chords, a heading would be feigned.
    let corner = |step: u8| {
        let (sin, cos) = f64::from(2 * u16::from(step)).to_radians().sin_cos();
        [3.0 * cos, 3.0 * sin]
    };
    let corners = (0..180).map(corner).collect();
    let ring = Outline { name: "ring".to_owned(), corners, closed: true };
    let room = Room::new("ring", vec![ring]).expect("a room");
    let scanner = Scanner::default();
    let mut random = course::random(8);
    for trial in 0..300 {
        let before =
            Pose::new(between(&mut random, -1.0, 1.0), between(&mut random, -1.0, 1.0), 0.0);
        let after = before.compose(&course::motion(&mut random, scanner.period));
        let poses = [before, after];
        let (reference, scan) = course::reference_and_scan(&room, &scanner, trial, poses, 0.01);
        let guess = before.relative(&after);
        let found = reference.locate(&scan, &guess, &MatchOptions::default()).expect("a match");
        assert_ne!(found.status, Status::Converged, "{trial} {found:?}");
    }
}

#[test]
fn in_the_open_nothing_is_matched() {
    let open = Room::new("open", Vec::new()).expect("a room");
    for Trial { found, .. } in trials(&open, 3) {
        assert_eq!((found.status, found.returns), (Status::Unmatched, 0));
        // The guess and its deviation of 0.1.
        assert!((found.motion.covariance[(0, 0)] - 0.01).abs() < 1e-15);
    }
}

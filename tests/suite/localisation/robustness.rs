//! Bad guesses, strangers in the scan, and input that makes no sense.

use super::course::{self, between};
use trackdyn_core::Pose;
use trackdyn_localisation::{Deviation, MatchOptions, Reference, Room, Scan, Scanner, Status};

#[test]
fn without_odometry_matches_are_right_or_say_so() {
    let (room, scanner) = (Room::furnished(), Scanner::default());
    let mut random = course::random(11);
    // Up to 1 m/s and 2 rad/s over 0.27 s, and nothing known of it.
    let guess = Deviation { position: 0.15, yaw: 0.3 };
    let options = MatchOptions { guess, ..MatchOptions::default() };
    let mut converged = 0;
    for trial in 0..300 {
        let before = course::free_pose(&mut random);
        let truth = course::motion(&mut random, scanner.period);
        let poses = [before, before.compose(&truth)];
        let (reference, scan) = course::reference_and_scan(&room, &scanner, trial, poses, 0.01);
        let found = reference.locate(&scan, &Pose::default(), &options).expect("a match");
        if found.status == Status::Converged {
            converged += 1;
            let squared = found.motion.normalised_error_squared(&truth).expect("regular");
            // One in a million of χ² with three degrees of freedom lies beyond 30.7.
            assert!(squared < 30.7, "{trial} {squared} {found:?}");
        }
    }
    assert!(converged >= 297, "{converged} of 300");
}

#[test]
fn a_person_in_the_way_is_left_out() {
    let (room, scanner) = (Room::furnished(), Scanner::default());
    let mut random = course::random(12);
    for trial in 0..100 {
        let before = course::free_pose(&mut random);
        let truth = course::motion(&mut random, scanner.period);
        let poses = [before, before.compose(&truth)];
        let (reference, clean) = course::reference_and_scan(&room, &scanner, trial, poses, 0.01);
        // A body half a metre wide at one metre covers 28 degrees.
        let mut ranges = clean.ranges().to_vec();
        for range in &mut ranges[150..206] {
            *range = range.min(between(&mut random, 0.98, 1.02));
        }
        let scan =
            Scan::new(0.27, clean.first_angle(), clean.angle_step(), ranges).expect("a scan");
        let found = reference.locate(&scan, &truth, &MatchOptions::default()).expect("a match");
        let squared = found.motion.normalised_error_squared(&truth).expect("regular");
        assert!(found.status != Status::Converged || squared < 30.7, "{trial} {found:?}");
        assert!(!matches!(found.status, Status::NotConverged), "{trial}");
    }
}

#[test]
fn another_room_is_not_matched() {
    let scanner = Scanner::default();
    let mut random = course::random(13);
    for trial in 0..100 {
        let here = course::free_pose(&mut random);
        // Four metres off and turned by half a turn: the same lab, from elsewhere.
        let poses = [here, Pose::new(10.0 - here.x, 8.0 - here.y, here.yaw + 1.0)];
        let (reference, there) =
            course::reference_and_scan(&Room::furnished(), &scanner, trial, poses, 0.01);
        let guess = Pose::default();
        let found = reference.locate(&there, &guess, &MatchOptions::default()).expect("a match");
        assert_ne!(found.status, Status::Converged, "{trial} {found:?}");
    }
}

#[test]
fn understated_noise_is_inconsistent() {
    let scanner = Scanner { range_noise: 0.03, ..Scanner::default() };
    let scan = |index| {
        let pose = Pose::new(5.0, 4.0, 0.3);
        scanner.scan(&Room::furnished(), 0.0, index, |_| pose).expect("a scan")
    };
    let reference = Reference::new(&scan(0), 0.01).expect("lines");
    let found = reference.locate(&scan(1), &Pose::default(), &MatchOptions::default());
    let status = found.expect("a match").status;
    assert!(matches!(status, Status::Inconsistent | Status::Unmatched), "{status:?}");
}

#[test]
fn nonsense_is_refused() {
    let scan = Scan::new(0.0, 0.0, 0.1, vec![1.0; 9]).expect("a scan");
    assert!(Reference::new(&scan, 0.0).is_err());
    let reference = Reference::new(&scan, 0.01).expect("lines");
    let nan = Pose::new(0.0, f64::NAN, 0.0);
    let error = reference.locate(&scan, &nan, &MatchOptions::default()).expect_err("refused");
    assert!(error.to_string().contains("guess, y = NaN"));
    let guess = Deviation { position: -1.0, yaw: 0.1 };
    let options = MatchOptions { guess, ..MatchOptions::default() };
    let error = reference.locate(&scan, &Pose::default(), &options).expect_err("refused");
    assert!(error.to_string().contains("guess.position = -1"));
}

//! Judgements of bags: what is mended, what is told, and what is left to the user.

use super::drives::{Bag, RADIUS, at, speeds, times};
use trackdyn::inspect::{Content, Finding, Lack, Use, Verdict};
use trackdyn::{InspectSettings, Inspection, inspect};
use trackdyn_core::PerSide;
use trackdyn_estimate::Contradiction;

/// Wheels whose joints count so many radians for one, 50 a second.
fn wheels(signs: PerSide<f64>) -> Bag {
    let mut bag = Bag::default();
    for t in times(50) {
        let PerSide { left, right } = speeds(t);
        let values = [signs.left * left, signs.right * right];
        bag.joints("/joint_states", at(t), &["left_wheel", "right_wheel"], [&[], &values]);
    }
    bag
}

fn inspected(bag: Bag) -> Inspection {
    let (_folder, path) = bag.write();
    inspect(&path, &InspectSettings::default()).expect("a bag")
}

fn radius(found: &Inspection) -> Option<f64> {
    found.lacks.iter().find_map(|lack| match lack {
        Lack::WheelRadius { about } => *about,
        _ => None,
    })
}

/// The radius is not known: poses tell it, and the units do not look mixed up.
#[test]
fn a_wheel_radius_is_told_by_the_way_of_the_poses() {
    for turns in [1.0, 0.1, 8.0] {
        let found = inspected(wheels(PerSide::new(turns, turns)).with_poses());
        let about = radius(&found).expect("a way");
        // track speeds change within the segments
        let truth = RADIUS / turns;
        assert!((about / truth - 1.0).abs() < 0.02, "{about} for {truth}");
        let over_time = found.over_time.as_ref().expect("motion");
        // eq. (9) holds in joint speeds as well
        let deviation = over_time.rates.deviation().expect("segments");
        assert!(deviation < 0.02, "{deviation} rad/s");
    }
}

/// What is computed from the tracks is no reference, and is said to be none.
#[test]
fn a_side_that_counts_backwards_is_reversed_and_wheel_odometry_is_told() {
    let found = inspected(wheels(PerSide::new(1.0, -1.0)).with_poses());
    let mended = |of: &Finding| matches!(of, Finding::Mended(text) if text.contains("backwards"));
    assert!(found.findings.iter().any(mended), "{:?}", found.findings);
    assert_eq!(found.options.bag.right_joints, ["-right_wheel"]);
    assert_eq!(found.options.bag.left_joints, ["left_wheel"]);
    let is_odometry =
        |of: &Finding| matches!(of, Finding::Fit(Contradiction::WheelOdometry { .. }));
    assert!(found.findings.iter().any(is_odometry), "{:?}", found.findings);
    let identify = found.readiness.iter().find(|of| of.what == Use::Identify).expect("tried");
    assert!(matches!(&identify.verdict, Verdict::No(reason) if reason.contains("wheel odometry")));
}

#[test]
fn a_bag_without_poses_is_judged_by_its_topics() {
    let found = inspected(wheels(PerSide::new(1.0, 1.0)));
    assert!(matches!(&found.content, Content::Unread(reason) if reason.contains("poses")));
    assert!(found.lacks.contains(&Lack::Poses), "{:?}", found.lacks);
    assert!(found.readiness.iter().all(|of| !of.is_ready()) && found.over_time.is_none());
    assert_eq!(found.topics.len(), 1);
}

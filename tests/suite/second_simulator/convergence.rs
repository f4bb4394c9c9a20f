//! Finer steps lead to the same place.

use crate::second_simulator::turn::{auriga, typical};
use std::time::Instant;
use trackdyn_core::{Command, PerSide, Plant, Pose, Schedule};
use trackdyn_second_simulator::{Robot, Setup};

/// A minute of steps as a driver makes them: arcs, spins, straight stretches, reverse, standstill.
fn minute() -> Schedule {
    let steps = [
        (0.5, 0.5),
        (0.3, 0.7),
        (-0.4, 0.4),
        (0.8, 0.5),
        (0.0, 0.0),
        (-0.5, -0.3),
        (0.6, -0.2),
        (0.2, 0.21),
        (0.9, 0.6),
        (-0.7, -0.7),
    ];
    let commands = (0..=40).zip(steps.into_iter().cycle()).map(|(k, (left, right))| Command {
        t: 1.5 * f64::from(k),
        speeds: PerSide::new(left, right),
    });
    Schedule::new(commands.collect()).expect("a schedule")
}

fn end(ids: &[&str], refinement: f64) -> Pose {
    let standard = Setup::default();
    let setup = Setup {
        shortest_step: standard.shortest_step / refinement,
        longest_step: standard.longest_step / refinement,
        speed_change: standard.speed_change / refinement,
        ..standard
    };
    let mut robot = Robot::new(&auriga([-0.015, 0.04]), &typical(ids), &setup).expect("a robot");
    let begin = Instant::now();
    let way = robot.follow(&minute()).expect("a motion");
    println!(
        "{ids:?}, steps / {refinement}: {:.2} s for a minute, {} steps",
        begin.elapsed().as_secs_f64(),
        way.moments().len()
    );
    robot.moment().pose
}

#[test]
fn step_halving_halves_the_error() {
    for ids in [
        &[][..],
        &["yaw-inertia", "centripetal", "load-transfer"],
        &["drivetrain-lag"],
        &["belt-slip"],
        &["belt-slip", "slope"],
    ] {
        let ends = [1.0, 2.0, 4.0, 8.0].map(|refinement| end(ids, refinement));
        let apart = |a: Pose, b: Pose| (a.x - b.x).hypot(a.y - b.y) + 0.5 * (a.yaw - b.yaw).abs();
        let changes: Vec<f64> = ends.windows(2).map(|pair| apart(pair[0], pair[1])).collect();
        println!("{ids:?}: {changes:.6?} m");
        // 25 m of driving: the default steps are good to a few millimetres at its end, to 15 with
        // belts that stretch by a tenth at every one of 40 commands; the first two changes may have
        // opposite signs by chance
        let coarse = changes[0].max(changes[1]);
        assert!(coarse < 1e-2, "{ids:?}: {changes:?}");
        assert!(changes[2] < 0.6 * coarse, "{ids:?}: {changes:?}");
    }
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let ids = ["stribeck-friction", "belt-slip", "slope", "terrain-patch"];
    let way = |seed| {
        let setup = Setup { seed, ..Setup::default() };
        let mut robot = Robot::new(&auriga([0.0, 0.04]), &typical(&ids), &setup).expect("a robot");
        robot.follow(&minute()).expect("a motion")
    };
    assert_eq!(way(5), way(5));
    assert_ne!(way(5), way(6));
}

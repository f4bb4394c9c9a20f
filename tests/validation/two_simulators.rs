//! The laws of the catalogue beside those of the independent ground, which were written apart and share
//! no code: what an effect does to a drive must be alike.

use trackdyn_core::{Command, PerSide, Plant, Pose, Schedule, Trajectory};
use trackdyn_motion::Transient;
use trackdyn_physics::{ActiveEffect, CATALOGUE, Effects, Model, VehicleFile};
use trackdyn_proof::{ActiveMechanism, Robot, Setup};

/// Least cosine between what both simulators make of an effect. Where the laws are the same it is 1.000;
/// other forms of one mechanism go down to 0.9 (creep of shoes against creep of a belt), and Wong's hump,
/// which softens after its peak where Janosi's law does not, to 0.6. A wrong sign is negative.
const ALIKE: f64 = 0.5;

/// Turns both ways, forward and backward, slow and fast, and straights, with gentle changes.
fn schedule() -> Schedule {
    const INTERVAL: f64 = 0.05;
    let targets = [
        (0.5, 0.5),
        (0.2, 0.6),
        (-0.4, 0.4),
        (0.8, 0.3),
        (-0.5, -0.5),
        (-0.7, -0.3),
        (0.4, -0.4),
        (-0.2, -0.6),
        (0.3, 0.9),
        (0.0, 0.0),
    ];
    let mut speeds = PerSide::new(0.0, 0.0);
    let mut commands = Vec::new();
    let mut step = 0;
    let towards = |from: f64, to: f64| from + (to - from).clamp(-0.05, 0.05);
    for (left, right) in targets {
        for _ in 0..60 {
            speeds = PerSide::new(towards(speeds.left, left), towards(speeds.right, right));
            commands.push(Command { t: INTERVAL * f64::from(step), speeds });
            step += 1;
        }
    }
    Schedule::new(commands).expect("a schedule")
}

fn own(effects: &[ActiveEffect]) -> Trajectory {
    let vehicle = VehicleFile::auriga_alpha().vehicle;
    let model = Model::new(vehicle, effects.iter().cloned().collect::<Effects>());
    let mut robot = Transient::at_rest(&model, 0.0, Pose::default());
    let path = robot.follow(&schedule()).unwrap_or_else(|stop| panic!("{effects:?}: {stop}"));
    model.sensor().reported_path(&path)
}

fn independent(effects: &[ActiveEffect]) -> Trajectory {
    let mechanisms: Vec<ActiveMechanism> = effects
        .iter()
        .map(|effect| effect.to_string().parse().expect("the same names and ranges"))
        .collect();
    let vehicle = VehicleFile::auriga_alpha().vehicle;
    let mut robot = Robot::new(&vehicle, &mechanisms, &Setup::default()).expect("a robot");
    let path = robot.follow(&schedule()).unwrap_or_else(|stop| panic!("{effects:?}: {stop}"));
    robot.report(&path)
}

/// What effects change about the motion over half a second, all along the drive: along, across and
/// yaw, m and rad.
fn change(with: &Trajectory, without: &Trajectory) -> Vec<f64> {
    let step = |path: &Trajectory, t: f64| path.pose_at(t).relative(&path.pose_at(t + 0.5));
    (0..58)
        .map(|k| 0.5 * f64::from(k))
        .flat_map(|t| {
            let (a, b) = (step(with, t), step(without, t));
            [a.x - b.x, a.y - b.y, a.yaw - b.yaw]
        })
        .collect()
}

#[test]
fn effects_do_the_same_in_both_simulators() {
    let base = (own(&[]), independent(&[]));
    let floor = norm(&change(&base.0, &base.1));
    println!("base motions differ by {:.2} mm, mrad rms", rms(floor));
    println!("{:24}{:>10}{:>10}{:>8}{:>8}", "effect", "own", "other", "cosine", "ratio");
    let mut wrong = Vec::new();
    for card in CATALOGUE.iter().filter(|card| !card.is_form()) {
        let effect = ActiveEffect::new(card.id, &[]).expect("typical sizes");
        let ours = change(&own(std::slice::from_ref(&effect)), &base.0);
        let theirs = change(&independent(std::slice::from_ref(&effect)), &base.1);
        let (size, other) = (norm(&ours), norm(&theirs));
        let dot: f64 = ours.iter().zip(&theirs).map(|(a, b)| a * b).sum();
        let (cosine, ratio) = (dot / (size * other), size / other);
        println!("{:24}{:10.2}{:10.2}{cosine:8.3}{ratio:8.2}", card.id, rms(size), rms(other));
        if cosine < ALIKE || !(0.5..2.0).contains(&ratio) {
            wrong.push(card.id);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// In mm and mrad per half second.
fn rms(norm: f64) -> f64 {
    1e3 * norm / (3.0_f64 * 58.0).sqrt()
}

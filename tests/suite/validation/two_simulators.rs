//! The laws of the catalogue beside those of the independent ground, which were written apart and
//! share no code: what an effect does to a drive must be alike.

use rayon::prelude::*;
use std::sync::LazyLock;
use trackdyn_core::{Command, PerSide, Plant, Pose, Schedule, Trajectory};
use trackdyn_model::Transient;
use trackdyn_model::{ActiveEffect, CATALOGUE, Effects, Model, RunningGear, Vehicle, VehicleFile};
use trackdyn_second_simulator::{ActiveMechanism, Form, Robot, Setup, sheet_of};

/// Least cosine between what both simulators make of an effect. Where the laws are the same it is
/// 1.000; a hull that leans with a delay has 0.99.
const MIN_ALIKE_COSINE: f64 = 0.95;

/// Largest ratio of what both simulators make of an effect.
const SIZE_RATIO: f64 = 2.0;

/// Parameters of an effect that are not typical.
type Shape = &'static [(&'static str, f64)];

/// Mechanisms of which one has two forms, each with the shape that comes nearest to the other
/// simulator's: creep of shoes and creep of a belt, half of an excess that is lost sooner or later;
/// an arc tangent; and Wong's hump on ground that remembers how far it was sheared where the robot
/// now turns differently.
const OTHER_FORMS: [(&str, Shape, f64); 3] = [
    ("stribeck-friction", &[], 0.85),
    ("friction-creep", &[("sharpness", 1.0)], MIN_ALIKE_COSINE),
    ("shear-displacement", &[("residual", 0.8)], 0.5),
];

/// The shape in which an effect is compared, and the least cosine.
fn form(id: &str) -> (Shape, f64) {
    let form = OTHER_FORMS.iter().find(|(other, ..)| *other == id);
    form.map_or((&[], MIN_ALIKE_COSINE), |(_, shape, alike)| (*shape, *alike))
}

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

fn own(vehicle: &Vehicle, effects: &[ActiveEffect]) -> Trajectory {
    let model = Model::new(vehicle.clone(), effects.iter().cloned().collect::<Effects>());
    let mut robot = Transient::at_rest(&model, 0.0, Pose::default());
    let path = robot.follow(&schedule()).unwrap_or_else(|stop| panic!("{effects:?}: {stop}"));
    model.sensor().reported_path(&path)
}

fn independent(vehicle: &Vehicle, effects: &[ActiveEffect], form: Form) -> Trajectory {
    let mechanisms: Vec<ActiveMechanism> = effects
        .iter()
        .map(|effect| {
            let id = effect.card().id;
            let sheet = sheet_of(id).expect("the same names");
            // a shape of ours may be a constant of theirs
            let stated = effect.stated().map(|(parameter, value)| (parameter.key, value));
            let theirs = |key: &str| sheet.parameters.iter().any(|parameter| parameter.key == key);
            let settings: Vec<_> = stated.filter(|(key, _)| theirs(key)).collect();
            let form = if sheet.family.is_some() { form } else { Form::Plain };
            let active = ActiveMechanism::new(id, &settings).expect("the same ranges");
            active.with(form).expect("a form of a family")
        })
        .collect();
    let mut robot = Robot::new(vehicle, &mechanisms, &Setup::default()).expect("a robot");
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

/// An effect that is added, and what our laws make of it.
struct Ours {
    id: &'static str,
    /// What acts with it.
    effects: Vec<ActiveEffect>,
    change: Vec<f64>,
}

/// A robot to which effects are added one by one.
struct Compared {
    vehicle: Vehicle,
    /// Motion of the independent simulator without them.
    without: Trajectory,
    /// Size of the difference of both simulators without them.
    floor: f64,
    ours: Vec<Ours>,
}

/// The robot on which nothing acts already.
static PLAIN_ROBOT: LazyLock<Compared> =
    LazyLock::new(|| Compared::new(VehicleFile::auriga_alpha().vehicle, &[]));

impl Compared {
    /// A robot to which effects are added that are not among these, which act on it already.
    fn new(vehicle: Vehicle, beside: &[&str]) -> Self {
        let typical = |id: &str| ActiveEffect::new(id, form(id).0).expect("typical sizes");
        let beside: Vec<ActiveEffect> = beside.iter().map(|id| typical(id)).collect();
        let base = own(&vehicle, &beside);
        let without = independent(&vehicle, &beside, Form::Plain);
        let floor = norm(&change(&base, &without));
        let is_new = |id: &str| beside.iter().all(|effect| effect.card().id != id);
        let ours = CATALOGUE.par_iter().filter(|card| !card.is_form() && is_new(card.id));
        let ours = ours.map(|card| {
            let effects: Vec<ActiveEffect> =
                beside.iter().cloned().chain([typical(card.id)]).collect();
            let change = change(&own(&vehicle, &effects), &base);
            Ours { id: card.id, effects, change }
        });
        let ours = ours.collect();
        Self { vehicle, without, floor, ours }
    }

    /// Effects that are not alike, in the plain form of the independent laws.
    fn unlike(&self) -> Vec<&'static str> {
        self.unlike_in(Form::Plain, |id| form(id).1, SIZE_RATIO)
    }

    /// As [`Compared::unlike`], in a form of the independent laws, by a least cosine of each effect
    /// and the largest ratio of what both simulators make of it.
    fn unlike_in(
        &self,
        of: Form,
        alike: impl Fn(&str) -> f64,
        size_ratio: f64,
    ) -> Vec<&'static str> {
        let has_form =
            |id: &str| of == Form::Plain || sheet_of(id).is_some_and(|it| it.family.is_some());
        let compared: Vec<&Ours> = self.ours.iter().filter(|ours| has_form(ours.id)).collect();
        let theirs: Vec<Vec<f64>> = compared
            .par_iter()
            .map(|ours| change(&independent(&self.vehicle, &ours.effects, of), &self.without))
            .collect();
        println!("base motions differ by {:.2} mm, mrad rms", rms(self.floor));
        println!("{:24}{:>10}{:>10}{:>8}{:>8}", "effect", "own", "other", "cosine", "ratio");
        let mut wrong = Vec::new();
        for (Ours { id, change: ours, .. }, theirs) in compared.into_iter().zip(theirs) {
            let (size, other) = (norm(ours), norm(&theirs));
            let dot: f64 = ours.iter().zip(&theirs).map(|(a, b)| a * b).sum();
            let (cosine, ratio) = (dot / (size * other), size / other);
            println!("{id:24}{:10.2}{:10.2}{cosine:8.3}{ratio:8.2}", rms(size), rms(other));
            if cosine < alike(id) || ratio.max(1.0 / ratio) > size_ratio {
                wrong.push(*id);
            }
        }
        wrong
    }
}

#[test]
fn effects_do_the_same_in_both_simulators() {
    assert_eq!(PLAIN_ROBOT.unlike(), [""; 0]);
}

/// Least cosine between an effect and a drawn form of its law: the least that the plain form of
/// sheared soil has.
const MIN_RELATED_COSINE: f64 = 0.5;

/// As [`SIZE_RATIO`], of a drawn form: a size means the same at one speed, time or traction, and
/// steps may stand below all speeds of a drive or above them.
const DRAWN_SIZE_RATIO: f64 = 4.0;

#[test]
fn drawn_forms_do_about_the_same_at_the_same_size() {
    for number in 1..=3 {
        let unlike =
            PLAIN_ROBOT.unlike_in(Form::Drawn(number), |_| MIN_RELATED_COSINE, DRAWN_SIZE_RATIO);
        assert_eq!(unlike, [""; 0], "form {number}");
    }
}

/// Laws along the contact count over all wheels of a side.
#[test]
fn effects_do_the_same_to_a_robot_on_wheels() {
    let mut vehicle = VehicleFile::auriga_alpha().vehicle;
    vehicle.running_gear =
        RunningGear::Wheels { contact_length: 0.12, width: 0.1, axles: vec![0.25, -0.25] };
    assert_eq!(Compared::new(vehicle, &[]).unlike(), [""; 0]);
}

/// Forces that only speeding up knows, such as the load that a high centre of gravity throws back.
#[test]
fn effects_do_the_same_to_a_robot_with_mass() {
    let vehicle = VehicleFile::auriga_alpha().vehicle;
    let compared = Compared::new(vehicle, &["yaw-inertia", "centripetal"]);
    assert_eq!(compared.unlike(), [""; 0]);
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// In mm and mrad per half second.
fn rms(norm: f64) -> f64 {
    1e3 * norm / (3.0_f64 * 58.0).sqrt()
}

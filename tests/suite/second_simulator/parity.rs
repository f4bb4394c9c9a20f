//! Which symmetries each mechanism breaks, measured in time and compared with its sheet.

use crate::second_simulator::turn::{Turn, auriga, distance, typical};
use rayon::prelude::*;
use trackdyn_core::{PerSide, Plant, Pose, Trajectory};
use trackdyn_second_simulator::{ActiveMechanism, Form, MECHANISMS, Robot, Setup, Sheet, Symmetry};

/// Change of an ICR, m, that breaks a symmetry: what a spin test can see.
const MIN_BREAK: f64 = 1e-3;

/// Change that the shoes' draw and the shoes that come and go may cause in the base case, m: a
/// hundredth of a shoe.
const MAX_SHOE_CHANGE: f64 = 2.5e-4;

/// Arc, counter-rotation and spin, m/s.
const PATTERNS: [(f64, f64); 3] = [(0.4, 1.0), (-0.4, 1.0), (-1.0, 1.0)];

/// Headings at which a direction of the world shows: none along an axis of the robot.
const HEADINGS: [f64; 2] = [0.6, 1.9];

/// A machine on the mirror's plane, forward of the middle, under mechanisms.
struct Subject {
    active: Vec<ActiveMechanism>,
    setup: Setup,
    at: f64,
}

/// Turns of the patterns at the headings.
struct Bases {
    /// Their ICRs, m.
    icrs: [[[f64; 3]; 3]; 2],
    /// Where the turn of each pattern begins, seen from where it is measured.
    starts: [Pose; 3],
}

impl Subject {
    fn new(active: Vec<ActiveMechanism>) -> Self {
        Self { active, setup: Setup::default(), at: 20.0 }
    }

    /// ICRs of a turn that may begin at `start`, seen from its target; `start` becomes where it
    /// begins.
    fn icrs(&self, speeds: (f64, f64), target: Pose, start: &mut Pose) -> [f64; 3] {
        let vehicle = auriga([0.0, 0.04]);
        // steps of the same way at all speeds
        let fastest = speeds.0.abs().max(speeds.1.abs());
        let longest_step = self.setup.longest_step / fastest;
        let setup = Setup { longest_step, ..self.setup.clone() };
        let (vehicle, active, setup) = (&vehicle, self.active.as_slice(), &setup);
        Turn { vehicle, active, setup, speeds, target, at: self.at }.icrs_from(start)
    }

    fn bases(&self) -> Bases {
        let mut starts = [Pose::default(); 3];
        let icrs = HEADINGS.map(|yaw| {
            let target = Pose::new(0.0, 0.0, yaw);
            std::array::from_fn(|k| self.icrs(PATTERNS[k], target, &mut starts[k]))
        });
        Bases { icrs, starts }
    }

    /// Largest change of an ICR from `bases` under the transformation of a symmetry, m; the first
    /// beyond `enough`, where there is one.
    fn change(&self, symmetry: Symmetry, bases: &Bases, enough: f64) -> f64 {
        // where the symmetry holds, the way of a turn is transformed as well
        let mut starts = bases.starts.map(|start| match symmetry {
            Symmetry::Reversal => start.inverse(),
            Symmetry::Mirror => Pose::new(start.x, -start.y, -start.yaw),
            _ => start,
        });
        let mut worst = 0.0_f64;
        for (heading, at_heading) in HEADINGS.into_iter().zip(&bases.icrs) {
            let at = Pose::new(0.0, 0.0, heading);
            for (k, (left, right)) in PATTERNS.into_iter().enumerate() {
                let start = &mut starts[k];
                let other = match symmetry {
                    Symmetry::SpeedScale => self.icrs((0.25 * left, 0.25 * right), at, start),
                    Symmetry::Reversal => self.icrs((-left, -right), at, start),
                    Symmetry::Manoeuvre => at_heading[0],
                    Symmetry::Mirror => {
                        let [x_left, x_right, y] = self.icrs((right, left), at, start);
                        [-x_right, -x_left, y]
                    }
                    Symmetry::Heading => bases.icrs[0][k],
                    Symmetry::Place => {
                        self.icrs((left, right), Pose::new(1.3, -2.6, heading), start)
                    }
                    Symmetry::Time => {
                        let (active, setup) = (self.active.clone(), self.setup.clone());
                        Self { active, setup, at: 120.0 }.icrs((left, right), at, start)
                    }
                    Symmetry::Transient | Symmetry::Straight => unreachable!("not of turns"),
                };
                worst = worst.max(distance(at_heading[k], other));
                if worst > enough {
                    return worst;
                }
            }
        }
        worst
    }

    /// How far equal speeds lead off the line of the start in a way of 1 m, m.
    fn strays(&self) -> f64 {
        self.strays_at(0.5).max(self.strays_at(-0.5))
    }

    /// How far a straight run at this speed, m/s, leads astray, m.
    fn strays_at(&self, speed: f64) -> f64 {
        let robot = Robot::new(&auriga([0.0, 0.04]), &self.active, &self.setup);
        let mut robot = robot.expect("a robot");
        let mut way = Trajectory::default();
        for until in [1.0, 3.0] {
            robot.drive(PerSide::new(speed, speed), until, &mut way).expect("a motion");
        }
        let reported = robot.report(&way);
        let [_, end] = reported.span().expect("a motion");
        reported.pose_at(end - 2.0).relative(&reported.pose_at(end)).y.abs()
    }

    /// What a turn that starts and ends lacks against the steady one in its middle part, in m of
    /// the belt: yaw at a stamp over that at the same way of the encoders.
    fn lags(&self) -> f64 {
        let robot = Robot::new(&auriga([0.0, 0.04]), &self.active, &self.setup);
        let mut robot = robot.expect("a robot");
        let mut way = Trajectory::default();
        way.push(robot.moment());
        robot.drive(PerSide::new(0.0, 0.0), 1.0, &mut way).expect("a motion");
        robot.drive(PerSide::new(-0.5, 0.5), 4.0, &mut way).expect("a motion");
        let reported = robot.report(&way);
        // a heading that drifts at rest does so in the turn
        let drift = (reported.pose_at(0.9).yaw - reported.pose_at(0.2).yaw) / 0.7;
        let yaw = |t| reported.pose_at(t).yaw - drift * t;
        let rate = (yaw(3.8) - yaw(2.8)) / 1.0;
        // the belt's way at which the steady turn would have begun
        let began = 2.8 - (yaw(2.8) - yaw(0.2)) / rate;
        0.5 * (began - 1.0).abs()
    }
}

#[test]
fn the_base_case_breaks_nothing() {
    let subject = Subject::new(Vec::new());
    let bases = subject.bases();
    for symmetry in &Symmetry::ALL[..7] {
        let change = subject.change(*symmetry, &bases, MAX_SHOE_CHANGE);
        println!("{}: {:.2} mm", symmetry.letter(), 1e3 * change);
        assert!(change < MAX_SHOE_CHANGE, "{}: {change} m", symmetry.letter());
    }
    assert!(subject.strays() < 1e-5 && subject.lags() < 1e-4);
}

/// Forms of each family that are measured: the plain one and so many drawn ones.
const DRAWN_FORMS: u32 = 2;

/// All mechanisms at their typical sizes, in several forms.
fn subjects() -> Vec<(&'static Sheet, Form)> {
    let forms = |sheet: &Sheet| if sheet.family.is_some() { 0..=DRAWN_FORMS } else { 0..=0 };
    let of = |number| if number == 0 { Form::Plain } else { Form::Drawn(number) };
    let all = MECHANISMS.iter();
    all.flat_map(|sheet| forms(sheet).map(move |number| (sheet, of(number)))).collect()
}

#[test]
fn every_mechanism_breaks_what_its_sheet_says_in_all_forms() {
    println!(
        "first change of an ICR that breaks, or the largest, mm; way off the line in 1 m, mm; \
         belt's way lost at a start, mm"
    );
    println!("{:26}{}", "", Symmetry::ALL.map(|i| format!("{:>8}", i.letter())).concat());
    let subjects = subjects();
    let measured: Vec<[f64; Symmetry::ALL.len()]> = subjects
        .par_iter()
        .map(|(sheet, form)| {
            let active = typical(&[sheet.id]).remove(0).with(*form).expect("a form");
            let subject = Subject::new(vec![active]);
            let bases = subject.bases();
            Symmetry::ALL.map(|symmetry| match symmetry {
                Symmetry::Straight => subject.strays(),
                Symmetry::Transient => subject.lags(),
                _ => subject.change(symmetry, &bases, MIN_BREAK),
            })
        })
        .collect();
    let mut wrong = Vec::new();
    for ((sheet, form), changes) in subjects.into_iter().zip(measured) {
        let number = form.number().map_or_else(String::new, |number| format!(" {number}"));
        println!(
            "{:26}{}",
            format!("{}{number}", sheet.id),
            changes.map(|change| format!("{:8.2}", 1e3 * change)).concat()
        );
        for (symmetry, change) in Symmetry::ALL.into_iter().zip(changes) {
            let breaks = sheet.breaks.contains(&symmetry);
            // what depends on heading, place or time changes during the turn that shows transients
            let moves = [Symmetry::Heading, Symmetry::Place, Symmetry::Time]
                .iter()
                .any(|of| sheet.breaks.contains(of));
            let hidden = symmetry == Symmetry::Transient && moves;
            if breaks != (change > MIN_BREAK) && !hidden {
                let letter = symmetry.letter();
                wrong.push(format!("{}{number} {letter}: {change:.2e} m", sheet.id));
            }
        }
    }
    assert!(wrong.is_empty(), "sheets and measurement differ: {wrong:#?}");
}

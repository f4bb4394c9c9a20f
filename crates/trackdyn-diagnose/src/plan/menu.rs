//! Manoeuvres that any tracked robot can drive on a free floor, each from rest to rest.
//!
//! No track stands still while the other one runs: motion resistance changes its sign there, and
//! its direction is not determined.

use crate::evidence::planned::READINGS;
use crate::settings;
use std::f64::consts::FRAC_PI_4;
use trackdyn_core::{PerSide, real};

/// Time between readings of the encoders, and between commands, s.
pub const INTERVAL: f64 = 0.03;

/// A manoeuvre from rest to rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Manoeuvre {
    /// Name in words.
    pub name: String,
    /// Track speeds of each interval, m/s; a multiple of whole samples.
    pub speeds: Vec<PerSide<f64>>,
}

impl Manoeuvre {
    /// Duration, s.
    pub fn duration(&self) -> f64 {
        INTERVAL * real(self.speeds.len())
    }
}

/// The menu for track speeds up to `fastest` (m/s, above zero). `gap` is the distance of the ICRs,
/// x_r − x_l, which sets the angle of turns, m.
pub fn menu(fastest: f64, gap: f64, settings: &settings::Plan) -> Vec<Manoeuvre> {
    let mut menu = Vec::new();
    for side in SIDES {
        for share in [0.25, 0.5, 1.0] {
            let speed = share * fastest;
            let name = format!("spin {} at {speed:.3} m/s", side.name);
            menu.push(plain(name, side.spin(speed), settings));
        }
        for (word, sense) in DIRECTIONS {
            for share in [0.3, 0.6, 1.0] {
                for ratio in [0.3, 0.6, 0.85] {
                    let speed = share * fastest;
                    let name = format!("arc {word} {} at {speed:.3} m/s, ratio {ratio}", side.name);
                    menu.push(plain(name, side.turn(sense * speed, ratio), settings));
                }
            }
            for share in [0.5, 1.0] {
                let speed = share * fastest;
                for (kind, ratio) in [("counter-rotation", -0.4), ("tight arc", 0.1)] {
                    let name = format!("{kind} {word} {} at {speed:.3} m/s", side.name);
                    menu.push(plain(name, side.turn(sense * speed, ratio), settings));
                }
            }
        }
    }
    straight(&mut menu, fastest, settings);
    transients(&mut menu, fastest, settings);
    creeping(&mut menu, fastest, settings);
    for side in SIDES {
        menu.push(headings(side, fastest, gap, settings));
        menu.push(square(side, fastest, gap, settings));
    }
    menu
}

#[derive(Clone, Copy)]
struct Turning {
    name: &'static str,
    /// 1 to the left, −1 to the right.
    sense: f64,
}

const SIDES: [Turning; 2] =
    [Turning { name: "left", sense: 1.0 }, Turning { name: "right", sense: -1.0 }];

const DIRECTIONS: [(&str, f64); 2] = [("forward", 1.0), ("backward", -1.0)];

impl Turning {
    /// The outer track at `speed`, the inner one at `ratio` times it.
    fn turn(self, speed: f64, ratio: f64) -> PerSide<f64> {
        if self.sense > 0.0 {
            PerSide::new(ratio * speed, speed)
        } else {
            PerSide::new(speed, ratio * speed)
        }
    }

    fn spin(self, speed: f64) -> PerSide<f64> {
        PerSide::new(-self.sense * speed, self.sense * speed)
    }
}

fn plain(name: String, speeds: PerSide<f64>, settings: &settings::Plan) -> Manoeuvre {
    let mut drive = Drive::new(settings);
    drive.to(speeds, settings.gentle_ramp);
    drive.hold(settings.steady);
    drive.finish(name)
}

fn both(speed: f64) -> PerSide<f64> {
    PerSide::new(speed, speed)
}

/// Straight runs: steady, with starts and stops, and out and back.
fn straight(menu: &mut Vec<Manoeuvre>, fastest: f64, settings: &settings::Plan) {
    for (word, sense) in DIRECTIONS {
        for share in [0.5, 1.0] {
            let speed = share * fastest;
            menu.push(plain(
                format!("straight {word} at {speed:.3} m/s"),
                both(sense * speed),
                settings,
            ));
            let mut drive = Drive::new(settings);
            for _ in 0..3 {
                drive.to(both(sense * speed), settings.sharp_ramp);
                drive.hold(settings.rest);
                drive.to(both(0.0), settings.sharp_ramp);
                drive.hold(settings.rest);
            }
            menu.push(drive.finish(format!("starts and stops {word} at {speed:.3} m/s")));
        }
    }
    for share in [0.5, 1.0] {
        let speed = share * fastest;
        let mut drive = Drive::new(settings);
        for sense in [1.0, -1.0] {
            drive.to(both(sense * speed), settings.gentle_ramp);
            drive.hold(settings.steady);
            drive.to(both(0.0), settings.gentle_ramp);
        }
        menu.push(drive.finish(format!("out and back at {speed:.3} m/s")));
    }
}

/// Sharp changes of speed.
fn transients(menu: &mut Vec<Manoeuvre>, fastest: f64, settings: &settings::Plan) {
    let mut steps = |name: String, between: [PerSide<f64>; 2]| {
        let mut drive = Drive::new(settings);
        drive.to(between[0], settings.gentle_ramp);
        for _ in 0..3 {
            drive.hold(settings.rest);
            drive.to(between[1], settings.sharp_ramp);
            drive.hold(settings.rest);
            drive.to(between[0], settings.sharp_ramp);
        }
        menu.push(drive.finish(name));
    };
    for (word, sense) in DIRECTIONS {
        let between = [0.2, 0.8].map(|share| both(sense * share * fastest));
        steps(format!("steps of speed {word}"), between);
        let [left, right] = SIDES.map(|side| side.turn(sense * 0.7 * fastest, 0.3));
        steps(format!("steps between arcs {word}, left first"), [left, right]);
        steps(format!("steps between arcs {word}, right first"), [right, left]);
    }
    for side in SIDES {
        let between = [0.15, 0.6].map(|share| side.spin(share * fastest));
        steps(format!("steps of a spin {}", side.name), between);
        let between = [side.spin(0.4 * fastest), side.spin(-0.4 * fastest)];
        steps(format!("reversals of a spin, {} first", side.name), between);
    }
}

/// Slow turns.
fn creeping(menu: &mut Vec<Manoeuvre>, fastest: f64, settings: &settings::Plan) {
    for speed in settings.creeping_speeds.into_iter().filter(|speed| *speed <= fastest) {
        for side in SIDES {
            let name = format!("creeping spin {} at {speed:.3} m/s", side.name);
            menu.push(plain(name, side.spin(speed), settings));
            for (word, sense) in DIRECTIONS {
                let name = format!("creeping arc {word} {} at {speed:.3} m/s", side.name);
                menu.push(plain(name, side.turn(sense * speed, 0.4), settings));
            }
        }
    }
}

/// One arc at eight headings.
fn headings(side: Turning, fastest: f64, gap: f64, settings: &settings::Plan) -> Manoeuvre {
    let mut drive = Drive::new(settings);
    for _ in 0..8 {
        // Out and back on one arc: the difference between arcs is the heading.
        for sense in [1.0, -1.0] {
            drive.to(side.turn(sense * 0.4 * fastest, 0.5), settings.gentle_ramp);
            drive.hold(settings.rest);
            drive.to(both(0.0), settings.gentle_ramp);
        }
        drive.spin(side, FRAC_PI_4, 0.4 * fastest, gap);
    }
    drive.finish(format!("the same arc {} at eight headings", side.name))
}

/// A square with turns on the spot.
fn square(side: Turning, fastest: f64, gap: f64, settings: &settings::Plan) -> Manoeuvre {
    let mut drive = Drive::new(settings);
    for _ in 0..4 {
        drive.to(both(0.7 * fastest), settings.gentle_ramp);
        drive.hold(settings.square_side);
        drive.to(both(0.0), settings.gentle_ramp);
        drive.spin(side, 2.0 * FRAC_PI_4, 0.4 * fastest, gap);
    }
    drive.finish(format!("square to the {}", side.name))
}

/// A manoeuvre under construction, one command per interval.
struct Drive<'a> {
    speeds: Vec<PerSide<f64>>,
    settings: &'a settings::Plan,
}

impl<'a> Drive<'a> {
    fn new(settings: &'a settings::Plan) -> Self {
        Self { speeds: Vec::new(), settings }
    }

    fn now(&self) -> PerSide<f64> {
        self.speeds.last().copied().unwrap_or_default()
    }

    /// Ramps to these speeds within a number of intervals.
    fn to(&mut self, target: PerSide<f64>, intervals: usize) {
        let from = self.now();
        for k in 1..=intervals {
            let share = real(k) / real(intervals);
            let towards = |side| from[side] + share * (target[side] - from[side]);
            self.speeds.push(if k == intervals { target } else { PerSide::from_fn(towards) });
        }
    }

    fn hold(&mut self, intervals: usize) {
        self.speeds.extend(std::iter::repeat_n(self.now(), intervals));
    }

    /// Turns on the spot by an angle (rad), from rest to rest, at `fastest` (m/s) or less.
    fn spin(&mut self, side: Turning, angle: f64, fastest: f64, gap: f64) {
        // V_r − V_l = ω (x_r − x_l), eq. (9): each track runs half of the arc.
        let ramp = self.settings.gentle_ramp;
        let arc = angle * gap / 2.0;
        let mut steady = 0;
        while INTERVAL * real(ramp + steady) * fastest < arc {
            steady += 1;
        }
        // Two ramps cover as much as one ramp's time at full speed.
        let speed = arc / (INTERVAL * real(ramp + steady));
        self.to(side.spin(speed), ramp);
        self.hold(steady);
        self.to(both(0.0), ramp);
    }

    /// Ramps to rest and pads to whole samples.
    fn finish(mut self, name: String) -> Manoeuvre {
        if self.now() != both(0.0) {
            self.to(both(0.0), self.settings.gentle_ramp);
        }
        self.hold(self.settings.rest);
        self.hold(self.speeds.len().next_multiple_of(READINGS) - self.speeds.len());
        Manoeuvre { name, speeds: self.speeds }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn manoeuvres_start_and_end_at_rest_and_stay_within_the_limit() {
        let settings = settings::Plan::default();
        for fastest in [0.02, 0.3, 1.0, 3.0] {
            let menu = menu(fastest, 0.83, &settings);
            for manoeuvre in &menu {
                let sizes = manoeuvre.speeds.iter().map(|v| v.left.abs().max(v.right.abs()));
                let largest = sizes.fold(0.0, f64::max);
                assert!(largest > 0.0 && largest <= fastest + 1e-12, "{}", manoeuvre.name);
                assert_eq!(manoeuvre.speeds.len() % READINGS, 0, "{}", manoeuvre.name);
                assert_eq!(*manoeuvre.speeds.last().expect("some"), both(0.0));
                let first = manoeuvre.speeds[0];
                assert!(
                    first.left.abs().max(first.right.abs())
                        <= fastest / real(settings.sharp_ramp) + 1e-12
                );
            }
            let mut names: Vec<&str> = menu.iter().map(|m| m.name.as_str()).collect();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), menu.len(), "names are unique");
        }
    }

    #[test]
    fn every_manoeuvre_has_its_mirror_image() {
        let menu = menu(1.0, 0.83, &settings::Plan::default());
        for manoeuvre in &menu {
            let mirrored: Vec<PerSide<f64>> =
                manoeuvre.speeds.iter().map(|v| PerSide::new(v.right, v.left)).collect();
            assert!(menu.iter().any(|other| other.speeds == mirrored), "{}", manoeuvre.name);
        }
    }
}

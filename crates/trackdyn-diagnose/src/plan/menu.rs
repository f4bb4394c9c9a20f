//! Manoeuvres that any tracked robot can drive on a free floor, each from rest to rest.
//!
//! No track stands still while the other one runs: motion resistance changes its sign there, and
//! its direction is not determined.

use crate::evidence::planned::READINGS;
use crate::settings::{self, Settings};
use std::f64::consts::FRAC_PI_4;
use trackdyn_core::{PerSide, real};

/// A manoeuvre from rest to rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Manoeuvre {
    /// Name in words.
    pub name: String,
    /// Time between readings of the encoders, and between commands, s.
    pub interval: f64,
    /// Track speeds of each interval, m/s; a multiple of whole samples.
    pub speeds: Vec<PerSide<f64>>,
}

impl Manoeuvre {
    /// Duration, s.
    pub fn duration(&self) -> f64 {
        self.interval * real(self.speeds.len())
    }
}

/// The menu for track speeds up to `fastest` (m/s, above zero). `gap` is the distance of the ICRs,
/// x_r − x_l, which sets the angle of turns, m.
pub fn menu(fastest: f64, gap: f64, settings: &Settings) -> Vec<Manoeuvre> {
    let by = &settings.menu;
    let mut menu = Vec::new();
    for side in SIDES {
        for share in by.spin_shares {
            let speed = share * fastest;
            let name = format!("spin {} at {speed:.3} m/s", side.name);
            menu.push(plain(name, side.spin(speed), settings));
        }
        for (word, sense) in DIRECTIONS {
            for share in by.arc_shares {
                for ratio in by.arc_ratios {
                    let speed = share * fastest;
                    let name = format!("arc {word} {} at {speed:.3} m/s, ratio {ratio}", side.name);
                    menu.push(plain(name, side.turn(sense * speed, ratio), settings));
                }
            }
            for share in by.tight_shares {
                let speed = share * fastest;
                for (kind, ratio) in
                    ["counter-rotation", "tight arc"].into_iter().zip(by.tight_ratios)
                {
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

fn plain(name: String, speeds: PerSide<f64>, settings: &Settings) -> Manoeuvre {
    let mut drive = Drive::new(settings);
    drive.to(speeds, settings.plan.gentle_ramp);
    drive.hold(settings.plan.steady);
    drive.finish(name)
}

fn both(speed: f64) -> PerSide<f64> {
    PerSide::new(speed, speed)
}

/// Straight runs: steady, with starts and stops, and out and back.
fn straight(menu: &mut Vec<Manoeuvre>, fastest: f64, settings: &Settings) {
    let (by, plan) = (&settings.menu, &settings.plan);
    for (word, sense) in DIRECTIONS {
        for share in by.straight_shares {
            let speed = share * fastest;
            menu.push(plain(
                format!("straight {word} at {speed:.3} m/s"),
                both(sense * speed),
                settings,
            ));
            let mut drive = Drive::new(settings);
            for _ in 0..3 {
                drive.to(both(sense * speed), plan.sharp_ramp);
                drive.hold(plan.rest);
                drive.to(both(0.0), plan.sharp_ramp);
                drive.hold(plan.rest);
            }
            menu.push(drive.finish(format!("starts and stops {word} at {speed:.3} m/s")));
        }
    }
    for share in by.straight_shares {
        let speed = share * fastest;
        let mut drive = Drive::new(settings);
        for sense in [1.0, -1.0] {
            drive.to(both(sense * speed), plan.gentle_ramp);
            drive.hold(plan.steady);
            drive.to(both(0.0), plan.gentle_ramp);
        }
        menu.push(drive.finish(format!("out and back at {speed:.3} m/s")));
    }
}

/// Sharp changes of speed.
fn transients(menu: &mut Vec<Manoeuvre>, fastest: f64, settings: &Settings) {
    let (by, plan) = (&settings.menu, &settings.plan);
    let mut steps = |name: String, between: [PerSide<f64>; 2]| {
        let mut drive = Drive::new(settings);
        drive.to(between[0], plan.gentle_ramp);
        for _ in 0..3 {
            drive.hold(plan.rest);
            drive.to(between[1], plan.sharp_ramp);
            drive.hold(plan.rest);
            drive.to(between[0], plan.sharp_ramp);
        }
        menu.push(drive.finish(name));
    };
    for (word, sense) in DIRECTIONS {
        let between = by.speed_steps.map(|share| both(sense * share * fastest));
        steps(format!("steps of speed {word}"), between);
        let [left, right] =
            SIDES.map(|side| side.turn(sense * by.arc_step_share * fastest, by.arc_step_ratio));
        steps(format!("steps between arcs {word}, left first"), [left, right]);
        steps(format!("steps between arcs {word}, right first"), [right, left]);
    }
    for side in SIDES {
        let between = by.spin_steps.map(|share| side.spin(share * fastest));
        steps(format!("steps of a spin {}", side.name), between);
        let between = [1.0, -1.0].map(|sense| side.spin(sense * by.reversal_share * fastest));
        steps(format!("reversals of a spin, {} first", side.name), between);
    }
}

/// Slow turns.
fn creeping(menu: &mut Vec<Manoeuvre>, fastest: f64, settings: &Settings) {
    let ratio = settings.menu.creeping_ratio;
    for speed in settings.plan.creeping_speeds.into_iter().filter(|speed| *speed <= fastest) {
        for side in SIDES {
            let name = format!("creeping spin {} at {speed:.3} m/s", side.name);
            menu.push(plain(name, side.spin(speed), settings));
            for (word, sense) in DIRECTIONS {
                let name = format!("creeping arc {word} {} at {speed:.3} m/s", side.name);
                menu.push(plain(name, side.turn(sense * speed, ratio), settings));
            }
        }
    }
}

/// One arc at eight headings.
fn headings(side: Turning, fastest: f64, gap: f64, settings: &Settings) -> Manoeuvre {
    let (by, plan) = (&settings.menu, &settings.plan);
    let mut drive = Drive::new(settings);
    for _ in 0..8 {
        // Out and back on one arc: the difference between arcs is the heading.
        for sense in [1.0, -1.0] {
            let speed = sense * by.heading_share * fastest;
            drive.to(side.turn(speed, by.heading_ratio), plan.gentle_ramp);
            drive.hold(plan.rest);
            drive.to(both(0.0), plan.gentle_ramp);
        }
        drive.spin(side, FRAC_PI_4, by.corner_share * fastest, gap);
    }
    drive.finish(format!("the same arc {} at eight headings", side.name))
}

/// A square with turns on the spot.
fn square(side: Turning, fastest: f64, gap: f64, settings: &Settings) -> Manoeuvre {
    let (by, plan) = (&settings.menu, &settings.plan);
    let mut drive = Drive::new(settings);
    for _ in 0..4 {
        drive.to(both(by.square_share * fastest), plan.gentle_ramp);
        drive.hold(plan.square_side);
        drive.to(both(0.0), plan.gentle_ramp);
        drive.spin(side, 2.0 * FRAC_PI_4, by.corner_share * fastest, gap);
    }
    drive.finish(format!("square to the {}", side.name))
}

/// A manoeuvre under construction, one command per interval.
struct Drive<'a> {
    speeds: Vec<PerSide<f64>>,
    settings: &'a settings::Plan,
}

impl<'a> Drive<'a> {
    fn new(settings: &'a Settings) -> Self {
        Self { speeds: Vec::new(), settings: &settings.plan }
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
        let &settings::Plan { gentle_ramp: ramp, interval, .. } = self.settings;
        let arc = angle * gap / 2.0;
        let mut steady = 0;
        while interval * real(ramp + steady) * fastest < arc {
            steady += 1;
        }
        // Two ramps cover as much as one ramp's time at full speed.
        let speed = arc / (interval * real(ramp + steady));
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
        Manoeuvre { name, interval: self.settings.interval, speeds: self.speeds }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn manoeuvres_start_and_end_at_rest_and_stay_within_the_limit() {
        let settings = Settings::default();
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
                        <= fastest / real(settings.plan.sharp_ramp) + 1e-12
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
        let menu = menu(1.0, 0.83, &Settings::default());
        for manoeuvre in &menu {
            let mirrored: Vec<PerSide<f64>> =
                manoeuvre.speeds.iter().map(|v| PerSide::new(v.right, v.left)).collect();
            assert!(menu.iter().any(|other| other.speeds == mirrored), "{}", manoeuvre.name);
        }
    }
}

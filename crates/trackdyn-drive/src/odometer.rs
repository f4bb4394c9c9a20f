//! Travel of the belts of a motion.

use trackdyn_core::{Moment, PerSide, Trajectory};

/// Travel between two neighbouring moments, m: speeds change linearly, as twists do.
fn step(from: &Moment, to: &Moment) -> PerSide<f64> {
    let duration = to.t - from.t;
    PerSide::from_fn(|side| duration * f64::midpoint(from.belt_speed[side], to.belt_speed[side]))
}

fn sum(a: PerSide<f64>, b: PerSide<f64>) -> PerSide<f64> {
    PerSide::from_fn(|side| a[side] + b[side])
}

/// A counter that runs along with a motion.
pub(crate) struct Odometer<'a> {
    moments: &'a [Moment],
    /// Place of the last moment that was passed.
    passed: usize,
    /// Travel up to it, m.
    travel: PerSide<f64>,
}

impl<'a> Odometer<'a> {
    pub(crate) fn new(trajectory: &'a Trajectory) -> Self {
        Self { moments: trajectory.moments(), passed: 0, travel: PerSide::default() }
    }

    /// Travel at a time that does not come before the last one asked for, m.
    pub(crate) fn travel(&mut self, t: f64) -> PerSide<f64> {
        while let [from, to, ..] = &self.moments[self.passed..] {
            if to.t <= t {
                self.travel = sum(self.travel, step(from, to));
                self.passed += 1;
                continue;
            }
            let share = (t - from.t) / (to.t - from.t);
            let belt_speed = PerSide::from_fn(|side| {
                from.belt_speed[side] + share * (to.belt_speed[side] - from.belt_speed[side])
            });
            return sum(self.travel, step(from, &Moment { t, belt_speed, ..*to }));
        }
        self.travel
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_core::{Pose, Twist};

    #[test]
    fn speeds_change_linearly() {
        let mut trajectory = Trajectory::default();
        for (t, v) in [(1.0, 0.0), (2.0, 2.0), (4.0, 0.0)] {
            let twist = Twist::zero();
            let belt_speed = PerSide::new(v, -v);
            trajectory.push(Moment { t, pose: Pose::default(), twist, belt_speed });
        }
        let mut odometer = Odometer::new(&trajectory);
        let left = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0].map(|t| odometer.travel(t).left);
        assert_eq!(left, [0.0, 0.25, 1.0, 2.5, 3.0, 3.0]);
    }
}

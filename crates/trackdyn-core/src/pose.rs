//! Position and heading in the plane: the group SE(2).

use crate::Twist;

/// Planar pose `world_from_body`: position in m, yaw in rad (not wrapped).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Position along the world's x axis, m.
    pub x: f64,
    /// Position along the world's y axis, m.
    pub y: f64,
    /// Heading, counter-clockwise positive, rad.
    pub yaw: f64,
}

impl Pose {
    /// The pose (x, y, yaw).
    pub const fn new(x: f64, y: f64, yaw: f64) -> Self {
        Self { x, y, yaw }
    }

    /// `a_from_c = a_from_b · b_from_c`.
    pub fn compose(&self, b_from_c: &Self) -> Self {
        let (sin, cos) = self.yaw.sin_cos();
        Self {
            x: self.x + cos * b_from_c.x - sin * b_from_c.y,
            y: self.y + sin * b_from_c.x + cos * b_from_c.y,
            yaw: self.yaw + b_from_c.yaw,
        }
    }

    /// `b_from_a` of `a_from_b`.
    pub fn inverse(&self) -> Self {
        let (sin, cos) = self.yaw.sin_cos();
        Self { x: -cos * self.x - sin * self.y, y: sin * self.x - cos * self.y, yaw: -self.yaw }
    }

    /// `b_from_c` of `a_from_b` (self) and `a_from_c`: the motion from self to `other`, seen from
    /// self.
    pub fn relative(&self, other: &Self) -> Self {
        self.inverse().compose(other)
    }

    /// Motion after `duration` seconds of a constant twist in body axes (the exponential map).
    pub fn exp(twist: &Twist, duration: f64) -> Self {
        let angle = twist.w * duration;
        // sin a / a and (1 − cos a) / a, by their series where the quotient loses digits
        let square = angle * angle;
        let (s, c) = if square < 0.01 {
            let s = alternating(square, [6.0, 20.0, 42.0, 72.0]);
            (s, angle / 2.0 * alternating(square, [12.0, 30.0, 56.0, 90.0]))
        } else {
            let (sin, cos) = angle.sin_cos();
            (sin / angle, (1.0 - cos) / angle)
        };
        Self {
            x: duration * (s * twist.v_x - c * twist.v_y),
            y: duration * (c * twist.v_x + s * twist.v_y),
            yaw: angle,
        }
    }

    /// The constant twist that leads here from the origin in `duration` seconds: the inverse of
    /// [`Pose::exp`] for turns of less than a full one.
    pub fn log(&self, duration: f64) -> Twist {
        let half = self.yaw / 2.0;
        // ½ yaw cot(½ yaw), by its series where the quotient loses digits
        let cotangent = if half.abs() < 1e-4 { 1.0 - half * half / 3.0 } else { half / half.tan() };
        Twist {
            v_x: (cotangent * self.x + half * self.y) / duration,
            v_y: (cotangent * self.y - half * self.x) / duration,
            w: self.yaw / duration,
        }
    }
}

/// 1 − x/a (1 − x/b (1 − x/c (1 − x/d))).
fn alternating(x: f64, [a, b, c, d]: [f64; 4]) -> f64 {
    1.0 - x / a * (1.0 - x / b * (1.0 - x / c * (1.0 - x / d)))
}

/// The angle wrapped into (−π, π].
pub fn wrap_angle(angle: f64) -> f64 {
    let wrapped = angle.rem_euclid(std::f64::consts::TAU);
    if wrapped > std::f64::consts::PI { wrapped - std::f64::consts::TAU } else { wrapped }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_undoes_compose() {
        let a = Pose::new(1.0, -2.0, 0.4);
        let b = Pose::new(-0.3, 0.9, 2.0);
        let back = a.relative(&a.compose(&b));
        assert!((back.x - b.x).abs() < 1e-15);
        assert!((back.y - b.y).abs() < 1e-15);
        assert!((back.yaw - b.yaw).abs() < 1e-15);
    }

    #[test]
    fn exp_is_the_limit_of_small_steps() {
        let twist = Twist { v_x: 0.3, v_y: 1.1, w: -0.8 };
        let steps = 1_000;
        let step = Pose::exp(&twist, 2.0 / f64::from(steps));
        let walked = (0..steps).fold(Pose::default(), |pose, _| pose.compose(&step));
        let whole = Pose::exp(&twist, 2.0);
        assert!((walked.x - whole.x).abs() < 1e-12);
        assert!((walked.y - whole.y).abs() < 1e-12);
        // A quarter circle of radius 1.
        let quarter = Pose::exp(&Twist { v_x: 1.0, v_y: 0.0, w: 1.0 }, std::f64::consts::FRAC_PI_2);
        assert!((quarter.x - 1.0).abs() < 1e-15 && (quarter.y - 1.0).abs() < 1e-15);
    }

    #[test]
    fn log_undoes_exp() {
        for w in [0.0, 1e-6, -1e-4, 0.3, -1.0, 1.5] {
            let twist = Twist { v_x: 0.3, v_y: -1.1, w };
            let back = Pose::exp(&twist, 2.0).log(2.0);
            assert!((back.v_x - twist.v_x).abs() < 1e-12 && (back.v_y - twist.v_y).abs() < 1e-12);
            assert_eq!(back.w, w);
        }
    }

    #[test]
    fn exp_is_continuous_where_it_changes_formula() {
        let at = |w| Pose::exp(&Twist { v_x: 1.0, v_y: 0.5, w }, 1.0);
        let (below, above) = (at(0.1_f64.next_down()), at(0.1));
        assert!((below.x - above.x).abs() < 1e-15 && (below.y - above.y).abs() < 1e-15);
    }

    #[test]
    fn angles_wrap_into_the_half_open_turn() {
        use std::f64::consts::PI;
        assert_eq!(wrap_angle(PI), PI);
        assert!((wrap_angle(-PI) - PI).abs() < 1e-15);
        assert!((wrap_angle(7.0) - (7.0 - std::f64::consts::TAU)).abs() < 1e-15);
    }
}

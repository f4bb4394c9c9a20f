//! What a ray hits first.
//!
//! A ray o + ρ u meets the segment a-b where u × (a − o) and u × (b − o) differ in sign, at ρ = (a
//! − o) × (b − a) / (u × (b − a)). Segments that share a corner compute its cross product from the
//! same numbers, so that no ray slips through between them.

use super::{Room, Segment};
use std::f64::consts::{PI, TAU};
use trackdyn_core::Pose;
use trackdyn_core::pose::wrap_angle;

/// Rays from one point, at equal angles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fan {
    /// Bearing of ray 0, rad.
    pub(crate) first_angle: f64,
    /// Bearing from one ray to the next, rad, positive.
    pub(crate) angle_step: f64,
    /// Rays.
    pub(crate) count: usize,
}

/// Bearings are this exact, rad: what is nearer to the end of a segment is decided by intersection.
const BEARING_ROUNDING: f64 = 1e-9;

impl Room {
    /// Distance in m from a point to the first segment along a bearing (rad); `None` in the open.
    ///
    /// A ray along a segment meets its nearer end. A ray that starts on a segment has distance
    /// zero.
    pub fn range(&self, origin: [f64; 2], bearing: f64) -> Option<f64> {
        let (sin, cos) = bearing.sin_cos();
        let hits = self.segments().iter().filter_map(|segment| meet(segment, origin, [cos, sin]));
        hits.min_by(f64::total_cmp)
    }

    /// The ranges of a fan of rays, m, infinite in the open; the same bits as [`Room::range`]
    /// gives.
    ///
    /// Each segment is intersected with the rays between the bearings of its ends only.
    pub(crate) fn ranges(&self, pose: &Pose, fan: &Fan) -> Vec<f64> {
        let origin = [pose.x, pose.y];
        let directions: Vec<[f64; 2]> = (0..fan.count)
            .map(|ray| {
                let (sin, cos) = (pose.yaw + fan.bearing(ray)).sin_cos();
                [cos, sin]
            })
            .collect();
        let mut ranges = vec![f64::INFINITY; fan.count];
        for segment in self.segments() {
            for rays in fan.rays_across(segment, pose) {
                let hits = ranges[rays.clone()].iter_mut().zip(&directions[rays]);
                for (range, direction) in hits {
                    if let Some(hit) = meet(segment, origin, *direction) {
                        *range = range.min(hit);
                    }
                }
            }
        }
        ranges
    }
}

impl Fan {
    /// Bearing of a ray against the fan's axis, rad.
    #[expect(clippy::cast_precision_loss, reason = "beams are few")]
    pub(crate) fn bearing(&self, ray: usize) -> f64 {
        self.first_angle + self.angle_step * ray as f64
    }

    /// Rays that can meet a segment: two ranges of indices, for it may lie at both ends of a wide
    /// fan.
    fn rays_across(&self, segment: &Segment, pose: &Pose) -> [std::ops::Range<usize>; 2] {
        let at_end = |end: [f64; 2]| end == [pose.x, pose.y];
        if at_end(segment.from) || at_end(segment.to) {
            return [0..self.count, 0..0];
        }
        let bearing = |[x, y]: [f64; 2]| (y - pose.y).atan2(x - pose.x) - pose.yaw;
        let (from, to) = (bearing(segment.from), bearing(segment.to));
        let width = wrap_angle(to - from);
        // From a point on the segment, its two sides are half a turn apart, and which half is
        // rounding.
        if width.abs() > PI - 1e-6 {
            return [0..self.count, 0..0];
        }
        let low = self.first_angle
            + (from.min(from + width) - BEARING_ROUNDING - self.first_angle).rem_euclid(TAU);
        let high = low + width.abs() + 2.0 * BEARING_ROUNDING;
        [low - TAU, low].map(|start| self.index(start)..self.index(start + high - low))
    }

    /// The first ray at or beyond a bearing, at most the count.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "as saturates below zero and above the count alike"
    )]
    fn index(&self, bearing: f64) -> usize {
        (((bearing - self.first_angle) / self.angle_step).ceil() as usize).min(self.count)
    }
}

/// Distance along a ray to a segment.
fn meet(segment: &Segment, origin: [f64; 2], u: [f64; 2]) -> Option<f64> {
    let a = [segment.from[0] - origin[0], segment.from[1] - origin[1]];
    let b = [segment.to[0] - origin[0], segment.to[1] - origin[1]];
    let (u_a, u_b) = (cross(u, a), cross(u, b));
    if (u_a > 0.0 && u_b > 0.0) || (u_a < 0.0 && u_b < 0.0) {
        return None;
    }
    let along = [b[0] - a[0], b[1] - a[1]];
    // u × (b − a)
    let across = u_b - u_a;
    let range = if across == 0.0 {
        let ends = [dot(u, a), dot(u, b)];
        if ends[0].min(ends[1]) <= 0.0 && ends[0].max(ends[1]) >= 0.0 {
            0.0
        } else {
            ends[0].min(ends[1])
        }
    } else {
        // ρ = (a − o) × (b − a) / (u × (b − a))
        cross(a, along) / across
    };
    // + 0 turns −0 into 0.
    (range >= 0.0).then_some(range + 0.0)
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::room::Outline;

    fn square() -> Room {
        let corners = vec![[-2.0, -1.0], [2.0, -1.0], [2.0, 1.0], [-2.0, 1.0]];
        let outline = Outline { name: "walls".to_owned(), corners, closed: true };
        Room::new("square", vec![outline]).expect("a room")
    }

    #[test]
    fn ranges_in_a_box_are_those_of_trigonometry() {
        let room = square();
        for step in 0..720 {
            let bearing = f64::from(step) * PI / 360.0;
            let (sin, cos) = bearing.sin_cos();
            // The nearer of the wall across and the wall ahead; 1e-15 is rounding.
            let expected = (2.0 / cos.abs()).min(1.0 / sin.abs());
            let range = room.range([0.0, 0.0], bearing).expect("a wall");
            assert!((range - expected).abs() < 2e-15 * expected, "{bearing}: {range}");
        }
    }

    #[test]
    fn a_ray_along_a_wall_meets_its_nearer_end() {
        let wall = Outline {
            name: "wall".to_owned(),
            corners: vec![[1.0, 0.0], [3.0, 0.0]],
            closed: false,
        };
        let room = Room::new("wall", vec![wall]).expect("a room");
        assert_eq!(room.range([0.0, 0.0], 0.0), Some(1.0));
        assert_eq!(room.range([2.0, 0.0], 0.0), Some(0.0));
        assert_eq!(room.range([4.0, 0.0], 0.0), None);
        assert_eq!(room.range([0.0, 1e-9], 0.0), None);
    }

    #[test]
    fn no_ray_slips_through_a_corner() {
        let room = square();
        for (x, y) in [(2.0_f64, 1.0_f64), (-2.0, 1.0), (2.0, -1.0), (-2.0, -1.0)] {
            for origin in [[0.1, 0.2], [-1.3, 0.7], [1.9, -0.9]] {
                let exact = (y - origin[1]).atan2(x - origin[0]);
                for bearing in [exact.next_down(), exact, exact.next_up()] {
                    let range = room.range(origin, bearing).expect("a closed room");
                    let corner = (x - origin[0]).hypot(y - origin[1]);
                    assert!((range - corner).abs() < 1e-12, "{range} {corner}");
                }
            }
        }
    }

    #[test]
    fn fans_give_the_ranges_of_single_rays() {
        let room = Room::furnished();
        let fan = Fan { first_angle: -3.0, angle_step: 0.01, count: 628 };
        for pose in [
            Pose::new(5.0, 4.0, 0.3),
            Pose::new(2.0, 1.7, -2.9),
            Pose::new(12.0, 4.0, 9.0),
            // On a wall, and on a corner.
            Pose::new(10.0, 1.0, 0.2),
            Pose::new(2.8, 0.4, 1.0),
        ] {
            for (ray, range) in room.ranges(&pose, &fan).into_iter().enumerate() {
                let single = room.range([pose.x, pose.y], pose.yaw + fan.bearing(ray));
                assert_eq!(single.unwrap_or(f64::INFINITY), range, "{pose:?} {ray}");
            }
        }
    }
}

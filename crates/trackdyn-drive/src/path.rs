//! A way over the ground: points joined by straight pieces.

mod file;
mod shapes;

use crate::Error;
use trackdyn_core::Pose;

/// A polyline, in m, with its length along.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    points: Vec<[f64; 2]>,
    /// Length up to each point, m.
    along: Vec<f64>,
}

/// Where something is beside a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Length of the path up to the nearest point, m.
    pub along: f64,
    /// Distance to it, left positive, m.
    pub offset: f64,
    /// Direction of the path there, rad.
    pub direction: f64,
}

impl Path {
    /// Checks the points.
    ///
    /// # Errors
    /// [`Error::NoPath`].
    pub fn new(points: Vec<[f64; 2]>) -> Result<Self, Error> {
        if points.len() < 2 {
            return Err(Error::NoPath(format!("{} points", points.len())));
        }
        let mut along = Vec::with_capacity(points.len());
        let mut length = 0.0;
        for (index, point) in points.iter().enumerate() {
            if let Some(before) = index.checked_sub(1) {
                length += distance(points[before], *point);
                if length <= along[before] {
                    return Err(Error::NoPath(format!("points {before} and {index} in one place")));
                }
            }
            if !(length.is_finite() && point.iter().all(|value| value.is_finite())) {
                return Err(Error::NoPath(format!("a point {index} that is not finite")));
            }
            along.push(length);
        }
        Ok(Self { points, along })
    }

    /// Its points, m.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Length, m.
    pub fn length(&self) -> f64 {
        self.along[self.along.len() - 1]
    }

    /// The path seen from another frame: `frame_from_path` moves its points.
    pub fn moved(&self, frame_from_path: &Pose) -> Self {
        let moved = |&[x, y]: &[f64; 2]| {
            let Pose { x, y, .. } = frame_from_path.compose(&Pose::new(x, y, 0.0));
            [x, y]
        };
        Self { points: self.points.iter().map(moved).collect(), along: self.along.clone() }
    }

    /// The first point and the direction there.
    pub fn start(&self) -> Pose {
        let [x, y] = self.points[0];
        Pose::new(x, y, self.direction(0))
    }

    /// The point at a length along, m; on the straight line beyond the ends.
    pub fn point_at(&self, along: f64) -> [f64; 2] {
        let index = self.piece_at(along);
        let share = (along - self.along[index]) / (self.along[index + 1] - self.along[index]);
        self.between(index, share)
    }

    /// Direction of the path at a length along, rad; at a point, that of the piece after it.
    pub fn direction_at(&self, along: f64) -> f64 {
        self.direction(self.piece_at(along))
    }

    /// Lengths along at which the direction changes by more than an angle, rad.
    pub fn corners(&self, angle: f64) -> Vec<f64> {
        (1..self.points.len() - 1)
            .filter(|&index| {
                let change = self.direction(index) - self.direction(index - 1);
                trackdyn_core::pose::wrap_angle(change).abs() > angle
            })
            .map(|index| self.along[index])
            .collect()
    }

    /// The place nearest to a point among those between two lengths along.
    pub fn nearest(&self, point: [f64; 2], [from, until]: [f64; 2]) -> Station {
        let (from, until) = (from.max(0.0), until.min(self.length()));
        let first = self.piece_at(from);
        let mut best: Option<(f64, usize, f64)> = None;
        for index in first..self.points.len() - 1 {
            if index > first && self.along[index] > until {
                break;
            }
            let [a, b] = [self.points[index], self.points[index + 1]];
            let piece = [b[0] - a[0], b[1] - a[1]];
            let length = self.along[index + 1] - self.along[index];
            let projected =
                ((point[0] - a[0]) * piece[0] + (point[1] - a[1]) * piece[1]) / (length * length);
            let low = ((from - self.along[index]) / length).clamp(0.0, 1.0);
            let high = ((until - self.along[index]) / length).clamp(low, 1.0);
            let share = projected.clamp(low, high);
            let away = distance(point, self.between(index, share));
            if best.is_none_or(|(least, ..)| away < least) {
                best = Some((away, index, share));
            }
        }
        let (away, index, share) = best.unwrap_or((0.0, first, 0.0));
        let direction = self.direction(index);
        let [x, y] = self.between(index, share);
        let (sin, cos) = direction.sin_cos();
        let side = cos * (point[1] - y) - sin * (point[0] - x);
        let length = self.along[index + 1] - self.along[index];
        Station {
            along: self.along[index] + share * length,
            offset: away.copysign(side),
            direction,
        }
    }

    /// The first place between two lengths along that lies at least a radius away from a point:
    /// where a circle around it is left. None where the path stays inside.
    pub fn leaves_circle(
        &self,
        centre: [f64; 2],
        radius: f64,
        [from, until]: [f64; 2],
    ) -> Option<[f64; 2]> {
        let start = self.point_at(from);
        if distance(start, centre) >= radius {
            return Some(start);
        }
        let mut a = start;
        for index in self.piece_at(from)..self.points.len() - 1 {
            let last = self.along[index + 1] >= until;
            let b = if last { self.point_at(until) } else { self.points[index + 1] };
            if distance(b, centre) >= radius {
                // |a + λ (b − a) − c| = r, from inside to outside: the larger root
                let (d, r) = ([b[0] - a[0], b[1] - a[1]], [a[0] - centre[0], a[1] - centre[1]]);
                let (dd, dr) = (d[0] * d[0] + d[1] * d[1], d[0] * r[0] + d[1] * r[1]);
                let rest = radius * radius - r[0] * r[0] - r[1] * r[1];
                let share = ((dr * dr + dd * rest).sqrt() - dr) / dd;
                return Some([a[0] + share * d[0], a[1] + share * d[1]]);
            }
            if last {
                return None;
            }
            a = b;
        }
        None
    }

    /// Index of the piece that holds a length along; the first or last one outside.
    fn piece_at(&self, along: f64) -> usize {
        let after = self.along.partition_point(|start| *start <= along);
        after.saturating_sub(1).min(self.points.len() - 2)
    }

    /// Direction of a piece, rad.
    fn direction(&self, index: usize) -> f64 {
        let [a, b] = [self.points[index], self.points[index + 1]];
        (b[1] - a[1]).atan2(b[0] - a[0])
    }

    fn between(&self, index: usize, share: f64) -> [f64; 2] {
        let [a, b] = [self.points[index], self.points[index + 1]];
        [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]
    }
}

/// Distance between two points, m.
pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bend() -> Path {
        Path::new(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 3.0]]).expect("a path")
    }

    #[test]
    fn places_along_and_beside() {
        let path = bend();
        assert_eq!(path.length(), 5.0);
        assert_eq!(path.point_at(3.0), [2.0, 1.0]);
        assert_eq!(path.point_at(6.0), [2.0, 4.0]);
        assert_eq!(path.point_at(-1.0), [-1.0, 0.0]);
        let station = path.nearest([1.5, 1.0], [0.0, 5.0]);
        assert_eq!((station.along, station.offset), (3.0, 0.5));
        // the same place, looked for on the first leg only, and left of it
        let station = path.nearest([1.5, 1.0], [0.0, 2.0]);
        assert_eq!((station.along, station.offset), (1.5, 1.0));
        assert_eq!(path.corners(0.5), [2.0]);
        assert!(path.corners(1.6).is_empty());
    }

    #[test]
    fn a_circle_is_left_once() {
        let path = bend();
        assert_eq!(path.leaves_circle([0.0, 0.0], 1.0, [0.0, 5.0]), Some([1.0, 0.0]));
        let [x, y] = path.leaves_circle([0.0, 0.0], 8.0_f64.sqrt(), [0.0, 5.0]).expect("left");
        assert!((x - 2.0).abs() < 1e-12 && (y - 2.0).abs() < 1e-12);
        assert_eq!(path.leaves_circle([0.0, 0.0], 3.0, [0.0, 3.0]), None);
    }

    #[test]
    fn what_is_no_path_is_refused() {
        let refused = |points| Path::new(points).expect_err("no path").to_string();
        assert!(refused(vec![[0.0, 0.0]]).contains("1 points"));
        assert!(refused(vec![[0.0, 0.0], [0.0, 0.0]]).contains("points 0 and 1"));
        assert!(refused(vec![[0.0, 0.0], [f64::NAN, 0.0]]).contains("not finite"));
        assert!(refused(vec![[0.0, 0.0], [f64::INFINITY, 0.0]]).contains("not finite"));
    }
}

//! Which part of the contact bears the load.
//!
//! # Law
//! Ground pushes and never pulls. Where the linear pressure would be negative the contact has
//! lifted, and the rest bears the load with the centre of pressure that the balance of moments
//! asks for. With η = ±y towards the loaded end,
//!
//! ```text
//! p(η) = g max(0, η − η₀),   ∫ p dA = N,   ∫ η p dA = N η_p
//! ```
//!
//! The ratio of both integrals leaves one equation for the edge η₀. Its left side grows with η₀:
//!
//! ```text
//! η₀ + ⅔ Q/P = η_p,   P = Σ (w₂² − w₁²), Q = Σ (w₂³ − w₁³),   w_i = max(0, η_i − η₀)
//! ```
//!
//! with the sums over patches from η₁ to η₂. One track has η₀ = 3 η_p − 2 η_end: a triangle.

use crate::contact::pressure::Footprint;
use crate::contact::{Patch, Pressure};
use trackdyn_core::Scalar;

/// Share of the outermost patch that always bears. A load nearer to the end of the contact, or
/// outside, is borne there by a linear pressure that pulls on part of it: no motion of a robot,
/// but a residual that a solver can leave again.
const MIN_BEARING: f64 = 0.01;

/// Largest number of steps towards the edge; halving alone reaches rounding.
const MAX_STEPS: usize = 100;

/// The part of the contact of each side that bears its load. Both sides have one centre of pressure
/// along the track (Fig. 5), hence one edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bearing<S = f64> {
    /// All of it, with this centre of pressure (y, m).
    Whole(S),
    /// What lies beyond an edge.
    Part {
        /// y of the edge, m.
        edge: S,
        /// Whether the part before the edge bears, not the one behind.
        in_front: bool,
        /// Pressure per newton of load, 1/m² and 1/m³.
        per_load: Pressure<S>,
    },
}

impl<S: Scalar> Bearing<S> {
    /// The part of these patches that bears a load with this centre of pressure (y, m).
    #[inline]
    pub fn of(patches: &[Patch], footprint: &Footprint, centre_of_pressure: S) -> Self {
        let [rear, front] = footprint.support();
        if (rear..=front).contains(&centre_of_pressure.value()) {
            Self::Whole(centre_of_pressure)
        } else {
            Self::part(patches, centre_of_pressure, centre_of_pressure.value() > front)
        }
    }

    #[cold]
    fn part(patches: &[Patch], centre_of_pressure: S, in_front: bool) -> Self {
        let sense = if in_front { 1.0 } else { -1.0 };
        let intervals = Intervals::towards(sense, patches);
        let centre = centre_of_pressure * sense;
        let edge = intervals.edge(centre);
        let bearing = |per_load| Self::Part { edge: edge * sense, in_front, per_load };
        if edge.value() >= intervals.last_edge() {
            let at = bearing(Pressure { at_origin: S::from(0.0), gradient: S::from(0.0) });
            let rest: Vec<Patch> =
                patches.iter().filter_map(|patch| Some(at.pressed(patch)?.value())).collect();
            return bearing(Footprint::of(&rest).pressure(S::from(1.0), centre_of_pressure));
        }
        // g = 2 N/(b P)
        let gradient = (intervals.second_order(edge) * (patches[0].width() / 2.0)).recip();
        bearing(Pressure { at_origin: -gradient * edge, gradient: gradient * sense })
    }

    /// Pressure of one side under its load, N.
    #[inline]
    pub fn pressure(&self, footprint: &Footprint, normal_load: S) -> Pressure<S> {
        match self {
            Self::Whole(centre_of_pressure) => footprint.pressure(normal_load, *centre_of_pressure),
            Self::Part { per_load: Pressure { at_origin, gradient }, .. } => {
                Pressure { at_origin: *at_origin * normal_load, gradient: *gradient * normal_load }
            }
        }
    }

    /// The part of a patch that bears; none where all of it has lifted.
    #[inline]
    pub fn pressed(&self, patch: &Patch) -> Option<Patch<S>> {
        let Patch { x, y: [rear, front] } = *patch;
        let [whole_rear, whole_front] = [rear, front].map(S::from);
        let y = match *self {
            Self::Whole(_) => [whole_rear, whole_front],
            Self::Part { edge, in_front: true, .. } => {
                [if edge.value() > rear { edge } else { whole_rear }, whole_front]
            }
            Self::Part { edge, in_front: false, .. } => {
                [whole_rear, if edge.value() < front { edge } else { whole_front }]
            }
        };
        (y[0].value() < y[1].value()).then_some(Patch { x, y })
    }
}

/// Patches along η: where each begins and ends, m.
struct Intervals(Vec<[f64; 2]>);

impl Intervals {
    fn towards(sense: f64, patches: &[Patch]) -> Self {
        let ordered = |patch: &Patch| {
            let [a, b] = patch.y.map(|y| sense * y);
            [a.min(b), a.max(b)]
        };
        Self(patches.iter().map(ordered).collect())
    }

    /// The patch at the loaded end.
    fn outermost(&self) -> [f64; 2] {
        self.0.iter().copied().fold([f64::NEG_INFINITY; 2], |a, b| if b[1] > a[1] { b } else { a })
    }

    /// The edge beyond which too little would bear.
    fn last_edge(&self) -> f64 {
        let [low, high] = self.outermost();
        high - MIN_BEARING * (high - low)
    }

    /// P = Σ (w₂² − w₁²) of an edge.
    fn second_order<S: Scalar>(&self, edge: S) -> S {
        let mut sum = S::from(0.0);
        for interval in &self.0 {
            let [first, second] = interval.map(|end| beyond(end, edge));
            sum += second * second - first * first;
        }
        sum
    }

    /// Centre of pressure of an edge, m, and its derivative by the edge.
    fn centre(&self, edge: f64) -> [f64; 2] {
        let [mut p, mut q, mut r] = [0.0; 3];
        for interval in &self.0 {
            let [first, second] = interval.map(|end| beyond(end, edge));
            p += second.powi(2) - first.powi(2);
            q += second.powi(3) - first.powi(3);
            r += second - first;
        }
        // dQ/dη₀ = −3 P, dP/dη₀ = −2 R
        [edge + 2.0 / 3.0 * q / p, 4.0 / 3.0 * q * r / (p * p) - 1.0]
    }

    /// The edge for a centre of pressure, m, at most the last one: Newton's method between bounds.
    fn edge<S: Scalar>(&self, centre: S) -> S {
        let wanted = centre.value();
        let last = self.last_edge();
        if self.centre(last)[0] <= wanted {
            return S::from(last);
        }
        let [first, end] = [self.first_end(), self.outermost()[1]];
        let (mut low, mut high) = (first, last);
        let mut edge = (3.0 * wanted - 2.0 * end).clamp(low, high);
        for _ in 0..MAX_STEPS {
            let [reached, slope] = self.centre(edge);
            if reached < wanted {
                low = edge;
            } else {
                high = edge;
            }
            let step = (wanted - reached) / slope;
            let next = edge + step;
            let next = if next > low && next < high { next } else { f64::midpoint(low, high) };
            let is_there = (next - edge).abs() <= f64::EPSILON * (end - first);
            edge = next;
            if is_there {
                break;
            }
        }
        centre.map(edge, self.centre(edge)[1].recip())
    }

    /// Where the contact begins at the end that lifts.
    fn first_end(&self) -> f64 {
        self.0.iter().map(|interval| interval[0]).fold(f64::INFINITY, f64::min)
    }
}

/// w = max(0, η − η₀).
#[inline]
fn beyond<S: Scalar>(end: f64, edge: S) -> S {
    if end > edge.value() { -edge + end } else { S::from(0.0) }
}

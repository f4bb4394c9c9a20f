//! Contact rectangles.

use trackdyn_core::Scalar;

/// A rectangular contact area with its sides along the axes of the paper's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch<S = f64> {
    /// Left and right edge, m.
    pub x: [f64; 2],
    /// Rear and front edge, m; they move with the load where part of the patch lifts.
    pub y: [S; 2],
}

impl Patch {
    /// The rectangle of the given centre, width (along x) and length (along y), m.
    pub fn centred(centre: [f64; 2], width: f64, length: f64) -> Self {
        Self {
            x: [centre[0] - width / 2.0, centre[0] + width / 2.0],
            y: [centre[1] - length / 2.0, centre[1] + length / 2.0],
        }
    }

    /// Area, m².
    pub fn area(&self) -> f64 {
        self.width() * self.length()
    }
}

impl<S: Scalar> Patch<S> {
    /// Centre (x, y), m.
    pub fn centre(&self) -> [S; 2] {
        [S::from(f64::midpoint(self.x[0], self.x[1])), (self.y[0] + self.y[1]) * 0.5]
    }

    /// Extent along x, m.
    pub fn width(&self) -> f64 {
        self.x[1] - self.x[0]
    }

    /// Extent along y, m.
    pub fn length(&self) -> S {
        self.y[1] - self.y[0]
    }

    /// The rectangle without derivatives.
    pub fn value(&self) -> Patch {
        Patch { x: self.x, y: self.y.map(Scalar::value) }
    }
}

/// Centre and size of one side's contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Centroid (x, y), m.
    pub middle: [f64; 2],
    /// Root mean square distance of its points from the centroid, m.
    pub radius: f64,
}

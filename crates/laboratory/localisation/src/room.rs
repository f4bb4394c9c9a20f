//! Walls and furniture as a planar laser sees them.

use crate::Error;

mod cast;
mod file;

pub(crate) use cast::Fan;

/// A room: outlines of straight segments in the room's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    name: String,
    outlines: Vec<Outline>,
    segments: Vec<Segment>,
}

/// A chain of straight segments: a wall, a desk, a box.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// What it is.
    pub name: String,
    /// Its corners (x, y), m.
    pub corners: Vec<[f64; 2]>,
    /// Whether a segment leads from the last corner back to the first.
    pub closed: bool,
}

/// A straight piece of an outline, from corner to corner, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// One end (x, y), m.
    pub from: [f64; 2],
    /// The other end (x, y), m.
    pub to: [f64; 2],
}

impl Outline {
    /// Its segments, in order.
    pub fn segments(&self) -> impl Iterator<Item = Segment> {
        let pairs = self.corners.windows(2).map(|pair| Segment { from: pair[0], to: pair[1] });
        let closing = match self.corners.as_slice() {
            [first, .., last] if self.closed => Some(Segment { from: *last, to: *first }),
            _ => None,
        };
        pairs.chain(closing)
    }

    fn check(&self) -> Result<(), Error> {
        let error = |found: String, expected| {
            Err(Error::Outline { outline: self.name.clone(), found, expected })
        };
        let fewest = if self.closed { 3 } else { 2 };
        if self.corners.len() < fewest {
            let expected = "two or more corners, three if it is closed";
            return error(format!("{} corners", self.corners.len()), expected);
        }
        if let Some(corner) =
            self.corners.iter().find(|corner| !corner.iter().all(|c| c.is_finite()))
        {
            return error(format!("corner {corner:?}"), "finite coordinates in m");
        }
        if let Some(segment) = self.segments().find(|segment| segment.from == segment.to) {
            return error(format!("corner {:?} twice in a row", segment.from), "corners apart");
        }
        Ok(())
    }
}

impl Room {
    /// A room of outlines. Without any, it is the open.
    ///
    /// # Errors
    /// [`Error::Outline`] for too few corners, corners that are not finite, and segments without
    /// length.
    pub fn new(name: impl Into<String>, outlines: Vec<Outline>) -> Result<Self, Error> {
        for outline in &outlines {
            outline.check()?;
        }
        let segments = outlines.iter().flat_map(Outline::segments).collect();
        Ok(Self { name: name.into(), outlines, segments })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its outlines, as given.
    pub fn outlines(&self) -> &[Outline] {
        &self.outlines
    }

    /// All segments, outline by outline.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }
}

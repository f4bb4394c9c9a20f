//! Colours.

use serde::{Deserialize, Serialize};

/// Red, green, blue.
pub type Rgb = [u8; 3];

/// Paper.
pub const WHITE: Rgb = [255, 255, 255];
/// Text and markers.
pub const INK: Rgb = [26, 26, 26];
/// Text of second rank.
pub const GREY: Rgb = [96, 96, 96];
/// Frames and ticks.
pub const FRAME: Rgb = [90, 90, 90];
/// Grid lines.
pub const GRID: Rgb = [226, 226, 226];

/// Last index of a [`ColourMap::table`]; even, so that noise about the middle of a range keeps one
/// colour.
pub const LAST_INDEX: u8 = 254;

/// A colour as pages write it.
pub(crate) fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A map from 0..1 to colours, readable with any kind of colour vision.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
#[serde(try_from = "Anchors")]
pub struct ColourMap {
    /// Colours at equal distances, from 0 to 1.
    anchors: &'static [Rgb],
}

/// Viridis (van der Walt and Smith, 2015): of rising lightness.
pub const VIRIDIS: ColourMap = ColourMap {
    anchors: &[
        [68, 1, 84],
        [72, 36, 117],
        [65, 68, 135],
        [53, 95, 141],
        [42, 120, 142],
        [33, 145, 140],
        [34, 168, 132],
        [68, 191, 112],
        [122, 209, 81],
        [189, 223, 38],
        [253, 231, 37],
    ],
};

/// The darker four fifths of Plasma (van der Walt and Smith, 2015): points on white paper.
pub const DARK_PLASMA: ColourMap = ColourMap {
    anchors: &[
        [13, 8, 135],
        [65, 4, 157],
        [106, 0, 168],
        [143, 13, 164],
        [177, 42, 144],
        [204, 71, 120],
        [225, 100, 98],
        [242, 132, 75],
        [252, 166, 54],
    ],
};

/// From white to dark blue (Blues of Brewer, 2003): little and much on white paper.
pub const BLUES: ColourMap = ColourMap {
    anchors: &[
        [255, 255, 255],
        [222, 235, 247],
        [198, 219, 239],
        [158, 202, 225],
        [107, 174, 214],
        [66, 146, 198],
        [33, 113, 181],
        [8, 81, 156],
        [8, 48, 107],
    ],
};

/// From blue by white to red (RdBu of Brewer, 2003): too little and too much.
pub const BLUE_RED: ColourMap = ColourMap {
    anchors: &[
        [5, 48, 97],
        [33, 102, 172],
        [67, 147, 195],
        [146, 197, 222],
        [209, 229, 240],
        [247, 247, 247],
        [253, 219, 199],
        [244, 165, 130],
        [214, 96, 77],
        [178, 24, 43],
        [103, 0, 31],
    ],
};

/// A map of colours as it is read.
#[derive(Deserialize)]
struct Anchors {
    anchors: Vec<Rgb>,
}

impl TryFrom<Anchors> for ColourMap {
    type Error = &'static str;

    fn try_from(read: Anchors) -> Result<Self, Self::Error> {
        let known = [VIRIDIS, DARK_PLASMA, BLUES, BLUE_RED];
        let found = known.into_iter().find(|map| map.anchors == read.anchors);
        found.ok_or("colours of no map: expected those of viridis, plasma, blues or blue-red")
    }
}

impl ColourMap {
    /// Colours at equal distances, from 0 to 1.
    pub const fn anchors(&self) -> &'static [Rgb] {
        self.anchors
    }

    /// The colour at a place from 0 to 1; the nearer end outside.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "places are clamped to 0..1 and channels to 0..255"
    )]
    pub fn at(&self, place: f64) -> Rgb {
        let last = self.anchors.len() - 1;
        let place = place.clamp(0.0, 1.0) * last as f64;
        let below = (place as usize).min(last - 1);
        let share = place - below as f64;
        let (low, high) = (self.anchors[below], self.anchors[below + 1]);
        std::array::from_fn(|k| {
            (f64::from(low[k]) * (1.0 - share) + f64::from(high[k]) * share).round() as u8
        })
    }

    /// The colours at places from 0 to 1, [`LAST_INDEX`] + 1 of them.
    pub fn table(&self) -> Vec<Rgb> {
        (0..=LAST_INDEX).map(|k| self.at(f64::from(k) / f64::from(LAST_INDEX))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_rise_in_lightness_and_end_at_their_anchors() {
        for map in [VIRIDIS, DARK_PLASMA] {
            let luminance = |[r, g, b]: Rgb| {
                0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
            };
            let table = map.table();
            assert!(table.windows(2).all(|pair| luminance(pair[1]) >= luminance(pair[0]) - 1.0));
            assert_eq!(map.at(-1.0), map.anchors[0]);
            assert_eq!(Some(&map.at(2.0)), map.anchors.last());
        }
    }
}

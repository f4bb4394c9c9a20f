//! Text in the embedded font.
//!
//! The font is `DejaVu Sans`, cut down to Latin, Greek, and the signs of formulas. Glyphs are
//! placed here rather than by `plotters`, which drops their side bearings and so spaces them
//! unevenly.

use crate::colour::{INK, Rgb};
use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Size of numbers at ticks, pixels.
pub const TICK_SIZE: f32 = 24.0;
/// Size of axis labels, pixels.
pub const LABEL_SIZE: f32 = 26.0;
/// Size of a panel's title, pixels.
pub const TITLE_SIZE: f32 = 28.0;

/// The embedded font.
static FONT: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    FontRef::try_from_slice(include_bytes!("../assets/dejavu-sans-subset.ttf"))
        .expect("the embedded font is whole, which a test reads")
});

/// Where the given point lies along the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Horizontal {
    /// At its beginning.
    Left,
    /// In its middle.
    Centre,
    /// At its end.
    Right,
}

/// Where the given point lies across the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Vertical {
    /// At the top of capitals.
    Top,
    /// In the middle of capitals and digits.
    Middle,
    /// On the baseline.
    Baseline,
    /// At the foot of descenders.
    Bottom,
}

/// How text looks.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Style {
    /// Size of the em, pixels.
    pub size: f32,
    /// Colour.
    pub colour: Rgb,
    /// Where the given point lies.
    pub anchor: (Horizontal, Vertical),
    /// Whether it reads upwards.
    pub upwards: bool,
}

impl Style {
    /// Ink on the baseline, from the given point to the right.
    pub const fn new(size: f32) -> Self {
        Self { size, colour: INK, anchor: (Horizontal::Left, Vertical::Baseline), upwards: false }
    }

    /// In this colour.
    pub const fn colour(self, colour: Rgb) -> Self {
        Self { colour, ..self }
    }

    /// With the given point here.
    pub const fn anchor(self, horizontal: Horizontal, vertical: Vertical) -> Self {
        Self { anchor: (horizontal, vertical), ..self }
    }

    /// Distance from the given point down to the baseline, pixels.
    pub fn baseline(&self) -> f32 {
        // Height of capitals and depth of descenders of the font, em
        const CAPITALS: f32 = 0.729;
        const DESCENDERS: f32 = 0.236;
        self.size
            * match self.anchor.1 {
                Vertical::Top => CAPITALS,
                Vertical::Middle => CAPITALS / 2.0,
                Vertical::Baseline => 0.0,
                Vertical::Bottom => -DESCENDERS,
            }
    }
}

/// A line of text on the sheet.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Text {
    /// What is written.
    pub text: String,
    /// Column and row of its point, pixels.
    pub at: [i32; 2],
    /// How it looks.
    pub style: Style,
}

/// Width of a line of text, pixels.
#[expect(clippy::cast_possible_truncation, reason = "a few thousand pixels")]
pub fn width(text: &str, size: f32) -> i32 {
    glyphs(text, size).1.ceil() as i32
}

/// The text, or as much of its beginning and its end as fits, with an ellipsis between: names of
/// files often begin alike.
pub fn fitted(text: &str, size: f32, room: i32) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let letters: Vec<char> = text.chars().collect();
    let with = |kept: usize| -> String {
        let (first, last) = (kept.div_ceil(2), kept / 2);
        letters[..first].iter().chain(&['…']).chain(&letters[letters.len() - last..]).collect()
    };
    let mut shorter = (0..letters.len()).rev().map(with);
    shorter.find(|text| width(text, size) <= room).unwrap_or_else(|| with(0))
}

/// A text in two lines, broken where the first is full.
pub fn two_lines(text: &str, size: f32, room: i32) -> [String; 2] {
    let (mut first, mut second) = (String::new(), String::new());
    for word in text.split_whitespace() {
        let longer = if first.is_empty() { word.to_owned() } else { format!("{first} {word}") };
        if second.is_empty() && width(&longer, size) <= room {
            first = longer;
        } else {
            if !second.is_empty() {
                second.push(' ');
            }
            second.push_str(word);
        }
    }
    [first, second]
}

/// Calls with each pixel of a line of text at the origin: column, row and cover.
#[expect(clippy::cast_possible_truncation, reason = "places on the sheet")]
pub fn pixels(text: &str, style: &Style, mut pixel: impl FnMut(i32, i32, f32)) {
    let (glyphs, width) = glyphs(text, style.size);
    let back = match style.anchor.0 {
        Horizontal::Left => 0.0,
        Horizontal::Centre => width / 2.0,
        Horizontal::Right => width,
    };
    let (shift, drop) = (-back.round() as i32, style.baseline().round() as i32);
    for outline in glyphs.into_iter().filter_map(|glyph| FONT.outline_glyph(glyph)) {
        let corner = outline.px_bounds().min;
        let (left, top) = (corner.x as i32 + shift, corner.y as i32 + drop);
        outline.draw(|x, y, cover| {
            let (along, down) = (left + x.cast_signed(), top + y.cast_signed());
            let (x, y) = if style.upwards { (down, -along) } else { (along, down) };
            pixel(x, y, cover);
        });
    }
}

/// The glyphs of a text on a baseline from the origin, and its width.
fn glyphs(text: &str, size: f32) -> (Vec<Glyph>, f32) {
    // The font's scale is its full height, of which the em is a part
    let em = FONT.units_per_em().unwrap_or(1.0);
    let full = PxScale::from(size * FONT.height_unscaled() / em);
    let (mut glyphs, mut x) = (Vec::with_capacity(text.len()), 0.0);
    for character in text.chars() {
        let (character, share, drop) = match subscript(character) {
            Some(letter) => (letter, SUBSCRIPT_SIZE, SUBSCRIPT_DROP * size),
            None => (character, 1.0, 0.0),
        };
        let scale = PxScale { x: full.x * share, y: full.y * share };
        let id = FONT.glyph_id(character);
        glyphs.push(id.with_scale_and_position(scale, point(x, drop)));
        x += FONT.as_scaled(scale).h_advance(id);
    }
    (glyphs, x)
}

/// Size of subscripts, em.
pub const SUBSCRIPT_SIZE: f32 = 0.72;
/// Distance of subscripts below the baseline, em.
pub const SUBSCRIPT_DROP: f32 = 0.2;

/// The letter of a subscript. The font's own subscripts are too small to be read at half size.
pub fn subscript(character: char) -> Option<char> {
    match character {
        'ₗ' => Some('l'),
        'ᵣ' => Some('r'),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sign_of_our_formulas_has_a_glyph() {
        for sign in "xₗxᵣχμωαΔσ₀₁²³−±×·…≤≥°aZ09éß".chars() {
            assert_ne!(FONT.glyph_id(sign).0, 0, "{sign}");
        }
    }

    #[test]
    fn long_text_is_cut_to_its_width() {
        let long = "a name that goes on and on";
        let short = fitted(long, 20.0, 100);
        assert!(width(&short, 20.0) <= 100 && short.contains('…'));
        assert!(long.starts_with(&short[..1]) && long.ends_with(&short[short.len() - 1..]));
        assert_eq!(fitted(long, 20.0, 1000), long);
        assert_eq!(fitted("wide", 20.0, 0), "…");
    }

    #[test]
    fn the_size_is_that_of_the_em() {
        // A digit is 0.636 em wide
        assert_eq!(width("0000000000", 100.0), 637);
    }
}

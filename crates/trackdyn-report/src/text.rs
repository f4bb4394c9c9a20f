//! Text in the embedded font.
//!
//! The font is `DejaVu Sans`, cut down to Latin, Greek, and the signs of formulas. Glyphs are placed here
//! rather than by `plotters`, which drops their side bearings and so spaces them unevenly.

use crate::canvas::Canvas;
use crate::colour::{INK, Rgb};
use ab_glyph::{Font, FontRef, Glyph, InvalidFont, PxScale, ScaleFont, point};

/// Where the given point lies along the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Horizontal {
    /// At its beginning.
    Left,
    /// In its middle.
    Centre,
    /// At its end.
    Right,
}

/// Where the given point lies across the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
#[derive(Clone, Copy, Debug)]
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

    /// Distance from the given point down to the baseline.
    fn baseline(&self) -> f32 {
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

/// The embedded font.
///
/// # Errors
/// Where it is damaged.
pub fn font() -> Result<FontRef<'static>, InvalidFont> {
    FontRef::try_from_slice(include_bytes!("../assets/dejavu-sans-subset.ttf"))
}

impl Canvas {
    /// Writes one line of text at a point.
    #[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
    pub fn text(&mut self, text: &str, at: [i32; 2], style: &Style) {
        let (glyphs, width) = self.glyphs(text, style.size);
        let back = match style.anchor.0 {
            Horizontal::Left => 0.0,
            Horizontal::Centre => width / 2.0,
            Horizontal::Right => width,
        };
        let (shift, drop) = (-back.round() as i32, style.baseline().round() as i32);
        let [column, row] = at;
        for glyph in glyphs {
            let Some(outline) = self.font.outline_glyph(glyph) else { continue };
            let corner = outline.px_bounds().min;
            let (left, top) = (corner.x as i32 + shift, corner.y as i32 + drop);
            outline.draw(|x, y, cover| {
                let (along, down) = (left + x.cast_signed(), top + y.cast_signed());
                let (x, y) = if style.upwards { (down, -along) } else { (along, down) };
                self.blend(column + x, row + y, style.colour, cover);
            });
        }
    }

    /// Width of a line of text, pixels.
    #[expect(clippy::cast_possible_truncation, reason = "a few thousand pixels")]
    pub fn text_width(&self, text: &str, size: f32) -> i32 {
        self.glyphs(text, size).1.ceil() as i32
    }

    /// The text, or as much of its beginning and its end as fits, with an ellipsis between: names of files often begin alike.
    pub fn fitted(&self, text: &str, size: f32, width: i32) -> String {
        if self.text_width(text, size) <= width {
            return text.to_owned();
        }
        let letters: Vec<char> = text.chars().collect();
        let with = |kept: usize| -> String {
            let (first, last) = (kept.div_ceil(2), kept / 2);
            letters[..first].iter().chain(&['…']).chain(&letters[letters.len() - last..]).collect()
        };
        let mut shorter = (0..letters.len()).rev().map(with);
        shorter.find(|text| self.text_width(text, size) <= width).unwrap_or_else(|| with(0))
    }

    /// The glyphs of a text on a baseline from the origin, and its width.
    fn glyphs(&self, text: &str, size: f32) -> (Vec<Glyph>, f32) {
        // The font's scale is its full height, of which the em is a part
        let em = self.font.units_per_em().unwrap_or(1.0);
        let full = PxScale::from(size * self.font.height_unscaled() / em);
        let (mut glyphs, mut x) = (Vec::with_capacity(text.len()), 0.0);
        for character in text.chars() {
            let (character, share, drop) = match subscript(character) {
                Some(letter) => (letter, 0.72, 0.2 * size),
                None => (character, 1.0, 0.0),
            };
            let scale = PxScale { x: full.x * share, y: full.y * share };
            let id = self.font.glyph_id(character);
            glyphs.push(id.with_scale_and_position(scale, point(x, drop)));
            x += self.font.as_scaled(scale).h_advance(id);
        }
        (glyphs, x)
    }
}

/// The letter of a subscript. The font's own subscripts are too small to be read at half size.
fn subscript(character: char) -> Option<char> {
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
        let font = font().expect("a font");
        for sign in "xₗxᵣχμωαΔσ₀₁²³−±×·…≤≥°aZ09éß".chars() {
            assert_ne!(font.glyph_id(sign).0, 0, "{sign}");
        }
    }

    #[test]
    fn long_text_is_cut_to_its_width() {
        let canvas = Canvas::new(10, 10).expect("a canvas");
        let long = "a name that goes on and on";
        let short = canvas.fitted(long, 20.0, 100);
        assert!(canvas.text_width(&short, 20.0) <= 100 && short.contains('…'));
        assert!(long.starts_with(&short[..1]) && long.ends_with(&short[short.len() - 1..]));
        assert_eq!(canvas.fitted(long, 20.0, 1000), long);
        assert_eq!(canvas.fitted("wide", 20.0, 0), "…");
    }

    #[test]
    fn the_size_is_that_of_the_em() {
        let canvas = Canvas::new(10, 10).expect("a canvas");
        // A digit is 0.636 em wide
        assert_eq!(canvas.text_width("0000000000", 100.0), 637);
    }
}

//! The canvas as a backend of `plotters`: its charts, with our lines and our text.

use crate::canvas::{Area, Canvas};
use crate::colour::Rgb;
use crate::text::{Horizontal, Style, Vertical};
use plotters::style::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontTransform,
};
use std::convert::Infallible;

/// What `plotters` draws with.
#[derive(Debug)]
pub struct Brush<'c>(pub &'c mut Canvas);

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

fn mixture(colour: BackendColor) -> (Rgb, f32) {
    let (r, g, b) = colour.rgb;
    #[expect(clippy::cast_possible_truncation, reason = "a share of one")]
    let cover = colour.alpha as f32;
    ([r, g, b], cover)
}

impl DrawingBackend for Brush<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.0.size()
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, colour: BackendColor) -> Drawn {
        let (colour, cover) = mixture(colour);
        self.0.blend(x, y, colour, cover);
        Ok(())
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Drawn {
        let place = |(x, y): BackendCoord| [f64::from(x), f64::from(y)];
        let (colour, _) = mixture(style.color());
        self.0.line(place(from), place(to), f64::from(style.stroke_width()), colour);
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let mut path = path.into_iter();
        let Some(mut from) = path.next() else { return Ok(()) };
        for to in path {
            self.draw_line(from, to, style)?;
            from = to;
        }
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (left, top): BackendCoord,
        (right, bottom): BackendCoord,
        style: &S,
        fill: bool,
    ) -> Drawn {
        let area = Area::new(left, top, right - left + 1, bottom - top + 1);
        let (colour, _) = mixture(style.color());
        if fill {
            self.0.fill(area, colour);
        } else {
            self.0.outline(area, style.stroke_width().cast_signed(), colour);
        }
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &S,
        (x, y): BackendCoord,
    ) -> Drawn {
        let anchor = style.anchor();
        let horizontal = match anchor.h_pos {
            HPos::Left => Horizontal::Left,
            HPos::Center => Horizontal::Centre,
            HPos::Right => Horizontal::Right,
        };
        let vertical = match anchor.v_pos {
            VPos::Top => Vertical::Top,
            VPos::Center => Vertical::Middle,
            VPos::Bottom => Vertical::Bottom,
        };
        let upwards = matches!(style.transform(), FontTransform::Rotate270);
        let (colour, _) = mixture(style.color());
        let style = Style { upwards, ..size(style).colour(colour).anchor(horizontal, vertical) };
        self.0.text(text, [x, y], &style);
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let Style { size, .. } = size(style);
        let width = self.0.text_width(text, size).unsigned_abs();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a size in pixels"
        )]
        let height = size.ceil() as u32;
        Ok((width, height))
    }
}

fn size(style: &impl BackendTextStyle) -> Style {
    #[expect(clippy::cast_possible_truncation, reason = "a size in pixels")]
    Style::new(style.size() as f32)
}

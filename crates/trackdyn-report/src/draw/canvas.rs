//! The pixels of a figure.

use super::paper::Paper;
use crate::Error;
use crate::colour::{ColourMap, LAST_INDEX, Rgb, WHITE};
use crate::figure::{Area, Cell, Hatch, Scale};
use crate::text::{self, Style};

/// An RGB picture. What falls outside it, or outside the clip, is not drawn.
#[derive(Clone, Debug)]
pub(super) struct Canvas {
    whole: Area,
    clip: Area,
    pixels: Vec<u8>,
}

impl Canvas {
    /// White paper of this many columns and rows.
    pub(super) fn new([width, height]: [i32; 2]) -> Self {
        let whole = Area::new(0, 0, width.max(1), height.max(1));
        let pixels = whole.width.unsigned_abs() as usize * whole.height.unsigned_abs() as usize;
        Self { whole, clip: whole, pixels: vec![WHITE[0]; 3 * pixels] }
    }

    /// Gives each pixel of a rectangle the colour of its column and row.
    fn paint(&mut self, area: Area, colour: impl Fn(i32, i32) -> Rgb) {
        let area = area.intersection(&self.clip);
        if area.width == 0 {
            return;
        }
        for y in area.top..area.bottom() {
            let (first, end) = (self.offset(area.left, y), self.offset(area.right(), y));
            for (pixel, x) in self.pixels[first..end].chunks_exact_mut(3).zip(area.left..) {
                pixel.copy_from_slice(&colour(x, y));
            }
        }
    }

    /// Mixes a colour into a pixel; `cover` is its share.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a mean of two channels is a channel"
    )]
    fn blend(&mut self, x: i32, y: i32, colour: Rgb, cover: f32) {
        let Area { left, top, .. } = self.clip;
        if x < left || x >= self.clip.right() || y < top || y >= self.clip.bottom() {
            return;
        }
        let at = self.offset(x, y);
        let cover = cover.clamp(0.0, 1.0);
        for (channel, colour) in self.pixels[at..at + 3].iter_mut().zip(colour) {
            let mixed = f32::from(*channel) * (1.0 - cover) + f32::from(colour) * cover;
            *channel = mixed.round() as u8;
        }
    }

    /// Mixes a colour into the pixels around a line by the cover that each one has.
    #[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
    fn shade(
        &mut self,
        from: [f64; 2],
        to: [f64; 2],
        reach: f64,
        colour: Rgb,
        cover: impl Fn(f64, f64) -> f64,
    ) {
        let low = |k: usize, least: i32| ((from[k].min(to[k]) - reach - 1.0) as i32).max(least);
        let high = |k: usize, most: i32| ((from[k].max(to[k]) + reach + 2.0) as i32).min(most);
        let clip = self.clip;
        for y in low(1, clip.top)..high(1, clip.bottom()) {
            for x in low(0, clip.left)..high(0, clip.right()) {
                let cover = cover(f64::from(x), f64::from(y));
                if cover > 0.0 {
                    self.blend(x, y, colour, cover as f32);
                }
            }
        }
    }

    #[expect(clippy::cast_sign_loss, reason = "inside the picture, which is clipped before")]
    fn offset(&self, x: i32, y: i32) -> usize {
        3 * (y * self.whole.width + x) as usize
    }

    /// The bytes of a PNG file.
    ///
    /// # Errors
    /// [`Error::Encoding`].
    pub(super) fn to_png(
        &self,
        compression: png::Compression,
        filter: png::Filter,
    ) -> Result<Vec<u8>, Error> {
        let [width, height] = [self.whole.width, self.whole.height].map(i32::unsigned_abs);
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(compression);
        encoder.set_filter(filter);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        writer.finish()?;
        Ok(bytes)
    }
}

impl Paper for Canvas {
    fn clip(&mut self, area: Area, draw: impl FnOnce(&mut Self)) {
        let before = self.clip;
        self.clip = before.intersection(&area);
        draw(self);
        self.clip = before;
    }

    fn fill(&mut self, area: Area, colour: Rgb) {
        self.paint(area, |_, _| colour);
    }

    fn disc(&mut self, centre: [f64; 2], radius: f64, colour: Rgb) {
        self.shade(centre, centre, radius, colour, |x, y| {
            radius + 0.5 - (x - centre[0]).hypot(y - centre[1])
        });
    }

    fn ring(&mut self, centre: [f64; 2], radius: f64, thickness: f64, colour: Rgb) {
        self.shade(centre, centre, radius + thickness / 2.0, colour, |x, y| {
            thickness / 2.0 + 0.5 - ((x - centre[0]).hypot(y - centre[1]) - radius).abs()
        });
    }

    fn line(&mut self, from: [f64; 2], to: [f64; 2], thickness: f64, colour: Rgb) {
        let along = [to[0] - from[0], to[1] - from[1]];
        let squared_length = along[0] * along[0] + along[1] * along[1];
        self.shade(from, to, thickness / 2.0, colour, |x, y| {
            let (dx, dy) = (x - from[0], y - from[1]);
            let share = if squared_length > 0.0 {
                ((dx * along[0] + dy * along[1]) / squared_length).clamp(0.0, 1.0)
            } else {
                0.0
            };
            thickness / 2.0 + 0.5 - (dx - share * along[0]).hypot(dy - share * along[1])
        });
    }

    fn arrow(&mut self, from: [f64; 2], to: [f64; 2], thickness: f64, colour: Rgb) {
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let along = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
        let head = 5.0 * thickness;
        let neck = [to[0] - head * along[0], to[1] - head * along[1]];
        self.line(from, neck, thickness, colour);
        self.shade(neck, to, head, colour, |x, y| {
            let (dx, dy) = (to[0] - x, to[1] - y);
            let behind = dx * along[0] + dy * along[1];
            let beside = (dx * along[1] - dy * along[0]).abs();
            (0.4 * behind - beside + 0.5).min(head - behind + 0.5)
        });
    }

    fn dots(&mut self, radius: f64, dots: impl Iterator<Item = ([i32; 2], Rgb)>) {
        #[expect(clippy::cast_possible_truncation, reason = "a radius of some pixels")]
        let reach = (radius + 0.5).ceil() as i32;
        // Cover in 256ths of each pixel of a dot
        let mut stamp = Vec::new();
        for down in -reach..=reach {
            for right in -reach..=reach {
                let cover = radius + 0.5 - f64::from(right).hypot(f64::from(down));
                #[expect(clippy::cast_possible_truncation, reason = "0 to 256")]
                let cover = (cover.clamp(0.0, 1.0) * 256.0).round() as i32;
                if cover > 0 {
                    stamp.push((right, down, cover));
                }
            }
        }
        let Area { left, top, width, height } = self.clip;
        for ([column, row], colour) in dots {
            for &(right, down, cover) in &stamp {
                let (x, y) = (column + right, row + down);
                if !(0..width).contains(&(x - left)) || !(0..height).contains(&(y - top)) {
                    continue;
                }
                let at = self.offset(x, y);
                for (channel, colour) in self.pixels[at..at + 3].iter_mut().zip(colour) {
                    let (below, above) = (i32::from(*channel), i32::from(colour));
                    #[expect(
                        clippy::cast_possible_truncation,
                        clippy::cast_sign_loss,
                        reason = "between two channels"
                    )]
                    let mixed = ((below * (256 - cover) + above * cover + 128) >> 8) as u8;
                    *channel = mixed;
                }
            }
        }
    }

    fn cells(&mut self, area: Area, count: usize, cells: &[Cell], scale: &Scale) {
        let colours = scale.colours.table();
        let colours: Vec<Result<Rgb, Hatch>> = cells
            .iter()
            .map(|cell| match *cell {
                Cell::Gap(hatch) => Err(hatch),
                Cell::Value(value) => {
                    #[expect(
                        clippy::cast_possible_truncation,
                        clippy::cast_sign_loss,
                        reason = "a small whole number"
                    )]
                    let place = (scale.share(value) * f64::from(LAST_INDEX)).round() as usize;
                    Ok(colours[place.min(usize::from(LAST_INDEX))])
                }
            })
            .collect();
        let cell = |pixel: i32, side: i32| {
            pixel.unsigned_abs() as usize * count / side.unsigned_abs() as usize
        };
        let across: Vec<usize> = (0..area.width).map(|pixel| cell(pixel, area.width)).collect();
        let upwards: Vec<usize> = (0..area.height).map(|pixel| cell(pixel, area.height)).collect();
        self.paint(area, |column, row| {
            let right = across[(column - area.left).unsigned_abs() as usize];
            let up = upwards[(area.bottom() - 1 - row).unsigned_abs() as usize];
            colours[right * count + up].unwrap_or_else(|hatch| hatch.at(column, row))
        });
    }

    fn ramp(&mut self, area: Area, colours: &ColourMap) {
        let height = f64::from(area.height);
        self.paint(area, |_, row| colours.at((f64::from(area.bottom() - row) - 0.5) / height));
    }

    fn text(&mut self, text: &str, [column, row]: [i32; 2], style: &Style) {
        text::pixels(text, style, |x, y, cover| {
            self.blend(column + x, row + y, style.colour, cover);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::INK;

    fn canvas() -> Canvas {
        Canvas::new([40, 30])
    }

    fn drawn(canvas: &Canvas) -> Vec<(i32, i32)> {
        let (width, height) = (canvas.whole.width, canvas.whole.height);
        (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .filter(|&(x, y)| canvas.pixels[canvas.offset(x, y)] != WHITE[0])
            .collect()
    }

    #[test]
    fn nothing_reaches_outside_the_clip() {
        let mut canvas = canvas();
        let area = Area::new(10, 10, 5, 5);
        canvas.clip(area, |canvas| {
            canvas.disc([9.0, 9.0], 30.0, INK);
            canvas.fill(Area::new(-5, -5, 100, 100), INK);
        });
        let drawn = drawn(&canvas);
        assert_eq!(drawn.len(), 25);
        assert!(drawn.iter().all(|&(x, y)| (10..15).contains(&x) && (10..15).contains(&y)));
    }

    #[test]
    fn shapes_beyond_the_picture_are_cut() {
        let mut canvas = canvas();
        canvas.line([-50.0, 15.0], [90.0, 15.0], 1.0, INK);
        assert_eq!(drawn(&canvas), (0..40).map(|x| (x, 15)).collect::<Vec<_>>());
        canvas.disc([1e9, -1e9], 5.0, INK);
        canvas.arrow([20.0, 40.0], [20.0, -10.0], 2.0, INK);
    }

    #[test]
    fn a_disc_covers_its_area() {
        let mut canvas = canvas();
        canvas.disc([20.3, 15.1], 8.0, [0, 0, 0]);
        let ink: f64 = canvas.pixels.iter().map(|&v| 1.0 - f64::from(v) / 255.0).sum::<f64>() / 3.0;
        // 1 %: the edge is approximated by distance
        assert!((ink - std::f64::consts::PI * 64.0).abs() < 2.0, "{ink}");
    }

    #[test]
    fn a_picture_survives_encoding() {
        let mut canvas = canvas();
        canvas.ring([20.0, 15.0], 8.0, 2.0, [200, 10, 30]);
        let bytes = canvas.to_png(png::Compression::Fast, png::Filter::Paeth).expect("encoded");
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut pixels).expect("pixels");
        assert_eq!(pixels, canvas.pixels);
    }
}

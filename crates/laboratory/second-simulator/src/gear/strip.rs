//! A lengthwise strip of a contact.

use super::Shoe;
use std::ops::Range;

/// A strip and where its belt stands.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Strip {
    /// x of its middle, m.
    pub(super) x: f64,
    /// Its width, m.
    pub(super) width: f64,
    /// Rear and front end of the contact, m.
    pub(super) extent: [f64; 2],
    /// Length of a shoe, m.
    pub(super) pitch: f64,
    /// Part of the foremost shoe that is inside the contact, from 0 to 1.
    pub(super) phase: f64,
    /// Its shoes among those of the side, from the front to the rear.
    pub(super) shoes: Range<usize>,
}

impl Strip {
    /// Moves the belt, forward driving positive, and places the shoes.
    pub(super) fn roll(&mut self, distance: f64, shoes: &mut [Shoe]) {
        // beyond a full contact every shoe is a new one
        let length = self.extent[1] - self.extent[0];
        let pitches = distance / self.pitch;
        self.phase += pitches;
        if distance.abs() > length + self.pitch {
            self.phase = self.phase.rem_euclid(1.0);
            shoes.fill(Shoe::default());
        }
        while self.phase >= 1.0 {
            self.phase -= 1.0;
            shoes.rotate_right(1);
            shoes[0] = Shoe::default();
        }
        while self.phase < 0.0 {
            self.phase += 1.0;
            shoes.rotate_left(1);
            shoes[shoes.len() - 1] = Shoe::default();
        }
        let [rear, front] = self.extent;
        for (k, shoe) in (0_u32..).zip(shoes) {
            let back = front - (f64::from(k) + self.phase) * self.pitch;
            let (back, ahead) = (back.max(rear), (back + self.pitch).min(front));
            shoe.position = [self.x, f64::midpoint(back, ahead)];
            shoe.area = self.width * (ahead - back).max(0.0);
        }
    }
}

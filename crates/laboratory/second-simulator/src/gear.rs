//! Belts as moving shoes.
//!
//! A contact is cut lengthwise into strips and each strip into shoes, which travel with the belt:
//! they come to the ground at one end of the contact undeflected and leave it at the other. A shoe
//! that stands across an end carries on the part that is inside. The strips' widths and the shoes'
//! phases are random, so that no grid is aligned with the motion; since each strip and shoe acts at
//! its own middle, area and first moments are exact whatever the draw.

mod bed;
mod strip;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use strip::Strip;
use trackdyn_core::{PerSide, Side};
use trackdyn_model::{RunningGear, Vehicle};

/// A shoe of a belt.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shoe {
    /// Middle of its part on the ground, paper's frame, m.
    pub position: [f64; 2],
    /// Its area on the ground, m².
    pub area: f64,
    /// Load on it, N.
    pub load: f64,
    /// Elastic deflection over the ground, paper's axes, m.
    pub bristle: [f64; 2],
    /// Way that it has slid since it came to the ground, m.
    pub slid: f64,
}

/// The running gear of both sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Gear {
    strips: PerSide<Vec<Strip>>,
    shoes: PerSide<Vec<Shoe>>,
}

impl Gear {
    /// Cuts each contact of a vehicle into strips and shoes.
    pub(crate) fn new(vehicle: &Vehicle, strips: u32, shoes: u32, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut gear = Self { strips: PerSide::default(), shoes: PerSide::default() };
        for side in Side::BOTH {
            let centre = side.sign() * vehicle.gauge / 2.0;
            for ([rear, front], width) in contacts(&vehicle.running_gear) {
                let mut left = centre - width / 2.0;
                for width in partition(width, strips, &mut random) {
                    let first = gear.shoes[side].len();
                    let strip = Strip {
                        x: left + width / 2.0,
                        width,
                        extent: [rear, front],
                        pitch: (front - rear) / f64::from(shoes),
                        phase: random.random(),
                        shoes: first..first + shoes as usize + 1,
                    };
                    gear.shoes[side].resize(strip.shoes.end, Shoe::default());
                    gear.strips[side].push(strip);
                    left += width;
                }
            }
            gear.roll(side, 0.0);
        }
        gear
    }

    /// Moves a belt over the hull, forward driving positive, m.
    pub(crate) fn roll(&mut self, side: Side, distance: f64) {
        for strip in &mut self.strips[side] {
            strip.roll(distance, &mut self.shoes[side][strip.shoes.clone()]);
        }
    }

    /// Spreads a side's load (N) with its centre of pressure at y (m) over the shoes, through
    /// springs of the given relative stiffness at (y, ends of the contact there).
    ///
    /// # Errors
    /// A centre of pressure beyond what the contacts reach.
    pub(crate) fn bear(
        &mut self,
        side: Side,
        load: f64,
        y: f64,
        stiffness: impl Fn(f64, [f64; 2]) -> f64,
    ) -> Result<(), String> {
        for strip in &self.strips[side] {
            for shoe in &mut self.shoes[side][strip.shoes.clone()] {
                // the spring's stiffness stands in the load until the load is known
                shoe.load = shoe.area * stiffness(shoe.position[1], strip.extent);
            }
        }
        bed::settle(&mut self.shoes[side], load, y)
    }

    /// The shoes of a side.
    pub(crate) fn shoes(&self, side: Side) -> &[Shoe] {
        &self.shoes[side]
    }

    /// As [`Gear::shoes`], to be changed.
    pub(crate) fn shoes_mut(&mut self, side: Side) -> &mut [Shoe] {
        &mut self.shoes[side]
    }

    /// Rear and front end of all contacts of a side, m.
    pub(crate) fn extent(&self, side: Side) -> [f64; 2] {
        let strips = self.strips[side].iter().map(|strip| strip.extent);
        strips.fold([f64::INFINITY, f64::NEG_INFINITY], |[rear, front], [back, ahead]| {
            [rear.min(back), front.max(ahead)]
        })
    }

    /// Takes over the state of a gear of the same machine.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        for side in Side::BOTH {
            self.shoes[side].copy_from_slice(&other.shoes[side]);
            for (own, others) in self.strips[side].iter_mut().zip(&other.strips[side]) {
                own.phase = others.phase;
            }
        }
    }
}

/// Rear and front end and the width of each contact of a side, m.
fn contacts(gear: &RunningGear) -> Vec<([f64; 2], f64)> {
    match gear {
        RunningGear::Track { contact_length: l, belt_width } => {
            vec![([-l / 2.0, l / 2.0], *belt_width)]
        }
        RunningGear::Wheels { contact_length: l, width, axles } => {
            axles.iter().map(|y| ([y - l / 2.0, y + l / 2.0], *width)).collect()
        }
    }
}

/// Parts of a width, each cut drawn from the middle half of its even place.
fn partition(width: f64, parts: u32, random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut cuts = vec![0.0];
    cuts.extend((1..parts).map(|k| f64::from(k) - 0.25 + 0.5 * random.random::<f64>()));
    cuts.push(f64::from(parts));
    cuts.windows(2).map(|pair| (pair[1] - pair[0]) * width / f64::from(parts)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_model::VehicleFile;

    fn gear(seed: u64) -> Gear {
        Gear::new(&VehicleFile::auriga_alpha().vehicle, 4, 12, seed)
    }

    #[test]
    fn area_and_first_moments_are_those_of_the_contact_wherever_the_belt_stands() {
        let mut gear = gear(3);
        for distance in [0.0, 0.013, 0.4, -1.7] {
            gear.roll(Side::Left, distance);
            let sum = |of: fn(&Shoe) -> f64| gear.shoes(Side::Left).iter().map(of).sum::<f64>();
            assert!((sum(|s| s.area) - 0.7 * 0.15).abs() < 1e-14);
            assert!((sum(|s| s.area * s.position[0]) + 0.21 * 0.7 * 0.15).abs() < 1e-14);
            assert!(sum(|s| s.area * s.position[1]).abs() < 1e-14);
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_shoes() {
        assert_eq!(gear(7), gear(7));
        assert_ne!(gear(7), gear(8));
    }

    #[test]
    fn what_a_shoe_has_gone_through_travels_with_it_and_ends_with_its_contact() {
        let mut gear = gear(1);
        for shoe in gear.shoes_mut(Side::Right) {
            shoe.slid = 1.0;
        }
        gear.roll(Side::Right, 0.35);
        for shoe in gear.shoes(Side::Right).iter().filter(|shoe| shoe.area > 0.0) {
            // driving forward brings new shoes in at the front; the border is one pitch wide
            let [_, y] = shoe.position;
            assert!(y.abs() < 0.06 || shoe.slid == f64::from(y < 0.0), "{y} {}", shoe.slid);
        }
        gear.roll(Side::Right, -0.8);
        assert!(gear.shoes(Side::Right).iter().all(|shoe| shoe.slid == 0.0));
    }
}

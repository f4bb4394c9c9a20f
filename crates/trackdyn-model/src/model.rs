//! The balance of forces on a vehicle with its effects.

use crate::contact::pressure::Footprint;
use crate::contact::quadrature;
use crate::contact::{Extent, Patch, Pressure, Resolution, ShearStress, friction_wrench};
use crate::effects::Effects;
use crate::pipeline::{Circumstance, Drive, Ground, Motion, Sensor, Site, Situation};
use crate::vehicle::Vehicle;
use trackdyn_core::{PerSide, Scalar, Side, Wrench};

/// A vehicle with its effects, and the forces on it at a given motion.
///
/// # Law
/// Stationary motion, eqs (14)-(15): friction + weight along the slope + what effects add = 0.
///
/// # Assumes
/// A rigid hull on flat patches, the pressure linear along the track and constant across it (Fig.
/// 5), anisotropic Coulomb friction (22)-(23).
///
/// # Sources
/// Martinez et al., IJRR 24(10), 2005.
#[derive(Clone, Debug)]
pub struct Model {
    vehicle: Vehicle,
    effects: Effects,
    patches: PerSide<Vec<Patch>>,
    footprint: Footprint,
    extent: PerSide<Extent>,
    drive: Drive,
    sensor: Sensor,
    /// Effects that change the shear stress.
    shear_laws: Effects,
    resolution: Resolution,
}

/// The forces on the body, by origin: the result of [`Model::balance`].
#[derive(Clone, Copy, Debug)]
pub struct Balance<S = f64> {
    /// Friction on each side.
    pub friction: PerSide<Wrench<S>>,
    /// All other forces: weight along the slope, and those of effects.
    pub load: Wrench<S>,
    /// Weight on each side, N.
    pub normal_load: PerSide<S>,
}

impl<S: Scalar> Balance<S> {
    /// Sum of all forces, zero at balance.
    #[inline]
    pub fn sum(&self) -> Wrench<S> {
        let mut sum = self.load;
        for side in Side::BOTH {
            sum += self.friction[side];
        }
        sum
    }
}

impl Model {
    /// The model of a vehicle on ground with these effects.
    pub fn new(mut vehicle: Vehicle, effects: Effects) -> Self {
        let (mut drive, mut sensor) = (Drive::direct(), Sensor::default());
        for effect in &effects {
            effect.body(&mut vehicle);
            effect.drive(&mut drive);
            effect.sense(&mut sensor);
        }
        let patches = PerSide::from_fn(|side| vehicle.patches(side));
        let footprint = Footprint::of(&patches.left);
        let extent = PerSide::from_fn(|side| footprint.extent(&patches[side]));
        let shear_laws = effects.iter().filter(|effect| effect.card().shears()).cloned().collect();
        let resolution = Resolution::default();
        Self { vehicle, effects, patches, footprint, extent, drive, sensor, shear_laws, resolution }
    }

    /// The model with another resolution of the shear-stress quadrature.
    pub fn with_resolution(self, resolution: Resolution) -> Self {
        Self { resolution, ..self }
    }

    /// Resolution of the shear-stress quadrature.
    pub fn resolution(&self) -> Resolution {
        self.resolution
    }

    /// The vehicle, after the effects of stage `body`.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// The effects, in the catalogue's order.
    pub fn effects(&self) -> &Effects {
        &self.effects
    }

    /// Contact patches of each side.
    pub fn patches(&self) -> &PerSide<Vec<Patch>> {
        &self.patches
    }

    /// Extent and second moment of one side's contact.
    pub fn footprint(&self) -> &Footprint {
        &self.footprint
    }

    /// Centre and size of each side's contact.
    pub fn extent(&self) -> &PerSide<Extent> {
        &self.extent
    }

    /// Stage `drive`: from encoder speeds to belt speeds.
    pub fn drive(&self) -> &Drive {
        &self.drive
    }

    /// Stage `sense`: the reported motion.
    pub fn sensor(&self) -> &Sensor {
        &self.sensor
    }

    /// Stage `ground`: friction and gravity in these circumstances.
    pub fn ground(&self, circumstance: &Circumstance) -> Ground {
        let mut ground = Ground::level(&self.vehicle, &self.footprint, *circumstance);
        for effect in &self.effects {
            effect.ground(&mut ground);
        }
        ground
    }

    /// Stages `load`, `shear` and `wrench`: the balance of forces at a motion.
    pub fn balance<S: Scalar>(&self, ground: &Ground, motion: &Motion<S>) -> Balance<S> {
        let situation = self.situation(ground, motion);
        let (normal_load, pressure) = self.load(&situation);

        let friction = PerSide::from_fn(|side| {
            let mut wrench = friction_wrench(
                &self.patches[side],
                ground.friction[side],
                &pressure[side],
                &motion.slip[side],
                self.resolution,
            );
            if !self.shear_laws.is_empty() {
                wrench += self.shear_departure(&situation, side, &pressure[side]);
            }
            wrench
        });
        let mass = self.vehicle.mass;
        let mut load = Wrench::zero();
        load.add_force(ground.gravity_along.map(|g| S::from(mass * g)), self.vehicle.cog);
        for effect in &self.effects {
            effect.wrench(&situation, &normal_load, &mut load);
        }
        Balance { friction, load, normal_load }
    }

    /// Whether the pressure is not positive somewhere in the contact at this motion.
    pub fn lifts(&self, ground: &Ground, motion: &Motion) -> bool {
        let situation = self.situation(ground, motion);
        let (normal_load, pressure) = self.load(&situation);
        Side::BOTH.iter().any(|&side| {
            normal_load[side] <= 0.0
                || self.footprint.ends.iter().any(|&y| pressure[side].at(y) <= 0.0)
        })
    }

    /// Whether the resultant load lies outside the contact at this motion, so that no pressure can
    /// bear it.
    pub fn tips(&self, ground: &Ground, motion: &Motion) -> bool {
        let (normal_load, pressure) = self.load(&self.situation(ground, motion));
        let [rear, front] = self.footprint.ends;
        Side::BOTH.iter().any(|&side| {
            let centre = self.footprint.centre_of_pressure(normal_load[side], &pressure[side]);
            normal_load[side] <= 0.0 || !(rear..=front).contains(&centre)
        })
    }

    fn situation<'a, S>(&'a self, ground: &'a Ground, motion: &'a Motion<S>) -> Situation<'a, S> {
        Situation { vehicle: &self.vehicle, ground, footprint: &self.footprint, motion }
    }

    /// Stage `load`: weight on each side (N; negative where it would have to pull) and pressure.
    #[inline]
    fn load<S: Scalar>(&self, situation: &Situation<S>) -> (PerSide<S>, PerSide<Pressure<S>>) {
        let mut centre_of_pressure = self.vehicle.cog.map(S::from);
        for effect in &self.effects {
            effect.load(situation, &mut centre_of_pressure);
        }
        let [x, y] = centre_of_pressure;
        let weight = self.vehicle.mass * situation.ground.gravity_normal;
        // Moments about the other track's centre-line: N_l = W (½ − x_p/L), N_r = W (½ + x_p/L)
        let share = x * (weight / self.vehicle.gauge);
        let normal_load = PerSide::new(-share + weight / 2.0, share + weight / 2.0);
        let pressure = normal_load.map(|load| self.footprint.pressure(load, y));
        (normal_load, pressure)
    }

    fn shear_departure<S: Scalar>(
        &self,
        situation: &Situation<S>,
        side: Side,
        pressure: &Pressure<S>,
    ) -> Wrench<S> {
        quadrature::departure_wrench(
            &self.patches[side],
            situation.ground.friction[side],
            pressure,
            &situation.motion.slip[side],
            self.resolution,
            |patch, slip| {
                let site = Site { situation, side, patch, pressure, slip };
                let mut stress = ShearStress::base();
                for effect in &self.shear_laws {
                    effect.shear(&site, &mut stress);
                }
                stress
            },
        )
    }
}

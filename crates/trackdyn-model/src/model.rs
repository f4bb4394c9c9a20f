//! The balance of forces on a vehicle with its effects.

use crate::contact::pressure::Footprint;
use crate::contact::quadrature;
use crate::contact::{Bearing, Extent, Patch, Pressure, Resolution, ShearStress, friction_wrench};
use crate::custom::{ActiveLaw, seen_at};
use crate::effects::{ActiveEffect, Effects};
use crate::pipeline::{Circumstance, Drive, Ground, Motion, RigidBody, Sensor, Site, Situation};
use crate::vehicle::Vehicle;
use trackdyn_core::{PerSide, Scalar, Side, Wrench};

/// A vehicle with its effects, and the forces on it at a given motion.
///
/// # Law
/// Stationary motion, eqs (14)-(15): friction + weight along the slope + what effects add = 0.
///
/// # Assumes
/// A rigid hull on flat patches, the pressure linear along the part of the track that bears and
/// constant across it (Fig. 5), anisotropic Coulomb friction (22)-(23).
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
    /// Laws of a user among them, which are asked for all points at once.
    custom_laws: Vec<ActiveLaw>,
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

/// How the contact bears the load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// All of it bears.
    Whole,
    /// Part of it has lifted.
    Part,
    /// None can: the load lies outside the contact, and the robot tips over.
    Tips,
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
        let shearing = || effects.iter().filter(|effect| effect.card().shears());
        let custom_laws = shearing().filter_map(ActiveEffect::custom).cloned().collect();
        let shear_laws = shearing().filter(|effect| effect.custom().is_none()).cloned().collect();
        let resolution = Resolution::default();
        Self {
            vehicle,
            effects,
            patches,
            footprint,
            extent,
            drive,
            sensor,
            shear_laws,
            custom_laws,
            resolution,
        }
    }

    /// The model with another resolution of the shear-stress quadrature.
    pub fn with_resolution(self, resolution: Resolution) -> Self {
        Self { resolution, ..self }
    }

    /// The model without its laws of the shear stress.
    pub fn without_shear_laws(&self) -> Self {
        let others = self.effects.iter().filter(|effect| !effect.card().shears());
        let effects = others.cloned().collect();
        let (shear_laws, custom_laws) = (Effects::none(), Vec::new());
        Self { effects, shear_laws, custom_laws, ..self.clone() }
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

    /// Extent and second moment of the part of one side's contact that bears with the centre of
    /// pressure at y, m.
    pub fn pressed(&self, y: f64) -> Footprint {
        let bearing = self.bearing(y);
        match bearing {
            Bearing::Whole(_) => self.footprint,
            Bearing::Part { .. } => {
                let parts = self.patches.left.iter().filter_map(|patch| bearing.pressed(patch));
                Footprint::of(&parts.collect::<Vec<_>>())
            }
        }
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

    /// What a simulator of rigid bodies is told beside the vehicle.
    pub fn rigid_body(&self) -> RigidBody {
        let mut body = RigidBody::default();
        for effect in &self.effects {
            effect.rigid_body(&mut body);
        }
        body
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
        let centre_of_pressure = self.centre_of_pressure(&situation);
        let normal_load = self.normal_load(ground, centre_of_pressure[0]);
        let bearing = self.bearing(centre_of_pressure[1]);

        let friction = PerSide::from_fn(|side| {
            let pressure = bearing.pressure(&self.footprint, normal_load[side]);
            let pressed = self.patches[side].iter().filter_map(|patch| bearing.pressed(patch));
            let mut wrench = friction_wrench(
                pressed.clone(),
                ground.friction[side],
                &pressure,
                &motion.slip[side],
                self.resolution,
            );
            if !(self.shear_laws.is_empty() && self.custom_laws.is_empty()) {
                wrench += self.shear_departure(&situation, side, pressed, &pressure);
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

    /// How the contact bears the load at this motion.
    pub fn support(&self, ground: &Ground, motion: &Motion) -> Support {
        let [x, y] = self.centre_of_pressure(&self.situation(ground, motion));
        let [rear, front] = self.footprint.ends;
        // The pressure is constant across a track: beyond a centre-line no pressure bears the load.
        if x.abs() >= self.vehicle.gauge / 2.0 || y <= rear || y >= front {
            return Support::Tips;
        }
        match self.bearing(y) {
            Bearing::Whole(_) => Support::Whole,
            Bearing::Part { .. } => Support::Part,
        }
    }

    fn situation<'a, S>(&'a self, ground: &'a Ground, motion: &'a Motion<S>) -> Situation<'a, S> {
        Situation { vehicle: &self.vehicle, ground, footprint: &self.footprint, motion }
    }

    /// Stage `load`: where the weight acts (x, y), m.
    #[inline]
    fn centre_of_pressure<S: Scalar>(&self, situation: &Situation<S>) -> [S; 2] {
        let mut centre_of_pressure = self.vehicle.cog.map(S::from);
        for effect in &self.effects {
            effect.load(situation, &mut centre_of_pressure);
        }
        centre_of_pressure
    }

    /// Weight on each side (N) with the centre of pressure at x (m); negative beyond a centre-line.
    #[inline]
    fn normal_load<S: Scalar>(&self, ground: &Ground, x: S) -> PerSide<S> {
        let weight = self.vehicle.mass * ground.gravity_normal;
        // Moments about the other track's centre-line: N_l = W (½ − x_p/L), N_r = W (½ + x_p/L)
        let share = x * (weight / self.vehicle.gauge);
        PerSide::new(-share + weight / 2.0, share + weight / 2.0)
    }

    /// The part of each side that bears with the centre of pressure at y, m.
    #[inline]
    fn bearing<S: Scalar>(&self, y: S) -> Bearing<S> {
        // Both sides have the same patches along y.
        Bearing::of(&self.patches.left, &self.footprint, y)
    }

    /// Change of the friction wrench of a side by all laws of the shear stress.
    fn shear_departure<S: Scalar>(
        &self,
        situation: &Situation<S>,
        side: Side,
        pressed: impl Iterator<Item = Patch<S>> + Clone,
        pressure: &Pressure<S>,
    ) -> Wrench<S> {
        let mut custom = self.custom_factors(situation, side, pressed.clone(), pressure);
        self.departure(situation, side, pressed, pressure, |site| {
            let mut stress = ShearStress::base();
            for effect in &self.shear_laws {
                effect.shear(site, &mut stress);
            }
            if let Some(factors) = custom.next() {
                stress.scale_each(factors);
            }
            stress
        })
    }

    /// Change of the friction wrench of a side by a law of the shear stress.
    #[inline]
    fn departure<S: Scalar>(
        &self,
        situation: &Situation<S>,
        side: Side,
        pressed: impl Iterator<Item = Patch<S>>,
        pressure: &Pressure<S>,
        mut law: impl FnMut(&Site<S>) -> ShearStress<S>,
    ) -> Wrench<S> {
        quadrature::departure_wrench(
            pressed,
            situation.ground.friction[side],
            pressure,
            &situation.motion.slip[side],
            self.resolution,
            |patch, slip| law(&Site { situation, side, patch, pressure, slip }),
        )
    }

    /// Factors on friction by laws of a user, at the points of the quadrature in their order.
    fn custom_factors<S: Scalar>(
        &self,
        situation: &Situation<S>,
        side: Side,
        pressed: impl Iterator<Item = Patch<S>>,
        pressure: &Pressure<S>,
    ) -> std::vec::IntoIter<[S; 2]> {
        if self.custom_laws.is_empty() {
            return Vec::new().into_iter();
        }
        let mut seen = Vec::new();
        self.departure(situation, side, pressed, pressure, |site| {
            seen.push(seen_at(site));
            ShearStress::base()
        });
        let mut product = vec![[S::from(1.0); 2]; seen.len()];
        for law in &self.custom_laws {
            for (product, factors) in product.iter_mut().zip(law.factors(&seen)) {
                *product = [product[0] * factors[0], product[1] * factors[1]];
            }
        }
        product.into_iter()
    }
}

//! Load transfer of a hull that leans on its springs.

use crate::form::Draws;
use crate::mechanism::{Described, Load, Mechanism, Scene, Step};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Scale, Sheet, Symmetry, Trial};
use std::f64::consts::TAU;

/// Time that the hull takes to lean, s.
const LEAN_TIME: f64 = 0.06;

/// The weight leans outwards in a turn, back where the robot speeds up, and downhill on a slope,
/// with the hull's own delay.
#[derive(Clone, Copy, Debug)]
pub struct LoadTransfer {
    height: f64,
    lean: [f64; 2],
    springs: Option<Springs>,
}

/// A hull with a mass of its own on springs.
#[derive(Clone, Copy, Debug)]
struct Springs {
    /// Natural frequency, rad/s.
    frequency: f64,
    damping_ratio: f64,
    /// How fast it leans, m/s.
    rate: [f64; 2],
}

impl Described for LoadTransfer {
    const SHEET: Sheet = Sheet {
        id: "load-transfer",
        origin: Origin::Catalogue,
        law: "q' = (h (g_along − a)/g_normal − q)/0.06 s, a = ω × v_cog + k dv_cog/dt, k the part \
              of the mass that stands against changes of speed; the load acts at the centre of \
              gravity + q",
        size: "in steady turns the same; the hull leans in 0.06 s, as on a suspension of 2.7 Hz",
        shares_size: false,
        family: Some(Family {
            law: "q'' = (2π f)² (h (g_along − a)/g_normal − q) − 2 ζ 2π f q', f from 1.2 to 4 Hz, \
                  ζ from 0.35 to 1.2",
            size: "in steady turns the same",
            shares_size: false,
        }),
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::Distinct, 3.0),
        parameters: &[Parameter {
            key: "cog_height_m",
            unit: "m",
            range: [0.0, 5.0],
            typical: 0.3,
            draw: Draw::size(0.5).times(Scale::Gauge),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { height: values[0], lean: [0.0, 0.0], springs: None }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let springs = Springs {
            frequency: TAU * random.log_between(1.2, 4.0),
            damping_ratio: random.between(0.35, 1.2),
            rate: [0.0, 0.0],
        };
        Self { springs: Some(springs), ..Self::from_values(values) }
    }
}

impl Mechanism for LoadTransfer {
    fn load(&self, _scene: &Scene, load: &mut Load) {
        load.across += self.lean[0];
        load.along.left += self.lean[1];
        load.along.right += self.lean[1];
    }

    fn advance(&mut self, step: &Step) {
        let Scene { vehicle, gravity, .. } = step.scene;
        let [before, after] =
            [step.scene.twist, step.twist].map(|twist| twist.velocity_at(vehicle.cog));
        let turning = step.twist.steady_acceleration_at(vehicle.cog);
        let share = -(-step.dt / LEAN_TIME).exp_m1();
        for (k, lean) in self.lean.iter_mut().enumerate() {
            // a = ω × v + k v'
            let a = turning[k] + step.inertia.transient * (after[k] - before[k]) / step.dt;
            if let Some(Springs { frequency, damping_ratio, rate }) = &mut self.springs {
                // q'' = ω² (h (g_along − a)/g_normal − q) − 2 ζ ω q', the rate at the step's end
                let settled = self.height * (gravity.along[k] - a) / gravity.normal;
                let pull = rate[k] + step.dt * frequency.powi(2) * (settled - *lean);
                let stiff = step.dt * *frequency * (2.0 * *damping_ratio + step.dt * *frequency);
                rate[k] = pull / (1.0 + stiff);
                *lean += step.dt * rate[k];
                continue;
            }
            // q' = (h (g_along − a)/g_normal − q)/T
            *lean += share * (self.height * (gravity.along[k] - a) / gravity.normal - *lean);
        }
    }
}

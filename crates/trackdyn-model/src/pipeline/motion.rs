//! Motion of hull and belts.

use crate::contact::{Extent, SlipField};
use trackdyn_core::{PerSide, Scalar, Side, Twist};

/// Motion of the hull, and the slip of both belts.
#[derive(Clone, Copy, Debug)]
pub struct Motion<S = f64> {
    /// Belt speeds relative to the hull, forward positive, m/s.
    pub belt_speed: PerSide<S>,
    /// Twist of the hull at the origin, paper's frame.
    pub twist: Twist<S>,
    /// Rate of change of the twist in the hull's axes, m/s² and rad/s²; zero in stationary motion.
    pub acceleration: Twist<S>,
    /// Slip of each belt over the ground.
    pub slip: PerSide<SlipField<S>>,
}

impl<S: Scalar> Motion<S> {
    /// Motion with the ICR of the track `anchor` at (x, y) and the hull turning by `turn` = w/(V_r
    /// − V_l) = 1/(x_r − x_l) ≥ 0, 1/m.
    ///
    /// At `turn` = 0 the anchor track sticks while the other slips straight; its slip direction is
    /// the limit from above. At equal belt speeds the robot moves straight, and both slip
    /// directions are the limit of a vanishing left turn.
    #[inline]
    pub fn anchored(belt_speed: PerSide<f64>, anchor: Side, icr: [S; 2], turn: S) -> Self {
        let [x, y] = icr;
        let difference = belt_speed.right - belt_speed.left;
        let sense = if difference < 0.0 { -1.0 } else { 1.0 };
        // w = (V_r − V_l)/(x_r − x_l), eq. (9)
        let w = turn * difference;
        // s = w (−(Y_point − y), X_point − x), in units of |w|
        let anchor_slip = SlipField {
            lateral: y * sense,
            forward: x * -sense,
            rotation: S::from(sense),
            speed: turn * difference.abs(),
        };
        // The other belt slips along y by V_anchor − V_other = ±(V_r − V_l) more, in units of |V_r
        // − V_l|.
        let other_slip = SlipField {
            lateral: turn * y * sense,
            forward: (turn * x - anchor.sign()) * -sense,
            rotation: turn * sense,
            speed: S::from(difference.abs()),
        };
        Self {
            belt_speed: belt_speed.map(S::from),
            twist: Twist {
                // y = v_x/w
                v_x: w * y,
                // x = (V_anchor − v_y)/w
                v_y: -w * x + belt_speed[anchor],
                w,
            },
            acceleration: Twist { v_x: S::from(0.0), v_y: S::from(0.0), w: S::from(0.0) },
            slip: match anchor {
                Side::Left => PerSide::new(anchor_slip, other_slip),
                Side::Right => PerSide::new(other_slip, anchor_slip),
            },
        }
    }

    /// Motion of a hull whose twist departs by `departure` from straight driving at the left belt's
    /// speed, with its acceleration.
    ///
    /// Slip is computed from the departure, so the creep of a sticking track keeps all digits. A
    /// slip field is scaled by its root mean square over the side's contact.
    #[inline]
    pub fn departing(
        belt_speed: PerSide<S>,
        departure: Twist<S>,
        acceleration: Twist<S>,
        contact: &PerSide<Extent>,
    ) -> Self {
        let slip = PerSide::from_fn(|side| {
            let Extent { middle: [x, y], radius } = contact[side];
            let behind = belt_speed.left - belt_speed[side];
            // s = (v_x − w y, v_y + w x − V)
            let lateral = departure.v_x - departure.w * y;
            let forward = departure.v_y + departure.w * x + behind;
            let rim = departure.w * radius;
            let squared = lateral * lateral + forward * forward + rim * rim;
            let speed = (squared + f64::MIN_POSITIVE).sqrt();
            let scale = speed.recip();
            SlipField {
                lateral: departure.v_x * scale,
                forward: (departure.v_y + behind) * scale,
                rotation: departure.w * scale,
                speed,
            }
        });
        let twist = Twist { v_y: departure.v_y + belt_speed.left, ..departure };
        Self { belt_speed, twist, acceleration, slip }
    }
}

//! The coefficients of the law, one line each.

use super::factor::{Argument, Component, Factor, Sign};
use crate::effect::{Parameter, Role};

/// Typical coefficients: a few hundredths of the weight at ordinary speeds, in ordinary places.
const CONSTANT: f64 = 0.03;
const LINEAR: f64 = 0.1;
const QUADRATIC: f64 = 0.2;
const PLACE: f64 = 0.01;
const TIME: f64 = 0.03;

/// Largest coefficient, in multiples of the typical one.
const MAX_TYPICAL_MULTIPLE: f64 = 50.0;

/// Unit of time, s.
const TIME_SCALE: Parameter = Parameter {
    key: "time_scale_s",
    symbol: "T",
    unit: "s",
    meaning: "unit of time of the terms with t/T",
    role: Role::Shape,
    range: [1.0, 10000.0],
    typical: 60.0,
};

/// Declares parameters and factors side by side.
macro_rules! coefficients {
    ($(
        $key:literal $component:ident $(($axis:expr))?, $sign:ident,
        $argument:ident $(($times:expr))?, $typical:ident, $meaning:literal;
    )+) => {
        /// Factor of each coefficient.
        pub(super) const FACTORS: &[Factor] = &[$(Factor {
            component: Component::$component $(($axis))?,
            sign: Sign::$sign,
            argument: Argument::$argument $(($times))?,
        }),+];

        /// The coefficients, and the unit of time.
        pub(super) const PARAMETERS: &[Parameter] = &[
            $(Parameter {
                key: $key,
                symbol: "c",
                unit: "1",
                meaning: $meaning,
                role: Role::Size { neutral: 0.0 },
                range: [-MAX_TYPICAL_MULTIPLE * $typical, MAX_TYPICAL_MULTIPLE * $typical],
                typical: $typical,
            },)+
            TIME_SCALE,
        ];
    };
}

/// Number of coefficients.
pub(super) const COUNT: usize = FACTORS.len();

coefficients! {
    "side" Side, Any, One, CONSTANT, "sideways, constant";
    "forward" Forward, Any, One, CONSTANT, "forward, constant";
    "turn" Turn, Any, One, CONSTANT, "turning, constant";
    "side_by_direction" Side, Along, One, CONSTANT, "sideways × sign(V_l + V_r)";
    "forward_by_direction" Forward, Along, One, CONSTANT, "forward × sign(V_l + V_r)";
    "turn_by_direction" Turn, Along, One, CONSTANT, "turning × sign(V_l + V_r)";
    "side_by_both" Side, Both, One, CONSTANT, "sideways, with both signs";
    "forward_by_both" Forward, Both, One, CONSTANT, "forward, with both signs";
    "turn_by_both" Turn, Both, One, CONSTANT, "turning, with both signs";
    "side_speed" Side, Any, Speed, LINEAR, "sideways, ∝ v";
    "side_speed_signed" Side, Any, SpeedSigned, QUADRATIC, "sideways, ∝ v |v|";
    "side_speed_squared" Side, Any, SpeedSquared, QUADRATIC, "sideways, ∝ v²";
    "side_rate" Side, Any, Rate, LINEAR, "sideways, ∝ ω";
    "side_rate_signed" Side, Any, RateSigned, QUADRATIC, "sideways, ∝ ω |ω|";
    "side_rate_squared" Side, Any, RateSquared, QUADRATIC, "sideways, ∝ ω²";
    "side_acceleration" Side, Any, Acceleration, QUADRATIC, "sideways, ∝ v ω";
    "forward_speed" Forward, Any, Speed, LINEAR, "forward, ∝ v";
    "forward_speed_signed" Forward, Any, SpeedSigned, QUADRATIC, "forward, ∝ v |v|";
    "forward_rate" Forward, Any, Rate, LINEAR, "forward, ∝ ω";
    "forward_rate_squared" Forward, Any, RateSquared, QUADRATIC, "forward, ∝ ω²";
    "forward_acceleration" Forward, Any, Acceleration, QUADRATIC, "forward, ∝ v ω";
    "turn_speed" Turn, Any, Speed, LINEAR, "turning, ∝ v";
    "turn_speed_signed" Turn, Any, SpeedSigned, QUADRATIC, "turning, ∝ v |v|";
    "turn_speed_squared" Turn, Any, SpeedSquared, QUADRATIC, "turning, ∝ v²";
    "turn_rate" Turn, Any, Rate, LINEAR, "turning, ∝ ω";
    "turn_rate_signed" Turn, Any, RateSigned, QUADRATIC, "turning, ∝ ω |ω|";
    "turn_acceleration" Turn, Any, Acceleration, QUADRATIC, "turning, ∝ v ω";
    "side_cos_heading" Side, Any, Cos(1), CONSTANT, "sideways, cos ψ";
    "side_sin_heading" Side, Any, Sin(1), CONSTANT, "sideways, sin ψ";
    "side_cos_double_heading" Side, Any, Cos(2), CONSTANT, "sideways, cos 2ψ";
    "side_sin_double_heading" Side, Any, Sin(2), CONSTANT, "sideways, sin 2ψ";
    "forward_cos_heading" Forward, Any, Cos(1), CONSTANT, "forward, cos ψ";
    "forward_sin_heading" Forward, Any, Sin(1), CONSTANT, "forward, sin ψ";
    "forward_cos_double_heading" Forward, Any, Cos(2), CONSTANT, "forward, cos 2ψ";
    "forward_sin_double_heading" Forward, Any, Sin(2), CONSTANT, "forward, sin 2ψ";
    "turn_cos_heading" Turn, Any, Cos(1), CONSTANT, "turning, cos ψ";
    "turn_sin_heading" Turn, Any, Sin(1), CONSTANT, "turning, sin ψ";
    "turn_cos_double_heading" Turn, Any, Cos(2), CONSTANT, "turning, cos 2ψ";
    "turn_sin_double_heading" Turn, Any, Sin(2), CONSTANT, "turning, sin 2ψ";
    "side_turning_cos_heading" Side, Turning, Cos(1), CONSTANT,
        "sideways, cos ψ × sign(V_r − V_l)";
    "side_turning_sin_heading" Side, Turning, Sin(1), CONSTANT,
        "sideways, sin ψ × sign(V_r − V_l)";
    "side_turning_cos_double_heading" Side, Turning, Cos(2), CONSTANT,
        "sideways, cos 2ψ × sign(V_r − V_l)";
    "side_turning_sin_double_heading" Side, Turning, Sin(2), CONSTANT,
        "sideways, sin 2ψ × sign(V_r − V_l)";
    "forward_turning_cos_heading" Forward, Turning, Cos(1), CONSTANT,
        "forward, cos ψ × sign(V_r − V_l)";
    "forward_turning_sin_heading" Forward, Turning, Sin(1), CONSTANT,
        "forward, sin ψ × sign(V_r − V_l)";
    "forward_turning_cos_double_heading" Forward, Turning, Cos(2), CONSTANT,
        "forward, cos 2ψ × sign(V_r − V_l)";
    "forward_turning_sin_double_heading" Forward, Turning, Sin(2), CONSTANT,
        "forward, sin 2ψ × sign(V_r − V_l)";
    "turn_turning_cos_heading" Turn, Turning, Cos(1), CONSTANT,
        "turning, cos ψ × sign(V_r − V_l)";
    "turn_turning_sin_heading" Turn, Turning, Sin(1), CONSTANT,
        "turning, sin ψ × sign(V_r − V_l)";
    "turn_turning_cos_double_heading" Turn, Turning, Cos(2), CONSTANT,
        "turning, cos 2ψ × sign(V_r − V_l)";
    "turn_turning_sin_double_heading" Turn, Turning, Sin(2), CONSTANT,
        "turning, sin 2ψ × sign(V_r − V_l)";
    "forward_direction_cos_heading" Forward, Along, Cos(1), CONSTANT,
        "forward, cos ψ × sign(V_l + V_r)";
    "forward_direction_sin_heading" Forward, Along, Sin(1), CONSTANT,
        "forward, sin ψ × sign(V_l + V_r)";
    "forward_direction_cos_double_heading" Forward, Along, Cos(2), CONSTANT,
        "forward, cos 2ψ × sign(V_l + V_r)";
    "forward_direction_sin_double_heading" Forward, Along, Sin(2), CONSTANT,
        "forward, sin 2ψ × sign(V_l + V_r)";
    "world_x" World([1, 0]), Any, One, CONSTANT, "along the x axis of the world, constant";
    "world_y" World([0, 1]), Any, One, CONSTANT, "along the y axis of the world, constant";
    "spring" Spring, Any, One, PLACE, "towards the origin of the world, per ℓ of distance";
    "side_turning_x" Side, Turning, X, PLACE,
        "sideways, ∝ x/ℓ × sign(V_r − V_l)";
    "side_turning_y" Side, Turning, Y, PLACE,
        "sideways, ∝ y/ℓ × sign(V_r − V_l)";
    "turn_turning_x" Turn, Turning, X, PLACE,
        "turning, ∝ x/ℓ × sign(V_r − V_l)";
    "turn_turning_y" Turn, Turning, Y, PLACE,
        "turning, ∝ y/ℓ × sign(V_r − V_l)";
    "forward_direction_x" Forward, Along, X, PLACE,
        "forward, ∝ x/ℓ × sign(V_l + V_r)";
    "forward_direction_y" Forward, Along, Y, PLACE,
        "forward, ∝ y/ℓ × sign(V_l + V_r)";
    "side_turning_time" Side, Turning, Time, TIME, "sideways, ∝ t/T × sign(V_r − V_l)";
    "turn_turning_time" Turn, Turning, Time, TIME, "turning, ∝ t/T × sign(V_r − V_l)";
    "forward_direction_time" Forward, Along, Time, TIME,
        "forward, ∝ t/T × sign(V_l + V_r)";
}

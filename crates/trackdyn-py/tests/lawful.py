"""Laws that tests share: a module that a pickle can import."""

import numpy as np

import trackdyn as td

G = 9.80665


@td.law(
    "my-turn",
    parameters={"strength": td.Parameter("1", 1.0, low=0.0, high=10.0)},
)
def my_turn(at, strength):
    """The catalogue's `centripetal` once more."""
    mass = (at.load_left + at.load_right) / G
    factor = strength * mass * at.yaw_rate
    return factor * at.v_lateral, -factor * at.v_forward


@td.law(
    "my-oil",
    acts="friction",
    parameters={"growth": td.Parameter("s/m", 0.5, low=0.0, high=10.0)},
)
def my_oil(at, growth):
    """The catalogue's `viscous-friction` once more."""
    return 1.0 + growth * at.slip_speed


@td.law("my-snow", parameters={"drag": td.Parameter("kg/s", 200.0, low=0.0, high=1e4)})
def my_snow(at, drag):
    """Drag of the hull in snow, which the catalogue does not have."""
    return -drag * at.v_forward, -drag * at.v_lateral


@td.law("my-slow-turn", parameters={"strength": td.Parameter("1", 1.0, low=0.0, high=10.0)})
def my_slow_turn(at, strength):
    """`my-turn` called in the interpreter, for nobody knows what an iterator does."""
    factor = strength * (at.load_left + at.load_right) / G * np.fromiter(at.yaw_rate, float)
    return factor * at.v_lateral, -factor * at.v_forward

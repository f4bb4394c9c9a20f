//! Properties that hold for every vehicle, ground and speed.

mod stationary;

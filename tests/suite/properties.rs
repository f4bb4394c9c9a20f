//! Properties that hold for every vehicle, ground and speed.

mod bearing;
mod contact;
mod force_law;
mod map;
mod stationary;
mod tanh_sinh;
mod transient;

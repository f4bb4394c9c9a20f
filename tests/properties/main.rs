//! Properties that hold for every vehicle, ground and speed.

mod contact;
mod map;
mod stationary;
mod tanh_sinh;
mod transient;

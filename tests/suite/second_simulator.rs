//! What makes the independent ground fit to prove anything.

mod constancy;
mod convergence;
mod endurance;
mod mechanisms;
mod parity;
mod published;
mod rest;
mod slide;
mod straight;
mod transients;
mod turn;

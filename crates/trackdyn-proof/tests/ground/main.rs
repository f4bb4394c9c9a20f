//! What makes the independent ground fit to prove anything.

mod constancy;
mod convergence;
mod mechanisms;
mod parity;
mod published;
mod rest;
mod slide;
mod turn;

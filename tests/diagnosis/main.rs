//! A diagnosis says no more than the evidence bears.

mod candidates;
mod compared;
mod held_out;
mod images;
mod inertia;
mod intervals;
mod measured;
mod nested;
mod nulls;
mod one_sided;
mod proposal;
mod real;
mod twins;
mod unknown;

//! A diagnosis says no more than the evidence bears.

mod answers;
mod belts;
mod images;
mod intervals;
mod measured;
mod nulls;
mod one_sided;
mod real;
mod twins;

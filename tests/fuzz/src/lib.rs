//! What the targets share: files for readers that take paths, and bags that are made up.
//!
//! A target gives a reader what it did not expect. An error is right, a panic is not. Memory is
//! bounded by [`MAX_MEMORY`]: more of it ends the target, and libFuzzer keeps the input.

pub mod bag;
pub mod damage;
pub mod drive;
pub mod encoder;
pub mod files;
pub mod reading;
pub mod round_trip;

use cap::Cap;
use std::alloc::System;

/// Most memory that a reader may take at once, bytes.
pub const MAX_MEMORY: usize = 500 << 20;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, MAX_MEMORY);

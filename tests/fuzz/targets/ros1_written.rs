//! `.bag` files that were written as they should be, and then damaged.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_fuzz::bag::Bag;
use trackdyn_fuzz::reading;

fuzz_target!(|bag: Bag| reading::bag(&bag.ros1(), bag.wanted));

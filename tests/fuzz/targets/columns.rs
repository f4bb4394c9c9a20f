//! Tables whose columns are named by the user: the columns, a zero byte, the table. Columns that
//! are none are those of the usual names.

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::str::from_utf8;
use trackdyn_fuzz::{files, reading};
use trackdyn_recording::{Columns, columns};

const USUAL_COLUMNS: &str = "t=t,v_l=l,v_r=r,x=x,y=y,yaw=yaw";

fuzz_target!(|input: &[u8]| {
    let [named, table] = files::parts::<2>(input);
    let named = named.and_then(|named| from_utf8(named).ok()).unwrap_or_default();
    let path = files::file("table.csv", table.unwrap_or_default());
    let usual = || USUAL_COLUMNS.parse().expect("columns");
    let named: Columns = named.parse().unwrap_or_else(|_| usual());
    reading::table(|options| columns::read(&path, &named, options));
});

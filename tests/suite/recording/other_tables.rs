//! Tables as other programs write them: dates, decimal commas, units below the header.

use std::fmt::Write;
use trackdyn_recording::{Columns, Error, Recording, TableOptions, columns};

const COLUMNS: &str = "t=t,v_l=vl,v_r=vr,x=x,y=y,yaw=yaw";

/// Time, speeds and pose of a straight drive at 1 m/s that speeds up and slows down, every 50 ms.
fn rows() -> Vec<[f64; 6]> {
    let row = |k: u32| {
        let t = 0.05 * f64::from(k);
        let (v, x) = (1.0 + 0.5 * t.sin(), t + 0.5 * (1.0 - t.cos()));
        [t, v, v, x, 0.25, 0.5]
    };
    (0..200).map(row).collect()
}

/// A table by its text, with the cells of each row as `row` writes them.
fn text(header: &str, separator: &str, row: impl Fn([f64; 6]) -> [String; 6]) -> Vec<u8> {
    let mut text = format!("{header}\n");
    for values in rows() {
        let _ = writeln!(text, "{}", row(values).join(separator));
    }
    text.into_bytes()
}

fn plain(row: [f64; 6]) -> [String; 6] {
    row.map(|value| format!("{value:.6}"))
}

fn read(text: &[u8]) -> Result<Recording, Error> {
    let place = tempfile::tempdir().expect("a temporary folder");
    let path = place.path().join("drive.csv");
    std::fs::write(&path, text).expect("written");
    let columns: Columns = COLUMNS.parse().expect("columns");
    columns::read(&path, &columns, &TableOptions::default())
}

/// The drive comes out, within the digits that are written.
#[track_caller]
fn assert_reads(text: &[u8]) {
    let recording = read(text).expect("readable");
    let run = &recording.runs()[0];
    let start = run.tracks()[0].t;
    assert_eq!((run.tracks().len(), run.poses().len()), (200, 200));
    for ((found, pose), [t, v, _, x, ..]) in run.tracks().iter().zip(run.poses()).zip(rows()) {
        let off = [found.t - start - t, found.v_left - v, found.v_right - v, pose.pose.x - x];
        assert!(off.iter().all(|off| off.abs() < 2e-6), "{found:?} {t} {v} {x}");
    }
}

#[track_caller]
fn assert_refuses(text: &[u8], parts: &[&str]) {
    let problem = read(text).expect_err("refused").to_string();
    for part in parts {
        assert!(problem.contains(part), "{part:?} is not in {problem}");
    }
}

const HEADER: &str = "t,vl,vr,x,y,yaw";

/// The time of a row as hours, minutes and seconds from 23:59:55 on.
fn clock(t: f64) -> String {
    let midnight = t >= 5.0;
    let seconds = if midnight { t - 5.0 } else { 55.0 + t };
    let hour = if midnight { "00:00" } else { "23:59" };
    format!("{hour}:{seconds:06.3}")
}

#[test]
fn dates_and_times_of_day_are_read() {
    let day = |t: f64, first: &str, second: &str| if t < 5.0 { first } else { second }.to_owned();
    let at = |time: &dyn Fn(f64) -> String| {
        text(HEADER, ",", |row| {
            let mut cells = plain(row);
            cells[0] = time(row[0]);
            cells
        })
    };
    assert_reads(&at(&clock));
    assert_reads(&at(&|t| day(t, "2024-02-28T", "2024-02-29T") + &clock(t) + "Z"));
    assert_reads(&at(&|t| day(t, "28.02.2024 ", "29.02.2024 ") + &clock(t)));
    let slashes = at(&|t| day(t, "02/28/2024 ", "02/29/2024 ") + &clock(t));
    assert_refuses(&slashes, &[":2:1: t = \"02/28/2024", "a date such as 2024-03-31T"]);
    let seconds = at(&|t| clock(t)[..8].to_owned());
    assert_refuses(&seconds, &["share the stamp of the row before", "--accept stamps"]);
}

#[test]
fn commas_encodings_units_and_lines_above_are_read() {
    let commas = |row: [f64; 6]| plain(row).map(|cell| cell.replace('.', ","));
    assert_reads(&text("t;vl;vr;x;y;yaw", ";", commas));
    assert_reads(&text(HEADER, ",", |row| commas(row).map(|cell| format!("\"{cell}\""))));
    let whole = String::from_utf8(text(HEADER, ",", plain)).expect("text");
    assert_reads(&[b"\xef\xbb\xbf", whole.as_bytes()].concat());
    for bytes in [u16::to_le_bytes, u16::to_be_bytes] {
        let units = ['\u{feff}'].into_iter().chain(whole.chars()).map(|c| bytes(c as u16));
        assert_reads(&units.flatten().collect::<Vec<u8>>());
    }
    let preamble = format!("Logger 2.1\r\n\r\nrobot, made\r\n{}", whole.replace('\n', "\r\n"));
    assert_reads(preamble.as_bytes());
    let below = |units: &str| whole.replacen('\n', &format!("\n{units}\n"), 1).into_bytes();
    assert_reads(&below("s,m/s,[m/s],m,,rad"));
    assert_refuses(&below("s,furlong,m/s,m,m,rad"), &[":2:2: vl = \"furlong\"", "row of units"]);
    let fast = text(HEADER, ",", |[t, l, r, x, y, yaw]| plain([t, 3.6 * l, 3.6 * r, x, y, yaw]));
    let fast = String::from_utf8(fast).expect("text");
    assert_reads(fast.replacen('\n', "\ns,km/h,km/h,m,m,rad\n", 1).as_bytes());
}

#[test]
fn what_was_not_measured_is_left_out_and_what_is_unclear_refused() {
    let whole = String::from_utf8(text(HEADER, ",", plain)).expect("text");
    let mut lines: Vec<String> = whole.lines().map(str::to_owned).collect();
    lines[2] = "0.050000,n/a,1.02,0.05,0.25,0.5".to_owned();
    let recording = read(lines.join("\n").as_bytes()).expect("readable");
    assert_eq!(recording.runs()[0].tracks().len(), 199);
    lines[3] = "0.1,\"1,234\",1.02,0.05,0.25,0.5".to_owned();
    assert_refuses(lines.join("\n").as_bytes(), &[":4:2: vl = \"1,234\"", "expected a number"]);
    assert_refuses(b"PK\x03\x04...", &["a spreadsheet", "expected a table as text"]);
}

//! Identifies ICRs and alphas from a recording as long as the paper's: what the comparison with
//! Python peers reads.
//!
//! `identify_case --case FILE --seed N` writes the segments to a file, one per line: observed
//! forward, left (m) and yaw (rad), then duration (s), V_l and V_r (m/s) of each piece. It prints,
//! per method: name, seconds (median), cost (17), x_l, x_r, y, alpha_l, alpha_r. The seed is that
//! of the genetic algorithm.

mod paper_case;

use paper_case::{LEVER, PaperCase};
use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::time::Instant;
use trackdyn_estimate::genetic::Cost;
use trackdyn_estimate::{Observations, Parameters};

/// Timings per method.
const REPEATS: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (file, seed) = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["--case", file, "--seed", seed] => (Path::new(file), seed.parse()?),
        _ => return Err("usage: identify_case --case FILE --seed N".into()),
    };
    let case = PaperCase::new();
    write(&case.observations, file)?;
    let cost = Cost::new(&case.observations, LEVER);
    report("noise_huber", &cost, || case.noise_huber().parameters);
    report("distance_squares", &cost, || case.distance_squares().parameters);
    report("genetic", &cost, || case.genetic(seed).parameters);
    Ok(())
}

fn write(observations: &Observations, file: &Path) -> std::io::Result<()> {
    let mut out = BufWriter::new(File::create(file)?);
    for segment in observations.segments() {
        let [forward, left, yaw] = segment.motion;
        write!(out, "{forward:e} {left:e} {yaw:e}")?;
        for piece in observations.pieces(segment) {
            write!(out, " {:e} {:e} {:e}", piece.duration, piece.v_left, piece.v_right)?;
        }
        writeln!(out)?;
    }
    out.flush()
}

/// Times a method and prints what it found; the first time is not counted.
fn report(name: &str, cost: &Cost, method: impl Fn() -> Parameters) {
    let parameters = method();
    let mut seconds = [0.0; REPEATS];
    for seconds in &mut seconds {
        let start = Instant::now();
        std::hint::black_box(method());
        *seconds = start.elapsed().as_secs_f64();
    }
    seconds.sort_by(f64::total_cmp);
    let [x_l, x_r, y, alpha_l, alpha_r] = parameters.0;
    println!(
        "{name} {:e} {:e} {x_l:e} {x_r:e} {y:e} {alpha_l:e} {alpha_r:e}",
        seconds[REPEATS / 2],
        cost.at(&parameters)
    );
}

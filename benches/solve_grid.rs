//! Solves the centripetal + load-transfer map of Auriga-alpha on one core and prints the time of a
//! solve and every solution: what the comparison with Python peers reads.
//!
//! `solve_grid --grid N` prints `seconds_per_solve S`, then `V_l V_r x_l x_r y` per turning motion.

use std::error::Error;
use std::io::{BufWriter, Write};
use std::time::Instant;
use trackdyn_core::PerSide;
use trackdyn_model::{Circumstance, Model, VehicleFile};
use trackdyn_model::{Grid, Solution, Stationary, Status};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let points = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["--grid", points] => points.parse()?,
        _ => return Err("usage: solve_grid --grid N".into()),
    };
    let effects = ["centripetal".parse()?, "load-transfer:cog_height_m=0.05".parse()?];
    let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects.into_iter().collect());
    let solver = Stationary::new(&model, &Circumstance::default());
    let speeds = Grid::new(points, Grid::PAPER_SPEED)?.speeds();
    let pairs: Vec<PerSide<f64>> = speeds
        .iter()
        .flat_map(|&left| speeds.iter().map(move |&right| PerSide::new(left, right)))
        .filter(|pair| pair.left != pair.right)
        .collect();

    let start = Instant::now();
    let solutions: Vec<Solution> = pairs.iter().map(|&pair| solver.solve(pair)).collect();
    let elapsed = start.elapsed().as_secs_f64();

    let mut out = BufWriter::new(std::io::stdout().lock());
    #[expect(clippy::cast_precision_loss, reason = "at most four million pairs")]
    let count = pairs.len() as f64;
    writeln!(out, "seconds_per_solve {:e}", elapsed / count)?;
    for solution in &solutions {
        let (Status::Turning, Some(icrs)) = (solution.status, solution.icrs) else {
            return Err(format!("{:?} at {:?}", solution.status, solution.belt_speed).into());
        };
        let PerSide { left, right } = solution.belt_speed;
        writeln!(
            out,
            "{left:.17e} {right:.17e} {:.17e} {:.17e} {:.17e}",
            icrs.x_left, icrs.x_right, icrs.y
        )?;
    }
    Ok(())
}

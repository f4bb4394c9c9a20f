//! Writes figures of ICR maps of all kinds of vehicles into a folder, with the time that each
//! takes.
//!
//! `cargo run --release -p trackdyn-report --example gallery -- <folder>`

use std::path::{Path, PathBuf};
use std::time::Instant;
use trackdyn_core::output;
use trackdyn_model::contact::Friction;
use trackdyn_model::{
    Circumstance, Effects, Model, RunningGear, Uncertainty, Vehicle, VehicleFile,
};
use trackdyn_model::{Grid, IcrMap};

type Anything = Box<dyn std::error::Error>;

fn main() -> Result<(), Anything> {
    let folder = PathBuf::from(std::env::args_os().nth(1).ok_or("expected a folder")?);
    output::prepare_folder(&folder)?;
    let auriga = VehicleFile::auriga_alpha().vehicle;
    let cloud = ["centripetal", "load-transfer:cog_height_m=0.05"];
    for points in [11, 41, 201] {
        draw(&folder, &format!("base-{points}"), &auriga, &[], points)?;
        draw(&folder, &format!("cloud-{points}"), &auriga, &cloud, points)?;
    }
    draw(&folder, "resistance", &auriga, &["motion-resistance"], 41)?;
    draw(&folder, "slope", &auriga, &["slope"], 41)?;
    draw(&folder, "shear", &auriga, &["shear-displacement"], 41)?;
    draw(&folder, "viscous", &auriga, &["viscous-friction"], 41)?;
    let all = ["centripetal", "load-transfer", "motion-resistance", "slope", "viscous-friction"];
    draw(&folder, "many-effects", &auriga, &all, 41)?;
    draw(&folder, "two-speeds", &auriga, &cloud, 2)?;

    let husky = Vehicle {
        name: "Husky A200".to_owned(),
        mass: 75.0,
        gauge: 0.56,
        cog: [0.0, 0.02],
        running_gear: RunningGear::Wheels {
            contact_length: 0.1,
            width: 0.1,
            axles: vec![0.256, -0.256],
        },
        friction: Friction { across: 0.8, along: 0.7 },
        uncertainty: Uncertainty::default(),
    };
    draw(&folder, "husky", &husky, &cloud, 41)?;
    let track = |gauge, contact_length, belt_width, cog| Vehicle {
        name: format!("Vehicle of {gauge} m × {contact_length} m"),
        mass: 300.0,
        gauge,
        cog,
        running_gear: RunningGear::Track { contact_length, belt_width },
        friction: Friction { across: 0.9, along: 0.7 },
        uncertainty: Uncertainty::default(),
    };
    draw(&folder, "long", &track(0.3, 4.0, 0.1, [0.0, 0.1]), &cloud, 41)?;
    draw(&folder, "wide", &track(3.0, 0.5, 0.3, [0.1, 0.01]), &cloud, 41)?;
    draw(&folder, "large", &track(12.0, 18.0, 3.0, [0.4, -0.5]), &[], 41)?;
    let offset = |x| track(1.2, 0.4, 0.2, [x, 0.0]);
    let transfer = ["centripetal", "load-transfer:cog_height_m=1.5"];
    draw(&folder, "held", &offset(0.5), &[], 41)?;
    draw(&folder, "held-in-part", &offset(0.47), &["motion-resistance"], 41)?;
    draw(&folder, "held-in-half", &offset(0.47), &["slope", "centripetal"], 41)?;
    draw(&folder, "held-mostly", &offset(0.48), &transfer, 41)?;
    draw(&folder, "held-or-lifts", &offset(0.57), &transfer, 41)?;
    let forward = Vehicle { cog: [0.0, 0.11], ..auriga };
    let tall = ["centripetal", "load-transfer:cog_height_m=2"];
    draw(&folder, "tall", &forward, &tall, 41)?;
    Ok(())
}

fn draw(
    folder: &Path,
    name: &str,
    vehicle: &Vehicle,
    effects: &[&str],
    points: usize,
) -> Result<(), Anything> {
    vehicle.check()?;
    let effects = effects.iter().map(|text| text.parse()).collect::<Result<Effects, _>>()?;
    let model = Model::new(vehicle.clone(), effects);
    let map = IcrMap::solve(&model, Grid::new(points, 1.0)?, &Circumstance::default(), &|_| {});
    let start = Instant::now();
    let figure = trackdyn_report::icr_map(&map, &model, &format!("gallery of figures, {name}"));
    let picture = figure.to_png()?;
    println!(
        "{name:14} {:5.1} ms {:5} kB  counts {:?}",
        1e3 * start.elapsed().as_secs_f64(),
        picture.len() / 1000,
        map.counts(),
    );
    output::write_file(&folder.join(format!("{name}.png")), &picture)?;
    output::write_file(&folder.join(format!("{name}.svg")), figure.to_svg()?.as_bytes())?;
    Ok(())
}

//! Numbers at the ends of their range, in every option and key that takes one.

use super::{Case, check, prepared};
use crate::{Workplace, project_text};

const ABSURD_NUMBERS: [&str; 7] = ["5e-324", "1e-300", "1e308", "-1e308", "-0", "nan", "inf"];

/// Options that take a number.
const OPTIONS: [&str; 40] = [
    "map --grid 5 --fastest {}",
    "map --grid 5 --cog {},0",
    "map --grid 5 --heading {}",
    "map --grid 5 --position {},0",
    "map --grid 5 --at-time {}",
    "map --grid 5 --effect load-transfer:cog_height_m={}",
    "map --grid 5 --effect slope:angle_deg={}",
    "kinematics --speeds {},1",
    "kinematics --kinematics m/kinematics.toml --speeds {},{}",
    "kinematics --twist {},1",
    "kinematics --kinematics m/kinematics.toml --twist 1,{}",
    "simulate --run-count 1 --duration {}",
    "simulate --run-count 1 --duration 3 --fastest {}",
    "simulate --run-count 1 --duration 3 --step {}",
    "simulate --run-count 1 --duration 3 --position {},0",
    "simulate --run-count 1 --duration 3 --heading {}",
    "drive --speed {}",
    "drive --look-ahead {}",
    "odometry rec --gauge {}",
    "odometry rec --gauge 0.5 --tau {}",
    "odometry rec --gauge 0.5 --time {},5",
    "odometry rec --gauge 0.5 --time 0,{}",
    "odometry rec --gauge 0.5 --mount-yaw {}",
    "odometry rec --gauge 0.5 --wheel-radius {}",
    "identify rec --gauge {} --generations 2",
    "identify rec --gauge 0.5 --generations 2 --settle {}",
    "plan --diagnosis none.toml --fastest {}",
    "plan --diagnosis none.toml --duration {}",
    "plan --diagnosis none.toml --noise-xy {}",
    "init i.toml --force --gauge {} --track 0.5,0.1 --mass 20",
    "init i.toml --force --gauge 0.5 --track {},{} --mass 20",
    "init i.toml --force --gauge 0.5 --track 0.5,0.1 --mass {}",
    "init i.toml --force --gauge 0.5 --track 0.5,0.1 --mass 30 --cog {},0",
    "init i.toml --force --gauge 0.5 --track 0.5,0.1 --mass 30 --friction {},1",
    "init i.toml --force --gauge 0.5 --wheels 0.1,0.1 --axles {},-0.2 --mass 30",
    "trial make --cases 1 --seed 1 --out t --duration {}",
    "trial run folder --limit {}",
    "export ros2 m/kinematics.toml --wheel-radius {} --left-joint a --right-joint b",
    "export urdf-frames m/kinematics.toml --contact-centre {},0",
    "export table --fastest {}",
];

#[test]
fn options() {
    let place = prepared();
    let of = |option: &&str| ABSURD_NUMBERS.map(|number| Case::ended(option.replace("{}", number)));
    let all: Vec<Case> = OPTIONS.iter().flat_map(of).collect();
    check(&place, &all);
}

/// No vehicle has these values: each is refused by file, line, key and value.
#[test]
fn keys_of_a_vehicle() {
    let place = prepared();
    let text = project_text("configs/vehicles/auriga-alpha.toml");
    let mut all = Vec::new();
    let keys = ["mass_kg", "gauge_m", "contact_length_m", "belt_width_m", "mu_x", "mu_y"];
    for (line, row) in (1..).zip(text.lines()) {
        let Some(key) = keys.iter().find(|key| row.starts_with(&format!("{key} = "))) else {
            continue;
        };
        for number in ["5e-324", "1e-300", "1e308", "-0.0", "1e12", "nan", "inf"] {
            let file = format!("{key}{number}.toml");
            place.write(&file, &text.replace(row, &format!("{key} = {number}")));
            let place = format!("{file}:{line}: ");
            let named = format!("{key} = {number}: expected ");
            let names = [place.as_str(), named.as_str()];
            all.push(Case::refused(format!("map --grid 5 --vehicle {file}"), &names));
        }
    }
    assert_eq!(all.len(), 42);
    check(&place, &all);
}

/// Columns of a recording.
#[test]
fn cells_of_a_recording() {
    let place = prepared();
    let mut all = Vec::new();
    for (file, columns) in [("tracks.csv", 1..4), ("poses.csv", 1..5)] {
        let text = String::from_utf8(place.read(&format!("rec/{file}"))).expect("text");
        for column in columns {
            for (index, number) in ["5e-324", "1e308", "-0", "1e300"].iter().enumerate() {
                let folder = format!("{file}-{column}-{index}");
                std::fs::create_dir(place.path().join(&folder)).expect("a folder");
                for other in ["recording.toml", "tracks.csv", "poses.csv"] {
                    let copy = place.path().join(&folder).join(other);
                    std::fs::copy(place.path().join("rec").join(other), copy).expect("a copy");
                }
                let row = |(line, row): (usize, &str)| {
                    let mut cells: Vec<&str> = row.split(',').collect();
                    if line > 0 && (line % 2 == 0 || index < 2) {
                        cells[column] = number;
                    }
                    cells.join(",") + "\n"
                };
                let rows: String = text.lines().enumerate().map(row).collect();
                place.write(&format!("{folder}/{file}"), &rows);
                all.push(Case::ended(format!("inspect {folder}")));
                all.push(Case::ended(format!("odometry {folder} --gauge 0.5")));
            }
        }
    }
    check(&place, &all);
}

/// Threads are started before any work: 10⁵ of them would keep the machine busy for minutes.
#[test]
fn threads() {
    let place = Workplace::new();
    for asked in ["100000", "18446744073709551616", "-1", "two"] {
        let run = place.command("map --grid 5 --out out").env("RAYON_NUM_THREADS", asked).output();
        let run = run.expect("the program starts");
        let said = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(1), "{said}");
        let expected = format!("RAYON_NUM_THREADS = {asked}: expected 0");
        assert!(said.contains(&expected), "{said}");
        assert!(place.files().is_empty(), "{:?}", place.files());
    }
    assert_eq!(place.run_with_threads("map --grid 5 --out out", 64).status, 0);
}

//! Files that are none, that have no end, or that are too large, deep or wide.

use super::{Case, check, prepared};
use crate::{Workplace, project_text, vehicle};
use std::fmt::Write;
use std::os::unix::fs::symlink;
use std::os::unix::net::UnixListener;
use std::process::Command;

/// Commands that read a TOML text; `{}` is where it stands.
const TEXTS: [&str; 15] = [
    "map --grid 3 --vehicle {}",
    "kinematics --speeds 1,1 --kinematics {}",
    "kinematics --speeds 1,1 --vehicle {}",
    "check {}",
    "plan --diagnosis {}",
    "simulate --run-count 1 --duration 3 --sensors {}",
    "drive --kinematics {}",
    "diagnose rec --vehicle auriga-alpha --settings {}",
    "diagnose rec --vehicle {}",
    "export ros2 {}",
    "export gz {}",
    "export urdf-frames {}",
    "export table --vehicle {}",
    "export ros2 m/kinematics.toml --wheel-radius 0.1 --contact-centre 0,0 --left-joint a \
     --right-joint b --residuals {}",
    "odometry rec --gauge 0.5 --kinematics {}",
];

/// Commands that read a table.
const TABLES: [&str; 5] = [
    "simulate --schedule {}",
    "drive --path {}",
    "odometry poses.tum --gauge 0.5 --tracks {}",
    "identify {} --gauge 0.5",
    "odometry {} --gauge 0.5 --columns t=t,v_l=v_left,v_r=v_right,x=x,y=y,yaw=yaw",
];

fn cases(commands: &[&str], files: &[&str]) -> Vec<Case> {
    let of = |file: &&str| -> Vec<Case> {
        let case = |command: &&str| Case::refused(command.replace("{}", file), &[file]);
        commands.iter().map(case).collect()
    };
    files.iter().flat_map(of).collect()
}

fn make_pipe(place: &Workplace, name: &str) {
    let status = Command::new("mkfifo").arg(place.path().join(name)).status().expect("mkfifo");
    assert!(status.success());
}

#[test]
fn devices_pipes_sockets_and_folders() {
    let place = prepared();
    make_pipe(&place, "pipe.csv");
    symlink("/dev/zero", place.path().join("zero.csv")).expect("a link");
    symlink("/dev/urandom", place.path().join("random.csv")).expect("a link");
    let _socket = UnixListener::bind(place.path().join("socket.csv")).expect("a socket");
    std::fs::create_dir(place.path().join("folder.csv")).expect("a folder");
    place.write("poses.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
    let files = ["pipe.csv", "zero.csv", "random.csv", "socket.csv", "folder.csv"];
    let mut all = cases(&TEXTS, &files);
    all.extend(cases(&TABLES, &files));
    all.extend(cases(&["trial score folder --key {}"], &["pipe.csv", "zero.csv"]).into_iter().map(
        |case| Case { names: vec![], ..case }, // a folder without a trial is named first
    ));
    for ending in ["mcap", "db3", "bag", "tum", "mcap.zstd", "db3.zstd", "bag.active"] {
        make_pipe(&place, &format!("pipe.{ending}"));
        symlink("/dev/zero", place.path().join(format!("zero.{ending}"))).expect("a link");
        for kind in ["pipe", "zero"] {
            let file = format!("{kind}.{ending}");
            all.push(Case::refused(format!("inspect {file}"), &[&file]));
            let arguments = format!("odometry {file} --gauge 0.5 --tracks rec/tracks.csv");
            all.push(Case::refused(arguments, &[&file]));
        }
    }
    for (number, part) in ["recording.toml", "tracks.csv", "poses.csv"].iter().enumerate() {
        for kind in ["pipe", "zero"] {
            let folder = format!("{kind}{number}");
            let home = place.path().join(&folder);
            std::fs::create_dir(&home).expect("a folder");
            for file in ["recording.toml", "tracks.csv", "poses.csv"] {
                if file != *part {
                    std::fs::copy(place.path().join("rec").join(file), home.join(file))
                        .expect("a copy");
                }
            }
            match kind {
                "pipe" => make_pipe(&place, &format!("{folder}/{part}")),
                _ => symlink("/dev/zero", home.join(part)).expect("a link"),
            }
            all.push(Case::refused(format!("inspect {folder}"), &[&folder]));
        }
    }
    check(&place, &all);
}

#[test]
fn texts_that_are_too_large_deep_or_long() {
    let place = prepared();
    let robot = project_text("configs/vehicles/auriga-alpha.toml");
    let large = |name: &str, head: &str| {
        place.write(name, head);
        let file = std::fs::File::options().write(true).open(place.path().join(name));
        file.and_then(|file| file.set_len(200_000_000)).expect("a large file");
    };
    large("large.toml", "# ");
    place.write("deep.toml", &format!("a = {}{}", "[".repeat(100_000), "]".repeat(100_000)));
    place.write("keys.toml", &format!("a{} = 1\n", ".a".repeat(100_000)));
    place.write("tables.toml", &format!("a = {}1{}", "{a=".repeat(100_000), "}".repeat(100_000)));
    place.write("wide.toml", &format!("{robot}{}", "a = 1\n".repeat(200_000)));
    let long = "x".repeat(100_000);
    let named =
        |name: &str| robot.replace("name = \"Auriga-alpha\"", &format!("name = \"{name}\""));
    place.write("name.toml", &named(&long));
    let numbers = format!("cog_m = [{}1]", "1,".repeat(500_000));
    place.write("list.toml", &robot.replace("cog_m = [-0.015, 0.04]", &numbers));
    let files = ["large.toml", "deep.toml", "keys.toml", "tables.toml", "wide.toml"];
    let mut all = cases(&TEXTS, &files);
    all.push(Case::refused("map --vehicle name.toml", &["name.toml:", "at most 200 characters"]));
    all.push(Case::refused("map --vehicle list.toml", &["list.toml:", "expected 2 numbers"]));
    check(&place, &all);
}

#[test]
fn tables_that_are_too_wide_long_or_open() {
    let place = prepared();
    place.write("poses.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
    let header = "t,v_left,v_right,v_forward,v_lateral,yaw_rate,x,y,yaw\n";
    let mut columns = header.trim().to_owned();
    for number in 0..1_000_000 {
        let _ = write!(columns, ",c{number}");
    }
    place.write("columns.csv", &columns);
    place.write("quotes.csv", &format!("{header}\"{}", "a\n".repeat(10_000_000)));
    place.write("line.csv", &format!("{header}{}", "1".repeat(20_000_000)));
    place.write("first.csv", &"1".repeat(20_000_000));
    let files = ["columns.csv", "quotes.csv", "line.csv", "first.csv"];
    let mut all = cases(&TABLES, &files);
    place.write("long.tum", &format!("# a\n{}", "1 ".repeat(10_000_000)));
    all.push(Case::refused("odometry long.tum --gauge 0.5 --tracks rec/tracks.csv", &["long.tum"]));
    check(&place, &all);
}

/// Times and lengths whose simulation no memory holds.
#[test]
fn drives_without_end() {
    let place = prepared();
    let schedule = |rows: &str| format!("t,v_left,v_right\n{rows}");
    place.write("late.csv", &schedule("0,0.1,0.1\n1e9,0,0\n"));
    place.write("late5.csv", &schedule("0,0.1,0.1\n2e5,0,0\n"));
    let epoch = "0,0.1,0.1\n0.5,0.1,0.1\n1764300000,0.1,0.1\n1764300010,0,0\n";
    place.write("epoch.csv", &schedule(epoch));
    place.write("fast.csv", &schedule("0,1e308,-1e308\n10,0,0\n"));
    place.write("path1000.csv", "x,y\n0,0\n1000000,0\n");
    place.write("path100.csv", "x,y\n0,0\n100000,0\n");
    place.write("far.csv", "x,y\n0,0\n1e308,0\n");
    let mut zigzag = String::from("x,y\n");
    for point in 0..20_000 {
        let _ = writeln!(zigzag, "{:.4},{}", f64::from(point) * 1e-4, f64::from(point % 2) * 1e-3);
    }
    place.write("zigzag.csv", &zigzag);
    let all = [
        Case::refused("simulate --schedule late.csv", &["--schedule", "1 GB"]),
        Case::refused("simulate --schedule late5.csv", &["--schedule", "1 GB"]),
        Case::refused("simulate --schedule epoch.csv", &["--schedule", "run 0", "1 GB"]),
        Case::refused("simulate --schedule fast.csv", &["fast.csv:2:2", "1000 m/s"]),
        Case::refused("drive --path path1000.csv", &["--path", "1000000 m", "a shorter path"]),
        Case::refused("drive --path path100.csv", &["--path", "100000 m", "a shorter path"]),
        Case::refused("drive --path far.csv", &["far.csv:3:1"]),
        Case::refused("drive --path zigzag.csv", &["--path", "fewer corners"]),
        Case::refused("simulate --duration 1e9", &["--duration", "1000000000"]),
        Case::refused("simulate --duration 50000 --run-count 1", &["--schedule", "1 GB"]),
        Case::refused("simulate --run-count 1000000000", &["--run-count", "1 to 10000"]),
        Case::refused("simulate --run-count 10000 --duration 50000", &["--run-count"]),
        Case::refused("simulate --run-count 18446744073709551616", &["--run-count"]),
        Case::refused("map --grid 1000000000", &["grid = 1000000000", "2 to 2001"]),
        Case::refused("simulate --seed 18446744073709551616", &["--seed"]),
        Case::ended("simulate --seed 18446744073709551615 --run-count 1 --duration 3"),
        Case::refused("trial make --cases 18446744073709551615 --seed 1 --out t", &["--cases"]),
        Case::refused("trial run folder --shard 0/0", &["--shard"]),
        Case::ended("odometry rec --gauge 0.5 --runs 1-9223372036854775807"),
        Case::ended("odometry rec --gauge 0.5 --runs 0-18446744073709551616"),
        Case::ended("odometry rec --gauge 0.5 --pose-index 18446744073709551615"),
        Case::refused("identify rec --gauge 0.5 --population 1000000000", &["--population"]),
        Case::refused("identify rec --gauge 0.5 --generations 1000000000", &["--generations"]),
        Case::refused("diagnose rec --vehicle auriga-alpha --draws 1000000000", &["--draws"]),
    ];
    check(&place, &all);
}

#[test]
fn escape_codes_and_directions_of_writing() {
    const CODES: &str = "\\u001b[2J\\u202e\\u0007";
    const RAW_CODES: &str = "\u{1b}[2J\u{202e}\u{7}";
    let place = prepared();
    let robot = project_text("configs/vehicles/auriga-alpha.toml");
    let auriga = "name = \"Auriga-alpha\"";
    place.write("name.toml", &robot.replace(auriga, &format!("name = \"{CODES}\"")));
    place.write("key.toml", &format!("\"{CODES}\" = 1\n{robot}"));
    place.write("effect.toml", &format!("{robot}\n[effect.\"{CODES}\"]\n"));
    place.write("comment.toml", &format!("{robot}\n# {RAW_CODES}\n"));
    place.write("table.csv", &format!("t,v_left,v_right{RAW_CODES}\n0,1,1\n"));
    place.write("cell.csv", &format!("t,v_left,v_right\n0,{RAW_CODES},1\n"));
    place.write("room.tum", &format!("0 0 0 0 0 0 0 {RAW_CODES}\n"));
    let manifest = String::from_utf8(place.read("rec/recording.toml")).expect("text");
    let robot_line = manifest.lines().find(|line| line.starts_with("robot = ")).expect("a robot");
    place.write(
        "rec/recording.toml",
        &manifest.replace(robot_line, &format!("robot = \"{CODES}\"")),
    );
    let all = [
        Case::ended("kinematics --speeds 1,1 --vehicle name.toml"),
        Case::ended("map --grid 3 --vehicle name.toml"),
        Case::refused("map --vehicle key.toml", &["key.toml:1", "\\u{1b}[2J\\u{202e}"]),
        Case::refused("map --vehicle effect.toml", &["effect.toml:"]),
        Case::refused(
            "map --vehicle comment.toml",
            &["comment.toml:", "\\u{1b}[2J\\u{202e}\\u{7}"],
        ),
        Case::refused("simulate --schedule table.csv", &["table.csv:1", "v_right\\u{1b}[2J"]),
        Case::refused("simulate --schedule cell.csv", &["cell.csv:2:2"]),
        Case::refused("odometry room.tum --gauge 1 --tracks rec/tracks.csv", &["room.tum:1:8"]),
        Case::ended("inspect rec"),
        Case::ended("odometry rec --gauge 0.5"),
        Case::refused("map --vehicle \\e[2J", &["--vehicle", "\\u{1b}[2J"]),
        Case::refused("map --effect \\e[2J", &["--effect"]),
        Case::refused("map --grid \\e[2J", &["--grid"]),
        Case::refused("inspect \\e[2J", &["\\u{1b}[2J"]),
        Case::refused("effects \\e[2J", &["\\u{1b}[2J"]),
        Case::refused("\\e[2J", &["subcommand"]),
        Case::refused("plan --diagnosis \\e[2J", &["\\u{1b}[2J"]),
        Case::refused("odometry rec --gauge 0.5 --kinematics \\e[2J", &["\\u{1b}[2J"]),
    ];
    check(&place, &all);
}

/// Results of two processes in one folder would mix: the second is refused. What a process that was
/// killed left half written goes when the next one writes there.
#[test]
fn one_process_at_a_time_writes_into_a_folder() {
    let place = Workplace::new();
    let robot = vehicle();
    std::fs::create_dir(place.path().join("out")).expect("a folder");
    let folder = std::fs::File::open(place.path().join("out")).expect("a folder");
    folder.lock().expect("locked");
    let run = place.run(&format!("map --grid 3 --vehicle {robot} --out out"));
    assert_eq!(run.status, 1, "{}", run.stderr);
    assert!(run.stderr.contains("out: another process of trackdyn writes there"), "{}", run.stderr);
    drop(folder);
    let [old, new] = ["out/.trackdyn-old", "out/.trackdyn-new"];
    place.write(old, "half");
    place.write(new, "half");
    let long_ago = std::time::SystemTime::now() - std::time::Duration::from_secs(3600);
    let file = std::fs::File::options().write(true).open(place.path().join(old));
    file.and_then(|file| file.set_modified(long_ago)).expect("an old file");
    let run = place.run(&format!("map --grid 3 --vehicle {robot} --out out"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    let files = place.files();
    assert!(!files.iter().any(|file| file.ends_with(".trackdyn-old")), "{files:?}");
    // Another process may be writing this one.
    assert!(files.iter().any(|file| file.ends_with(".trackdyn-new")), "{files:?}");
}

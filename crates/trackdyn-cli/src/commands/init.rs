//! `trackdyn init`: a vehicle file from a few measured numbers.

mod questions;

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::{finite, pair, positive};
use crate::shell::path;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use questions::Questions;
use std::io::{IsTerminal, stdin};
use std::path::PathBuf;
use trackdyn::{RunningGear, VehicleSketch};

/// Options of `trackdyn init`.
#[derive(Args)]
pub struct Options {
    /// Vehicle file to write
    #[arg(default_value = "my-robot.toml")]
    file: PathBuf,
    /// Name of the vehicle [default: that of the file]
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Distance in m between the middles of the left and the right belts or tyres
    #[arg(long, value_name = "M", value_parser = positive)]
    gauge: Option<f64>,
    /// Tracks: contact length on flat ground and width of a belt, m
    #[arg(long, value_name = "LENGTH,WIDTH", value_parser = pair, conflicts_with = "wheels")]
    track: Option<[f64; 2]>,
    /// Wheels: contact length and width of a tyre, m; with --axles
    #[arg(long, value_name = "LENGTH,WIDTH", value_parser = pair)]
    wheels: Option<[f64; 2]>,
    /// Wheels: axles in m forward of the middle, such as 0.256,-0.256
    #[arg(long, value_name = "FORWARD,...", value_parser = finite, value_delimiter = ',',
          allow_hyphen_values = true, conflicts_with = "track")]
    axles: Vec<f64>,
    /// Mass in kg, with all that it carries
    #[arg(long, value_name = "KG", value_parser = positive)]
    mass: Option<f64>,
    /// Centre of gravity in m from the centre of the contact area: right, forward (x, y of the
    /// vehicle file; not the order of ROS, in which it is forward, left) [default: there]
    #[arg(long, value_name = "RIGHT,FORWARD", value_parser = pair, allow_hyphen_values = true)]
    cog: Option<[f64; 2]>,
    /// Friction coefficients across and along the tracks [default: 0.8,0.8, as a guess]
    #[arg(long, value_name = "ACROSS,ALONG", value_parser = pair)]
    friction: Option<[f64; 2]>,
    /// Belt travel in m per radian of the joints: a remark in the file, and the option in logs
    #[arg(long, value_name = "M", value_parser = positive)]
    wheel_radius: Option<f64>,
    /// Replace a file that is there
    #[arg(long)]
    force: bool,
}

/// Takes the options, asks for what is missing, and writes the file.
pub fn run(options: &Options) -> Outcome {
    let file = &options.file;
    if file.exists() && !options.force {
        return Err(format!(
            "{}: is there already: expected another file, or --force to replace it",
            file.display()
        )
        .into());
    }
    let missing = options.missing();
    let numbers = if missing.is_empty() {
        options.numbers()
    } else if stdin().is_terminal() {
        options.asked(&mut Questions::of_terminal())?
    } else {
        let missing = missing.join(", ");
        return Err(format!("expected {missing}, or a terminal to ask for it on").into());
    };
    let Some(sketch) = numbers.sketch() else { unreachable!("nothing is missing") };
    sketch.write(file)?;
    say(format_args!("wrote {}", file.display()));
    let file = path(file);
    let radius = sketch.wheel_radius.map_or_else(String::new, |of| format!(" --wheel-radius {of}"));
    show(&format!(
        "go on with\n  trackdyn map --vehicle {file}\n  trackdyn inspect LOG{radius} --vehicle \
         {file}\n"
    ))?;
    Ok(Exit::Done)
}

/// What was measured.
#[derive(Clone)]
struct Numbers {
    name: String,
    gauge: Option<f64>,
    mass: Option<f64>,
    running_gear: Option<RunningGear>,
    cog: Option<[f64; 2]>,
    friction: Option<[f64; 2]>,
    wheel_radius: Option<f64>,
}

impl Numbers {
    /// The vehicle; none where a number is missing.
    fn sketch(self) -> Option<VehicleSketch> {
        let Self { name, cog, friction, wheel_radius, .. } = self;
        let sketch = VehicleSketch::new(&name, self.gauge?, self.mass?, self.running_gear?);
        Some(VehicleSketch { cog, friction, wheel_radius, ..sketch })
    }
}

impl Options {
    /// Options without which there is no vehicle.
    fn missing(&self) -> Vec<&'static str> {
        let is_wheeled = self.is_wheeled();
        let options = [
            ("--gauge", self.gauge.is_none()),
            ("--track or --wheels", self.track.is_none() && !is_wheeled),
            ("--wheels", is_wheeled && self.wheels.is_none()),
            ("--axles", is_wheeled && self.axles.is_empty()),
            ("--mass", self.mass.is_none()),
        ];
        options.into_iter().filter_map(|(name, is_missing)| is_missing.then_some(name)).collect()
    }

    fn is_wheeled(&self) -> bool {
        self.wheels.is_some() || !self.axles.is_empty()
    }

    fn numbers(&self) -> Numbers {
        let stem = self.file.file_stem().unwrap_or_default().to_string_lossy();
        let belts = self
            .track
            .map(|[contact_length, belt_width]| RunningGear::Track { contact_length, belt_width });
        let wheels = self.wheels.filter(|_| !self.axles.is_empty());
        let wheels = wheels.map(|[contact_length, width]| RunningGear::Wheels {
            contact_length,
            width,
            axles: self.axles.clone(),
        });
        Numbers {
            name: self.name.clone().unwrap_or_else(|| stem.into_owned()),
            gauge: self.gauge,
            mass: self.mass,
            running_gear: belts.or(wheels),
            cog: self.cog,
            friction: self.friction,
            wheel_radius: self.wheel_radius,
        }
    }

    /// The numbers with what is missing by the answers to questions.
    fn asked(&self, ask: &mut Questions) -> Result<Numbers, String> {
        let mut numbers = self.numbers();
        if numbers.gauge.is_none() {
            let question =
                "gauge in m, between the middles of the left and the right belts or tyres";
            numbers.gauge = Some(ask.until(question, positive)?);
        }
        if numbers.running_gear.is_none() {
            numbers.running_gear = Some(if self.is_wheeled() || ask.choice("tracks", "wheels")? {
                let question = "contact length and width of a tyre in m, such as 0.1,0.12";
                let [contact_length, width] = ask.unless(self.wheels, question, pair)?;
                let question = "axles in m forward of the middle, such as 0.256,-0.256";
                let known = Some(self.axles.clone()).filter(|axles| !axles.is_empty());
                let axles = ask.unless(known, question, list)?;
                RunningGear::Wheels { contact_length, width, axles }
            } else {
                let question =
                    "contact length on flat ground and width of a belt in m, such as 0.7,0.15";
                let [contact_length, belt_width] = ask.until(question, pair)?;
                RunningGear::Track { contact_length, belt_width }
            });
        }
        if numbers.mass.is_none() {
            numbers.mass = Some(ask.until("mass in kg, with all that it carries", positive)?);
        }
        if numbers.cog.is_none() {
            let question = "centre of gravity in m right and forward of the centre of the contact \
                            area, such as -0.015,0.04 (empty: not measured)";
            numbers.cog = ask.optional(question, pair)?;
        }
        if numbers.wheel_radius.is_none() {
            let question = "belt travel in m per radian of the joints (empty: not measured)";
            numbers.wheel_radius = ask.optional(question, positive)?;
        }
        Ok(numbers)
    }
}

/// Numbers, separated by commas.
fn list(text: &str) -> Result<Vec<f64>, String> {
    text.split(',').map(|number| finite(number.trim())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        options: Options,
    }

    fn asked(line: &str, answers: &str) -> (Result<Numbers, String>, String) {
        let words = std::iter::once("init").chain(line.split_whitespace());
        let Line { options } = Line::parse_from(words);
        let mut said = Vec::new();
        let mut answers = answers.as_bytes();
        let numbers = options.asked(&mut Questions::new(&mut answers, &mut said));
        (numbers, String::from_utf8(said).expect("text"))
    }

    #[test]
    fn what_is_missing_is_asked_for_until_it_is_answered() {
        let answers = "wide\n-1\n0.555\nw\n0.1,0.12\n0.256;-0.256\n0.256,-0.256\n75\n\n0.165\n";
        let (numbers, said) = asked("husky.toml", answers);
        let sketch = numbers.expect("answers").sketch().expect("all of them");
        let axles = vec![0.256, -0.256];
        let wheels = RunningGear::Wheels { contact_length: 0.1, width: 0.12, axles };
        let expected = VehicleSketch::new("husky", 0.555, 75.0, wheels);
        assert_eq!(sketch, VehicleSketch { wheel_radius: Some(0.165), ..expected });
        assert!(said.contains("wide: expected a number above zero"), "{said}");
        assert!(said.contains("0.256;-0.256: expected a finite number"), "{said}");
    }

    #[test]
    fn what_is_given_is_not_asked_for() {
        let line = "--gauge 0.42 --track 0.7,0.15 --cog 0,0.1 --wheel-radius 0.1";
        let (numbers, said) = asked(line, "258\n");
        let sketch = numbers.expect("answers").sketch().expect("all of them");
        assert_eq!((sketch.mass, sketch.cog), (258.0, Some([0.0, 0.1])));
        assert_eq!(said.matches(": ").count(), 1, "{said}");
    }

    #[test]
    fn answers_that_end_are_an_error() {
        let (numbers, _) = asked("--gauge 0.42 --track 0.7,0.15", "");
        let error = numbers.err().expect("no mass");
        assert!(error.contains("mass in kg"), "{error}");
    }
}

//! What the command line accepts, and which command does it.

use crate::commands;
use crate::commands::Outcome;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

/// Kinematics of tracked and skid-steer robots: simulate the ICRs of the tracks, check them, use
/// them.
#[derive(Parser)]
#[command(name = "trackdyn", version, max_term_width = 100)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

impl Arguments {
    /// Reads the command line of this process.
    ///
    /// # Errors
    /// Help or version where these were asked for, or what was expected.
    pub fn read() -> Result<Self, clap::Error> {
        let command = with_negative_numbers(Self::command());
        Self::from_arg_matches(&command.try_get_matches()?)
    }
}

/// An option takes what looks like a negative number for its value, and says what it expects in its
/// place.
fn with_negative_numbers(command: clap::Command) -> clap::Command {
    let command = command.mut_args(|arg| {
        let is_option = arg.get_action().takes_values() && !arg.is_positional();
        if is_option { arg.allow_negative_numbers(true) } else { arg }
    });
    command.mut_subcommands(with_negative_numbers)
}

/// The commands, one file each in `commands`.
#[derive(Subcommand)]
pub enum Command {
    /// Solve the stationary motion for every pair of track speeds: ICR map, kinematic parameters,
    /// picture
    Map(commands::map::Options),
    /// Evaluate the kinematics: track speeds to motion of the robot, or back
    Kinematics(commands::kinematics::Options),
    /// Drive a robot in time over a ground with any of the effects, and record it with realistic
    /// sensors
    Simulate(commands::simulate::Options),
    /// Follow a path with the path tracker: ideal differential drive against kinematic parameters
    Drive(commands::drive::Options),
    /// Replay a recording by dead reckoning with parameter sets and the ideal drive: errors, paths,
    /// picture
    Odometry(commands::odometry::Options),
    /// Recompute chi, e and the ICRs, and fail where they leave the tolerances of a reference file
    Check(commands::check::Options),
    /// Write kinematics, or a drive, as files of other programs: ROS 2, URDF, Gazebo, Foxglove
    Export(commands::export::Options),
    /// List the effects that a vehicle file or --effect can switch on
    Effects(commands::effects::Options),
    /// Write a vehicle file from a few measured numbers, asked for on a terminal or given
    Init(commands::init::Options),
    /// Judge a recording: what is there, what is missing, what looks wrong, and how to go on
    Inspect(commands::inspect::Options),
    /// Identify the kinematic parameters from a recording: spin test, genetic algorithm, least
    /// squares
    Identify(commands::identify::Options),
    /// Locate where a model and recordings differ, and say which physics was left out
    Diagnose(commands::diagnose::Options),
    /// Compare a simulator's recordings with the robot's: what differs, and what to set
    Compare(commands::compare::Options),
    /// Propose the driving that tells apart what a diagnosis could not
    Plan(commands::plan::Options),
    /// Prove the diagnosis on concealed physics: make sealed cases, run it on them, score its
    /// answers
    Trial(commands::trial::Options),
    /// Print completions for a shell
    Completions(commands::completions::Options),
    /// Print the manual page
    Man,
}

impl Command {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        match self {
            Self::Map(options) => commands::map::run(options),
            Self::Kinematics(options) => commands::kinematics::run(options),
            Self::Simulate(options) => commands::simulate::run(options),
            Self::Drive(options) => commands::drive::run(options),
            Self::Odometry(options) => commands::odometry::run(options),
            Self::Check(options) => commands::check::run(options),
            Self::Export(options) => commands::export::run(options),
            Self::Effects(options) => commands::effects::run(options),
            Self::Init(options) => commands::init::run(options),
            Self::Inspect(options) => commands::inspect::run(options),
            Self::Identify(options) => commands::identify::run(options),
            Self::Diagnose(options) => commands::diagnose::run(options),
            Self::Compare(options) => commands::compare::run(options),
            Self::Plan(options) => commands::plan::run(options),
            Self::Trial(options) => commands::trial::run(options),
            Self::Completions(options) => commands::completions::run(options, Arguments::command()),
            Self::Man => commands::man::run(Arguments::command()),
        }
    }
}

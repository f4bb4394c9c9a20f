//! Options of a diagnosis that a comparison has, too.

use super::count_within;
use clap::Args;
use std::path::PathBuf;
use trackdyn::{DiagnoseSettings, Error, HeldOut, MethodSettings, Resampling};

/// Heading of options in the help.
const BOOTSTRAP: &str = "Bootstrap";

/// How evidence is judged.
#[derive(Args)]
pub struct MethodOptions {
    /// Correct the yaw of the poses by the recording's gyroscope
    #[arg(long, help_heading = None::<&str>)]
    pub gyroscope: bool,
    /// Draws of the bootstrap behind the tests
    #[arg(long, help_heading = BOOTSTRAP, value_name = "N",
          default_value_t = Resampling::default().draws, value_parser = draws)]
    draws: usize,
    /// Seed of the bootstrap
    #[arg(long, help_heading = BOOTSTRAP, value_name = "N",
          default_value_t = Resampling::default().seed)]
    seed: u64,
    /// Numbers of the method that differ from their defaults: a table such as `[verdict]` with
    /// max_p = 0.001
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
}

impl MethodOptions {
    /// Options among these that only a recording of motion has, as they were given.
    pub fn given(&self) -> Option<String> {
        self.gyroscope.then(|| "--gyroscope".to_owned())
    }

    /// Draws and seed of the bootstrap.
    pub fn resampling(&self) -> Resampling {
        Resampling { draws: self.draws, seed: self.seed }
    }

    /// The numbers of the method.
    ///
    /// # Errors
    /// Those of [`MethodSettings::open`].
    pub fn method(&self) -> Result<MethodSettings, Error> {
        let method = self.settings.as_deref().map(MethodSettings::open).transpose()?;
        Ok(method.unwrap_or_default())
    }
}

fn draws(text: &str) -> Result<usize, String> {
    count_within(text, DiagnoseSettings::DRAWS_LIMITS)
}

/// The runs to judge a result on, as an option of this name says.
///
/// # Errors
/// A message that names the option and its value.
pub fn held_out(option: &str, given: Option<&str>) -> Result<HeldOut, String> {
    let Some(text) = given else { return Ok(HeldOut::default()) };
    text.parse().map_err(|error| format!("{option} {text}: {error}"))
}

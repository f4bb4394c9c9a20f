//! Kinematic parameters with their origin.

use crate::Error;
use std::path::Path;
use trackdyn_core::PerSide;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_core::output::{fingerprint, write_file};
use trackdyn_model::Kinematics;
use trackdyn_model::kinematics::{KinematicsFile, SeparationFile, Source};

/// Kinematic parameters of a robot, and where they come from (schema `trackdyn.kinematics/1`).
///
/// They come from [a map](crate::IcrMap::parameters), [a
/// recording](crate::Identification::parameters) or a file, and go into [`crate::odometry()`],
/// [`crate::drive()`] and [`crate::export`].
#[derive(Clone, Debug)]
pub struct Parameters {
    document: Document,
    file: KinematicsFile,
}

impl Parameters {
    /// Reads and checks a kinematics file.
    ///
    /// # Errors
    /// [`Error::Document`], which names file, line and key; [`Error::SeparationAlone`].
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::from_document(Document::read(path.as_ref())?)
    }

    /// The parameters of a text that is at hand.
    ///
    /// # Errors
    /// [`Error::Document`], which names line and key; [`Error::SeparationAlone`].
    pub fn from_document(document: Document) -> Result<Self, Error> {
        if SeparationFile::is_schema_of(&document) {
            return Err(Error::SeparationAlone { name: document.name().to_owned() });
        }
        let file = KinematicsFile::from_document(&document)?;
        Ok(Self { document, file })
    }

    /// Parameters that were just computed, under the name of the file that they go into.
    pub(crate) fn of(name: &str, file: KinematicsFile) -> Self {
        Self { document: Document::new(name, file.to_toml()), file }
    }

    /// The file as given, or the name of the one that they go into.
    pub fn name(&self) -> &str {
        self.document.name()
    }

    /// The fingerprint of the text.
    pub fn fingerprint(&self) -> String {
        fingerprint(self.document.text().as_bytes())
    }

    /// Where the numbers come from.
    pub fn source(&self) -> &Source {
        &self.file.source
    }

    /// Name of the vehicle whose parameters they are.
    pub fn vehicle(&self) -> &str {
        &self.file.source.vehicle
    }

    /// All that the file says.
    pub fn file(&self) -> &KinematicsFile {
        &self.file
    }

    /// The text and its name.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The kinematic model with the parameters of the whole map.
    pub fn kinematics(&self) -> Kinematics {
        self.file.kinematics()
    }

    /// Whether other parts of the answer that they come from contradict them.
    pub fn is_doubtful(&self) -> bool {
        self.file.doubtful
    }

    /// The kinematic model at these track speeds, m/s.
    pub fn kinematics_at(&self, speed: PerSide<f64>) -> Kinematics {
        self.file.kinematics_at(speed)
    }

    /// Track speeds, m/s, for a forward speed (m/s) and a yaw rate (rad/s), and the model that
    /// gives them.
    pub fn track_speeds(&self, forward: f64, yaw_rate: f64) -> (PerSide<f64>, Kinematics) {
        self.file.track_speeds(forward, yaw_rate)
    }

    /// Writes the file.
    ///
    /// # Errors
    /// [`Error::Output`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        Ok(write_file(path.as_ref(), self.document.text().as_bytes())?)
    }
}

/// Where the numbers of a kinematics file come from, be it that the distance of the ICRs is all it
/// holds.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn source_of(document: &Document) -> Result<Source, DocumentError> {
    if SeparationFile::is_schema_of(document) {
        return SeparationFile::from_document(document).map(|file| file.source);
    }
    KinematicsFile::from_document(document).map(|file| file.source)
}

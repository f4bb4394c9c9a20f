//! A vehicle with the physics that its model has.

use crate::{Error, preset};
use std::path::Path;
use trackdyn_core::document::Document;
use trackdyn_core::output::{fingerprint, write_file};
use trackdyn_model::{ActiveEffect, Effects, Model, VehicleFile};

/// A vehicle, and the effects that its model has beyond the base model (schema
/// `trackdyn.vehicle/1`).
///
/// ```
/// let robot = trackdyn::Vehicle::auriga_alpha().with_effect("load-transfer:cog_height_m=0.15")?;
/// assert_eq!(robot.gauge(), 0.42);
/// # Ok::<(), trackdyn::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Vehicle {
    file: VehicleFile,
}

impl Vehicle {
    /// Reads and checks a vehicle file.
    ///
    /// # Errors
    /// [`Error::Document`], which names file, line and key.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::from_document(&Document::read(path.as_ref())?)
    }

    /// The vehicle of a file, or of a name: a file that is there counts first. The names are
    /// [`Vehicle::names`].
    ///
    /// ```
    /// assert_eq!(trackdyn::Vehicle::choose("husky-a200")?.gauge(), 0.555);
    /// # Ok::<(), trackdyn::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoVehicle`] for what is neither; [`Error::Document`] for a file that is not
    /// accepted, or a path at which there is none.
    pub fn choose(choice: impl AsRef<Path>) -> Result<Self, Error> {
        let path = choice.as_ref();
        let named = || path.to_str().and_then(preset::named);
        if !path.is_file() {
            if let Some(file) = named() {
                return Ok(Self { file });
            }
            let is_path = path.extension().is_some() || path.components().count() > 1;
            if !is_path {
                return Err(Error::NoVehicle { choice: path.display().to_string() });
            }
        }
        Self::open(path)
    }

    /// The names of the vehicles that need no file.
    pub fn names() -> impl Iterator<Item = &'static str> {
        preset::names()
    }

    /// Name of the vehicle that counts where none is chosen.
    pub const DEFAULT: &'static str = preset::DEFAULT;

    /// The vehicle of a text that is at hand.
    ///
    /// # Errors
    /// [`Error::Document`], which names line and key.
    pub fn from_document(document: &Document) -> Result<Self, Error> {
        Ok(Self { file: VehicleFile::from_document(document)? })
    }

    /// Auriga-alpha, the vehicle of Martínez et al. (2005).
    pub fn auriga_alpha() -> Self {
        Self { file: VehicleFile::auriga_alpha() }
    }

    /// With this effect in place of the one that it may have: `id`, or `id:parameter=value,...`.
    ///
    /// # Errors
    /// [`Error::Effect`] for what the catalogue does not have, [`crate::effects()`].
    pub fn with_effect(self, text: &str) -> Result<Self, Error> {
        Ok(self.with_active(text.parse()?))
    }

    /// With this effect in place of the one that it may have.
    pub fn with_active(mut self, effect: ActiveEffect) -> Self {
        self.file.effects.insert(effect);
        self
    }

    /// With these effects and no others.
    pub fn with_effects(mut self, effects: Effects) -> Self {
        self.file.effects = effects;
        self
    }

    /// With its inertia in the model, as motion in time needs it; `false`: the robot is at its
    /// stationary motion at once.
    pub fn with_inertia(mut self, inertia: bool) -> Self {
        let effects = self.file.effects;
        self.file.effects = if inertia { effects.with_inertia() } else { effects.quasi_static() };
        self
    }

    /// With another centre of gravity, m from the centre of the contact area: right, forward. What
    /// the file says of its uncertainty is dropped, for that is of the former one.
    ///
    /// # Errors
    /// [`Error::CentreOfGravity`] where the vehicle would tip over.
    pub fn with_cog(mut self, cog: [f64; 2]) -> Result<Self, Error> {
        self.file.vehicle.cog = cog;
        self.file.vehicle.uncertainty.cog = None;
        self.file.vehicle.check().map_err(Error::CentreOfGravity)?;
        Ok(self)
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.file.vehicle.name
    }

    /// Distance between the track centre-lines, m.
    pub fn gauge(&self) -> f64 {
        self.file.vehicle.gauge
    }

    /// The effects that its model has.
    pub fn effects(&self) -> &Effects {
        &self.file.effects
    }

    /// All that its file says.
    pub fn file(&self) -> &VehicleFile {
        &self.file
    }

    /// The balance of forces on it.
    pub fn model(&self) -> Model {
        self.file.model()
    }

    /// The text of its file: equal vehicles of one source have equal texts.
    pub fn to_toml(&self) -> String {
        self.file.to_toml()
    }

    /// The fingerprint of that text without its source: equal vehicles have the same.
    pub fn fingerprint(&self) -> String {
        let file = VehicleFile { source: None, ..self.file.clone() };
        fingerprint(file.to_toml().as_bytes())
    }

    /// Writes its file.
    ///
    /// # Errors
    /// [`Error::Output`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        Ok(write_file(path.as_ref(), self.to_toml().as_bytes())?)
    }
}

impl From<VehicleFile> for Vehicle {
    fn from(file: VehicleFile) -> Self {
        Self { file }
    }
}

/// Refuses an effect that is given twice.
///
/// # Errors
/// [`Error::EffectTwice`].
pub fn refuse_repeated(effects: &[ActiveEffect]) -> Result<(), Error> {
    match repeated(effects) {
        Some(place) => Err(Error::EffectTwice { id: effects[place].card().id }),
        None => Ok(()),
    }
}

/// Place of the first effect that is there before it already.
pub(crate) fn repeated(effects: &[ActiveEffect]) -> Option<usize> {
    let is_there = |place: &usize| {
        effects[..*place].iter().any(|other| other.card().id == effects[*place].card().id)
    };
    (0..effects.len()).find(is_there)
}

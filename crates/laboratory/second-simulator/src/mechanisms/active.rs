//! Mechanisms that are switched on.

use super::{MECHANISMS, from_values, sheet_of};
use crate::error::Error;
use crate::form::Form;
use crate::mechanism::Mechanism;
use crate::sheet::Sheet;

/// Key of the number of a drawn form, beside those of the parameters.
const FORM: &str = "form";

/// A mechanism with the values of its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ActiveMechanism {
    index: usize,
    values: Vec<f64>,
    form: Form,
}

impl ActiveMechanism {
    /// The mechanism `id` with `settings` (key, value) and the typical size of every parameter that
    /// they leave out.
    ///
    /// # Errors
    /// Unknown mechanism or parameter, one that is given twice, or a value outside its physical
    /// range.
    pub fn new(id: &str, settings: &[(&str, f64)]) -> Result<Self, Error> {
        let index = MECHANISMS
            .iter()
            .position(|sheet| sheet.id == id)
            .ok_or_else(|| Error::UnknownMechanism { id: id.to_owned(), known: ids() })?;
        let sheet = &MECHANISMS[index];
        let mut values = vec![None; sheet.parameters.len()];
        for &(key, value) in settings {
            let place = sheet.parameters.iter().position(|parameter| parameter.key == key);
            let place =
                place.ok_or_else(|| Error::UnknownParameter { sheet, key: key.to_owned() })?;
            let parameter = &sheet.parameters[place];
            let [low, high] = parameter.range;
            if !(low..=high).contains(&value) {
                return Err(Error::OutOfRange { sheet, parameter, value });
            }
            if values[place].replace(value).is_some() {
                return Err(Error::RepeatedParameter { sheet, parameter });
            }
        }
        let values = values.into_iter().zip(sheet.parameters);
        let values = values.map(|(value, parameter)| value.unwrap_or(parameter.typical)).collect();
        Ok(Self { index, values, form: Form::Plain })
    }

    /// The mechanism of the name of a catalogue's effect, by the parameters of the effect: key,
    /// value and default. Where the law here has a constant instead, the value has to be the
    /// default.
    ///
    /// # Errors
    /// [`Error::Constant`]; those of [`ActiveMechanism::new`].
    pub fn of_effect<'a>(
        id: &str,
        parameters: impl IntoIterator<Item = (&'a str, f64, f64)>,
    ) -> Result<Self, Error> {
        let sheet = sheet_of(id);
        let has = |key: &str| sheet.is_none_or(|sheet| sheet.parameter(key).is_some());
        let mut settings = Vec::new();
        for (key, value, default) in parameters {
            if has(key) {
                settings.push((key, value));
            } else if value != default {
                return Err(Error::Constant { id: id.to_owned(), key: key.to_owned(), value });
            }
        }
        Self::new(id, &settings)
    }

    /// With this form of its law.
    ///
    /// # Errors
    /// A drawn form of a mechanism that has one law only.
    pub fn with(self, form: Form) -> Result<Self, Error> {
        if form != Form::Plain && self.sheet().family.is_none() {
            return Err(Error::NoFamily { sheet: self.sheet() });
        }
        Ok(Self { form, ..self })
    }

    /// Which form of its law it is.
    pub fn form(&self) -> Form {
        self.form
    }

    /// Its sheet.
    pub fn sheet(&self) -> &'static Sheet {
        &MECHANISMS[self.index]
    }

    /// Parameter values in the order of the sheet.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Place in the list of mechanisms, by which they act in turn.
    pub(crate) fn index(&self) -> usize {
        self.index
    }

    /// The mechanism itself, at rest.
    pub(crate) fn mechanism(&self) -> Box<dyn Mechanism> {
        from_values(self.index, &self.values, self.form)
    }
}

/// The ids of all mechanisms, separated by commas.
fn ids() -> String {
    MECHANISMS.iter().map(|sheet| sheet.id).collect::<Vec<_>>().join(", ")
}

/// Reads `id` or `id:key=value,key=value`; `form=NUMBER` among them draws the form of the law.
impl std::str::FromStr for ActiveMechanism {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let malformed = || Error::Malformed(text.to_owned());
        let (id, settings) = match text.split_once(':') {
            Some((id, settings)) => (id, settings.split(',').collect()),
            None => (text, Vec::new()),
        };
        let (mut form, mut values) = (Form::Plain, Vec::new());
        for setting in settings {
            let (key, value) = setting.split_once('=').ok_or_else(malformed)?;
            let (key, value) = (key.trim(), value.trim());
            if key == FORM {
                form = Form::Drawn(value.parse().map_err(|_| malformed())?);
            } else {
                values.push((key, value.parse().map_err(|_| malformed())?));
            }
        }
        Self::new(id.trim(), &values)?.with(form)
    }
}

/// `id:key=value,key=value`, which reads back.
impl std::fmt::Display for ActiveMechanism {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.sheet().id)?;
        for (k, (parameter, value)) in self.sheet().parameters.iter().zip(&self.values).enumerate()
        {
            write!(f, "{}{}={value}", if k == 0 { ':' } else { ',' }, parameter.key)?;
        }
        match self.form.number() {
            Some(number) => write!(f, ",{FORM}={number}"),
            None => Ok(()),
        }
    }
}

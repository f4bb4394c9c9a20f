//! A case with its answer and what the diagnosis said of it.

use crate::answer::{Answer, Concealed};
use crate::diagnosis::{Diagnosis, Missing, Status};
use crate::plan::Stratum;
use trackdyn_second_simulator::sheet_of;

/// What came back of a case.
#[derive(Clone, Debug, PartialEq)]
pub enum Reply {
    /// Its diagnosis.
    Diagnosed(Box<Diagnosis>),
    /// The process failed, or what it wrote cannot be read.
    Failed(String),
    /// It has not been run.
    Absent,
}

/// A case with its answer and what came back.
#[derive(Clone, Debug)]
pub struct Judged {
    /// What was concealed.
    pub answer: Answer,
    /// Effects of the class of constants by which the owner's vehicle file is off.
    pub owner_errors: Vec<&'static str>,
    /// Sizes of the case's files (bytes) and their stamps (s): what the outside of a case shows.
    pub outside: Vec<f64>,
    /// What came back.
    pub reply: Reply,
}

impl Judged {
    /// The diagnosis; none where the process failed.
    pub fn diagnosis(&self) -> Option<&Diagnosis> {
        match &self.reply {
            Reply::Diagnosed(diagnosis) => Some(diagnosis),
            Reply::Failed(_) | Reply::Absent => None,
        }
    }

    /// Whether the diagnosis says so in a word.
    pub fn says(&self, status: Status) -> bool {
        self.diagnosis().is_some_and(|diagnosis| diagnosis.status == status)
    }

    /// The concealed effect of a case that has one, of the catalogue.
    pub fn only(&self) -> Option<&Concealed> {
        match self.answer.concealed.as_slice() {
            [only] if only.in_catalogue => Some(only),
            _ => None,
        }
    }

    /// Whether an effect is truly there: concealed, an error of an instrument, or of the vehicle
    /// file.
    pub fn is_true(&self, effect: &str) -> bool {
        self.answer.concealed.iter().any(|concealed| concealed.mechanism == effect)
            || self.is_known_error(effect)
    }

    /// Whether it is an error of an instrument or of the vehicle file, which is right to name and
    /// no physics of the trial.
    fn is_known_error(&self, effect: &str) -> bool {
        self.answer.shown_errors().iter().any(|error| error.mechanism == effect)
            || self.owner_errors.contains(&effect)
    }

    /// Whether something is named of which nothing is true.
    pub fn claims_falsely(&self) -> bool {
        self.claims().iter().any(|claim| !claim.members().iter().any(|m| self.is_true(m)))
    }

    /// Whether a law of forces or of the drive is named that is not there, be it in a set with what
    /// is true.
    pub fn names_absent_law(&self) -> bool {
        self.claims().iter().any(|claim| self.has_absent_law(claim))
    }

    /// Whether one law of forces or of the drive that is not there is named by itself.
    pub fn names_absent_law_alone(&self) -> bool {
        let mut alone = self.claims().into_iter().filter(|claim| claim.members().len() == 1);
        alone.any(|claim| self.has_absent_law(claim))
    }

    fn has_absent_law(&self, claim: &Missing) -> bool {
        let is_law = |id: &str| {
            sheet_of(id).is_none_or(|sheet| !sheet.is_constant() && !sheet.is_instrument())
        };
        claim.members().iter().any(|member| is_law(member) && !self.is_true(member))
    }

    /// Whether an effect is named and nothing beside it, nor any absent law in a set with an error
    /// of an instrument or of the vehicle file.
    pub fn names_strictly(&self, effect: &str) -> bool {
        self.names_exactly(&[effect]) && !self.names_absent_law()
    }

    /// Letters of the symmetries that all that is truly there breaks: what is concealed, and known
    /// errors.
    pub fn truly_broken(&self) -> Vec<String> {
        let errors = self.answer.shown_errors();
        let errors = errors.iter().map(|error| error.mechanism.as_str());
        let known = errors.chain(self.owner_errors.iter().copied());
        let sheets = known.filter_map(sheet_of);
        let letters =
            sheets.flat_map(|sheet| sheet.breaks).map(|broken| broken.letter().to_string());
        self.answer.concealed.iter().flat_map(|c| c.breaks.clone()).chain(letters).collect()
    }

    /// What is named, without what is only an error of instruments or of the vehicle file.
    pub fn physics(&self) -> Vec<&Missing> {
        let concealed = |m: &str| self.answer.concealed.iter().any(|c| c.mechanism == m);
        self.claims()
            .into_iter()
            .filter(|claim| {
                let members = claim.members();
                members.iter().any(|m| concealed(m))
                    || !members.iter().any(|m| self.is_known_error(m))
            })
            .collect()
    }

    /// Whether an effect is named, and nothing beside it.
    pub fn names_exactly(&self, effects: &[&str]) -> bool {
        let physics = self.physics();
        physics.len() == effects.len()
            && effects.iter().all(|effect| physics.iter().any(|claim| claim.members() == [*effect]))
    }

    /// The smallest set that is named and holds an effect.
    pub fn set_with(&self, effect: &str) -> Option<Vec<&str>> {
        let sets = self.claims().into_iter().map(Missing::members);
        sets.filter(|members| members.contains(&effect)).min_by_key(Vec::len)
    }

    /// Whether one effect is named by itself that is not an error of instruments or of the vehicle
    /// file.
    pub fn names_one_alone(&self) -> bool {
        self.physics().iter().any(|claim| claim.members().len() == 1)
    }

    /// Whether the vehicle or the class of constants alone is concerned: nothing that a recording
    /// shows beside constant ICRs.
    pub fn is_constant(&self) -> bool {
        self.only().is_some_and(Concealed::is_constant)
    }

    /// Whether its stratum is one of these.
    pub fn is_of(&self, strata: &[Stratum]) -> bool {
        strata.contains(&self.answer.stratum)
    }

    fn claims(&self) -> Vec<&Missing> {
        self.diagnosis().map_or(Vec::new(), |diagnosis| diagnosis.missing.iter().collect())
    }
}

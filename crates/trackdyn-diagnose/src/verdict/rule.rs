//! Rules that a claim must meet, in words with their numbers.

use super::Refusal;
use crate::settings::Settings;

/// A rule that every claim must meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Broken by [`Refusal::Weak`].
    BayesFactor,
    /// Broken by [`Refusal::Chance`].
    Chance,
    /// Broken by [`Refusal::MetOnce`].
    Blocks,
    /// Broken by [`Refusal::NotForetold`].
    HeldOutGain,
    /// Broken by [`Refusal::Unstable`].
    Stability,
    /// Broken by [`Refusal::WithinForm`].
    Form,
    /// Broken by [`Refusal::AtLimit`].
    PhysicalSize,
    /// Broken by [`Refusal::MayBeNone`].
    Interval,
    /// Broken by [`Refusal::Nowhere`].
    Place,
    /// Broken by [`Refusal::NearlyAsFiled`].
    FiledSize,
    /// Broken by [`Refusal::WithinFiled`].
    FiledLaws,
    /// Broken by [`Refusal::ConstantsAsFiled`].
    Constants,
    /// Broken by [`Refusal::TooMany`].
    Rivals,
}

impl Rule {
    /// All rules, in the order of the report.
    pub const ALL: [Self; 13] = [
        Self::Chance,
        Self::Blocks,
        Self::BayesFactor,
        Self::HeldOutGain,
        Self::Stability,
        Self::Form,
        Self::PhysicalSize,
        Self::Interval,
        Self::Place,
        Self::FiledSize,
        Self::FiledLaws,
        Self::Constants,
        Self::Rivals,
    ];

    /// Paths of the settings that it uses.
    pub fn settings(self) -> &'static [&'static str] {
        match self {
            Self::BayesFactor => &["verdict.min_ln_bayes_factor"],
            Self::Chance => &["verdict.max_p"],
            Self::Blocks => &["verdict.min_blocks"],
            Self::HeldOutGain => &["verdict.min_held_out_gain"],
            Self::Stability => &["verdict.min_stability"],
            Self::Form => &["verdict.max_form_error"],
            Self::PhysicalSize | Self::Interval | Self::Place => &[],
            Self::FiledSize => &["verdict.min_filed_change"],
            Self::FiledLaws => &["answer.min_separation", "verdict.max_form_error"],
            Self::Constants => &["verdict.min_icr_difference"],
            Self::Rivals => &["answer.max_rivals"],
        }
    }

    /// Its condition, as the end of "it is claimed only where".
    pub fn sentence(self, settings: &Settings) -> String {
        let Settings { verdict, answer, .. } = settings;
        match self {
            Self::Chance => format!(
                "the probability of chance, among all that was looked at, is below {}",
                verdict.max_p
            ),
            Self::Blocks => format!(
                "not one event alone shows it: at least {} blocks of time do, or chance is less \
                 probable than that",
                verdict.min_blocks
            ),
            Self::BayesFactor => format!(
                "its ln Bayes factor against the best answer without it is at least {}",
                verdict.min_ln_bayes_factor
            ),
            Self::HeldOutGain => format!(
                "on blocks left out of the fit it gains at least {} standard errors",
                verdict.min_held_out_gain
            ),
            Self::Stability => {
                let share = percent(verdict.min_stability);
                format!("at least {share} of resampled recordings name the same")
            }
            Self::Form => format!(
                "its z, the root of what the misfit falls by, is at least {} of that of all laws \
                 together: the form of a law is known no better",
                percent(verdict.max_form_error)
            ),
            Self::PhysicalSize => "its sizes lie inside their physical ranges".to_owned(),
            Self::Interval => {
                "the 95 % interval of at least one of its sizes excludes the value at which it \
                 does nothing"
                    .to_owned()
            }
            Self::Place => {
                "the 95 % interval of its place, if it has one, is narrower than the area driven"
                    .to_owned()
            }
            Self::FiledSize => format!(
                "no law of the vehicle file explains it at a size within {} of the filed one",
                percent(verdict.min_filed_change)
            ),
            Self::FiledLaws => format!(
                "it stands {} standard deviations apart from what laws of the vehicle file leave \
                 whose sizes are off by {}",
                answer.min_separation,
                percent(verdict.max_form_error)
            ),
            Self::Constants => format!(
                "where constant ICRs stand for it, they differ from the vehicle file's by at \
                 least {} of the gauge",
                percent(verdict.min_icr_difference)
            ),
            Self::Rivals => format!(
                "at least one of the {} strongest rivals does worse when refitted in its place, \
                 or no other rival does as well",
                answer.max_rivals
            ),
        }
    }
}

impl Refusal {
    /// The rule that was broken.
    pub fn rule(&self) -> Rule {
        match self {
            Self::Weak { .. } => Rule::BayesFactor,
            Self::MetOnce { .. } => Rule::Blocks,
            Self::Chance { .. } => Rule::Chance,
            Self::NotForetold { .. } => Rule::HeldOutGain,
            Self::Unstable { .. } => Rule::Stability,
            Self::WithinForm { .. } => Rule::Form,
            Self::AtLimit { .. } => Rule::PhysicalSize,
            Self::TooMany { .. } => Rule::Rivals,
            Self::NearlyAsFiled { .. } => Rule::FiledSize,
            Self::WithinFiled { .. } => Rule::FiledLaws,
            Self::MayBeNone { .. } => Rule::Interval,
            Self::Nowhere { .. } => Rule::Place,
            Self::ConstantsAsFiled { .. } => Rule::Constants,
        }
    }
}

/// A share in percent, rounded to a hundredth of a percent.
fn percent(part: f64) -> String {
    format!("{} %", (1e4 * part).round() / 1e2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Settings;
    use toml::Value;

    #[test]
    fn every_setting_of_a_verdict_stands_in_a_rule() {
        let entries = Settings::entries().into_iter().map(|entry| entry.path);
        let stated: Vec<&str> =
            Rule::ALL.iter().flat_map(|rule| rule.settings()).copied().collect();
        let mut of_verdict = entries.filter(|path| path.starts_with("verdict."));
        assert_eq!(of_verdict.find(|path| !stated.contains(&&**path)), None);
    }

    /// A sentence changes with each of its settings, and with no other.
    #[test]
    fn a_rule_says_the_numbers_that_it_goes_by() {
        let defaults = Settings::default();
        for entry in Settings::entries() {
            let mut settings = defaults.clone();
            let other = match &entry.default {
                Value::Float(value) => Value::Float(0.5 * value),
                Value::Integer(value) => Value::Integer(value + 1),
                _ => continue,
            };
            if settings.set(&entry.path, &other).is_err() {
                continue;
            }
            for rule in Rule::ALL {
                let changes = rule.sentence(&settings) != rule.sentence(&defaults);
                let is_told = rule.settings().contains(&&*entry.path);
                assert_eq!(changes, is_told, "{rule:?}, {}", entry.path);
            }
        }
    }
}

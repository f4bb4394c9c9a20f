//! Why something is not claimed.

use crate::hypothesis::Unknown;
use crate::uncertainty::Interval;
use std::fmt;
use trackdyn_core::rounding::decimals;
use trackdyn_model::EffectId;

/// Why an effect is not claimed, with the value found and the value needed. Its text is a sentence
/// without the full stop.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refusal {
    /// The ln Bayes factor against the best alternative is too small.
    Weak {
        /// Logarithm of the Bayes factor.
        ln_bayes_factor: f64,
        /// Least value needed.
        needed: f64,
    },
    /// Strong, but shown by so few blocks of time that any single event would look alike.
    MetOnce {
        /// Effective number of blocks that show it.
        blocks: f64,
        /// Least number needed where p is not small.
        needed: f64,
        /// Family-wise p value.
        p: f64,
    },
    /// The best of all tested candidates may be as good by chance.
    Chance {
        /// Family-wise p value.
        p: f64,
        /// Below this it would be claimed.
        needed: f64,
    },
    /// Its cross-validated gain is too small.
    NotForetold {
        /// Gain of log-likelihood on blocks left out of the fit.
        gain: f64,
        /// Its standard error.
        error: f64,
        /// Standard errors needed.
        needed: f64,
    },
    /// Bootstrap recordings too often name another effect.
    Unstable {
        /// Share of them that name it.
        share: f64,
        /// Least share needed.
        needed: f64,
    },
    /// Errors in the form of the other laws may be as large.
    WithinForm {
        /// √ of the decrease of chi-squared by it.
        z: f64,
        /// Least value needed: a share of that by all laws.
        needed: f64,
    },
    /// A size ended at the limit of its physical range.
    AtLimit {
        /// The size.
        size: Unknown,
        /// Its value.
        value: f64,
    },
    /// So many effects explain it as well that not all were refitted.
    TooMany {
        /// Their number.
        effects: usize,
        /// How many were refitted.
        refitted: usize,
    },
    /// An effect of the vehicle file explains it at nearly the filed size.
    NearlyAsFiled {
        /// That effect.
        effect: EffectId,
        /// Largest change of its sizes, as share of the filed ones.
        change: f64,
        /// Least share needed.
        needed: f64,
    },
    /// Laws of the vehicle file with slightly other sizes may cause it.
    WithinFiled {
        /// These laws; one occurs as often as it has variants.
        laws: Vec<EffectId>,
        /// Its separation from them, standard deviations.
        apart: f64,
        /// Least separation needed.
        needed: f64,
    },
    /// The intervals of all its sizes include the neutral size.
    MayBeNone {
        /// Interval of the first of them.
        interval: Interval,
    },
    /// The interval of a place, or of a time, is wider than what was driven.
    Nowhere {
        /// The interval.
        interval: Interval,
        /// Half width needed: half of what was driven.
        needed: f64,
    },
    /// Constant ICRs are nearly those of the vehicle file.
    ConstantsAsFiled {
        /// Largest difference, m.
        largest: f64,
        /// Least difference needed, as share of the gauge.
        needed: f64,
    },
}

impl Refusal {
    /// Whether numbers that an effect needs speak against it, and not what it explains: another one
    /// may explain that with possible numbers.
    pub fn is_of_numbers(&self) -> bool {
        matches!(self, Self::AtLimit { .. } | Self::MayBeNone { .. } | Self::Nowhere { .. })
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Weak { ln_bayes_factor, needed } => {
                write!(f, "ln Bayes factor {ln_bayes_factor:.1}, below {needed}")
            }
            Self::MetOnce { blocks, needed, p } => write!(
                f,
                "may have happened once: {blocks:.1} blocks of time show it, {needed} are needed \
                 where p = {p:.3}"
            ),
            Self::Chance { p, needed } => {
                write!(f, "may be chance: family-wise p = {p:.3}, not below {needed}")
            }
            Self::NotForetold { gain, error, needed } => write!(
                f,
                "gain on held-out blocks {gain:.1} is less than {needed} standard errors of \
                 {error:.1}"
            ),
            Self::Unstable { share, needed } => write!(
                f,
                "named in {:.0} % of resampled recordings, {:.0} % are needed",
                100.0 * share,
                100.0 * needed
            ),
            Self::WithinForm { z, needed } => write!(
                f,
                "{z:.1} standard deviations are no more than the {needed:.1} that the form of the \
                 other laws may leave"
            ),
            Self::AtLimit { size, value } => {
                write!(f, "{} = {value} lies at the limit of what is physical", key(*size))
            }
            Self::TooMany { effects, refitted } => {
                write!(f, "{effects} effects explain it as well, of which {refitted} were refitted")
            }
            Self::NearlyAsFiled { effect, change, needed } => write!(
                f,
                "{effect} of the vehicle file explains it {:.0} % off its filed size, less than \
                 {:.0} %",
                100.0 * change,
                100.0 * needed
            ),
            Self::WithinFiled { laws, apart, needed } => {
                let names: Vec<&str> = laws.iter().map(|law| law.name()).collect();
                let names = names.join(" and ");
                write!(
                    f,
                    "{apart:.1} standard deviations, less than {needed}, from what {names} of a \
                     slightly other size may leave"
                )
            }
            Self::MayBeNone { interval } => {
                write!(f, "the 95 % interval of {} includes no effect", Bounds(interval))
            }
            Self::Nowhere { interval, needed } => write!(
                f,
                "the 95 % interval of {} is wider than the {:.1} driven",
                Bounds(interval),
                2.0 * needed
            ),
            Self::ConstantsAsFiled { largest, needed } => write!(
                f,
                "ICRs differ from the vehicle file's by {:.1} mm, less than {:.0} % of the gauge",
                1e3 * largest,
                100.0 * needed
            ),
        }
    }
}

/// Name of a parameter in files.
fn key(of: Unknown) -> &'static str {
    of.parameter().map_or("a number", |parameter| parameter.key)
}

/// A parameter with the ends of its interval, as text.
struct Bounds<'a>(&'a Interval);

impl fmt::Display for Bounds<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Interval { unknown, low, high, .. } = *self.0;
        let digits = decimals((high - low) / 2.0);
        write!(f, "{} ({low:.digits$} to {high:.digits$})", key(unknown))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_says_its_numbers() {
        let effect = EffectId::of("yaw-inertia").expect("an effect");
        let size = Unknown::Effect(effect, 0);
        let key = effect.card().parameters[0].key;
        let laws = vec![effect, EffectId::of("slope").expect("an effect")];
        let said = [
            (
                Refusal::Weak { ln_bayes_factor: 3.12, needed: 5.0 },
                "ln Bayes factor 3.1, below 5".to_owned(),
            ),
            (
                Refusal::NotForetold { gain: 2.0, error: 1.5, needed: 2.0 },
                "gain on held-out blocks 2.0 is less than 2 standard errors of 1.5".to_owned(),
            ),
            (
                Refusal::Unstable { share: 0.815, needed: 0.9 },
                "named in 82 % of resampled recordings, 90 % are needed".to_owned(),
            ),
            (
                Refusal::AtLimit { size, value: 0.25 },
                format!("{key} = 0.25 lies at the limit of what is physical"),
            ),
            (
                Refusal::NearlyAsFiled { effect, change: 0.04, needed: 0.1 },
                "yaw-inertia of the vehicle file explains it 4 % off its filed size, less than 10 %"
                    .to_owned(),
            ),
            (
                Refusal::MayBeNone {
                    interval: Interval { unknown: size, value: 0.01, low: -0.002, high: 0.022 },
                },
                format!("the 95 % interval of {key} (-0.002 to 0.022) includes no effect"),
            ),
            (
                Refusal::WithinFiled { laws, apart: 1.0, needed: 3.0 },
                "1.0 standard deviations, less than 3, from what yaw-inertia and slope of a \
                 slightly other size may leave"
                    .to_owned(),
            ),
            (
                Refusal::ConstantsAsFiled { largest: 0.0042, needed: 0.01 },
                "ICRs differ from the vehicle file's by 4.2 mm, less than 1 % of the gauge"
                    .to_owned(),
            ),
        ];
        for (refusal, expected) in said {
            assert_eq!(refusal.to_string(), expected);
        }
    }
}

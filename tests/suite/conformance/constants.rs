//! Numbers that decide an answer of the diagnosis are settings: what stays a constant is no choice.

use super::crates::all;
use std::collections::BTreeSet;

/// Modules of `trackdyn-estimate` whose constants are those of `identify` and `odometry`. From them
/// the diagnosis takes constant ICRs alone, where no noise shows, and for warnings.
const OF_IDENTIFICATION: [&str; 16] = [
    "doubt",
    "genetic",
    "identification",
    "least_squares",
    "observations",
    "odometry",
    "parameters",
    "prediction",
    "response",
    "run_clocks",
    "scatter",
    "sensor",
    "separation",
    "steady",
    "synthetic",
    "yaw_rates",
];

/// Crate, source, names of its constants, and why they are no settings.
type Argued = (&'static str, &'static str, &'static [&'static str], &'static str);

/// All numeric constants of the diagnosis, and of what it uses.
const ARGUED: &[Argued] = &[
    // definitions and formats
    ("diagnose", "base.rs", &["OFFSETS", "INERTIA_UNKNOWNS"], "places of unknowns"),
    ("diagnose", "compare.rs", &["STAGES"], "stages, as they are reported"),
    (
        "diagnose",
        "compare/words.rs",
        &["MAX_DECIMALS", "MAX_LISTED_DIFFERENCES"],
        "how numbers are written",
    ),
    ("diagnose", "diagnosis/pipeline.rs", &["STAGES"], "stages, as they are reported"),
    (
        "diagnose",
        "diagnosis/searched.rs",
        &["STAGES", "STAGES_SHARPENED"],
        "stages, as they are reported",
    ),
    ("diagnose", "document.rs", &["DIGITS"], "how numbers are written"),
    ("diagnose", "document/noise.rs", &["LIMITS"], "what a file may hold"),
    ("diagnose", "error.rs", &["USUAL_DURATION"], "an example in a message"),
    ("diagnose", "evidence/planned.rs", &["READINGS"], "a planned sample is the paper's"),
    ("diagnose", "evidence/ticks.rs", &["ORDER", "DIFFERENCE"], "the third difference"),
    ("diagnose", "plan.rs", &["DIGITS"], "how numbers are written"),
    ("diagnose", "plan/menu.rs", &["SIDES"], "signs of both sides"),
    ("diagnose", "verdict/support.rs", &["RESAMPLED_SEED"], "any seed draws as well"),
    ("estimate", "gyroscope/level.rs", &["OBSERVATION_ROW"], "a value is the sum of both states"),
    ("estimate", "gyroscope/level.rs", &["VARIANCE_OF_MEDIAN"], "a property of the median"),
    ("estimate", "interval.rs", &["NORMAL_QUANTILE"], "quantile of a 95 % interval"),
    ("estimate", "unexplained.rs", &["RAYLEIGH_MEDIAN"], "a property of the normal distribution"),
    ("estimate", "restricted_likelihood.rs", &["STAMP"], "place of a variance"),
    ("estimate", "noise/stamps.rs", &["STAMP"], "place of a variance"),
    ("estimate", "noise/triples.rs", &["STEPS"], "files name these steps in words"),
    ("estimate", "weighting.rs", &["COUNT"], "number of variances"),
    // rounding, and guards of a division, a logarithm or an inverse
    ("diagnose", "drift.rs", &["ROUNDING"], "rounding of a sum"),
    ("diagnose", "evidence/series.rs", &["ROUNDING"], "rounding of a time"),
    ("diagnose", "fit.rs", &["ROUNDING"], "rounding of a value at its limit"),
    ("diagnose", "form.rs", &["MIN_SPEED"], "keeps a logarithm finite at rest"),
    ("diagnose", "held_out.rs", &["MIN_EXCESS"], "guards a ratio; it is reported alone"),
    ("diagnose", "locate/waves.rs", &["MIN_INDEPENDENT"], "rank of a matrix"),
    ("diagnose", "mechanics/simulated.rs", &["LN_FRICTION_ROUNDING"], "rounding of a sum"),
    (
        "diagnose",
        "normal.rs",
        &["RIDGE", "MIN_INDEPENDENT_SHARE", "MAX_ROUNDING_SHARE"],
        "keep sums regular whose columns depend on each other",
    ),
    ("diagnose", "significance.rs", &["MIN_EIGENVALUE_RATIO"], "rank of a matrix"),
    ("diagnose", "weighted/starts.rs", &["MIN_EIGENVALUE"], "rank of a matrix"),
    ("estimate", "gyroscope/level.rs", &["MIN_WHITE", "MIN_WALK"], "keep variances above rounding"),
    ("estimate", "gyroscope/level.rs", &["DIFFERENCES"], "makes whitening a difference"),
    ("estimate", "segment.rs", &["MAX_INTERVALS"], "keeps a count finite"),
    ("estimate", "thinned.rs", &["INTERVAL_ROUNDING"], "rounding of a time"),
    ("estimate", "variances.rs", &["LN_ZERO", "LIMITS"], "stand for the logarithm of none"),
    (
        "estimate",
        "weighting.rs",
        &["MIN_POSE_NOISE"],
        "keeps a covariance regular, below `noise.min_deviations`",
    ),
    ("estimate", "weighting.rs", &["UNKNOWN_PLACE"], "stands for no knowledge"),
    // steps of differences and of searches that end at the same place
    ("diagnose", "base.rs", &["ROUNDS", "STEP"], "Newton's method, to rounding"),
    ("diagnose", "compare/constants.rs", &["ROUNDS", "STEP"], "Newton's method, to rounding"),
    ("diagnose", "compare/quantity.rs", &["SHARE"], "difference of what is nearly linear"),
    ("diagnose", "locate/waves/belts.rs", &["STEP"], "difference of what is nearly linear"),
    ("diagnose", "mechanics.rs", &["STEP"], "difference of what is nearly linear"),
    ("diagnose", "mechanics.rs", &["SAMPLES_PER_TASK"], "samples for each thread"),
    ("diagnose", "mechanics/ground.rs", &["PROBE_SPEEDS"], "forces differ exactly, in any turn"),
    (
        "diagnose",
        "mechanics/ground.rs",
        &["MAX_FAR_SHARE", "MAX_NEAR_STEPS"],
        "when starts of solves are kept",
    ),
    ("diagnose", "mechanics/simulated.rs", &["DELAYS"], "how much is kept"),
    ("diagnose", "plan.rs", &["SPIN_SPEED"], "slow ICRs are those of any slow speed"),
    (
        "diagnose",
        "surface.rs",
        &["SAMPLE_STRIDE", "MAX_UNSOLVED_SAMPLE_SHARE"],
        "a hypothesis fails before that anyway",
    ),
    ("diagnose", "surface/table.rs", &["ANGLES", "SIZES"], "nodes of a table"),
    (
        "estimate",
        "gauss_newton.rs",
        &["COST_ROUNDING", "START_DAMPING", "MIN_DAMPING", "DAMPING_INCREASE", "DAMPING_DECREASE"],
        "steps of identification",
    ),
    ("estimate", "noise/stamps.rs", &["CLIMB"], "variances to a hundredth: a search starts there"),
    // defaults that settings take from here
    ("estimate", "blocks.rs", &["MIN_WHOLE_RUNS"], "default of `evidence.min_whole_runs`"),
    ("estimate", "variances.rs", &["MIN_GAIN"], "default of `noise.min_stamp_gain`"),
    // without a part in an answer
    (
        "estimate",
        "contradiction.rs",
        &[
            "MAX_ERRORS",
            "MAX_OF_RESPONSE",
            "MAX_OF_SPIN",
            "MAX_OF_GENETIC",
            "MAX_EFFICIENCY",
            "MIN_EFFICIENCY",
            "ALPHAS",
            "MAX_LN_UNLIKE",
            "MAX_SPREAD_OF_UNITS",
            "MIN_FACTOR",
            "MIN_RATIO_BY_FACTORS",
            "MAX_TURNING_LEFT",
            "MAX_WAY_LEFT",
            "MIN_MOUNT",
        ],
        "a diagnosis warns of these and goes on",
    ),
    ("estimate", "contradiction/text.rs", &["USUAL_EFFICIENCIES"], "an example in a message"),
    (
        "estimate",
        "unexplained.rs",
        &["MIN_WAY", "MAX_FITTED_SHARE"],
        "a diagnosis warns and goes on",
    ),
    ("estimate", "segment.rs", &["MIN_DURATION_SHARE"], "no segment of a diagnosis is too short"),
];

/// Names of the constants in code that hold a number.
fn numeric(code: &str) -> Vec<String> {
    let mut lines = code.lines();
    let mut found = Vec::new();
    while let Some(line) = lines.next() {
        let line = line.trim_start();
        let line = ["pub ", "pub(crate) ", "pub(super) "]
            .iter()
            .find_map(|public| line.strip_prefix(public))
            .unwrap_or(line);
        let declared = line.strip_prefix("const ").and_then(|line| line.split_once(": "));
        let Some((name, rest)) = declared.filter(|(name, _)| is_constant(name)) else { continue };
        let mut declaration = rest.to_owned();
        while !declaration.ends_with(';') {
            let Some(line) = lines.next() else { break };
            declaration += " ";
            declaration += line.trim();
        }
        let holds = |(kind, value): (&str, &str)| !kind.contains("str") && has_number(value);
        if declaration.split_once(" = ").is_some_and(holds) {
            found.push(name.to_owned());
        }
    }
    found
}

fn is_constant(name: &str) -> bool {
    name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_')
}

/// Whether a value has a digit that is not part of a name.
fn has_number(value: &str) -> bool {
    let mut is_word = false;
    value.chars().any(|c| {
        let begins = c.is_ascii_digit() && !is_word;
        is_word = c.is_alphanumeric() || c == '_';
        begins
    })
}

#[test]
fn numbers_that_decide_a_diagnosis_are_settings() {
    let mut argued = BTreeSet::new();
    for &(of, source, names, why) in ARGUED {
        assert!(!why.is_empty());
        for &name in names {
            assert!(argued.insert(format!("{of}: {source}: {name}")), "{source}: {name} twice");
        }
    }
    let is_asked = |of: &str, source: &str| {
        let module = source.split(['/', '.']).next().unwrap_or_default();
        of == "diagnose" || of == "estimate" && !OF_IDENTIFICATION.contains(&module)
    };
    let mut found = BTreeSet::new();
    for of in all() {
        for (source, code) in of.code() {
            let source = source.to_string_lossy().into_owned();
            if is_asked(&of.name, &source) {
                let names = numeric(&code).into_iter();
                found.extend(names.map(|name| format!("{}: {source}: {name}", of.name)));
            }
        }
    }
    let new: Vec<&String> = found.difference(&argued).collect();
    assert!(new.is_empty(), "make them settings, or say here why they are none:\n{new:#?}");
    let gone: Vec<&String> = argued.difference(&found).collect();
    assert!(gone.is_empty(), "there are none of these:\n{gone:#?}");
}

#[test]
fn a_number_is_seen() {
    let code = "const MAX: f64 =\n    2.5;\npub(super) const ALL: [Self; 2] = [Self::A, Self::B];\n\
                impl<const N: usize> A for B {}\nconst NAME: &str = \"2\";\n\
                    pub const STEPS: [usize; 2] = [\n        1,\n        K2,\n    ];\n";
    assert_eq!(numeric(code), ["MAX", "STEPS"]);
}

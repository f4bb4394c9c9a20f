//! Odometry of public recordings with parameters from their other half.
//!
//! Goal: identified ICRs beat the ideal drive in yaw on driving that they were not fitted to, by
//! more than the 95 % interval of the ratio. The table in `docs/validation.md` is what this test
//! computes.

use crate::validation::recordings::identified;
use trackdyn_estimate::identification::Fit;
use trackdyn_estimate::odometry::comparison::{Component, SetErrors};
use trackdyn_estimate::odometry::{Comparison, Estimate, ParameterSet};
use trackdyn_estimate::{Clock, Interval, clock};
use trackdyn_recording::RunList;
use trackdyn_tests::real_recording;

/// Recording, gauge (m), runs that are fitted to, runs that are judged on.
const CASES: [(&str, f64, &str, &str); 5] = [
    ("marmotte-boreal", 0.52, "0-2", "3-4"),
    ("warthog-asphalt-a", 1.08, "0-149", "150-299"),
    ("warthog-asphalt-slow", 1.08, "0-149", "150-299"),
    ("warthog-gravel", 1.08, "0-149", "150-299"),
    ("husky-tile", 0.555, "0-299", "300-599"),
];

#[test]
fn identified_icrs_forecast_the_other_half() {
    let page = include_str!("../../../docs/validation.md");
    let mut stale = Vec::new();
    for (name, gauge, fitted, judged) in CASES {
        let Some(recording) = real_recording(name) else { continue };
        let part = |list: &str| {
            let list: RunList = list.parse().expect("a list");
            recording.of_runs(&list).expect(name)
        };
        let found = identified(&part(fitted), gauge, &[]);
        let [plain, with_alphas] = &found.fits;
        let set = |name: &str, fit: &Fit| {
            let estimate = fit.least_squares.as_ref().expect(name);
            ParameterSet::new(name, estimate.parameters.kinematics())
        };
        let sets = vec![ParameterSet::ideal(gauge), set("fit", plain), set("alpha", with_alphas)];
        let tau = Clock::of(&recording, None, &clock::Settings::default()).expect(name).tau();
        let result = Comparison::new(&part(judged), sets, tau).expect(name);
        let errors = &result.segments().expect(name).sets;

        let row = row(name, [fitted, judged], &found.fits, errors);
        println!("{row}");
        if !page.contains(&row) {
            stale.push(row);
        }
        let ratio = errors[1].yaw.over_first.expect("an ideal to compare with");
        let [_, high] = ratio.interval().expect("blocks");
        assert!(high < 1.0, "{name}: yaw error over that of the ideal drive {ratio:?}");
    }
    assert!(stale.is_empty(), "docs/validation.md does not have these rows:\n{}", stale.join("\n"));
}

/// The row of the table.
fn row(name: &str, runs: [&str; 2], fits: &[Fit; 2], errors: &[SetErrors]) -> String {
    let gap = |fit: &Fit| {
        let Interval { value, deviation, .. } = fit.least_squares.as_ref().expect(name).gap();
        format!("{value:.3} ({deviation:.3})")
    };
    let [.., alpha_l, alpha_r] = fits[1].least_squares.as_ref().expect(name).parameters.0;
    let over = |component: &Component| {
        let Estimate { value, half_width, .. } = component.over_first.expect("an ideal");
        format!("{value:.2} ± {:.2}", half_width.expect("blocks"))
    };
    let [fitted, judged] = runs;
    let cells = [
        name.to_owned(),
        format!("{fitted}, {judged}"),
        gap(&fits[0]),
        gap(&fits[1]),
        format!("{alpha_l:.3}, {alpha_r:.3}"),
        format!("{:.2}", errors[0].yaw.rms.value.to_degrees()),
        over(&errors[1].yaw),
        over(&errors[2].yaw),
        over(&errors[1].across),
        over(&errors[2].across),
        over(&errors[1].along),
        over(&errors[2].along),
    ];
    format!("| {} |", cells.join(" | "))
}

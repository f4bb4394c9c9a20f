//! Scores on answers and diagnoses that are written by hand.

use trackdyn_blind_trial::answer::{Answer, Concealed, Instrument};
use trackdyn_blind_trial::diagnosis::Diagnosis;
use trackdyn_blind_trial::plan::Stratum;
use trackdyn_blind_trial::score::{
    Judged, Outcome, Reply, Revisited, Score, cases_csv, markdown, means, rates, resolution,
    resolution_markdown,
};
use trackdyn_second_simulator::MECHANISMS;

fn concealed(id: &str, z_det: f64, z_iso: f64) -> Concealed {
    Concealed {
        mechanism: id.to_owned(),
        in_catalogue: trackdyn_model::CATALOGUE.iter().any(|card| card.id == id),
        form: None,
        parameters: [("coefficient".to_owned(), 0.05)].into(),
        breaks: vec!["P".to_owned()],
        z_wanted: None,
        z_det,
        z_iso,
        z_beyond: Some(z_iso),
        nearest: String::new(),
        class: Vec::new(),
    }
}

fn case(stratum: Stratum, concealed: Vec<Concealed>, diagnosis: &str) -> Judged {
    let diagnosis: Diagnosis = toml::from_str(diagnosis).expect("a diagnosis");
    Judged {
        answer: Answer {
            id: "case-0001".to_owned(),
            stratum,
            difficulty: None,
            driving: String::new(),
            fastest_m_per_s: 1.0,
            sensors: String::new(),
            pose_white_m: 0.0,
            pose_white_rad: 0.0,
            known: Vec::new(),
            recording: String::new(),
            files: String::new(),
            vehicle: String::new(),
            concealed,
            clock_offset_s: 0.0,
            instruments: vec![Instrument {
                mechanism: "encoder-scale".to_owned(),
                parameters: [("left".to_owned(), 1.02)].into(),
            }],
        },
        owner_errors: Vec::new(),
        outside: Vec::new(),
        reply: Reply::Diagnosed(Box::new(diagnosis)),
    }
}

#[test]
fn what_cannot_be_told_apart_makes_the_smallest_set() {
    let alone = concealed("slope", 20.0, 9.0);
    let near =
        Concealed { class: vec!["tether".to_owned(), "cohesion".to_owned()], ..alone.clone() };
    let of_class = Concealed { class: near.class.clone(), ..concealed("cohesion", 20.0, 9.0) };
    let constants = MECHANISMS.iter().filter(|sheet| sheet.is_constant()).count();
    assert!(constants > 5, "{constants} constants");
    // all constants, of which cohesion is one, and a tether
    let sizes = [alone, near, of_class].map(|truth| truth.smallest_set());
    assert_eq!(sizes, [1, 3, constants + 1]);
}

/// (successes, cases) of the rate whose name begins like this.
fn rate(cases: &[Judged], name: &str) -> (usize, usize) {
    let rates = rates::rates(cases);
    let rate = rates.iter().find(|rate| rate.name.starts_with(name));
    rate.map_or((0, 0), |rate| (rate.successes, rate.cases))
}

const NOTHING_MISSING: &str = "status = 'nothing-missing'";
const SLOPE: &str = "status = 'explained'\n[[missing]]\neffect = 'slope'\none_of = ['slope']\n";
const SLOPE_OR_TETHER: &str =
    "status = 'ambiguous'\n[[missing]]\neffect = 'slope'\none_of = ['slope', 'tether']\n";
const SCALE: &str = "status = 'explained'\n[[missing]]\neffect = 'encoder-scale'\n\
                     parameters = [{ name = 'left', value = 1, low95 = 1.01, high95 = 1.03 }]\n\
                     [source]\nfurther = 'keys are passed over'\n";

#[test]
fn only_what_is_not_there_is_a_false_claim() {
    let null = |text| case(Stratum::PlainNull, Vec::new(), text);
    let cases = [null(NOTHING_MISSING), null(SCALE), null(SLOPE), null(SLOPE_OR_TETHER)];
    // an encoder that is truly off is no false claim; a set of which nothing is true is one
    assert_eq!(rate(&cases, "false claim: nulls"), (2, 4));
    assert_eq!(rate(&cases, "nothing missing: nulls"), (1, 4));
    // a law beside an encoder that is truly off is excused as a claim, and counted as absent
    let beside = "status = 'ambiguous'\n[[missing]]\neffect = 'slope'\n\
                  one_of = ['slope', 'encoder-scale']\n";
    let cases = [null(NOTHING_MISSING), null(SCALE), null(beside)];
    assert_eq!(rate(&cases, "false claim: nulls"), (0, 3));
    assert_eq!(rate(&cases, "an absent law is named"), (1, 3));
}

#[test]
fn isolation_is_exact_and_sets_are_no_isolation() {
    let single = |text| case(Stratum::Single, vec![concealed("slope", 20.0, 9.0)], text);
    let both = format!("{SLOPE}[[missing]]\neffect = 'centripetal'\n");
    let beside = format!("{SLOPE}[[missing]]\neffect = 'encoder-scale'\n");
    let cases = [
        single(NOTHING_MISSING),
        single(SLOPE),
        single(SLOPE_OR_TETHER),
        single(&both),
        single(&beside),
    ];
    assert_eq!(rate(&cases, "exact isolation"), (2, 5));
    assert_eq!(rate(&cases, "wrong single name, an absent law alone: cases"), (1, 5));
    let lag =
        "[[missing]]\neffect = 'encoder-scale'\none_of = ['drivetrain-lag', 'encoder-scale']\n";
    let with_lag = [single(SLOPE), single(&format!("{SLOPE}{lag}"))];
    assert_eq!(rate(&with_lag, "exact isolation"), (2, 2));
    assert_eq!(rate(&with_lag, "strict isolation"), (1, 2));
    assert_eq!(rate(&with_lag, "wrong single name"), (0, 2));
    assert_eq!(rate(&cases, "truth in the reported set"), (4, 5));
    let sizes = means::means(&cases);
    // sets of 1, 2, 1 and 1
    assert!((sizes[0].mean - 1.25).abs() < 1e-12 && sizes[0].cases == 4);
    let first = rates::rates(&cases).remove(0).name;
    assert!(first.starts_with("strict isolation"), "{first}");
}

#[test]
fn constants_are_counted_apart_and_a_true_name_is_no_wrong_one() {
    let close = |text| case(Stratum::Equivalence, vec![concealed("slope", 20.0, 1.0)], text);
    // far from all effects but its own class, of which constant ICRs tell no member
    let shift = case(Stratum::Equivalence, vec![concealed("cog-shift", 200.0, 190.0)], SLOPE);
    let cases = [close(SLOPE), close(SLOPE_OR_TETHER), close(NOTHING_MISSING), close(SCALE), shift];
    assert_eq!(rate(&cases, "truth in the reported set: detectable singles but"), (2, 4));
    assert_eq!(rate(&cases, "truth in the reported set: detectable constants"), (0, 1));
    // a slope in the place of a shift
    assert_eq!(rate(&cases, "wrong single name"), (1, 5));
    assert_eq!(rate(&cases, "exact isolation"), (0, 0));
}

#[test]
fn pairs_intervals_and_laws_outside() {
    let pair = vec![concealed("slope", 20.0, 9.0), concealed("motion-resistance", 20.0, 9.0)];
    let resistance = "[[missing]]\neffect = 'motion-resistance'\n\
                      parameters = [{ name = 'coefficient', value = 0.05, \
                      low95 = 0.04, high95 = 0.06 }]\n";
    let both = case(Stratum::Pair, pair.clone(), &format!("{SLOPE}{resistance}"));
    let one = case(Stratum::Pair, pair, SLOPE);
    assert_eq!(rate(&[both.clone(), one], "both named"), (1, 2));
    let null = case(Stratum::PlainNull, Vec::new(), SCALE);
    assert_eq!(rate(&[both, null], "95 %"), (2, 2));
    let outside =
        |text: &str| case(Stratum::Outside, vec![concealed("steering-grip", 20.0, 9.0)], text);
    let flagged = outside("status = 'unexplained'\n[located]\nbroken = ['P']\n");
    let cases = [flagged, outside(SLOPE)];
    assert_eq!(rate(&cases, "outside the catalogue, unlike any effect"), (1, 2));
    assert_eq!(rate(&cases, "outside the catalogue, unlike any three"), (1, 2));
    assert_eq!(rate(&cases, "outside the catalogue: broken symmetries are its own, all"), (1, 2));
    assert_eq!(rate(&cases, "outside the catalogue: one effect"), (1, 2));
    assert_eq!(rate(&cases, "wrong single name, an absent law alone: outside"), (1, 2));
    assert_eq!(rate(&cases, "false claim: outside"), (1, 2));
    // encoders that are off break the mirror as well; a place nothing here does
    let broken = |letters: &str| {
        outside(&format!("status = 'unexplained'\n[located]\nbroken = {letters}\n"))
    };
    let cases = ["['M', 'P']", "['P', 'X']", "['M']"].map(broken);
    assert_eq!(rate(&cases, "outside the catalogue: broken symmetries are its own"), (1, 3));
}

#[test]
fn what_was_not_run_does_not_count_and_what_failed_is_counted() {
    let mut absent = case(Stratum::PlainNull, Vec::new(), NOTHING_MISSING);
    absent.reply = Reply::Absent;
    let mut failed = case(Stratum::Single, vec![concealed("slope", 20.0, 9.0)], NOTHING_MISSING);
    failed.reply = Reply::Failed("no".to_owned());
    let score = Score::of(vec![absent, failed]);
    assert_eq!((score.judged.len(), score.absent), (1, 1));
    for missed in ["exact isolation", "strict isolation", "truth in"] {
        assert_eq!(rate(&score.judged, missed), (0, 1), "{missed}");
    }
    assert_eq!(rate(&score.judged, "truth in the reported set: detectable singles but"), (0, 1));
    assert_eq!(rate(&score.judged, "process failed"), (1, 1));
    assert!(markdown(&score).contains("| slope | 1 |"));
    assert!(
        cases_csv(&score)
            .contains("case-0001,single,slope,20,9,,failed,,,false,false,0,0,,,,,,9\n")
    );
}

#[test]
fn the_line_of_a_case_is_enough_to_count_it_again() {
    let fit = "[fit]\nexcess_explained = 0.987654\nheld_out_before = 2\nheld_out_after = 1.02\n\
               noise_floor = 1.01\n";
    let line =
        cases_csv(&Score::of(vec![case(Stratum::PlainNull, Vec::new(), &format!("{SCALE}{fit}"))]));
    let line = line.lines().nth(1);
    let expected = "case-0001,plain-null,,,,,explained,encoder-scale,,false,false,1,1,0.9877,\
                    2.0000,,1.0200,1.0100,";
    assert_eq!(line, Some(expected));
}

#[test]
fn further_driving_resolves_what_it_leaves_the_truth_of_alone() {
    let open = |truth| case(Stratum::Single, vec![concealed(truth, 20.0, 2.0)], SLOPE_OR_TETHER);
    let (slope, patch) = (open("slope"), open("terrain-patch"));
    let diagnosed =
        |text: &str| Outcome::Diagnosed(Box::new(toml::from_str(text).expect("a diagnosis")));
    let tether = "status = 'explained'\n[[missing]]\neffect = 'tether'\none_of = ['tether']\n";
    let revisited = [
        Revisited { before: &slope, outcome: diagnosed(SLOPE) },
        Revisited { before: &slope, outcome: diagnosed(SLOPE_OR_TETHER) },
        Revisited { before: &slope, outcome: diagnosed(tether) },
        Revisited { before: &slope, outcome: Outcome::NothingToDrive },
        Revisited { before: &slope, outcome: Outcome::Failed("no".to_owned()) },
        Revisited { before: &patch, outcome: diagnosed(SLOPE) },
    ];
    let rates = resolution::rates(&revisited);
    let counts: Vec<_> = rates.iter().map(|rate| (rate.successes, rate.cases)).collect();
    // planned; truth before; still there, smaller, resolved, of what is concealed and of other
    // errors; misled; failed
    let expected = [(5, 6), (4, 5), (2, 4), (1, 4), (1, 4), (0, 0), (0, 0), (0, 0), (2, 5), (1, 5)];
    assert_eq!(counts, expected);
    assert!(
        resolution_markdown(&revisited).contains("| case-0001 | slope | slope, tether | slope |")
    );
}

#[test]
fn sets_that_move_constants_only_are_not_driven_for() {
    let constants = "status = 'ambiguous'\n[[missing]]\neffect = 'cog-shift'\n\
                     one_of = ['cog-shift', 'friction-split', 'sensor-lever-arm']\n";
    let of = |text| case(Stratum::Single, vec![concealed("slope", 20.0, 2.0)], text);
    assert!(resolution::open_sets(&of(constants)).is_empty());
    let with_another = constants.replace("sensor-lever-arm", "slope");
    assert_eq!(resolution::open_sets(&of(&with_another)).len(), 1);
    assert_eq!(resolution::open_sets(&of(SLOPE_OR_TETHER)), [["slope", "tether"]]);
    assert!(resolution::open_sets(&of(SLOPE)).is_empty());
}

#[test]
fn a_rule_names_what_it_should_not_along_with_what_it_should() {
    let single =
        |id: &str, z_iso| case(Stratum::Single, vec![concealed(id, 9.0, z_iso)], NOTHING_MISSING);
    let cases = vec![single("slope", 5.0), single("slope", 3.0), single("cog-shift", 50.0)];
    let score = Score::of(cases);
    let at_four = score.reach.iter().find(|reach| (reach.threshold - 4.0).abs() < 1e-9);
    let reach = at_four.expect("a rule of four standard deviations");
    // Φ(1), and of two others Φ(−1) and none
    assert!((reach.isolable - 0.841_345).abs() < 1e-6, "{reach:?}");
    assert!((reach.others - 0.158_655 / 2.0).abs() < 1e-6, "{reach:?}");
    assert!(markdown(&score).contains("| 4.0 | 84.1 % | 7.9 % |"));
    assert!(Score::of(vec![single("slope", 5.0)]).reach.is_empty());
}

//! The figures and the report of a diagnosis as their readers get them.

use std::collections::BTreeSet;
use trackdyn_core::PerSide;
use trackdyn_diagnose::diagnosis::HeldOut;
use trackdyn_diagnose::verdict::Rule;
use trackdyn_diagnose::{
    Diagnosis, DiagnosisFile, Evidence, Options, Resampling, Settings, diagnose, unobserved,
};
use trackdyn_estimate::synthetic::{ConstantIcr, Synthetic, random_steps};
use trackdyn_model::Stationary;
use trackdyn_model::kinematics::Source;
use trackdyn_model::{Circumstance, Effects, Model, VehicleFile};
use trackdyn_recording::OperatingPoint;
use trackdyn_report::figure::{Boxes, Paint, Panel, Series, Sign};
use trackdyn_report::{Figure, Subject, diagnosis_figures, diagnosis_html};

/// Pixels that stay white at the left, the right and the top of every figure.
const MARGIN: usize = 16;

/// A name that HTML must not take for its own.
const NAME: &str = "<script>alert('&\"1\"')</script> a & b";

struct Case {
    vehicle: VehicleFile,
    diagnosis: Diagnosis,
    file: DiagnosisFile,
}

impl Case {
    fn new(evidence: &Evidence, vehicle: VehicleFile, held_out: Vec<usize>) -> Self {
        let options = Options { held_out, resampling: Resampling { draws: 100, seed: 1 } };
        let diagnosis = diagnose(evidence, &vehicle, &options, &unobserved).expect("a diagnosis");
        let source = Source {
            command: "trackdyn diagnose <a&b>".to_owned(),
            version: "0".to_owned(),
            ..Source::default()
        };
        let file = DiagnosisFile::new(&diagnosis, &source);
        Self { vehicle, diagnosis, file }
    }

    /// Runs of a robot with the constant ICRs of the vehicle's own slow spin: nothing is missing.
    fn nothing_missing() -> Self {
        let vehicle = VehicleFile::auriga_alpha();
        let model = Model::new(vehicle.vehicle.clone(), Effects::none());
        let spin = Stationary::new(&model, &Circumstance::default()).solve(PerSide::new(-0.1, 0.1));
        let icrs = spin.icrs.expect("a spin turns");
        let synthetic = Synthetic {
            kinematics: ConstantIcr {
                x_left: icrs.x_left,
                x_right: icrs.x_right,
                y: icrs.y,
                alpha: PerSide::new(1.0, 1.0),
            },
            schedules: (0..4).map(|seed| random_steps(8, 2.5, 0.6, seed)).collect(),
            position_noise: 0.003,
            yaw_noise: 0.002,
            seed: 3,
            ..Synthetic::default()
        };
        let recording = synthetic.recording().expect("a recording");
        let evidence =
            Evidence::of_recording(&recording, vehicle.vehicle.gauge, &Settings::default())
                .expect("evidence");
        Self::new(&evidence, vehicle, vec![3])
    }

    /// A table of steady motions with centripetal force, without lateral speeds.
    fn steady_points() -> Self {
        let vehicle = VehicleFile::auriga_alpha();
        let effects = ["centripetal".parse().expect("an effect")].into_iter().collect();
        let model = Model::new(vehicle.vehicle.clone(), effects);
        let solver = Stationary::new(&model, &Circumstance::default());
        let mut points = Vec::new();
        for i in -5_i32..=5 {
            for j in -5_i32..=5 {
                let (v_left, v_right) = (0.16 * f64::from(i), 0.16 * f64::from(j));
                let twist = solver.solve(PerSide::new(v_left, v_right)).twist;
                let noise = 0.002 * f64::from((7 * i + 5 * j).rem_euclid(11) - 5) / 5.0;
                points.push(OperatingPoint {
                    v_left,
                    v_right,
                    v_forward: Some(twist.v_y + noise),
                    v_lateral: None,
                    yaw_rate: Some(twist.w - noise),
                });
            }
        }
        let evidence = Evidence::of_points(&points, &Settings::default()).expect("evidence");
        Self::new(&evidence, vehicle, Vec::new())
    }

    fn report(&self) -> (Vec<Figure>, String) {
        let caption = format!("made from {NAME}, {}", "long ".repeat(100));
        let subject = Subject {
            diagnosis: &self.diagnosis,
            vehicle: &self.vehicle,
            file: &self.file,
            name: NAME,
            caption: &caption,
        };
        let figures = diagnosis_figures(&subject);
        let html = diagnosis_html(&subject, &figures).expect("a report");
        (figures, html)
    }
}

/// Names of the elements that are open at the end of a page, or the first that is closed out of
/// turn.
fn unclosed(html: &str) -> Vec<String> {
    const EMPTY: [&str; 3] = ["meta", "br", "!DOCTYPE"];
    let style = html.find("<style>").expect("a style")..html.find("</style>").expect("its end");
    let mut open: Vec<String> = Vec::new();
    for (start, _) in html.match_indices('<').filter(|(place, _)| !style.contains(place)) {
        let tag = &html[start + 1..];
        let tag = &tag[..tag.find('>').expect("every tag ends")];
        if let Some(name) = tag.strip_prefix('/') {
            if name != "style" && open.pop().as_deref() != Some(name) {
                return vec![name.to_owned()];
            }
        } else if !tag.ends_with('/') {
            let name = tag.split_whitespace().next().expect("a name");
            if !EMPTY.contains(&name) {
                open.push(name.to_owned());
            }
        }
    }
    open
}

fn check(case: &Case, expected: &[&str]) {
    let (figures, html) = case.report();
    let names: Vec<String> = figures.iter().map(Figure::file).collect();
    assert_eq!(names, expected);
    let settings = case.diagnosis.evidence.seen.settings();
    for sentence in Rule::ALL.map(|rule| rule.sentence(settings)) {
        let sentence = sentence.replace('\'', "&#x27;").replace('/', "&#x2f;");
        assert!(html.contains(&sentence), "no rule is kept from the reader: {sentence}");
    }
    for figure in &figures {
        assert!(html.contains(&figure.file()) && html.contains(&figure.title));
        assert!(html.contains(&figure.to_svg_element().expect("a picture")));
        let png = figure.to_small_png().expect("a picture");
        assert!(!ink_in_margin(&png), "{} reaches its edge", figure.name);
        check_picture(figure);
    }
    assert_eq!(html.matches("<svg role=\"img\"").count(), figures.len());
    assert_eq!(html.matches("<img ").count(), 0);
    // Colours of a picture are named in it
    let without_own = html.replace("url(#", "");
    for outside in ["http:", "https:", "//", "<link", "<script", "@import", "url(", "data:"] {
        assert!(!without_own.contains(outside), "{outside}");
    }
    assert!(html.contains("&lt;script&gt;") && html.contains("a &amp; b"));
    assert!(html.contains("prefers-color-scheme: dark"));
    assert_eq!(unclosed(&html), Vec::<String>::new());
    let ids: Vec<&str> =
        html.split("id=\"").skip(1).filter_map(|id| id.split('"').next()).collect();
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len());
    for target in html.split("href=\"#").skip(1).filter_map(|id| id.split('"').next()) {
        assert!(ids.contains(&target), "{target}");
    }
    for target in html.split("url(#").skip(1).filter_map(|id| id.split(')').next()) {
        assert!(ids.contains(&target), "{target}");
    }
    let (again, same) = case.report();
    assert!(same == html && again == figures);
}

/// Checks that a picture is well-formed, and that every text of its figure is text in it.
fn check_picture(figure: &Figure) {
    let svg = figure.to_svg().expect("a picture");
    let document = roxmltree::Document::parse(&svg).expect("well-formed");
    let texts: BTreeSet<String> = document
        .descendants()
        .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "text")))
        .map(|text| {
            let inside = text.descendants().filter(roxmltree::Node::is_text);
            inside.filter_map(|node| node.text()).collect()
        })
        .collect();
    let titles = figure.panels.iter().map(|panel| &panel.title);
    let labels = figure.panels.iter().flat_map(|panel| &panel.labels).map(|label| &label.text);
    let others = figure.texts.iter().map(|text| &text.text);
    for text in titles.chain(labels).chain(others).filter(|text| !text.is_empty()) {
        // Subscripts are lowered letters
        let text = text.replace('ₗ', "l").replace('ᵣ', "r");
        assert!(texts.contains(&text), "{}: {text}", figure.name);
    }
}

/// The panel of a figure whose title begins so.
fn panel<'f>(figures: &'f [Figure], name: &str, title: &str) -> &'f Panel {
    let figure = figures.iter().find(|figure| figure.name == name).expect("a figure of this name");
    let panel = figure.panels.iter().find(|panel| panel.title.starts_with(title));
    panel.expect("a panel of this title")
}

fn boxes<'p>(panel: &'p Panel, name: &str) -> &'p Boxes {
    let named = panel.series.iter().filter(|series| series.name == name);
    let mut found = named.filter_map(|series| match &series.sign {
        Sign::Boxes(boxes) => Some(boxes),
        _ => None,
    });
    found.next_back().expect("boxes of this name")
}

fn ink_in_margin(bytes: &[u8]) -> bool {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let (width, height) = reader.info().size();
    reader.next_frame(&mut pixels).expect("pixels");
    let [width, height] = [width, height].map(|size| size as usize);
    let inside = |place: usize, size: usize| (MARGIN..size - MARGIN).contains(&place);
    pixels.chunks_exact(3).enumerate().any(|(k, pixel)| {
        !(inside(k % width, width) && inside(k / width, height)) && pixel != [255; 3]
    })
}

/// Figures of a report, the last one of recordings only.
const FIGURES: [&str; 8] = [
    "plane.png",
    "cells.png",
    "symmetries.png",
    "signatures.png",
    "evidence.png",
    "isolability.png",
    "errors.png",
    "path.png",
];

#[test]
fn a_recording_without_missing_physics_has_a_report() {
    check(&Case::nothing_missing(), &FIGURES);
}

#[test]
fn figures_hold_what_the_diagnosis_found() {
    let case = Case::nothing_missing();
    let (figures, _) = case.report();
    let diagnosis = &case.diagnosis;
    let errors = panel(&figures, "errors", "held-out runs");
    assert_eq!(errors.y.label(), "rms residual (σ)");
    let heights = boxes(errors, "held-out runs").boxes.iter().map(|[_, [_, top]]| *top);
    let expected = diagnosis.evidence.errors;
    assert_eq!(
        heights.collect::<Vec<_>>(),
        [expected.before, expected.after, expected.noise_floor]
    );
    let matrix = panel(&figures, "isolability", "");
    let Some(Paint::Values { values, scale }) = &boxes(matrix, "|cosine|").paint else {
        panic!("cells without values");
    };
    assert_eq!(scale.range, [0.0, 1.0]);
    let largest = values.iter().fold(0.0_f64, |most, value| most.max(*value));
    // An effect resembles itself
    assert!((largest - 1.0).abs() < 1e-6, "{largest}");
    let bars = panel(&figures, "evidence", "");
    let shown = boxes(bars, "gain of ln evidence").boxes.len();
    let gains = diagnosis.limits.screened.iter().filter(|one| one.gain.is_finite()).count();
    assert!(shown >= gains.saturating_sub(diagnosis.answer.missing.len()) && shown > 0);
    let path = panel(&figures, "path", "Paths");
    let lines: Vec<&Series> =
        path.series.iter().filter(|series| matches!(series.sign, Sign::Line(_))).collect();
    let names: Vec<&str> = lines.iter().map(|series| series.name.as_str()).collect();
    assert_eq!(names, ["observed", "as filed", "corrected"]);
    assert_eq!([path.x.label(), path.y.label()], ["x (m)", "y (m)"]);
}

#[test]
fn figures_are_plain_data() {
    let (figures, _) = Case::steady_points().report();
    for figure in &figures {
        let value = serde_yaml_ng::to_value(figure).expect("data");
        let panels = value["panels"].as_sequence().expect("panels");
        assert_eq!(panels.len(), figure.panels.len());
        for (panel, of) in panels.iter().zip(&figure.panels) {
            assert_eq!(panel["x"]["quantity"].as_str(), Some(of.x.quantity.as_str()));
            assert_eq!(panel["x"]["unit"].as_str(), Some(of.x.unit.as_str()));
            assert_eq!(panel["y"]["range"][1].as_f64(), Some(of.y.range[1]));
            let series = panel["series"].as_sequence().expect("series");
            assert!(series.iter().all(|series| series["sign"]["kind"].is_string()));
        }
    }
}

#[test]
fn steady_points_have_a_report_without_paths() {
    check(&Case::steady_points(), &FIGURES[..7]);
}

#[test]
fn a_claim_that_held_out_runs_contradict_is_not_for_driving() {
    let mut case = Case::steady_points();
    assert!(!case.diagnosis.answer.missing.is_empty());
    for (after, warned) in [(1.1, false), (1.2, true), (1.3, true)] {
        case.diagnosis.evidence.errors =
            HeldOut { before: 1.2, instruments: 1.2, after, noise_floor: 1.0, are_held_out: true };
        let (_, html) = case.report();
        assert_eq!(html.contains("What is claimed does not help there"), warned, "{after}");
    }
}

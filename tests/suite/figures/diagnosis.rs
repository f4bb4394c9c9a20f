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
use trackdyn_report::figure::{Boxes, Paint, Panel, Points, Series, Sign};
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
        let options = Options {
            held_out,
            resampling: Resampling { draws: 100, seed: 1 },
            ..Options::default()
        };
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

/// A page without the insides of its style and its scripts, and these.
fn parts(html: &str) -> (String, Vec<&str>) {
    let (mut page, mut rest, mut insides) = (String::new(), html, Vec::new());
    while let Some((element, start)) = ["<style>", "<script"]
        .into_iter()
        .filter_map(|element| Some((element, rest.find(element)?)))
        .min_by_key(|(_, start)| *start)
    {
        let inside = start + rest[start..].find('>').expect("every tag ends") + 1;
        let end = element.replace('<', "</").replace('>', "");
        let end = inside + rest[inside..].find(&end).expect("its end");
        page.push_str(&rest[..inside]);
        insides.push(&rest[inside..end]);
        rest = &rest[end..];
    }
    page.push_str(rest);
    (page, insides)
}

/// Names of the elements that are open at the end of a page, or the first that is closed out of
/// turn.
fn unclosed(html: &str) -> Vec<String> {
    const EMPTY_ELEMENTS: [&str; 4] = ["meta", "br", "!DOCTYPE", "input"];
    let mut open: Vec<String> = Vec::new();
    for (start, _) in html.match_indices('<') {
        let tag = &html[start + 1..];
        let tag = &tag[..tag.find('>').expect("every tag ends")];
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop().as_deref() != Some(name) {
                return vec![name.to_owned()];
            }
        } else if !tag.ends_with('/') {
            let name = tag.split_whitespace().next().expect("a name");
            if !EMPTY_ELEMENTS.contains(&name) {
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
    assert!(html.len() < 1_000_000, "{} bytes", html.len());
    let (page, insides) = parts(&html);
    let [style, values, script] = insides.as_slice() else { panic!("a style, values, a script") };
    // Colours of a picture are named in it
    let without_own = page.replace("url(#", "");
    for outside in ["http:", "https:", "//", "<link", "@import", "url(", "data:", " src="] {
        assert!(!without_own.contains(outside), "{outside}");
    }
    for outside in ["@import", "url(", "fetch(", "XMLHttpRequest", "WebSocket", "import(", "eval("]
    {
        assert!(![style, script].iter().any(|of| of.contains(outside)), "{outside}");
    }
    assert!(page.contains("content=\"default-src 'none';"), "a browser refuses what is outside");
    assert!(script.contains("Permission is hereby granted"), "the library with its licence");
    assert!(!values.contains('<'));
    assert!(page.contains("&lt;script&gt;") && page.contains("a &amp; b"));
    assert!(style.contains("prefers-color-scheme: dark"));
    assert_eq!(unclosed(&page), Vec::<String>::new());
    assert_eq!(page.matches("<h1").count(), 1);
    check_numbers(case, &page);
    check_values(&figures, values);
    let html = page;
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
    assert!(parts(&same).0 == html && again == figures);
}

/// Checks that the numbers of the first screen are those of the file, rounded.
fn check_numbers(case: &Case, page: &str) {
    let file: toml::Value = toml::from_str(&case.file.to_toml()).expect("a file");
    let mut known = Vec::new();
    collect(&file, &mut known);
    let shown = page.split("<data value=\"").skip(1);
    let mut count = 0;
    for shown in shown.filter_map(|rest| rest.split_once("</data>")).map(|(of, _)| of) {
        let (value, text) = shown.split_once("\">").expect("a value and its text");
        let value: f64 = value.parse().expect("a number");
        assert!(known.contains(&value), "{value} is not in the file");
        count += 1;
        if let Ok(number) = text.replace('\u{2212}', "-").parse::<f64>() {
            let digits = text.split('e').next().map_or("", |mantissa| mantissa);
            let decimals = digits.split_once('.').map_or(0, |(_, after)| after.len());
            let half = 0.500_001 * 10.0_f64.powi(-i32::try_from(decimals).expect("few digits"));
            assert!((number - value).abs() <= half, "{text} is not {value}");
        }
    }
    assert!(count >= 1, "the error on the log at least");
}

/// All numbers of a file.
fn collect(value: &toml::Value, into: &mut Vec<f64>) {
    match value {
        toml::Value::Float(number) => into.push(*number),
        toml::Value::Array(all) => all.iter().for_each(|one| collect(one, into)),
        toml::Value::Table(all) => all.iter().for_each(|(_, one)| collect(one, into)),
        _ => {}
    }
}

/// Checks that what a reader looks at closely is what the figures hold. JSON is YAML, too.
fn check_values(figures: &[Figure], values: &str) {
    let values: serde_yaml_ng::Value = serde_yaml_ng::from_str(values).expect("JSON");
    let number = |value: &serde_yaml_ng::Value| value.as_f64();
    let plane = &values["plane"];
    let shown = plane["panels"].as_sequence().expect("panels");
    let drawn = figures.iter().find(|figure| figure.name == "plane").expect("a plane");
    for panel in shown {
        let title = panel["title"].as_str().expect("a title");
        let of = drawn.panels.iter().find(|of| of.title == title).expect("its panel");
        let (Sign::Boxes(Boxes { paint: Some(Paint::Values { values, .. }), .. })
        | Sign::Points(Points { paint: Paint::Values { values, .. }, .. })) = &of.series[0].sign
        else {
            panic!("{title}: no values");
        };
        let step = panel["step"].as_f64().expect("a step");
        let all = panel["v"].as_sequence().expect("values");
        let mut steps: Vec<f64> = all.iter().filter_map(number).collect();
        let mut expected: Vec<f64> = values.iter().map(|value| (value / step).round()).collect();
        for all in [&mut steps, &mut expected] {
            all.sort_by(f64::total_cmp);
        }
        assert!(steps == expected, "{title}");
        assert_eq!(all.len(), plane["cells"].as_sequence().expect("cells").len());
    }
    let Some(time) = figures.iter().find(|figure| figure.name == "time") else {
        assert!(
            values["time"].is_null()
                && values["paths"]["pieces"].as_sequence().expect("paths").is_empty()
        );
        return;
    };
    let times = values["time"]["t"].as_sequence().expect("times");
    assert!(times.windows(2).all(|pair| number(&pair[0]) <= number(&pair[1])));
    for (panel, of) in
        values["time"]["panels"].as_sequence().expect("panels").iter().zip(&time.panels)
    {
        let drawn: usize = of
            .series
            .iter()
            .filter_map(|series| match &series.sign {
                Sign::Line(line) => Some(line.points.len()),
                _ => None,
            })
            .sum();
        let lines = panel["lines"].as_sequence().expect("lines");
        let lines = lines.iter().map(|line| line["v"].as_sequence().expect("values"));
        assert!(lines.clone().all(|values| values.len() == times.len()));
        let shown = lines.flatten().filter(|value| !value.is_null()).count();
        assert_eq!(shown, drawn, "{}", of.title);
    }
    let end = values["time"]["end"].as_f64().expect("an end") / 0.01;
    for stretches in plane["stretches"].as_sequence().expect("stretches") {
        let ends: Vec<f64> =
            stretches.as_sequence().expect("ends").iter().filter_map(number).collect();
        assert!(!ends.is_empty() && ends.len().is_multiple_of(2));
        assert!(ends.iter().all(|place| (0.0..=end + 1.0).contains(place)));
        assert!(ends.windows(2).all(|pair| pair[0] <= pair[1]));
    }
    let names = values["paths"]["names"].as_sequence().expect("names").len();
    for piece in values["paths"]["pieces"].as_sequence().expect("paths") {
        let count = piece["t"].as_sequence().expect("times").len();
        assert!(count >= 2);
        for along in ["x", "y"] {
            let paths = piece[along].as_sequence().expect("paths");
            assert_eq!(paths.len(), names);
            assert!(paths.iter().all(|path| path.as_sequence().expect("places").len() == count));
        }
        for error in piece["errors"].as_sequence().expect("errors") {
            assert_eq!(error.as_sequence().expect("paths").len(), names - 1);
        }
    }
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

/// Figures of a report; time and path are those of recordings only.
const FIGURES: [&str; 9] = [
    "plane.png",
    "time.png",
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
    let of_drives = ["time.png", "path.png"];
    let expected = FIGURES.into_iter().filter(|name| !of_drives.contains(name));
    check(&Case::steady_points(), &expected.collect::<Vec<_>>());
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

//! The figures and the report of a diagnosis as their readers get them.

use std::collections::BTreeSet;
use trackdyn_core::PerSide;
use trackdyn_diagnose::diagnosis::HeldOut;
use trackdyn_diagnose::{Diagnosis, DiagnosisFile, Evidence, Options, Resampling, diagnose};
use trackdyn_estimate::synthetic::{ConstantIcr, Synthetic, random_steps};
use trackdyn_model::Stationary;
use trackdyn_model::kinematics::Source;
use trackdyn_model::{Circumstance, Effects, Model, VehicleFile};
use trackdyn_recording::OperatingPoint;
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
        let diagnosis = diagnose(evidence, &vehicle, &options, &|_| {}).expect("a diagnosis");
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
        let evidence = Evidence::of_recording(&recording, vehicle.vehicle.gauge).expect("evidence");
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
        let evidence = Evidence::of_points(&points).expect("evidence");
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
        let figures = diagnosis_figures(&subject).expect("figures");
        let html = diagnosis_html(&subject, &figures).expect("a report");
        (figures, html)
    }
}

/// Names of the elements that are open at the end of a page, or the first that is closed out of
/// turn.
fn unclosed(html: &str) -> Vec<String> {
    const EMPTY: [&str; 4] = ["meta", "br", "img", "!DOCTYPE"];
    let style = html.find("<style>").expect("a style")..html.find("</style>").expect("its end");
    let mut open: Vec<String> = Vec::new();
    for (start, _) in html.match_indices('<').filter(|(place, _)| !style.contains(place)) {
        let tag = &html[start + 1..];
        let tag = &tag[..tag.find('>').expect("every tag ends")];
        if let Some(name) = tag.strip_prefix('/') {
            if name != "style" && open.pop().as_deref() != Some(name) {
                return vec![name.to_owned()];
            }
        } else {
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
    let names: Vec<&str> = figures.iter().map(|figure| figure.file).collect();
    assert_eq!(names, expected);
    for figure in &figures {
        assert!(html.contains(figure.file) && html.contains(figure.title));
        assert!(!ink_in_margin(&figure.png), "{} reaches its edge", figure.file);
    }
    assert_eq!(html.matches("src=\"data:image/png;base64,iVBOR").count(), figures.len());
    assert_eq!(html.matches("<img ").count(), figures.len());
    for outside in ["http:", "https:", "//", "<link", "<script", "@import", "url("] {
        let text: String = html.split('"').filter(|part| !part.starts_with("data:image")).collect();
        assert!(!text.contains(outside), "{outside}");
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
    let (again, same) = case.report();
    assert!(same == html && again.iter().zip(&figures).all(|(a, b)| a.png == b.png));
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
fn steady_points_have_a_report_without_paths() {
    check(&Case::steady_points(), &FIGURES[..7]);
}

#[test]
fn a_claim_that_held_out_runs_contradict_is_not_for_driving() {
    let mut case = Case::steady_points();
    assert!(!case.diagnosis.missing.is_empty());
    for (after, warned) in [(1.1, false), (1.2, true), (1.3, true)] {
        case.diagnosis.held_out =
            HeldOut { before: 1.2, instruments: 1.2, after, noise_floor: 1.0, are_held_out: true };
        let (_, html) = case.report();
        assert_eq!(html.contains("What is claimed does not help there"), warned, "{after}");
    }
}

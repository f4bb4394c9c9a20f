//! The figure of an ICR map as its readers get it.

use trackdyn_core::Side;
use trackdyn_model::{Circumstance, Model, Vehicle, VehicleFile};
use trackdyn_model::{Grid, IcrMap, Status};
use trackdyn_report::Figure;
use trackdyn_report::figure::{Axis, Cell, Cells, Sign};

const SIZE: [usize; 2] = [2400, 1350];
/// Pixels that stay white all around.
const MARGIN: usize = 20;
const EFFECTS: [&str; 2] = ["centripetal", "load-transfer:cog_height_m=0.05"];

fn auriga(effects: &[&str]) -> Model {
    let effects = effects.iter().map(|text| text.parse().expect("an effect")).collect();
    Model::new(VehicleFile::auriga_alpha().vehicle, effects)
}

fn solve(model: &Model, points: usize) -> IcrMap {
    let grid = Grid::new(points, 1.0).expect("a grid");
    IcrMap::solve(model, grid, &Circumstance::default(), &|_| {})
}

/// The pixels of the figure, three bytes each.
fn draw(map: &IcrMap, model: &Model, caption: &str) -> Vec<u8> {
    let bytes = trackdyn_report::icr_map(map, model, caption).to_png().expect("a figure");
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let frame = reader.next_frame(&mut pixels).expect("pixels");
    assert_eq!([frame.width as usize, frame.height as usize], SIZE);
    assert_eq!(pixels.len(), 3 * SIZE[0] * SIZE[1]);
    pixels
}

fn ink_in_margin(pixels: &[u8]) -> Option<[usize; 2]> {
    let inside = |k: usize, place: usize| (MARGIN..SIZE[k] - MARGIN).contains(&place);
    pixels
        .chunks_exact(3)
        .enumerate()
        .map(|(k, pixel)| ([k % SIZE[0], k / SIZE[0]], pixel))
        .find(|&([x, y], pixel)| !(inside(0, x) && inside(1, y)) && pixel != [255; 3])
        .map(|(place, _)| place)
}

fn coloured(pixels: &[u8]) -> usize {
    let grey = |pixel: &[u8]| pixel[0].abs_diff(pixel[1]) < 8 && pixel[1].abs_diff(pixel[2]) < 8;
    pixels.chunks_exact(3).filter(|pixel| !grey(pixel)).count()
}

#[test]
fn figures_keep_their_margins() {
    for effects in [&[][..], &EFFECTS[..]] {
        let model = auriga(effects);
        let pixels = draw(&solve(&model, 11), &model, "made for a test");
        assert_eq!(ink_in_margin(&pixels), None, "{effects:?}");
        assert!(coloured(&pixels) > 3 * 300 * 300, "{effects:?}: three heat maps");
    }
}

#[test]
fn long_texts_keep_the_margins() {
    let effects = [
        "centripetal",
        "load-transfer:cog_height_m=0.123456789",
        "motion-resistance:coefficient=0.0123456789",
        "slope",
        "viscous-friction",
        "friction-split",
        "resistance-split",
    ];
    let model = auriga(&effects);
    let vehicle = Vehicle { name: "A name ".repeat(60), ..model.vehicle().clone() };
    let model = Model::new(vehicle, model.effects().clone());
    let map = solve(&model, 11);
    let pixels = draw(&map, &model, &"caption ".repeat(100));
    assert_eq!(ink_in_margin(&pixels), None);
}

#[test]
fn the_widest_numbers_keep_the_margins() {
    let model = auriga(&[]);
    let mut map = solve(&model, 11);
    // A minus and five digits at the colour bar nearest to the edge
    for solution in &mut map.solutions {
        if let Some(icrs) = &mut solution.icrs {
            icrs.x_right -= 12.0;
        }
    }
    assert_eq!(ink_in_margin(&draw(&map, &model, "")), None);
}

#[test]
fn maps_without_turns_are_drawn_without_colour() {
    let model = auriga(&[]);
    let mut map = solve(&model, 11);
    for (status, held) in [(Status::Holds(Side::Left), 0), (Status::Tips, 0), (Status::Straight, 0)]
    {
        for solution in &mut map.solutions {
            solution.status = status;
        }
        map.solutions[held].icrs = None;
        let pixels = draw(&map, &model, "");
        assert_eq!(ink_in_margin(&pixels), None);
        // Only the samples of the legend
        assert!(coloured(&pixels) < 3000, "{status:?}: {}", coloured(&pixels));
    }
}

#[test]
fn one_turning_motion_is_a_map() {
    let model = auriga(&EFFECTS);
    let mut map = solve(&model, 11);
    for solution in map.solutions.iter_mut().skip(8) {
        solution.status = Status::NotConverged;
        solution.icrs = None;
    }
    for solution in map.solutions.iter_mut().take(7) {
        solution.status = Status::Holds(Side::Right);
        solution.icrs = None;
    }
    assert_eq!(map.turning().count(), 1);
    assert_eq!(ink_in_margin(&draw(&map, &model, "")), None);
}

#[test]
fn the_smallest_and_a_large_grid_are_drawn() {
    let model = auriga(&[]);
    for points in [2, 3, 401] {
        assert_eq!(ink_in_margin(&draw(&solve(&model, points), &model, "")), None, "{points}");
    }
}

/// The heat map of a coordinate, whose titles begin with its name.
fn heat_map<'f>(figure: &'f Figure, coordinate: &str) -> &'f Cells {
    let panel = figure.panels.iter().find(|panel| panel.title.starts_with(coordinate));
    let panel = panel.expect("a panel of this coordinate");
    assert_eq!([&panel.x, &panel.y].map(Axis::label), ["Vₗ (m/s)", "Vᵣ (m/s)"]);
    match &panel.series[0].sign {
        Sign::Cells(cells) => cells,
        other => panic!("expected a heat map: {other:?}"),
    }
}

#[test]
fn the_figure_holds_the_values_of_the_map() {
    let model = auriga(&EFFECTS);
    let map = solve(&model, 11);
    let figure = trackdyn_report::icr_map(&map, &model, "");
    for (k, coordinate) in ["xₗ", "xᵣ", "y"].into_iter().enumerate() {
        let cells = heat_map(&figure, coordinate);
        assert_eq!([cells.count, cells.cells.len()], [11, 121]);
        for (solution, cell) in map.solutions.iter().zip(&cells.cells) {
            let value = solution.icrs.map(|icrs| icrs.to_array()[k]);
            match (solution.status, *cell) {
                (Status::Turning, Cell::Value(shown)) => assert_eq!(Some(shown), value),
                (status, Cell::Gap(_)) => assert_ne!(status, Status::Turning),
                (status, Cell::Value(_)) => panic!("a value where it is {status:?}"),
            }
        }
    }
    let robot = &figure.panels[0];
    let clouds = robot.series.iter().filter_map(|series| match &series.sign {
        Sign::Cloud(cloud) => Some(cloud.points.len()),
        _ => None,
    });
    let turning = map.turning().filter(|solution| solution.icrs.is_some()).count();
    assert_eq!(clouds.collect::<Vec<_>>(), [turning, turning]);
}

#[test]
fn the_figure_is_well_formed_svg() {
    let model = auriga(&["motion-resistance"]);
    let mut map = solve(&model, 11);
    for (k, status) in
        [Status::Holds(Side::Left), Status::Tips, Status::NotConverged].into_iter().enumerate()
    {
        map.solutions[k].status = status;
    }
    let figure = trackdyn_report::icr_map(&map, &model, "<caption> & \"more\"");
    let svg = figure.to_svg().expect("a figure");
    let document = roxmltree::Document::parse(&svg).expect("well-formed");
    let texts: Vec<String> = document
        .descendants()
        .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "text")))
        .map(|text| {
            text.descendants()
                .filter(roxmltree::Node::is_text)
                .filter_map(|node| node.text())
                .collect()
        })
        .collect();
    for text in ["<caption> & \"more\"", "Left ICRs, enlarged", "no balance found"] {
        assert!(texts.iter().any(|other| other == text), "{text}: {texts:?}");
    }
}

#[test]
fn the_number_of_threads_does_not_show() {
    let bytes = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let model = auriga(&EFFECTS);
            trackdyn_report::icr_map(&solve(&model, 21), &model, "").to_png().expect("a figure")
        })
    };
    assert!(bytes(1) == bytes(4));
}

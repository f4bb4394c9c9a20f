//! The figure of drives along a path as its readers get it.

use trackdyn_drive::tracking::{DriveOptions, Estimate};
use trackdyn_drive::{Journey, Path, Rolling, Tracker, drive};
use trackdyn_model::{Icrs, Kinematics};
use trackdyn_report::{TrackedDrive, path_tracking};
use trackdyn_tests::circle;

const SIZE: [usize; 2] = [2400, 1350];
/// Pixels that stay white all around.
const MARGIN: usize = 20;
const AURIGA: Icrs = Icrs { x_left: -0.375, x_right: 0.457, y: 0.0492 };

fn journey(path: &Path, model: Kinematics, options: &DriveOptions) -> Journey {
    let mut robot = Rolling::new(Kinematics::new(AURIGA), path.start());
    drive(&mut robot, path, &Tracker::default(), &model, options, &|_| ()).expect("valid")
}

fn draw(path: &Path, options: &DriveOptions, names: [&str; 2], texts: [&str; 2]) -> Vec<u8> {
    let models = [Kinematics::ideal(0.42), Kinematics::new(AURIGA)];
    let journeys = models.map(|model| journey(path, model, options));
    let drives = [0, 1].map(|k| TrackedDrive { name: names[k], journey: &journeys[k] });
    path_tracking(path, &drives, [0.0, 0.0], texts[0], texts[1]).expect("a figure")
}

fn ink_in_margin(bytes: &[u8]) -> bool {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut pixels).expect("pixels");
    let inside = |k: usize, place: usize| (MARGIN..SIZE[k] - MARGIN).contains(&place);
    pixels
        .chunks_exact(3)
        .enumerate()
        .any(|(k, pixel)| !(inside(0, k % SIZE[0]) && inside(1, k / SIZE[0])) && pixel != [255; 3])
}

#[test]
fn figures_keep_their_margins_and_are_the_same_again() {
    let square = Path::square(3.0, true, 1).expect("a square");
    for path in [square, circle(2.0, false, 1)] {
        for estimate in [Estimate::Truth, Estimate::Odometry] {
            let options = DriveOptions { estimate, ..DriveOptions::default() };
            let draw = || draw(&path, &options, ["ideal", "identified"], ["square", "caption"]);
            let bytes = draw();
            assert!(!ink_in_margin(&bytes));
            assert!(bytes == draw());
        }
    }
}

#[test]
fn long_texts_short_drives_and_no_drives_can_be_drawn() {
    let line = Path::new(vec![[-0.001, 0.0], [0.001, 0.0]]).expect("a path");
    let long = "a long name ".repeat(40);
    let options = DriveOptions { time_limit: Some(0.01), ..DriveOptions::default() };
    assert!(!ink_in_margin(&draw(&line, &options, [&long, &long], [&long, &long])));
    let empty = path_tracking(&line, &[], [0.0, 0.0], "", "").expect("a figure");
    assert!(!ink_in_margin(&empty));
}

//! Bags written by the Python package `rosbags` (`fixtures/make_rosbags.py`), which shares no code
//! with the readers here.

use std::path::{Path, PathBuf};
use trackdyn_recording::recording::Finding;
use trackdyn_recording::rosbag::{self, JointSignal, Role, RosbagOptions};
use trackdyn_recording::{Error, Recording, Warning};

const COUNT: usize = 20;
const RADIUS: f64 = 0.125;

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/recordings").join(name)
}

fn options() -> RosbagOptions {
    RosbagOptions { wheel_radius: Some(RADIUS), ..RosbagOptions::default() }
}

fn step(index: usize) -> f64 {
    f64::from(u32::try_from(index).expect("small"))
}

/// Speeds are sums and means of the same decimals in another order: 1e-12 is their rounding.
#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");
}

/// The track speeds of `truth` in the script, for the first `count` steps.
#[track_caller]
fn assert_tracks(recording: &Recording, count: usize) {
    let tracks = recording.runs()[0].tracks();
    assert_eq!(tracks.len(), count);
    for (index, sample) in tracks.iter().enumerate() {
        assert_near(sample.t, 0.05 * step(index));
        assert_near(sample.v_left, RADIUS * (2.25 + 0.1 * step(index)));
        assert_near(sample.v_right, RADIUS * (4.0 - 0.05 * step(index)));
    }
}

/// The poses of `truth` in the script; yaw passes π and must go on.
#[track_caller]
fn assert_poses(recording: &Recording, count: usize) {
    let poses = recording.runs()[0].poses();
    assert_eq!(poses.len(), count);
    for (index, sample) in poses.iter().enumerate() {
        let t = 0.05 * step(index);
        assert_near(sample.t, t);
        assert_near(sample.pose.x, 0.3 * t);
        assert_near(sample.pose.y, -0.1 * t);
        assert_near(sample.pose.yaw, 3.0 + 0.4 * t);
    }
}

fn damage(recording: &Recording) -> Option<u64> {
    recording.warnings().iter().find_map(|warning| match warning {
        Warning::Damaged { messages, .. } => Some(*messages),
        _ => None,
    })
}

#[test]
fn all_storages_give_the_same_recording() {
    let mut fingerprints = Vec::new();
    for name in ["drive.mcap", "drive-zstd.mcap", "drive.db3"] {
        let recording = rosbag::read(&fixture(name), &options()).expect(name);
        assert_tracks(&recording, COUNT);
        assert_poses(&recording, COUNT);
        let imu = recording.runs()[0].imu();
        assert_eq!(imu.len(), COUNT);
        assert_near(imu[7].gyro_z, 0.47);
        assert_eq!((imu[7].acc_x, imu[7].acc_y), (0.5, -0.25));
        assert_eq!(recording.source().epoch_ns, Some(1_700_000_000_000_000_000));
        assert_eq!(damage(&recording), None);
        fingerprints.push(recording.fingerprint().to_owned());
    }
    assert!(fingerprints.iter().all(|other| *other == fingerprints[0]));
}

#[test]
fn a_bag_folder_is_read_through_its_metadata() {
    for pose_topic in ["/pose", "/amcl", "/leica"] {
        let options = RosbagOptions { pose_topic: Some(pose_topic.into()), ..options() };
        let recording = rosbag::read(&fixture("poses"), &options).expect(pose_topic);
        assert_poses(&recording, COUNT);
        // positions give one speed less than there are messages
        assert_tracks(&recording, COUNT - 1);
    }
}

#[test]
fn a_listed_file_that_is_not_there_is_missed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in ["metadata.yaml", "poses.mcap"] {
        std::fs::copy(fixture("poses").join(name), folder.path().join(name)).expect("copied");
    }
    let metadata = folder.path().join("metadata.yaml");
    let text = std::fs::read_to_string(&metadata).expect("text");
    let more = text.replace("  - poses.mcap\n", "  - poses.mcap\n  - poses_1.mcap\n");
    assert_ne!(more, text);
    std::fs::write(&metadata, more).expect("written");
    let options = RosbagOptions { pose_topic: Some("/amcl".into()), ..options() };
    let recording = rosbag::read(folder.path(), &options).expect("readable");
    let path = folder.path().join("poses_1.mcap");
    assert!(recording.warnings().contains(&Warning::PartMissing { path }));
}

/// The odometry of the tracks agrees with any model of them.
#[test]
fn poses_that_may_come_from_the_tracks_are_doubted() {
    let doubts = |name: &str, options: &RosbagOptions| {
        let recording = rosbag::read(&fixture(name), options).expect("readable");
        let doubt = |warning: &&Warning| matches!(warning, Warning::OwnOdometry { .. });
        recording.warnings().iter().filter(doubt).count()
    };
    assert_eq!(doubts("drive.mcap", &options()), 1);
    let amcl = RosbagOptions { pose_topic: Some("/amcl".into()), ..options() };
    assert_eq!(doubts("poses", &amcl), 0);
    let tf = RosbagOptions {
        pose_topic: Some("/tf".into()),
        child_frame: Some("base_link".into()),
        ..options()
    };
    assert_eq!(doubts("poses", &tf), 1);
}

#[test]
fn transforms_are_told_apart_by_their_frames() {
    let tf = RosbagOptions { pose_topic: Some("/tf".into()), ..options() };
    let composed = rosbag::read(&fixture("poses"), &tf).expect("map over odometry");
    let is_told = |warning: &Warning| warning.to_string().contains("base_link in map by map");
    assert!(composed.warnings().iter().any(is_told), "{:?}", composed.warnings());
    let options = RosbagOptions { child_frame: Some("/base_link".into()), ..tf };
    assert_poses(&rosbag::read(&fixture("poses"), &options).expect("one pair"), COUNT);
}

#[test]
fn several_topics_that_fit_are_named_and_none_is_taken() {
    let error = rosbag::read(&fixture("poses"), &options()).expect_err("four sources of poses");
    assert!(matches!(error, Error::Topic { what: "poses", .. }));
    let text = error.to_string();
    assert!(["/pose", "/amcl", "/leica", "/tf"].iter().all(|topic| text.contains(topic)), "{text}");
}

#[test]
fn joints_are_chosen_and_reversed_by_name() {
    let named = RosbagOptions {
        left_joints: vec!["rear_left".into()],
        right_joints: vec!["-front_right".into(), "-rear_right".into()],
        ..options()
    };
    let recording = rosbag::read(&fixture("drive.mcap"), &named).expect("readable");
    let first = recording.runs()[0].tracks()[0];
    assert_near(first.v_left, RADIUS * 2.5);
    assert_near(first.v_right, RADIUS * -4.0);
    let taken = |recording: &Recording| -> Vec<String> {
        let notes = recording.warnings().iter().map(ToString::to_string);
        notes.filter(|note| note.contains("joints")).collect()
    };
    assert!(taken(&recording).is_empty());
    // what was guessed by the names is said
    let guessed = rosbag::read(&fixture("drive.mcap"), &options()).expect("readable");
    assert_eq!(taken(&guessed)[0], "left joints: took front_left, rear_left");
}

#[test]
fn what_is_missing_is_said_with_what_is_there() {
    let of = |options: RosbagOptions| {
        rosbag::read(&fixture("drive.mcap"), &options).expect_err("refused").to_string()
    };
    let text = of(RosbagOptions { pose_topic: Some("/nowhere".into()), ..options() });
    assert!(text.contains("/odom (nav_msgs/msg/Odometry)"), "{text}");
    assert!(text.contains("--pose-topic") && text.contains("/nowhere is not there"), "{text}");
    let text = of(RosbagOptions { left_joints: vec!["port".into()], ..options() });
    let absent =
        "20 messages skipped, because not all of the left joints (port) are in it, but front_left";
    assert!(text.contains(absent), "{text}");
    let text = of(RosbagOptions { joint_signal: JointSignal::Position, ..options() });
    assert!(text.contains("the joints have no such signal"), "{text}");
    let text = of(RosbagOptions::default());
    assert!(text.contains("expected the radius of wheel or sprocket, --wheel-radius"), "{text}");
}

#[test]
fn messages_without_a_stamp_are_dated_by_their_logging() {
    let recording = rosbag::read(&fixture("undated.mcap"), &options()).expect("readable");
    assert_tracks(&recording, COUNT);
    assert_poses(&recording, COUNT);
    assert_eq!(recording.source().epoch_ns, Some(1_700_000_000_002_000_000));
    for topic in ["/joints", "/odom"] {
        let said = Warning::LogTime { topic: topic.to_owned(), count: COUNT as u64 };
        assert!(recording.warnings().contains(&said));
    }
}

/// A simulation begins at zero: its first message has that stamp, and was logged at another time.
#[test]
fn a_message_without_a_stamp_among_others_is_left_out() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("drive.db3");
    std::fs::copy(fixture("drive.db3"), &path).expect("copied");
    let bag = rusqlite::Connection::open(&path).expect("a database");
    // the stamp follows the four bytes that say how the message is encoded
    let first = "UPDATE messages \
                 SET data = CAST(substr(data, 1, 4) || zeroblob(8) || substr(data, 13) AS BLOB) \
                 WHERE id = 1";
    assert_eq!(bag.execute(first, []), Ok(1));
    drop(bag);
    let recording = rosbag::read(&path, &options()).expect("readable");
    let tracks = recording.runs()[0].tracks();
    assert_eq!(tracks.len(), COUNT - 1);
    assert_near(tracks[0].t, 0.05);
    assert_poses(&recording, COUNT);
    let said = recording.warnings().iter().any(|warning| match warning {
        Warning::MessagesSkipped { topic, count: 1, reason } => {
            topic == "/joint_states" && reason.contains("no stamp")
        }
        _ => false,
    });
    assert!(said, "{:?}", recording.warnings());
}

#[test]
fn a_folder_without_metadata_is_read_file_by_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in ["a_10.mcap", "a_9.mcap"] {
        std::fs::copy(fixture("drive.mcap"), folder.path().join(name)).expect("copied");
    }
    let recording = rosbag::read(folder.path(), &options()).expect("readable");
    assert_tracks(&recording, COUNT);
    let repeats = recording.warnings().iter().filter(|warning| match warning {
        Warning::Cleaned(cleaning) => {
            cleaning.finding == Finding::Repeated && cleaning.count == COUNT
        }
        _ => false,
    });
    assert_eq!(repeats.count(), 3, "all rows of tracks, poses and imu stand there twice");
}

#[test]
fn a_text_is_no_bag_however_short() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("notes.mcap");
    for text in ["hello", "a text that is longer than how a bag begins"] {
        std::fs::write(&path, text).expect("written");
        let refused = rosbag::read(&path, &options()).expect_err("refused");
        assert!(matches!(refused, Error::Bag { .. }), "{refused}");
    }
}

#[test]
fn a_truncated_mcap_keeps_its_good_part_and_says_so() {
    for name in ["drive.mcap", "drive-zstd.mcap"] {
        let whole = std::fs::read(fixture(name)).expect("a fixture");
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("cut.mcap");
        let mut partly = 0;
        for cut in (0..whole.len()).step_by(whole.len() / 60) {
            std::fs::write(&path, &whole[..cut]).expect("written");
            match rosbag::read(&path, &options()) {
                Ok(recording) => {
                    let count = recording.runs()[0].tracks().len();
                    assert_tracks(&recording, count);
                    assert!(damage(&recording).is_some(), "cut at {cut} goes unsaid");
                    partly += u32::from(count < COUNT);
                }
                Err(Error::Bag { .. } | Error::Topic { .. } | Error::Empty { .. }) => {}
                Err(error) => panic!("cut at {cut}: {error}"),
            }
        }
        // the data of the uncompressed file are in its first third, in one chunk
        assert!(partly >= 3 || name == "drive-zstd.mcap", "{name}: {partly} partial readings");
    }
}

#[test]
fn a_byte_flipped_anywhere_never_panics() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in ["drive.mcap", "drive-zstd.mcap", "drive.db3"] {
        let whole = std::fs::read(fixture(name)).expect("a fixture");
        let path = folder.path().join(name);
        let good = rosbag::read(&fixture(name), &options()).expect("readable");
        let mut noticed = 0;
        for at in (0..whole.len()).step_by(97) {
            let mut bytes = whole.clone();
            bytes[at] ^= 0x41;
            std::fs::write(&path, &bytes).expect("written");
            match rosbag::read(&path, &options()) {
                Ok(recording) => {
                    noticed += u32::from(recording.warnings().len() > good.warnings().len());
                }
                Err(_) => noticed += 1,
            }
        }
        assert!(noticed > 0, "{name}: no flip was noticed");
    }
}

#[test]
fn a_truncated_db3_keeps_its_good_part_or_is_refused() {
    let whole = std::fs::read(fixture("drive.db3")).expect("a fixture");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("cut.db3");
    for cut in (0..whole.len()).step_by(2048) {
        std::fs::write(&path, &whole[..cut]).expect("written");
        match rosbag::read(&path, &options()) {
            Ok(recording) => {
                assert_tracks(&recording, recording.runs()[0].tracks().len());
                assert!(damage(&recording).is_some(), "cut at {cut} goes unsaid");
            }
            Err(Error::Bag { .. } | Error::Topic { .. } | Error::Empty { .. }) => {}
            Err(error) => panic!("cut at {cut}: {error}"),
        }
    }
}

#[test]
fn inspection_lists_the_bag_and_suggests_options_that_read_it() {
    for name in ["drive.mcap", "drive.db3"] {
        let inspection = rosbag::inspect(&fixture(name)).expect(name);
        let names: Vec<&str> = inspection.topics.iter().map(|t| t.name.as_str()).collect();
        assert_eq!(names, ["/chatter", "/imu/data", "/joint_states", "/odom"]);
        assert!(inspection.topics.iter().all(|topic| topic.messages == 20));
        let joints = &inspection.topics[2];
        assert_near(joints.duration, 0.95);
        assert_eq!(joints.role, Some(Role::Tracks));
        assert_eq!(joints.signals, ["velocity"]);
        assert_eq!(joints.joints.len(), 5);
        let suggested = &inspection.suggested;
        assert_eq!(suggested.left_joints, ["front_left", "rear_left"]);
        assert_eq!(suggested.child_frame.as_deref(), Some("base_link"));
        let options = RosbagOptions { wheel_radius: Some(RADIUS), ..suggested.clone() };
        assert_tracks(&rosbag::read(&fixture(name), &options).expect("readable"), COUNT);
    }
    let poses = rosbag::inspect(&fixture("poses")).expect("readable");
    assert_eq!(poses.topics[4].frames.len(), 2, "map to odom, odom to base_link");
    assert_eq!(poses.suggested.pose_topic, None, "three topics could be it");
}

//! Localisation by laser, the paper's section 5.3: from drives in a room to recordings.

use super::models::GAUGE;
use super::robot::auriga_without_alpha;
use crate::validation::map_statistics;
use std::f64::consts::TAU;
use trackdyn_core::{Pose, Trajectory};
use trackdyn_drive::schedules::as_commanded;
use trackdyn_drive::sensors::{Preset, Views};
use trackdyn_drive::tracking::DriveOptions;
use trackdyn_drive::{Ending, Path, Sensors, Tracker, drive};
use trackdyn_estimate::odometry::ParameterSet;
use trackdyn_localisation::{
    Localisation, LocalisedPose, MatchAgainst, Room, Scan, Scanner, localise,
};
use trackdyn_model::Model;
use trackdyn_model::{Kinematics, Transient};
use trackdyn_recording::{PoseSample, TrackSample, UncheckedRun, hold};

/// Corner of Auriga-alpha's tracks as seen from their centre, half of 0.70 m by 0.57 m: what must
/// not touch a wall, m.
const REACH: f64 = 0.452;

/// A drive along a figure of eight, with what was measured on it.
pub struct Drive {
    id: i64,
    truth: Trajectory,
    tracks: Vec<TrackSample>,
    /// Odometry of the ideal drive at the scans.
    odometry: Vec<Pose>,
    scans: Vec<Scan>,
}

/// Where the laser sits: ahead of the centre, a little to the left, not quite straight.
pub fn mount() -> Pose {
    Pose::new(0.25, 0.05, 0.02)
}

/// An eight in the middle of the room, one and a half times, about 20 m: wide or narrow by its
/// number, and every second one the other way.
fn eight(id: i64) -> Path {
    let (size, sense) =
        (f64::from(u8::try_from(id).expect("few")), [1.0, -1.0][usize::from(id % 2 == 1)]);
    let (width, height) = (2.0 + 0.07 * size, 1.2 + 0.07 * size);
    let point = |k: u32| {
        let angle = TAU * f64::from(k) / 480.0;
        [5.0 + width * angle.sin(), 4.1 + sense * height * (2.0 * angle).sin()]
    };
    Path::new((0..720).map(point).collect()).expect("an eight")
}

impl Drive {
    /// Drives by the kinematics of the simulated map, and measures.
    pub fn new(model: &Model, id: i64) -> Self {
        let room = Room::furnished();
        let path = eight(id);
        let steering = Kinematics::new(map_statistics(&auriga_without_alpha()).mean);
        let tracker = Tracker { look_ahead: 0.3, speed: 0.4, ..Tracker::default() };
        let mut robot = Transient::at_rest(model, 0.0, path.start());
        let options = DriveOptions::default();
        let journey = drive(&mut robot, &path, &tracker, &steering, &options, &|_| ());
        let journey = journey.expect("values that a tracker has");
        assert_eq!(journey.ending, Ending::Arrived);
        let schedule = journey.schedule().expect("commands");
        let truth = journey.trajectory;
        assert!(
            clearance(&room, &truth) > REACH,
            "run {id} comes {} m near",
            clearance(&room, &truth)
        );

        let encoders = as_commanded(&schedule, &truth);
        let sensors = Preset::Laboratory.sensors();
        let views = Views { encoders: &encoders, body: &truth, poses: &truth };
        let tracks = sensors.observe_views(id, &views, 1).expect("a motion").tracks.samples;

        let scanner = Scanner {
            robot_from_sensor: mount(),
            seed: 100 + id.unsigned_abs(),
            ..Scanner::default()
        };
        let [start, end] = truth.span().expect("a motion");
        let scans: Vec<Scan> = (0..u32::MAX)
            .map(|k| (k, start + scanner.period * f64::from(k)))
            .take_while(|(_, t)| *t <= end)
            .map(|(k, t)| scanner.scan(&room, t, k.into(), |t| truth.pose_at(t)).expect("a scan"))
            .collect();
        let odometry = odometry(&tracks, &scans, scan_clock(&sensors));
        Self { id, truth, tracks, odometry, scans }
    }

    /// Where the laser takes the robot to be.
    pub fn localised(&self, against: MatchAgainst) -> Vec<LocalisedPose> {
        let options =
            Localisation { against, robot_from_sensor: mount(), ..Localisation::default() };
        localise(&self.scans, &self.odometry, &options).expect("scans in order")
    }

    /// True poses of the robot at the scans, as seen from the first.
    pub fn truth(&self) -> Vec<Pose> {
        let at = |scan: &Scan| self.truth.pose_at(scan.stamp());
        let first = at(&self.scans[0]);
        self.scans.iter().map(|scan| first.relative(&at(scan))).collect()
    }

    /// Encoders and localised poses as a run.
    pub fn run(&self, localised: &[LocalisedPose]) -> UncheckedRun {
        let pose = |found: &LocalisedPose| PoseSample { t: found.stamp, pose: found.estimate.pose };
        UncheckedRun {
            id: self.id,
            tracks: self.tracks.clone().into(),
            poses: localised.iter().map(pose).collect::<Vec<_>>().into(),
            imu: Vec::new().into(),
        }
    }
}

/// Clock offset of scans, which are stamped when they are taken, against these encoders, s.
fn scan_clock(sensors: &Sensors) -> f64 {
    sensors.clock_offset() - sensors.pose.delay
}

/// Poses of the ideal drive at the scans.
fn odometry(tracks: &[TrackSample], scans: &[Scan], tau: f64) -> Vec<Pose> {
    let ideal = ParameterSet::ideal(GAUGE);
    let mut poses = vec![Pose::default()];
    for (pair, before) in scans.windows(2).zip(0..) {
        let [from, to] = [pair[0].stamp(), pair[1].stamp()];
        let motion = hold::integrate(tracks, from, to, tau, |speeds| ideal.steady(speeds).1);
        poses.push(poses[before].compose(&motion));
    }
    poses
}

/// Least distance between the robot's origin and what stands in the room, m.
fn clearance(room: &Room, truth: &Trajectory) -> f64 {
    let distance = |[x, y]: [f64; 2]| {
        let of = |segment: &trackdyn_localisation::room::Segment| {
            let ([a, b], [c, d]) = (segment.from, segment.to);
            let squared = (c - a).powi(2) + (d - b).powi(2);
            let share = (((x - a) * (c - a) + (y - b) * (d - b)) / squared).clamp(0.0, 1.0);
            (a + share * (c - a) - x).hypot(b + share * (d - b) - y)
        };
        room.segments().iter().map(of).fold(f64::INFINITY, f64::min)
    };
    truth
        .moments()
        .iter()
        .map(|moment| distance([moment.pose.x, moment.pose.y]))
        .fold(f64::INFINITY, f64::min)
}

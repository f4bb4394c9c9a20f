//! A diagnosis as layers of viewers: what was observed, what is claimed, and what the ideal drive
//! and the vehicle file predict, the file as it is and as corrected.

mod claims;
mod mismatch;

use super::Diagnosis;
use crate::viewer::{self, Actor, Moment, Timeline, plot};
use crate::{Error, Provenance};
use std::ops::Range;
use trackdyn_core::{PerSide, Pose, Twist};
use trackdyn_diagnose::evidence::Sample;
use trackdyn_diagnose::{Evidence, replay};
use trackdyn_export::viewer::{JointLayer, Layers, MarkerLayer, PathLayer, Tab, Trace};
use trackdyn_model::VehicleFile;
use trackdyn_recording::Recording as Motion;
use trackdyn_report::figure::entry_colour;

/// What viewers need to know of a recording beside its evidence.
pub(super) struct Log {
    timeline: Timeline,
    frames: [String; 2],
    robot: String,
}

impl Log {
    pub(super) fn of(motion: &Motion) -> Self {
        let robot = motion.robot().to_owned();
        Self { timeline: Timeline::new(motion), frames: viewer::frames(motion), robot }
    }
}

/// Someone who drives, with the motion of each sample.
struct Driver {
    actor: Actor,
    /// Frame that moves along its path.
    frame: String,
    motions: Vec<Pose>,
    /// Whether the motions are those observed.
    is_observed: bool,
}

/// Samples of a run in a row, which last about [`viewer::PIECE`].
struct Piece {
    samples: Range<usize>,
    duration: f64,
}

/// The layers of a diagnosis.
pub(super) fn of(diagnosis: &Diagnosis, provenance: &Provenance) -> Result<Layers, Error> {
    let prepared = &diagnosis.of;
    let none = || Error::NoMotion { recording: prepared.place.clone() };
    let log = prepared.log.as_ref().ok_or_else(none)?;
    let evidence = &prepared.evidence;
    let drive = Drive { evidence, log };
    let corrected = diagnosis.corrected.file();
    let drivers = drive.drivers(prepared.vehicle.file(), corrected, prepared.vehicle.gauge());
    let pieces = drive.pieces();
    let tracks = drive.tracks();
    let gauge = prepared.vehicle.gauge();
    let [fixed_frame, _] = log.frames.clone();
    Ok(Layers {
        notes: viewer::notes([
            ("command", provenance.command.clone()),
            ("version", provenance.version.clone()),
            ("recording", prepared.name.clone()),
            ("fingerprint", prepared.fingerprint.clone()),
            ("robot", log.robot.clone()),
            ("vehicle", prepared.vehicle.name().to_owned()),
            ("vehicle_fingerprint", prepared.vehicle.fingerprint()),
            ("status", diagnosis.status().name().to_owned()),
            ("where", diagnosis.found.answer.place.clone()),
            ("clock_offset_s", format!("{:.9}", evidence.tau())),
            ("runs_moved_in_time", log.timeline.moved()),
        ]),
        fixed_frame,
        paths: drivers.iter().map(|driver| drive.path(driver)).collect(),
        markers: drivers.iter().map(|driver| drive.markers(driver, &pieces, gauge)).collect(),
        texts: vec![drive.regimes(diagnosis), drive.claims(diagnosis)],
        tabs: vec![
            drive.motion(&drivers, &tracks),
            drive.residuals(diagnosis),
            drive.icrs(&drivers, &pieces),
        ],
        joints: vec![tracks],
    })
}

/// The motion over a sample of the ideal drive, whose tracks do not slip.
///
/// # Law
/// v = (V_l + V_r)/2, ω = (V_r − V_l)/L.
fn ideal(sample: &Sample, gauge: f64) -> Pose {
    let PerSide { left, right } = sample.speeds;
    let twist = Twist { v_x: f64::midpoint(left, right), v_y: 0.0, w: (right - left) / gauge };
    Pose::exp(&twist, sample.duration)
}

/// The evidence of all runs, and their log.
struct Drive<'a> {
    evidence: &'a Evidence,
    log: &'a Log,
}

impl Drive<'_> {
    /// The stamp of a time of a run, by its index, s as those of the samples.
    fn stamp(&self, run: usize, t: f64) -> u64 {
        self.log.timeline.stamp(self.evidence.runs()[run], self.evidence.begin() + t)
    }

    /// The stamp of the middle of a sample.
    fn middle(&self, sample: &Sample) -> u64 {
        self.stamp(sample.run, sample.start + sample.duration / 2.0)
    }

    /// The robot as observed; as filed and as corrected, where these have a motion; and the ideal
    /// drive with this gauge, m.
    fn drivers(&self, filed: &VehicleFile, corrected: &VehicleFile, gauge: f64) -> Vec<Driver> {
        let [_, base_frame] = &self.log.frames;
        let names = ["as filed", "corrected", "ideal"];
        let models = names.into_iter().enumerate().map(|(place, name)| (name, entry_colour(place)));
        let (observed, models) = Actor::all(models);
        let observed = Driver {
            actor: observed,
            frame: base_frame.clone(),
            motions: self.evidence.samples().iter().map(|of| replay::pose(&of.motion)).collect(),
            is_observed: true,
        };
        let motions = [
            replay::motions(self.evidence, filed),
            replay::motions(self.evidence, corrected),
            Some(self.evidence.samples().iter().map(|of| ideal(of, gauge)).collect()),
        ];
        let models = models.into_iter().zip(motions).filter_map(|(actor, motions)| {
            let motions: Vec<Pose> = motions?;
            let frame = actor.frame().to_owned();
            Some(Driver { frame, motions, is_observed: false, actor })
        });
        std::iter::once(observed).chain(models).collect()
    }

    /// The samples of each run that has some.
    fn runs(&self) -> Vec<Range<usize>> {
        let samples = self.evidence.samples();
        let mut runs: Vec<Range<usize>> = Vec::new();
        for (index, sample) in samples.iter().enumerate() {
            match runs.last_mut() {
                Some(run) if samples[run.start].run == sample.run => run.end = index + 1,
                _ => runs.push(index..index + 1),
            }
        }
        runs
    }

    /// Samples in a row, without gaps, of about a second, from one place that was seen to another;
    /// what is left is too short and dropped.
    fn pieces(&self) -> Vec<Piece> {
        const ROUNDING: f64 = 1e-6;
        let samples = self.evidence.samples();
        let mut pieces = Vec::new();
        let mut open: Option<Piece> = None;
        for (index, sample) in samples.iter().enumerate() {
            let start = match open.take().filter(|_| sample.follows) {
                Some(open) => open,
                None => Piece { samples: index..index, duration: 0.0 },
            };
            let piece = Piece {
                samples: start.samples.start..index + 1,
                duration: start.duration + sample.duration,
            };
            if piece.duration >= viewer::PIECE - ROUNDING && sample.has_place[1] {
                pieces.push(piece);
            } else {
                open = Some(piece);
            }
        }
        pieces
    }

    fn path(&self, driver: &Driver) -> PathLayer {
        let mut layer = driver.actor.path(&driver.frame);
        for chosen in self.runs() {
            let run = self.evidence.samples()[chosen.start].run;
            layer.starts.push(layer.poses.len());
            let times = replay::times(self.evidence, chosen.clone());
            layer.stamps.extend(times.into_iter().map(|t| self.stamp(run, t)));
            layer.poses.extend(if driver.is_observed {
                replay::observed(self.evidence, chosen)
            } else {
                replay::chained(self.evidence, chosen, &driver.motions)
            });
        }
        layer
    }

    /// Track speeds as measured.
    fn tracks(&self) -> JointLayer {
        let mut layer = viewer::tracks();
        for (run, readings) in self.evidence.tracks().iter().enumerate() {
            for reading in readings {
                layer.stamps.push(self.stamp(run, reading.t));
                layer.speeds.push(reading.speeds());
            }
        }
        layer
    }

    /// The stamp of the middle of a piece, and the ICRs of a driver over it, where it turns.
    fn moment(&self, driver: &Driver, piece: &Piece) -> (u64, Option<Moment>) {
        let samples = self.evidence.samples();
        let mut moved = Pose::default();
        let mut way = PerSide::<f64>::default();
        for index in piece.samples.clone() {
            let Sample { duration, speeds, .. } = samples[index];
            moved = moved.compose(&driver.motions[index]);
            way.left += speeds.left * duration;
            way.right += speeds.right * duration;
        }
        let first = &samples[piece.samples.start];
        let stamp = self.stamp(first.run, first.start + piece.duration / 2.0);
        let speeds = way.map(|way| way / piece.duration);
        (stamp, Moment::of_motion(&moved, piece.duration, speeds))
    }

    /// Markers of the ICRs, which move with the robot.
    fn markers(&self, driver: &Driver, pieces: &[Piece], gauge: f64) -> MarkerLayer {
        let [_, base_frame] = &self.log.frames;
        let mut layer = viewer::markers(&driver.actor, base_frame, gauge);
        for piece in pieces {
            let (stamp, moment) = self.moment(driver, piece);
            layer.stamps.push(stamp);
            layer.places.push(viewer::places(moment.as_ref()));
        }
        layer
    }

    /// Curves of the ICRs.
    fn icrs(&self, drivers: &[Driver], pieces: &[Piece]) -> Tab {
        let plots = viewer::COORDINATES.map(|(title, topic, value)| {
            let curves = drivers.iter().map(|driver| {
                let mut trace = Trace::default();
                for piece in pieces {
                    if let (stamp, Some(moment)) = self.moment(driver, piece) {
                        trace.push(stamp, value(&moment.tracks));
                    }
                }
                driver.actor.curve(topic, trace)
            });
            plot(title, curves)
        });
        Tab { title: "ICRs".to_owned(), plots: plots.into() }
    }

    /// Track speeds, and rates of all samples.
    fn motion(&self, drivers: &[Driver], tracks: &JointLayer) -> Tab {
        let rates = viewer::RATES.map(|(title, topic, rate)| {
            let curves = drivers.iter().map(|driver| {
                let mut trace = Trace::default();
                for (sample, motion) in self.evidence.samples().iter().zip(&driver.motions) {
                    if let Some(rate) = rate(motion, sample.duration) {
                        trace.push(self.middle(sample), rate);
                    }
                }
                driver.actor.curve(topic, trace)
            });
            plot(title, curves)
        });
        let plots = std::iter::once(viewer::track_speeds(tracks)).chain(rates).collect();
        Tab { title: "Motion".to_owned(), plots }
    }
}

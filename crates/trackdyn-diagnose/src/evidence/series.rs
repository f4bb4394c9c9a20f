//! Evidence from recordings of driving.

use super::{Evidence, Origin, Sample, between_places, check_number};
use crate::error::Error;
use crate::settings::{self, Settings};
use nalgebra::Vector3;
use std::borrow::Cow;
use std::sync::Arc;
use trackdyn_core::robust::usual_interval;
use trackdyn_core::{PerSide, Pose};
use trackdyn_estimate::blocks::Blocks;
use trackdyn_estimate::frames::share_a_frame;
use trackdyn_estimate::gyroscope::{Corrected, Filled, Unfit, with_gyroscope};
use trackdyn_estimate::noise::{Noise, noise};
use trackdyn_estimate::observations::{Observation, Observations, Piece};
use trackdyn_estimate::regular::with_regular_poses;
use trackdyn_estimate::residual_noise;
use trackdyn_estimate::thinned::{with_poses_every, with_readings_every};
use trackdyn_estimate::weighting::{MIN_POSE_NOISE, SegmentNoise};
use trackdyn_estimate::{Clock, SegmentOptions, spin_test};
use trackdyn_recording::{Recording, Run, TrackSample};

/// Difference of times that is rounding, s.
const ROUNDING: f64 = 1e-6;

/// What is said where each run has a frame of its own.
const NO_WORLD_MESSAGE: &str = "; each run has a frame of its own, so nothing is looked for that \
                                needs a place or a heading in the world";

impl Evidence {
    /// The segments of a recording, with noise measured on the recording without a model: the
    /// starting values of [`noise`](crate::noise).
    ///
    /// `gauge` (m) converts encoder noise to yaw noise where the robot never spins.
    ///
    /// # Errors
    /// Too few segments, no noise measured or stated, poses far from the origin of their frame, or
    /// clocks that do not go together.
    pub fn of_recording(
        recording: &Recording,
        gauge: f64,
        settings: &Settings,
    ) -> Result<Self, Error> {
        Self::of_drive(recording, gauge, settings, false, None)
    }

    /// The segments of a recording: where it is wanted, with the yaw of its poses corrected by its
    /// gyroscope, if it has one that serves ([`Evidence::gyroscope`]). `tau` is the time by which
    /// poses lag behind the track speeds, s; estimated where it is not given.
    ///
    /// # Errors
    /// Those of [`Evidence::of_recording`].
    pub fn of_drive(
        recording: &Recording,
        gauge: f64,
        settings: &Settings,
        by_gyroscope: bool,
        tau: Option<f64>,
    ) -> Result<Self, Error> {
        settings.check()?;
        let by = &settings.evidence;
        check_places(recording, by.max_coordinate)?;
        let recording = with_readings_every(recording, by.min_reading_interval);
        let recording = with_poses_every(&recording, by.min_pose_interval);
        let clock = Clock::of(&recording, tau, &settings.clock).map_err(Error::Clock)?;
        let tau = clock.tau();
        let poses = Poses::quieter(&recording, tau, settings);
        let poses = if by_gyroscope { poses.with_gyroscope(tau, settings) } else { poses };
        let seen = segments(poses.recording(), tau, None, by);
        let spin = spin_test(&seen, gauge, &settings.spin);
        let gap = spin.map_or(by.gap_without_spins * gauge, |spin| spin.gap);
        let noise = noise_of_segments(&poses, &seen, gap, gauge)?;
        let blocks = seen.blocks(by.min_whole_runs);
        let has_world = share_a_frame(poses.recording(), &settings.frames);
        let begin = poses.recording().begin();
        let samples = if let Some(Filled { recording, has_place }) = poses.filled(by) {
            // Poses that the gyroscope does not join are as far apart as they were.
            let longest = longest_pose_interval(&seen);
            let observations = segments(&recording, tau, Some(longest), by);
            samples(&recording, &has_place, &observations, &blocks, begin)
        } else {
            let has_place = all_seen(poses.recording());
            samples(poses.recording(), &has_place, &seen, &blocks, begin)
        };
        check_number(&samples, by.min_segments)?;
        let tracks = tracks(poses.recording(), &samples, begin);
        let runs = poses.recording().runs().iter().map(Run::id).collect();
        let gyroscope = poses.corrected.map(|found| found.map(|corrected| corrected.gyroscope));
        Ok(Self {
            tracks: tracks.into(),
            samples: samples.into(),
            blocks: blocks.count(),
            runs,
            tau,
            begin,
            has_world,
            origin: Origin::Drive(noise),
            description: format!(
                "{}{}; noise measured on what driving cannot explain{}",
                blocks.description(),
                if matches!(gyroscope, Some(Ok(_))) { "; yaw by the gyroscope" } else { "" },
                if has_world { "" } else { NO_WORLD_MESSAGE }
            ),
            starts: None,
            gyroscope,
            settings: Arc::new(settings.clone()),
        })
    }
}

/// Checks that all poses lie within the region in which effects may have places.
fn check_places(recording: &Recording, largest: f64) -> Result<(), Error> {
    let poses = recording.runs().iter().flat_map(Run::poses);
    let along = |at: &Pose| at.x.abs().max(at.y.abs());
    let found = poses.map(|sample| along(&sample.pose)).fold(0.0, f64::max);
    if found > largest {
        return Err(Error::FarFromOrigin { found, largest });
    }
    Ok(())
}

/// Segments between neighbouring poses, each with a reading at least, at a clock offset of `tau`
/// (s); cut such that readings cover every offset from zero to beyond `tau`. A longer interval of
/// poses than this, s, is a gap.
fn segments(
    recording: &Recording,
    tau: f64,
    longest_pose_interval: Option<f64>,
    settings: &settings::Evidence,
) -> Observations {
    let options = SegmentOptions {
        minimum_duration: 0.0,
        minimum_readings: 1,
        longest_pose_interval,
        tau: tau / 2.0,
        tau_margin: tau.abs() / 2.0 + settings.clock_margin,
        ..SegmentOptions::default()
    };
    Observations::new(recording, &options).at(tau)
}

/// Noise of the segments: measured, or else as stated in the recording, or else what constant ICRs
/// leave. `gap` is the distance of the ICRs, m.
fn noise_of_segments(
    poses: &Poses,
    observations: &Observations,
    gap: f64,
    gauge: f64,
) -> Result<SegmentNoise, Error> {
    let stated = || poses.recording().stated_noise().map(SegmentNoise::stated);
    let remaining = || residual_noise(observations, gauge);
    let measured = SegmentNoise::measured(&poses.noise, gap);
    measured.or_else(stated).or_else(remaining).ok_or(Error::NoNoise)
}

/// One sample for each segment, with times since `begin`, from the first place that was seen to the
/// last in each row.
fn samples(
    recording: &Recording,
    has_place: &[Vec<bool>],
    observations: &Observations,
    blocks: &Blocks,
    begin: f64,
) -> Vec<Sample> {
    let sample = |segment: &Observation| {
        let poses = recording.runs()[segment.run].poses();
        let travelled = observations.travelled(segment);
        let pieces = observations.pieces(segment);
        let change = |speed: fn(&Piece) -> f64| {
            let (first, last) =
                (pieces.first().map_or(0.0, speed), pieces.last().map_or(0.0, speed));
            (last - first) / segment.duration
        };
        Sample {
            run: segment.run,
            block: blocks.of(segment.run, segment.start).unwrap_or(0),
            start: segment.start - begin,
            duration: segment.duration,
            motion: Vector3::from(segment.motion),
            pose: poses[segment.poses[0]].pose,
            speeds: travelled.map(|distance| distance / segment.duration),
            acceleration: PerSide::new(change(|piece| piece.v_left), change(|piece| piece.v_right)),
            follows: segment.follows,
            has_place: segment.poses.map(|pose| has_place[segment.run][pose]),
        }
    };
    let all: Vec<Sample> = observations.segments().iter().map(sample).collect();
    let mut kept: Vec<Sample> = Vec::new();
    for row in between_places(&all).map(|range| &all[range]) {
        let [Some(first), Some(last)] = [row.first(), row.last()] else { continue };
        if first.has_place[0] && last.has_place[1] {
            let is_next = |before: &Sample| before.run == first.run && ends_at(before, first.start);
            let follows = first.follows && kept.last().is_some_and(is_next);
            kept.push(Sample { follows, ..*first });
            kept.extend(&row[1..]);
        }
    }
    kept
}

/// Track readings of each run that has samples, with times since `begin`.
fn tracks(recording: &Recording, samples: &[Sample], begin: f64) -> Vec<Vec<TrackSample>> {
    let of_run = |(run, of): (usize, &Run)| {
        if !samples.iter().any(|sample| sample.run == run) {
            return Vec::new();
        }
        of.tracks().iter().map(|track| TrackSample { t: track.t - begin, ..*track }).collect()
    };
    recording.runs().iter().enumerate().map(of_run).collect()
}

/// A recording with the best of its poses.
struct Poses<'a> {
    /// The recording before a gyroscope corrects it.
    uncorrected: Cow<'a, Recording>,
    /// Their noise, measured without a model.
    noise: Noise,
    /// The recording as a gyroscope corrects it, or why not; none where it was not asked.
    corrected: Option<Result<Corrected, Unfit>>,
}

impl<'a> Poses<'a> {
    /// Those at regular times where that lowers the noise: a late stamp looks like motion.
    fn quieter(recording: &'a Recording, tau: f64, settings: &Settings) -> Self {
        let as_stamped = noise(recording, tau, &settings.measured_noise);
        let due = with_regular_poses(recording, &settings.stamps);
        let as_due = noise(&due, tau, &settings.measured_noise);
        // log of the product of the white-noise standard deviations
        let level = |noise: &Noise| -> Option<f64> {
            let axes = noise.moving.as_ref()?.of_pose;
            Some(axes.iter().map(|white| white.max(MIN_POSE_NOISE).ln()).sum())
        };
        let (uncorrected, noise) = match (level(&as_stamped), level(&as_due)) {
            (Some(stamped), Some(level)) if level < stamped => (Cow::Owned(due), as_due),
            _ => (Cow::Borrowed(recording), as_stamped),
        };
        Self { uncorrected, noise, corrected: None }
    }

    /// The recording, as a gyroscope corrects it where one serves.
    fn recording(&self) -> &Recording {
        match &self.corrected {
            Some(Ok(corrected)) => &corrected.recording,
            Some(Err(_)) | None => &self.uncorrected,
        }
    }

    /// The poses with their yaw corrected by a gyroscope; as they are where it does not serve. Late
    /// stamps were mended before, so that a pose and the gyroscope are compared at one time.
    fn with_gyroscope(self, tau: f64, settings: &Settings) -> Self {
        let corrected = with_gyroscope(&self.uncorrected, tau, &settings.gyroscope);
        let noise = match &corrected {
            Ok(corrected) => noise(&corrected.recording, tau, &settings.measured_noise),
            Err(_) => self.noise,
        };
        Self { noise, corrected: Some(corrected), ..self }
    }

    /// The recording with the yaw between its poses, where a gyroscope tells it.
    fn filled(&self, settings: &settings::Evidence) -> Option<Filled> {
        // Two readings of the tracks, so that no pose lacks one.
        let interval = |run: &Run| {
            let readings = usual_interval(run.tracks().iter().map(|reading| reading.t));
            settings.min_pose_interval.max(2.0 * readings)
        };
        let corrected = self.corrected.as_ref()?.as_ref().ok()?;
        Some(corrected.filled(interval))
    }
}

/// Of each pose of each run, that its place was measured.
fn all_seen(recording: &Recording) -> Vec<Vec<bool>> {
    recording.runs().iter().map(|run| vec![true; run.poses().len()]).collect()
}

/// Longest duration of a segment, s.
fn longest_pose_interval(observations: &Observations) -> f64 {
    observations.segments().iter().map(|segment| segment.duration).fold(0.0, f64::max)
}

/// Whether a sample ends at a time, s.
fn ends_at(sample: &Sample, time: f64) -> bool {
    (sample.start + sample.duration - time).abs() < ROUNDING
}

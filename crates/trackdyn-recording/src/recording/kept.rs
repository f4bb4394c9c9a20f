//! A recording taken apart and restored: for those who keep it in another form than files.

use super::{PoseFrame, Recording, Run, Source, StatedNoise, UncheckedRun, Warning};
use crate::Error;
use std::path::PathBuf;

/// All that a recording holds, but for the columns beside its samples and its warnings.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// Name for titles and outputs.
    pub name: String,
    /// The robot that was recorded.
    pub robot: String,
    /// The rows of the runs, as they were cleaned.
    pub runs: Vec<UncheckedRun>,
    /// Whether the positions of all poses are known.
    pub has_positions: bool,
    /// Pose noise as its maker states it.
    pub stated_noise: Option<StatedNoise>,
    /// Frame of its poses as its maker states it.
    pub pose_frame: Option<PoseFrame>,
    /// Where it comes from.
    pub source: Source,
    /// Fingerprint of the whole that it is, or is a part of.
    pub fingerprint: String,
    /// Fingerprint of the poses of that whole.
    pub pose_fingerprint: String,
}

impl Recording {
    /// What it holds.
    pub fn keep(&self) -> Kept {
        Kept {
            name: self.name.clone(),
            robot: self.robot.clone(),
            runs: self.runs.iter().map(|run| run.clone().into_rows()).collect(),
            has_positions: self.has_positions(),
            stated_noise: self.stated_noise,
            pose_frame: self.pose_frame,
            source: self.source.clone(),
            fingerprint: self.fingerprint.clone(),
            pose_fingerprint: self.pose_fingerprint.clone(),
        }
    }

    /// The recording that was kept. `warnings` are those that it had.
    ///
    /// # Errors
    /// [`Error::Empty`] where the rows are not those of a recording: cleaning leaves some out, or
    /// nothing is left.
    pub fn restore(kept: Kept, warnings: Vec<Warning>) -> Result<Self, Error> {
        let has_positions = kept.has_positions;
        let rows = |run: &UncheckedRun| [run.tracks.samples.len(), run.poses.samples.len()];
        let before: Vec<[usize; 2]> = kept.runs.iter().map(rows).collect();
        let restored = |run| Run::new(run, &mut Vec::new()).with_positions(has_positions);
        let runs: Vec<Run> = kept.runs.into_iter().map(restored).collect();
        let after = runs.iter().map(|run| [run.tracks().len(), run.poses().len()]);
        if runs.is_empty() || !after.eq(before) || !runs.iter().all(Run::is_usable) {
            let path = kept.source.path.unwrap_or_else(|| PathBuf::from(&kept.name));
            let message = "what was kept of it is no recording: expected it unchanged".to_owned();
            return Err(Error::Empty { path, message });
        }
        Ok(Self {
            name: kept.name,
            robot: kept.robot,
            runs,
            stated_noise: kept.stated_noise,
            pose_frame: kept.pose_frame,
            source: kept.source,
            warnings,
            fingerprint: kept.fingerprint,
            pose_fingerprint: kept.pose_fingerprint,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PoseSample, TrackSample};
    use trackdyn_core::Pose;

    fn recording() -> Recording {
        let time = |k: u32| 0.1 * f64::from(k);
        let tracks = (0..50).map(|k| TrackSample { t: time(k), v_left: 0.3, v_right: 0.4 });
        let pose =
            |k: u32| PoseSample { t: time(k), pose: Pose::new(0.035 * f64::from(k), 0.0, 0.1) };
        let run = |id| UncheckedRun {
            id,
            tracks: tracks.clone().collect::<Vec<_>>().into(),
            poses: (0..50).map(pose).collect::<Vec<_>>().into(),
            ..UncheckedRun::default()
        };
        let runs = vec![run(3), run(5)];
        Recording::new("drive", "robot", runs, Source::computed(), Vec::new()).expect("sound")
    }

    #[test]
    fn a_recording_is_restored() {
        let whole = recording();
        let part = whole.of_runs(&"5".parse().expect("a list")).expect("a run");
        for recording in [whole, part] {
            let restored = Recording::restore(recording.keep(), recording.warnings().to_vec());
            assert_eq!(restored.expect("unchanged"), recording);
        }
    }

    #[test]
    fn what_was_changed_is_refused() {
        let mut kept = recording().keep();
        kept.runs[0].tracks.samples[7].t = f64::NAN;
        let error = Recording::restore(kept, Vec::new()).expect_err("refused");
        assert!(error.to_string().contains("expected it unchanged"), "{error}");
    }
}

//! Scale, bias and lag of a gyroscope against poses.

use super::level::Level;
use super::turned::Turned;
use super::{Settings, Unfit};
use crate::gauss_newton::Loss;
use nalgebra::{Matrix2, Vector2};
use std::ops::Range;
use trackdyn_core::real;
use trackdyn_core::robust::deviation_about_zero;
use trackdyn_recording::Recording;

/// A recording and the integrals of its gyroscope, run by run.
pub(super) struct Drive<'a> {
    pub(super) recording: &'a Recording,
    pub(super) turned: &'a [Vec<Turned>],
    /// Indices of the poses of each run at which their yaw jumps.
    pub(super) jumps: Vec<Vec<usize>>,
    pub(super) settings: &'a Settings,
}

/// Poses of a run during which a gyroscope measures without a gap.
pub(super) struct Row<'a> {
    /// Index of the run.
    pub(super) run: usize,
    /// Index of its session: runs of a session share one bias.
    session: usize,
    /// Indices of the poses.
    pub(super) poses: Range<usize>,
    /// Their stamps, s.
    pub(super) times: Vec<f64>,
    yaws: Vec<f64>,
    turned: &'a Turned,
}

impl Row<'_> {
    /// Its poses in groups of one length, at least so long, s; two groups at least.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small, positive")]
    fn groups(&self, duration: f64) -> Vec<Range<usize>> {
        let [Some(first), Some(last)] = [self.times.first(), self.times.last()] else {
            return Vec::new();
        };
        let span = last - first;
        let count = (span / duration).floor().max(2.0);
        let group = |t: &f64| ((t - first) / span * count).min(count - 1.0) as usize;
        let mut end = 0;
        let of_times = self.times.chunk_by(|a, b| group(a) == group(b));
        let ranges = of_times.map(|times| {
            end += times.len();
            end - times.len()..end
        });
        ranges.collect()
    }
}

/// Means of a column over groups.
fn means(column: &[f64], groups: &[Range<usize>]) -> Vec<f64> {
    let mean = |group: &Range<usize>| column[group.clone()].iter().sum::<f64>() / real(group.len());
    groups.iter().map(mean).collect()
}

impl Drive<'_> {
    /// The rows of poses that the gyroscope covers at a lag, s.
    pub(super) fn rows(&self, lag: f64) -> Vec<Row<'_>> {
        let &Settings { min_row, max_session, .. } = self.settings;
        let mut rows = Vec::new();
        let (mut session, mut begin) = (0, f64::INFINITY);
        for (run, (of, turned)) in self.recording.runs().iter().zip(self.turned).enumerate() {
            if let Some(first) = of.imu().first()
                && !(0.0..max_session).contains(&(first.t - begin))
            {
                session += 1;
                begin = first.t;
            }
            for turned in turned {
                let [start, end] = turned.span();
                let index = |after: f64| of.poses().partition_point(|pose| pose.t - lag < after);
                let (mut first, last) = (index(start), index(end));
                let within = self.jumps[run].iter().filter(|jump| (first..last).contains(*jump));
                for end in within.copied().chain([last]).collect::<Vec<_>>() {
                    let poses = std::mem::replace(&mut first, end)..end;
                    if poses.len() >= min_row {
                        let samples = of.poses()[poses.clone()].iter();
                        let (times, yaws) =
                            samples.map(|sample| (sample.t, sample.pose.yaw)).unzip();
                        rows.push(Row { run, session, poses, times, yaws, turned });
                    }
                }
            }
        }
        rows
    }
}

/// Rows made white: residual, and derivatives by scale and by lag, without the bias of each row.
#[derive(Default)]
struct Whitened {
    residual: Vec<f64>,
    by: [Vec<f64>; 2],
}

/// What fits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    pub(super) scale: f64,
    /// Standard deviation of the scale.
    pub(super) scale_deviation: f64,
    pub(super) lag: f64,
    pub(super) level: Level,
}

impl Fit {
    /// A fit before any value is known but a lag, s.
    fn start(lag: f64, settings: &Settings) -> Self {
        let (scale, scale_deviation) = (1.0, settings.scale_prior);
        Self { scale, scale_deviation, lag, level: Level::DIFFERENCES }
    }

    /// The lag that fits best of those near none, and near a clock offset, s.
    pub(super) fn best_lag(drive: &Drive, tau: f64) -> Result<f64, Unfit> {
        let &Settings { max_lag, lag_step, min_poses, .. } = drive.settings;
        #[expect(clippy::cast_possible_truncation, reason = "a small count")]
        let steps = (max_lag / lag_step).round() as i32;
        let starts = [0.0, tau].into_iter();
        let lags =
            starts.flat_map(|at| (-steps..=steps).map(move |step| at + lag_step * f64::from(step)));
        let covered = |lag: f64| drive.rows(lag).iter().map(|row| row.poses.len()).sum::<usize>();
        let lags: Vec<(f64, usize)> = lags.map(|lag| (lag, covered(lag))).collect();
        let most = lags.iter().map(|(_, poses)| *poses).max().unwrap_or(0);
        // A few poses scatter little by chance.
        let often = lags.into_iter().filter(|(_, poses)| 2 * poses >= most);
        let misfit = |(lag, _): (f64, usize)| {
            Some((Self::start(lag, drive.settings).with_best_scale(drive)?, lag))
        };
        let best = often.filter_map(misfit).min_by(|a, b| a.0.total_cmp(&b.0));
        best.map(|(_, lag)| lag).ok_or(Unfit::TooFewPoses { found: most, needed: min_poses })
    }

    /// The best fit near a lag, s: quick changes determine the lag, and turns over longer times the
    /// scale.
    pub(super) fn near(drive: &Drive, lag: f64) -> Result<Self, Unfit> {
        let quick = Self::start(lag, drive.settings).settled(drive, lag, None)?;
        quick.settled(drive, quick.lag, Some(drive.settings.scale_interval))
    }

    /// The fit after steps until it settles, of which the lag starts at `lag`, s: by differences of
    /// poses; or by those of means over a time, s, with the lag it has.
    fn settled(self, drive: &Drive, lag: f64, over: Option<f64>) -> Result<Self, Unfit> {
        let &Settings { max_steps, lag_step, min_poses, .. } = drive.settings;
        let mut fit = self;
        for _ in 0..max_steps {
            let rows = drive.rows(fit.lag);
            let (step, variance) = fit.step(&fit.whitened(&rows, over), lag, drive.settings);
            fit.scale_deviation = variance.sqrt();
            fit.scale += step.x;
            fit.lag += step.y.clamp(-lag_step, lag_step);
            let rows = drive.rows(fit.lag);
            let residuals = rows.iter().map(|row| &row.times[..]).zip(fit.residuals(&rows));
            let Some(level) = Level::of(&residuals.collect::<Vec<_>>(), drive.settings) else {
                let rows = rows.iter().map(|row| row.poses.len());
                let (found, longest) = (rows.clone().sum(), rows.max().unwrap_or(0));
                return Err(if found < min_poses {
                    Unfit::TooFewPoses { found, needed: min_poses }
                } else {
                    Unfit::ShortRows { longest }
                });
            };
            fit.level = level;
            if step.x.abs() < 1e-7 && step.y.abs() < 1e-6 {
                break;
            }
        }
        Ok(fit)
    }

    /// Spread of the differences that the best scale leaves at this lag.
    fn with_best_scale(&self, drive: &Drive) -> Option<f64> {
        let Whitened { residual, by: [by_scale, _] } = self.whitened(&drive.rows(self.lag), None);
        let square: f64 = by_scale.iter().map(|by| by * by).sum();
        let product: f64 = by_scale.iter().zip(&residual).map(|(by, r)| by * r).sum();
        let change = if square > 0.0 { product / square } else { 0.0 };
        let left = residual.iter().zip(&by_scale).map(|(r, by)| r - change * by);
        let least = drive.settings.min_turning;
        deviation_about_zero(&mut of_turns(&left.collect::<Vec<_>>(), &by_scale, least))
    }

    /// Residuals r = ψ − s G(t − τ) − b t of some rows, with the bias that fits each session.
    pub(super) fn residuals(&self, rows: &[Row]) -> Vec<Vec<f64>> {
        let of_session = |rows: &[Row]| -> Vec<Vec<f64>> {
            let residuals: Vec<Vec<f64>> = rows
                .iter()
                .map(|row| {
                    let [residual, ..] = self.columns(row);
                    residual
                })
                .collect();
            let white = self.white(rows, &residuals);
            let times: Vec<Vec<f64>> = rows.iter().map(|row| row.times.clone()).collect();
            let bias = slope(&self.white(rows, &times), &white, &weights(&white));
            let without = residuals.iter().zip(rows).map(|(residual, row)| {
                let times = row.times.iter().map(|t| t - rows[0].times[0]);
                residual.iter().zip(times).map(|(r, t)| r - bias * t).collect()
            });
            without.collect()
        };
        rows.chunk_by(|a, b| a.session == b.session).flat_map(of_session).collect()
    }

    /// True yaw rate at a pose of a row, rad/s.
    pub(super) fn rate(&self, row: &Row, pose: usize) -> f64 {
        self.scale * row.turned.at(row.times[pose] - self.lag).1
    }

    /// A column of some rows, whitened row by row.
    fn white(&self, rows: &[Row], columns: &[Vec<f64>]) -> Vec<f64> {
        let pairs = rows.iter().zip(columns);
        pairs.flat_map(|(row, column)| self.level.whitened(&row.times, column)).collect()
    }

    /// ψ − s G(t − τ), and its derivatives: −∂/∂s = G, −∂/∂τ = −s ω.
    fn columns(&self, row: &Row) -> [Vec<f64>; 3] {
        let measured: Vec<(f64, f64)> =
            row.times.iter().map(|t| row.turned.at(t - self.lag)).collect();
        [
            row.yaws
                .iter()
                .zip(&measured)
                .map(|(yaw, (angle, _))| yaw - self.scale * angle)
                .collect(),
            measured.iter().map(|(angle, _)| *angle).collect(),
            measured.iter().map(|(_, rate)| -self.scale * rate).collect(),
        ]
    }

    /// Residual and derivatives of some rows; or of their means over a time, s, which say nothing
    /// of the lag.
    fn whitened(&self, rows: &[Row], over: Option<f64>) -> Whitened {
        let mut all = Whitened::default();
        for rows in rows.chunk_by(|a, b| a.session == b.session) {
            let [mut residual, mut by_scale, mut by_lag, mut times]: [Vec<f64>; 4] =
                Default::default();
            for row in rows {
                let columns = self.columns(row);
                let columns = columns.each_ref().map(Vec::as_slice);
                let [r, scale, lag, time] = match over {
                    None => {
                        let white = |column: &[f64]| self.level.whitened(&row.times, column);
                        let [r, scale, lag] = columns.map(white);
                        [r, scale, lag, white(&row.times)]
                    }
                    Some(duration) => {
                        let groups = row.groups(duration);
                        let at = means(&row.times, &groups);
                        let fewest = groups.iter().map(Range::len).min().unwrap_or(1);
                        let white = self.level.white / real(fewest);
                        let level = Level { white, ..self.level };
                        let white = |column: &[f64]| level.whitened(&at, &means(column, &groups));
                        let [r, scale, _] = columns.map(white);
                        let no_lag = vec![0.0; r.len()];
                        [r, scale, no_lag, white(&row.times)]
                    }
                };
                residual.extend(r);
                by_scale.extend(scale);
                by_lag.extend(lag);
                times.extend(time);
            }
            let weights = weights(&residual);
            let without = |column: Vec<f64>| -> Vec<f64> {
                let bias = slope(&times, &column, &weights);
                column.iter().zip(&times).map(|(value, time)| value - bias * time).collect()
            };
            all.by[0].extend(without(by_scale));
            all.by[1].extend(without(by_lag));
            all.residual.extend(without(residual));
        }
        all
    }

    /// Step of scale and lag by Gauss and Newton, and the variance of the scale; `start` is where
    /// the lag began, s.
    ///
    /// # Law
    /// H⁻¹ (Σ ψ(r)² j jᵀ + P) H⁻¹, with ψ Huber's function of a residual r, j its derivatives,
    /// H = Σ ψ′(r) j jᵀ + P, and P the precision before the measurement.
    fn step(&self, rows: &Whitened, start: f64, settings: &Settings) -> (Vector2<f64>, f64) {
        let &Settings { min_turning, scale_prior, lag_prior, .. } = settings;
        let spread = deviation_about_zero(&mut of_turns(&rows.residual, &rows.by[0], min_turning));
        let spread = spread.unwrap_or(1.0).max(f64::MIN_POSITIVE);
        let priors = Vector2::new(scale_prior, lag_prior).map(|deviation| deviation.powi(-2));
        let from = Vector2::new(1.0 - self.scale, start - self.lag);
        let mut matrix = Matrix2::from_diagonal(&priors);
        let mut right = priors.component_mul(&from);
        let (mut curvature, mut scatter) = (matrix, matrix);
        for (k, residual) in rows.residual.iter().enumerate() {
            let by = Vector2::new(rows.by[0][k], rows.by[1][k]) / spread;
            let residual = residual / spread;
            let weight = Loss::Huber.weight(residual);
            matrix += weight * by * by.transpose();
            right += weight * residual * by;
            curvature += Loss::Huber.curvature(residual) * by * by.transpose();
            scatter += (weight * residual).powi(2) * by * by.transpose();
        }
        let inverse = matrix.try_inverse().unwrap_or(Matrix2::zeros());
        let bread = curvature.try_inverse().unwrap_or(Matrix2::zeros());
        (inverse * right, (bread * scatter * bread)[(0, 0)])
    }
}

/// The values at turns: those at rest scatter by another noise. Their derivative is less than
/// `least` of the root mean square. All of them without turns.
fn of_turns(values: &[f64], by: &[f64], least: f64) -> Vec<f64> {
    let square = by.iter().map(|by| by * by).sum::<f64>() / real(by.len().max(1));
    let least = least * square.sqrt();
    let turns = values.iter().zip(by).filter(|(_, by)| by.abs() >= least);
    turns.map(|(value, _)| *value).collect()
}

/// Huber's weights of values about their median size.
fn weights(values: &[f64]) -> Vec<f64> {
    let least = f64::EPSILON * values.iter().map(|value| value.abs()).sum::<f64>();
    let spread = deviation_about_zero(&mut values.to_vec()).unwrap_or(0.0);
    let spread = spread.max(least / real(values.len().max(1))).max(f64::MIN_POSITIVE);
    values.iter().map(|value| Loss::Huber.weight(value / spread)).collect()
}

/// Slope of values against others, through zero.
fn slope(by: &[f64], values: &[f64], weights: &[f64]) -> f64 {
    let sum =
        |of: &dyn Fn(usize) -> f64| -> f64 { (0..by.len()).map(|k| weights[k] * of(k)).sum() };
    let square = sum(&|k| by[k] * by[k]);
    if square > 0.0 { sum(&|k| by[k] * values[k]) / square } else { 0.0 }
}

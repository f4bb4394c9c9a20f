//! Evidence from tables of steady motion.

use super::{Evidence, Origin, Sample};
use crate::error::Error;
use crate::settings::{self, Settings};
use nalgebra::Vector3;
use std::sync::Arc;
use trackdyn_core::{PerSide, Pose};
use trackdyn_estimate::noise::scatter;
use trackdyn_recording::{OperatingPoint, TrackSample};

type Channel = fn(&OperatingPoint) -> Option<f64>;

const CHANNELS: [Channel; 3] =
    [|point| point.v_forward, |point| point.v_lateral, |point| point.yaw_rate];

impl Evidence {
    /// The points of a table. Their scatter is measured without a model: each point against the
    /// straight line through its two neighbours on a line of constant speed of one track.
    ///
    /// Each point is a block where they are few; otherwise neighbours in the table are grouped,
    /// since drift during a series of measurements shifts neighbours alike.
    ///
    /// # Errors
    /// Too few points, or no lines of constant track speed to measure scatter on.
    pub fn of_points(points: &[OperatingPoint], settings: &Settings) -> Result<Self, Error> {
        settings.check()?;
        let settings::Evidence { min_points, max_table_blocks, instant, .. } = settings.evidence;
        if points.len() < min_points {
            return Err(Error::TooFewPoints { found: points.len(), needed: min_points });
        }
        let scatter = CHANNELS.map(|channel| scatter(points, channel, &settings.measured_noise));
        if scatter[2].is_none() {
            return Err(Error::NoNoise);
        }
        let blocks = points.len().min(max_table_blocks);
        let mut samples = Vec::with_capacity(points.len());
        let mut tracks = Vec::with_capacity(points.len());
        let mut inverse = Vec::with_capacity(points.len());
        for (index, point) in points.iter().enumerate() {
            let measured: [Option<f64>; 3] = std::array::from_fn(|channel| {
                CHANNELS[channel](point).filter(|_| scatter[channel].is_some())
            });
            let motion = Vector3::from(measured.map(|value| value.unwrap_or(0.0) * instant));
            inverse.push(Vector3::from_fn(|channel, _| {
                match (measured[channel], scatter[channel]) {
                    (Some(_), Some(scatter)) => 1.0 / (scatter * instant),
                    _ => 0.0,
                }
            }));
            samples.push(Sample {
                run: index,
                block: index * blocks / points.len(),
                start: 0.0,
                duration: instant,
                motion,
                pose: Pose::default(),
                speeds: PerSide::new(point.v_left, point.v_right),
                acceleration: PerSide::default(),
                follows: false,
                has_place: [true; 2],
            });
            let (v_left, v_right) = (point.v_left, point.v_right);
            tracks.push(vec![TrackSample { t: 0.0, v_left, v_right }]);
        }
        let list = scatter.map(|scatter| scatter.map_or("-".to_owned(), |s| format!("{s:.4}")));
        Ok(Self {
            samples: samples.into(),
            tracks: tracks.into(),
            blocks,
            runs: (0..).take(points.len()).collect(),
            tau: 0.0,
            begin: 0.0,
            has_world: false,
            origin: Origin::SteadyPoints(inverse.into()),
            starts: None,
            gyroscope: None,
            description: format!(
                "{} steady points in {blocks} blocks of neighbours in the table; scatter against \
                 neighbours on lines of one track speed: {} m/s forward, {} m/s left, {} rad/s",
                points.len(),
                list[0],
                list[1],
                list[2]
            ),
            settings: Arc::new(settings.clone()),
        })
    }
}

//! Speeds that jump too often to be cut as spikes.
//!
//! # Law
//! A reading jumps where the way that it tells differs from that of the one before by more than ten
//! times the median way of the moving readings, and its speed by more than a track can change. Of
//! speeds that are quotients of positions at uneven stamps, the ways stay even.

use super::Run;
use super::spikes::MAX_ACCELERATION;
use crate::doubt::Doubt;
use trackdyn_core::robust::{median, usual_interval};
use trackdyn_core::{Side, real};

/// Least difference of two ways that is a jump, in median ways.
const MIN_JUMP: f64 = 10.0;

/// Fewest jumps that are too many.
const MIN_JUMPS: usize = 20;

/// Largest share of readings that may jump.
const MAX_SHARE: f64 = 0.05;

/// The doubt in track speeds that jump, where they do so too often.
pub(super) fn of(runs: &[Run]) -> Option<Doubt> {
    Side::BOTH.into_iter().find_map(|side| of_side(runs, side))
}

fn of_side(runs: &[Run], side: Side) -> Option<Doubt> {
    // Way and speed of each reading.
    let readings = |run: &Run| -> Vec<[f64; 2]> {
        let pairs = run.tracks().windows(2);
        pairs
            .map(|pair| {
                let speed = pair[0].speeds()[side];
                [speed * (pair[1].t - pair[0].t), speed]
            })
            .collect()
    };
    let all: Vec<(f64, Vec<[f64; 2]>)> = runs
        .iter()
        .map(|run| {
            let interval = usual_interval(run.tracks().iter().map(|reading| reading.t));
            (MAX_ACCELERATION * interval, readings(run))
        })
        .collect();
    let ways = all.iter().flat_map(|(_, readings)| readings).map(|[way, _]| way.abs());
    let usual = median(&mut ways.filter(|way| *way > 0.0).collect::<Vec<_>>())?;
    let (mut jumps, mut largest) = (0_usize, 0.0_f64);
    for (possible, readings) in &all {
        for pair in readings.windows(2) {
            let [way, speed] = [0, 1].map(|of| (pair[1][of] - pair[0][of]).abs());
            if way > MIN_JUMP * usual && speed > *possible {
                jumps += 1;
                largest = largest.max(pair[0][1].abs()).max(pair[1][1].abs());
            }
        }
    }
    // A jump leads to a reading and away from it.
    let count = all.iter().map(|(_, readings)| readings.len()).sum::<usize>();
    let share = 0.5 * real(jumps) / real(count.max(1));
    (share > MAX_SHARE && jumps >= MIN_JUMPS).then_some(Doubt::Jumps { share, largest })
}

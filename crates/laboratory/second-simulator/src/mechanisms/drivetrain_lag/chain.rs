//! Lags in a row behind a dead time.

use crate::form::Draws;
use std::collections::VecDeque;

/// What a speed passes through.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    /// Speeds on their way through the dead time: durations, s, and speeds, m/s, the oldest first.
    waiting: VecDeque<[f64; 2]>,
    /// Time constants, s, and speeds behind them, m/s.
    lags: Vec<[f64; 2]>,
}

impl Chain {
    /// One to three lags that delay a ramp by a time (s), together with a dead time.
    pub(super) fn draw(delay: f64, random: &mut Draws) -> Self {
        let count = random.whole(1, 3);
        let is_dead = random.happens(0.5) || count == 1;
        let dead = if is_dead { delay * random.between(0.1, 0.6) } else { 0.0 };
        let lags = random.shares(count).into_iter().map(|share| [share * (delay - dead), 0.0]);
        let waiting = if dead > 0.0 { [[dead, 0.0]].into() } else { VecDeque::new() };
        Self { waiting, lags: lags.collect() }
    }

    /// Takes in a speed for `dt` seconds; the mean speed that comes out meanwhile.
    pub(super) fn pass(&mut self, speed: f64, dt: f64) -> f64 {
        self.waiting.push_back([dt, speed]);
        let (mut left, mut way) = (dt, 0.0);
        while let Some([time, speed]) = self.waiting.front_mut() {
            let taken = left.min(*time);
            way += taken * *speed;
            left -= taken;
            *time -= taken;
            if *time > 0.0 {
                break;
            }
            self.waiting.pop_front();
        }
        // each lag sees the mean of what comes before it
        self.lags.iter_mut().fold(way / dt, |input, [time, output]| {
            let passed = dt / *time;
            let before = *output;
            *output = input + (before - input) * (-passed).exp();
            input + (before - input) * -(-passed).exp_m1() / passed
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form::Form;

    #[test]
    fn all_chains_delay_a_ramp_by_their_time() {
        for number in 0..100 {
            let mut draws = Form::Drawn(number).draws().expect("draws");
            let mut chain = Chain::draw(0.2, &mut draws);
            let dt = 1e-3;
            let mut lost = 0.0;
            for k in 0..5000 {
                let speed = (f64::from(k) + 0.5) * dt;
                lost = speed - chain.pass(speed, dt);
            }
            // 1 m/s² for 5 s
            assert!((lost - 0.2).abs() < 1e-3, "{number}: {lost} s");
        }
    }
}

//! Random monotone curves.

use super::Draws;

/// Number of halvings of an interval: more digits than numbers have.
const HALVINGS: u32 = 80;

/// A curve that rises from 0 at rest to 1 far away in logistic steps of the logarithm of its
/// argument.
///
/// # Law
/// `S(x) = Σ h_i/(1 + (c_i/x)^(1/w_i))` with Σ h_i = 1
#[derive(Clone, Debug)]
pub struct Steps {
    steps: Vec<Step>,
}

#[derive(Clone, Copy, Debug)]
struct Step {
    height: f64,
    centre: f64,
    steepness: f64,
}

impl Steps {
    /// Three to six steps of random heights at places between `from` and `until`, each with a width
    /// in the logarithm of 0.3 (from a tenth to nine tenths over a factor of 4) to 1.1 (over 125).
    pub fn draw(random: &mut Draws, from: f64, until: f64) -> Self {
        let count = random.whole(3, 6);
        let heights = random.shares(count);
        let step = |height| Step {
            height,
            centre: random.log_between(from, until),
            steepness: 1.0 / random.log_between(0.3, 1.1),
        };
        Self { steps: heights.into_iter().map(step).collect() }
    }

    /// With its argument stretched such that it has this value at an argument.
    pub fn through(self, argument: f64, value: f64) -> Self {
        let (mut low, mut high) = (1e-9_f64, 1e9_f64);
        for _ in 0..HALVINGS {
            let middle = (low * high).sqrt();
            if self.at(middle) < value { low = middle } else { high = middle }
        }
        let stretch = argument / low;
        let stretched = |step: Step| Step { centre: step.centre * stretch, ..step };
        Self { steps: self.steps.into_iter().map(stretched).collect() }
    }

    /// Its value.
    pub fn at(&self, x: f64) -> f64 {
        let step = |Step { height, centre, steepness }: &Step| {
            height / (1.0 + (centre / x).powf(*steepness))
        };
        if x > 0.0 { self.steps.iter().map(step).sum() } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rises_from_nothing_to_one_through_its_point() {
        for number in 0..100 {
            let steps = Steps::draw(&mut Draws::of(number), 0.1, 10.0).through(2.0, 0.4);
            assert!((steps.at(2.0) - 0.4).abs() < 1e-9, "{number}");
            let places: Vec<f64> = (-40..=40).map(|k| f64::from(k).exp()).collect();
            assert!(places.windows(2).all(|pair| steps.at(pair[0]) <= steps.at(pair[1])));
            assert!(steps.at(0.0).abs() < 1e-12 && (steps.at(1e18) - 1.0).abs() < 1e-9);
        }
    }
}

//! Median-based statistics, and constants of robust estimates.

/// Threshold of Huber's loss, in standard deviations: 95 % efficient on normal noise.
pub const HUBER_THRESHOLD: f64 = 1.345;

/// Ratio of the standard deviation to the median absolute deviation of a normal distribution,
/// 1 / Φ⁻¹(3/4).
pub const NORMAL_FROM_MAD: f64 = 1.482_602_218_505_602;

/// Ratio of the median of squares to the mean of squares of a normal distribution, Φ⁻¹(3/4)².
pub const MEDIAN_OF_CHI_SQUARE: f64 = 0.454_936_423_119_572_8;

/// Median of χ² with three degrees of freedom.
pub const MEDIAN_OF_CHI_SQUARE_3: f64 = 2.365_973_884_375_338;

/// The median; `None` where there is nothing. Reorders the values.
pub fn median(values: &mut [f64]) -> Option<f64> {
    if values.is_empty() {
        return None;
    }
    let (middle, odd) = (values.len() / 2, values.len() % 2 == 1);
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    if odd {
        return Some(upper);
    }
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Some(f64::midpoint(lower, upper))
}

/// The value below which a share of the values lies; `None` where there is nothing. Reorders the
/// values.
pub fn quantile(values: &mut [f64], share: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
    let place = (share * crate::real(last)).round() as usize;
    Some(*values.select_nth_unstable_by(place.min(last), f64::total_cmp).1)
}

/// The median interval of some stamps, s; zero of fewer than two.
pub fn usual_interval(stamps: impl Iterator<Item = f64> + Clone) -> f64 {
    let later = stamps.clone().skip(1);
    let mut intervals: Vec<f64> = stamps.zip(later).map(|(a, b)| b - a).collect();
    median(&mut intervals).unwrap_or(0.0)
}

/// Standard deviation of zero-mean normal values, from the median of their sizes: outliers do
/// not count. `None` where there is nothing. Reorders the values, and drops their signs.
pub fn deviation_about_zero(values: &mut [f64]) -> Option<f64> {
    for value in values.iter_mut() {
        *value = value.abs();
    }
    Some(median(values)? * NORMAL_FROM_MAD)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_of_odd_even_and_no_values() {
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&mut [4.0, 1.0, 2.0, 3.0]), Some(2.5));
        assert_eq!(median(&mut []), None);
    }

    #[test]
    fn quantiles_and_intervals_of_some_and_of_no_values() {
        let mut values = [3.0, 1.0, 4.0, 1.5, 9.0];
        assert_eq!(quantile(&mut values, 0.0), Some(1.0));
        assert_eq!(quantile(&mut values, 0.7), Some(4.0));
        assert_eq!(quantile(&mut values, 1.0), Some(9.0));
        assert_eq!(quantile(&mut [], 0.5), None);
        assert_eq!(usual_interval([0.0, 0.5, 1.0, 5.0].into_iter()), 0.5);
        assert_eq!(usual_interval([7.0].into_iter()), 0.0);
    }

    #[test]
    fn an_outlier_does_not_move_the_deviation() {
        let normal_scores = [-1.5, -0.674_489_750_196_081_7, 0.0, 0.674_489_750_196_081_7, 99.0];
        let mut values = normal_scores;
        let deviation = deviation_about_zero(&mut values).expect("values");
        assert!((deviation - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_two_constants_belong_together() {
        assert!((MEDIAN_OF_CHI_SQUARE * NORMAL_FROM_MAD * NORMAL_FROM_MAD - 1.0).abs() < 1e-12);
    }
}

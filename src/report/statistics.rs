//! Medians with intervals, and whether two samples could be of one kind.

use super::random::Random;

/// Resamples of a bootstrap.
const RESAMPLES: usize = 1000;

/// The middle value; of an even number the mean of the two in the middle. NaN for none.
#[must_use]
pub fn median(values: &[f64]) -> f64 {
    quantile(values, 0.5)
}

/// The value below which that share lies, between neighbours in proportion. NaN for none.
#[must_use]
pub fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let place = share * last as f64;
    let below = (place as usize).min(last);
    let above = (below + 1).min(last);
    if sorted[below] == sorted[above] {
        return sorted[below];
    }
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

/// From the lower to the upper quartile.
#[must_use]
pub fn interquartile_range(values: &[f64]) -> f64 {
    quantile(values, 0.75) - quantile(values, 0.25)
}

/// Where the median lies with a confidence of 95 %, by resampling (Efron 1979).
#[must_use]
pub fn median_interval(values: &[f64], seed: u64) -> [f64; 2] {
    let mut random = Random::new(seed);
    let mut resample = || median(&values.iter().map(|_| values[random.below(values.len())]).collect::<Vec<_>>());
    let medians: Vec<f64> = (0..RESAMPLES).map(|_| resample()).collect();
    [quantile(&medians, 0.025), quantile(&medians, 0.975)]
}

/// How likely two samples of one kind are as different as these or more (Kolmogorov and Smirnov; the limit law with Stephens's
/// correction for samples of this size).
#[must_use]
pub fn same_kind(a: &[f64], b: &[f64]) -> f64 {
    let (na, nb) = (a.len() as f64, b.len() as f64);
    let effective = (na * nb / (na + nb)).sqrt();
    let lambda = (effective + 0.12 + 0.11 / effective) * greatest_gap(a, b);
    if lambda < 0.2 {
        return 1.0; // the series below needs many terms there, and is 1 to twelve digits
    }
    let term = |k: i32| {
        let sign = if k % 2 == 1 { 2.0 } else { -2.0 };
        sign * libm::exp(-2.0 * f64::from(k * k) * lambda * lambda)
    };
    (1..=100).map(term).sum::<f64>().clamp(0.0, 1.0)
}

/// The greatest difference of the shares that lie at or below a value.
fn greatest_gap(a: &[f64], b: &[f64]) -> f64 {
    let share = |values: &[f64], x: f64| values.iter().filter(|v| **v <= x).count() as f64 / values.len() as f64;
    a.iter().chain(b).map(|x| (share(a, *x) - share(b, *x)).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_and_quartiles() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(interquartile_range(&[0.0, 1.0, 2.0, 3.0, 4.0]), 2.0);
        assert!(median(&[]).is_nan());
        assert_eq!(median(&[f64::INFINITY, f64::INFINITY, 1.0]), f64::INFINITY);
    }

    #[test]
    fn an_interval_holds_the_median_and_shrinks_with_the_sample() {
        let sample = |count: usize| {
            let mut random = Random::new(3);
            (0..count).map(|_| random.unit()).collect::<Vec<_>>()
        };
        let width = |count| {
            let values = sample(count);
            let [low, high] = median_interval(&values, 1);
            assert!(low <= median(&values) && median(&values) <= high);
            high - low
        };
        assert!(width(512) < 0.5 * width(32));
    }

    #[test]
    fn samples_of_one_kind_are_told_from_others() {
        let sample = |seed, shift: f64| {
            let mut random = Random::new(seed);
            (0..32).map(|_| random.unit() + shift).collect::<Vec<_>>()
        };
        assert!(same_kind(&sample(1, 0.0), &sample(2, 0.0)) > 0.05);
        assert!(same_kind(&sample(1, 0.0), &sample(2, 0.5)) < 0.01);
        assert_eq!(same_kind(&[1.0; 32], &[1.0; 32]), 1.0);
    }

    #[test]
    fn the_probability_is_that_of_the_tables() {
        // D = 0.34 with 32 and 32: critical at 5 % (1.358 √(2/32) = 0.3395 in the limit).
        let a: Vec<f64> = (0..32).map(f64::from).collect();
        let b: Vec<f64> = (0..32).map(|i| f64::from(i) + 10.5).collect(); // 11 of 32 below all of b's: D = 0.344
        let p = same_kind(&a, &b);
        assert!((0.02..0.06).contains(&p), "{p}");
    }
}

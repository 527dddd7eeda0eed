//! Orders of convergence, and whether a sequence of results has earned the name of a limit.

use serde::{Deserialize, Serialize};

/// Halvings in a row that must agree.
const HALVINGS: usize = 3;
/// How far each may be from the common factor.
const TOLERANCE: f64 = 0.2;
/// A sequence slower than this is not called convergent.
const LEAST_ORDER: f64 = 0.5;

/// What the differences of successive results say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The last three halvings of the time step shrank the difference by 2^p, each within 20 %.
    Converges {
        /// p.
        order: f64,
        /// How far the last result is from the limit, if it goes on like that.
        remainder: f64,
    },
    /// They did not.
    Wanders,
}

/// Judges differences between results with one time step and with half of it, coarsest first.
#[must_use]
pub fn judge(differences: &[f64]) -> Verdict {
    let Some(last) = differences.len().checked_sub(HALVINGS + 1).map(|start| &differences[start..]) else {
        return Verdict::Wanders;
    };
    if last.iter().any(|difference| *difference <= 0.0 || !difference.is_finite()) {
        return Verdict::Wanders;
    }
    let order = libm::log2(last[0] / last[HALVINGS]) / HALVINGS as f64;
    let factor = libm::pow(2.0, order);
    let agree = last.windows(2).all(|pair| (pair[0] / pair[1] / factor - 1.0).abs() <= TOLERANCE);
    if agree && order >= LEAST_ORDER {
        Verdict::Converges { order, remainder: last[HALVINGS] / (factor - 1.0) }
    } else {
        Verdict::Wanders
    }
}

/// The slope of a straight line through points with both logarithms taken, by least squares; `None` for fewer than three
/// points that have one.
#[must_use]
pub fn slope(points: impl IntoIterator<Item = (f64, f64)>) -> Option<f64> {
    let has_place = |(x, y): &(f64, f64)| *x > 0.0 && *y > 0.0 && x.is_finite() && y.is_finite();
    let logs: Vec<(f64, f64)> =
        points.into_iter().filter(has_place).map(|(x, y)| (libm::log(x), libm::log(y))).collect();
    if logs.len() < 3 {
        return None;
    }
    let count = logs.len() as f64;
    let (mx, my) = (logs.iter().map(|p| p.0).sum::<f64>() / count, logs.iter().map(|p| p.1).sum::<f64>() / count);
    let (above, below) = logs
        .iter()
        .fold((0.0, 0.0), |(above, below), (x, y)| (above + (x - mx) * (y - my), below + (x - mx) * (x - mx)));
    (below > 0.0).then(|| above / below)
}

/// What it costs to come within an error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Reach {
    /// So much, read off between two time steps, or at the longest one when that is close enough already.
    Measured(f64),
    /// So much, if it goes on beyond the smallest time step as the fitted slopes say.
    Extrapolated(f64),
    /// Nothing says that it ever comes so close.
    NotReached,
}

impl Reach {
    /// The cost, measured or extrapolated.
    #[must_use]
    pub fn cost(self) -> Option<f64> {
        match self {
            Reach::Measured(cost) | Reach::Extrapolated(cost) => Some(cost),
            Reach::NotReached => None,
        }
    }
}

/// What it costs to come within an error and to stay there with every smaller time step, from (error, cost) pairs, longest
/// time step first.
#[must_use]
pub fn reach(curve: &[(f64, f64)], within: f64) -> Reach {
    let beyond = curve.iter().rposition(|(error, _)| *error > within);
    match beyond {
        None if curve.is_empty() => Reach::NotReached,
        None => Reach::Measured(curve[0].1),
        Some(i) if i + 1 < curve.len() => {
            let ((e1, c1), (e2, c2)) = (curve[i], curve[i + 1]);
            let part = libm::log(e1 / within) / libm::log(e1 / e2.max(f64::MIN_POSITIVE));
            Reach::Measured(c1 * libm::pow(c2 / c1, part))
        }
        Some(last) => extrapolated(curve, last, within),
    }
}

/// An error of a half diagonal or more is a body that is somewhere else: it does not say how errors fall.
pub const LOST: f64 = 1.0;
/// A line is followed only where cost falls with error as some order from 0.5 to 4 makes it fall.
const STEEPEST: f64 = -2.0;
const FLATTEST: f64 = -0.25;

/// Beyond the smallest time step, along the line through all that was measured.
fn extrapolated(curve: &[(f64, f64)], last: usize, within: f64) -> Reach {
    let (error, cost) = curve[last];
    let converging = curve.iter().copied().filter(|(error, _)| *error < LOST);
    match slope(converging) {
        Some(slope) if error < 0.5 * LOST && STEEPEST < slope && slope < FLATTEST => {
            Reach::Extrapolated(cost * libm::pow(error / within, -slope))
        }
        _ => Reach::NotReached,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Differences of x(dt) = c·dt^p, dt halved each time.
    fn differences(order: f64, noise: [f64; 6]) -> Vec<f64> {
        let at = |k: i32| libm::pow(2.0, -order * f64::from(k));
        (0..6).zip(noise).map(|(k, noise)| (at(k) - at(k + 1)) * noise).collect()
    }

    #[test]
    fn a_first_order_sequence_is_accepted_with_its_order_and_remainder() {
        let Verdict::Converges { order, remainder } = judge(&differences(1.0, [1.0; 6])) else { panic!("refused") };
        assert!((order - 1.0).abs() < 1e-12);
        assert!((remainder - libm::pow(2.0, -6.0)).abs() < 1e-12, "as far as x(dt/64) is from the limit: {remainder}");
    }

    #[test]
    fn a_second_order_sequence_is_too() {
        let Verdict::Converges { order, .. } = judge(&differences(2.0, [1.0; 6])) else { panic!("refused") };
        assert!((order - 2.0).abs() < 1e-12);
    }

    #[test]
    fn noise_stagnation_and_short_sequences_are_refused() {
        assert_eq!(judge(&differences(1.0, [1.0, 1.0, 1.0, 1.9, 0.6, 1.0])), Verdict::Wanders);
        assert_eq!(judge(&[1e-3, 1e-3, 1e-3, 1e-3, 1e-3]), Verdict::Wanders, "it does not shrink");
        assert_eq!(judge(&[1e-3, 5e-4, 2.5e-4]), Verdict::Wanders, "two halvings are not three");
        assert_eq!(judge(&[1e-3, 5e-4, 0.0, 1e-4, 5e-5]), Verdict::Wanders);
        assert_eq!(judge(&[1e-3, 5e-4, f64::NAN, 1e-4, 5e-5]), Verdict::Wanders);
    }

    #[test]
    fn a_slope_is_that_of_the_power() {
        let points = (0..5).map(|k| (libm::pow(2.0, f64::from(k)), 7.0 * libm::pow(2.0, 1.5 * f64::from(k))));
        assert!((slope(points).expect("a slope") - 1.5).abs() < 1e-12);
        assert_eq!(slope([(1.0, 1.0), (2.0, 0.0), (4.0, 4.0)]), None, "two points that have a place are too few");
    }

    #[test]
    fn costs_are_read_off_between_time_steps() {
        let curve: Vec<(f64, f64)> =
            (0..6).map(|k| libm::pow(4.0, f64::from(k))).map(|n| (1e-2 / n, 1e-5 * n)).collect();
        let Reach::Measured(cost) = reach(&curve, 1e-2 / 8.0) else { panic!("not measured") };
        assert!((cost - 8e-5).abs() < 1e-16);
        let Reach::Extrapolated(cost) = reach(&curve, 1e-6) else { panic!("not extrapolated") };
        assert!((cost - 1e-1).abs() < 1e-12, "error times cost is 1e-7 along the line: {cost}");
        assert_eq!(reach(&curve, 1.0), Reach::Measured(1e-5), "the longest time step is good enough");
    }

    #[test]
    fn what_stagnates_or_is_not_known_is_not_reached() {
        let flat: Vec<(f64, f64)> = (0..6).map(|k| (0.3, 1e-5 * libm::pow(2.0, f64::from(k)))).collect();
        assert_eq!(reach(&flat, 1e-3), Reach::NotReached);
        assert_eq!(reach(&[], 1e-3), Reach::NotReached);
    }

    #[test]
    fn a_lucky_time_step_does_not_count_when_smaller_ones_are_worse() {
        let curve = [(1e-2, 1.0), (1e-9, 2.0), (2.5e-3, 4.0), (1e-3, 8.0)];
        let Reach::Measured(cost) = reach(&curve, 1.5e-3) else { panic!("not measured") };
        assert!(cost > 4.0 && cost < 8.0, "{cost}");
    }
}

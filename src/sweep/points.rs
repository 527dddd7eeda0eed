//! Points: which values the things that vary have together.

use serde::Deserialize;

use super::axis::{Axis, Value};
use super::sobol::Sobol;
use crate::report::random::Random;

/// How points are laid over what varies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Points {
    /// Every value with every other; the last thing varies fastest.
    #[default]
    Grid,
    /// Every thing's range in as many strata as points, each of them used once (McKay, Beckman and Conover 1979).
    LatinHypercube {
        /// How many points.
        count: usize,
        /// Where its own generator begins.
        #[serde(default)]
        seed: u64,
    },
    /// The first points of Sobol's sequence: most even when they are a power of 2.
    Sobol {
        /// How many points.
        count: usize,
    },
}

impl Points {
    /// How many points there are; `None` when they cannot be counted.
    #[must_use]
    pub fn count(&self, axes: &[Axis]) -> Option<usize> {
        match self {
            Points::Grid => axes.iter().try_fold(1usize, |count, axis| count.checked_mul(axis.levels())),
            Points::LatinHypercube { count, .. } | Points::Sobol { count } => Some(*count),
        }
    }

    /// Every point in order, a value for each axis.
    #[must_use]
    pub fn lay(&self, axes: &[Axis]) -> Vec<Vec<Value>> {
        let count = self.count(axes).unwrap_or(0);
        let at = |shares: &[f64]| axes.iter().zip(shares).map(|(axis, share)| axis.at(*share)).collect();
        match self {
            Points::Grid => (0..count).map(|number| grid_point(axes, number)).collect(),
            Points::LatinHypercube { seed, .. } => {
                let columns = latin_hypercube(count, axes.len(), *seed);
                (0..count).map(|row| at(&columns.iter().map(|column| column[row]).collect::<Vec<_>>())).collect()
            }
            Points::Sobol { .. } => {
                let sobol = Sobol::new(axes.len());
                (0..count).map(|number| at(&sobol.point(number as u32))).collect()
            }
        }
    }
}

fn grid_point(axes: &[Axis], mut number: usize) -> Vec<Value> {
    let mut point: Vec<Value> = axes
        .iter()
        .rev()
        .map(|axis| {
            let place = number % axis.levels();
            number /= axis.levels();
            axis.level(place)
        })
        .collect();
    point.reverse();
    point
}

/// By dimension, the coordinates of all points: somewhere in each stratum, in an order of their own.
fn latin_hypercube(count: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::new(seed);
    let mut column = || {
        let mut strata: Vec<usize> = (0..count).collect();
        for place in (1..count).rev() {
            strata.swap(place, random.below(place + 1));
        }
        strata.into_iter().map(|stratum| (stratum as f64 + random.unit()) / count as f64).collect()
    };
    (0..dimensions).map(|_| column()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(name: &str, values: &[f64]) -> Axis {
        let values = values.iter().map(|value| Value::Number(*value)).collect();
        Axis { name: name.to_owned(), unit: None, from: None, to: None, count: None, values }
    }

    #[test]
    fn a_grid_has_every_value_with_every_other_once() {
        let axes = [axis("a", &[1.0, 2.0, 3.0]), axis("b", &[4.0, 5.0])];
        let numbers = |value: &Value| if let Value::Number(number) = value { *number } else { f64::NAN };
        let points: Vec<[f64; 2]> =
            Points::Grid.lay(&axes).iter().map(|point| [numbers(&point[0]), numbers(&point[1])]).collect();
        assert_eq!(points, [[1.0, 4.0], [1.0, 5.0], [2.0, 4.0], [2.0, 5.0], [3.0, 4.0], [3.0, 5.0]]);
        assert_eq!(Points::Grid.lay(&[]).len(), 1, "nothing varies: one point");
    }

    #[test]
    fn a_latin_hypercube_uses_each_stratum_of_each_dimension_once() {
        for (count, seed) in [(1, 0), (7, 1), (100, 2)] {
            let columns = latin_hypercube(count, 5, seed);
            for column in &columns {
                let mut strata: Vec<usize> = column.iter().map(|share| (share * count as f64) as usize).collect();
                strata.sort_unstable();
                assert_eq!(strata, (0..count).collect::<Vec<_>>());
            }
            assert_eq!(columns, latin_hypercube(count, 5, seed), "the same every time");
        }
        assert_ne!(latin_hypercube(7, 5, 1), latin_hypercube(7, 5, 2));
    }
}

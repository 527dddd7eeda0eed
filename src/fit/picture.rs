//! How the residual grows when each value is moved: a curve per value, from one end of its range to the other.

use super::answer::Answer;
use super::problem::{BAD, Horizon, Problem};
use super::refine::Found;
use crate::output::numbers::rough;
use crate::plot::{Axis, Figure, Look, Point, Series};

/// Points of a curve, evenly over the range.
const POINTS: usize = 41;
/// What is far below the tolerance is drawn here at least, in tolerances: smaller still says nothing.
const FLOOR: f64 = 1e-3;
/// More of them on each side of the value, each half as far away as the last.
const NEAR: i32 = 10;

/// The residual over the shares of all ranges, one value moved at a time.
#[must_use]
pub fn figure(problem: &Problem, answer: &Answer, best: &Found, jobs: usize) -> Figure {
    let floor = FLOOR * answer.tolerance;
    let limit = |x| Point { x, y: answer.tolerance, label: None };
    let tolerance = Series {
        name: format!("met below {}", answer.tolerance),
        look: Look(problem.dimension()),
        joined: true,
        points: vec![limit(0.0), limit(1.0)],
    };
    let series = (0..problem.dimension()).map(|axis| {
        let places = if problem.whole[axis] { problem.shares(axis, POINTS) } else { shares(best.place[axis]) };
        let costs = problem.spread(&places, jobs, |bench, share| {
            let mut place = best.place.clone();
            place[axis] = *share;
            bench.cost(&place, Horizon::Whole)
        });
        let points = places.iter().zip(costs).filter(|(_, cost)| *cost < BAD);
        let value = &answer.values[axis];
        let [min, max] = value.range;
        Series {
            name: format!("{} = {}, from {min} to {max}", value.name, rough(value.value)),
            look: Look(axis),
            joined: true,
            points: points.map(|(x, cost)| Point { x: *x, y: cost.max(floor), label: None }).collect(),
        }
    });
    Figure {
        title: format!("{}: how sharply the values are determined", answer.title),
        subtitle:
            "each value moved alone, the others as they were found; where a curve is flat its value does not matter"
                .to_owned(),
        x: Axis::linear("share of the range"),
        y: Axis::log("residual"),
        series: series.chain([tolerance]).collect(),
    }
}

/// Shares of a range, closer to each other near the value.
fn shares(value: f64) -> Vec<f64> {
    let even = (0..POINTS).map(|i| i as f64 / (POINTS - 1) as f64);
    let near = (1..=NEAR).flat_map(|i| {
        let away = libm::pow(0.5, f64::from(i)) / (POINTS - 1) as f64;
        [value - away, value + away]
    });
    let mut shares: Vec<f64> = even.chain(near).chain([value]).filter(|share| (0.0..=1.0).contains(share)).collect();
    shares.sort_by(f64::total_cmp);
    shares.dedup();
    shares
}

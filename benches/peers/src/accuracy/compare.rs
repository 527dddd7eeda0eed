//! Whose curve lies lower: errors at equal CPU time.

use super::Outcome;
use crate::engine::Engine;

/// Errors smaller than this are rounding; they count as this much.
pub const ROUNDING: f64 = 1e-15;

/// Choque's curve beside a peer's, over the CPU times at which both have made a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// The peer.
    pub peer: Engine,
    /// Its least error over ours, where that is least: above 1 our curve lies lower at every cost.
    pub factor: f64,
    /// The shortest time in which we make a run, and it does \[s\].
    pub from: [f64; 2],
}

/// The engine that stands for choque: continuous motion where it took part.
#[must_use]
pub fn ours(outcomes: &[Outcome]) -> Engine {
    let continuous = outcomes.iter().any(|outcome| outcome.engine == Engine::ChoqueContinuous);
    if continuous { Engine::ChoqueContinuous } else { Engine::Choque }
}

/// Choque beside each peer.
#[must_use]
pub fn standings(outcomes: &[Outcome]) -> Vec<Standing> {
    let ours = ours(outcomes);
    let mut peers: Vec<Engine> = outcomes.iter().map(|outcome| outcome.engine).filter(|e| !e.is_choque()).collect();
    peers.sort();
    peers.dedup();
    peers.into_iter().map(|peer| standing(outcomes, ours, peer)).collect()
}

fn standing(outcomes: &[Outcome], ours: Engine, peer: Engine) -> Standing {
    let cheapest = |engine| {
        let times = outcomes.iter().filter(|outcome| outcome.engine == engine).map(|outcome| outcome.seconds);
        times.fold(f64::INFINITY, f64::min)
    };
    let from = [cheapest(ours), cheapest(peer)];
    let both = from[0].max(from[1]);
    let costs = outcomes.iter().filter(|outcome| [ours, peer].contains(&outcome.engine)).map(|outcome| outcome.seconds);
    let ratio = |cost| best(outcomes, peer, cost) / best(outcomes, ours, cost);
    Standing { peer, factor: costs.filter(|cost| *cost >= both).map(ratio).fold(f64::INFINITY, f64::min), from }
}

/// The least error an engine comes to in that time.
fn best(outcomes: &[Outcome], engine: Engine, cost: f64) -> f64 {
    let within = outcomes.iter().filter(|outcome| outcome.engine == engine && outcome.seconds <= cost);
    within.map(|outcome| outcome.error).filter(|error| error.is_finite()).fold(f64::INFINITY, f64::min).max(ROUNDING)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(engine: Engine, points: &[(f64, f64)]) -> Vec<Outcome> {
        points.iter().map(|(seconds, error)| Outcome { engine, rate: 60, error: *error, seconds: *seconds }).collect()
    }

    #[test]
    fn the_factor_is_the_least_over_all_costs_that_both_can_pay() {
        let mut outcomes = curve(Engine::Choque, &[(2.0, 1e-3), (8.0, 1e-4)]);
        outcomes.extend(curve(Engine::Box2d, &[(1.0, 1e-1), (4.0, 2e-3), (16.0, 1e-2)]));
        let found = standings(&outcomes)[0];
        assert!((found.factor - 2.0).abs() < 1e-12, "{found:?}: at 4 s 2e-3 over 1e-3");
        assert_eq!(found.from, [2.0, 1.0]);
    }

    #[test]
    fn two_that_are_right_to_rounding_are_equal() {
        let mut outcomes = curve(Engine::ChoqueContinuous, &[(1.0, 0.0)]);
        outcomes.extend(curve(Engine::Choque, &[(1.0, 7.0)]));
        outcomes.extend(curve(Engine::RapierF64, &[(1.0, 4e-16)]));
        assert_eq!(ours(&outcomes), Engine::ChoqueContinuous);
        assert_eq!(standings(&outcomes)[0].factor, 1.0);
    }

    #[test]
    fn a_body_lost_among_the_numbers_is_no_answer() {
        let mut outcomes = curve(Engine::Choque, &[(1.0, 0.5)]);
        outcomes.extend(curve(Engine::RapierF32, &[(1.0, f64::NAN)]));
        assert_eq!(standings(&outcomes)[0].factor, f64::INFINITY);
    }
}

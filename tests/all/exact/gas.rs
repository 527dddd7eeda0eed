//! E4: eight equal rods in a tunnel (Tonks 1936). They hand their velocities through, so each free path goes on as if it were alone: fold
//! x + v t into the free length by reflection, sort, and put the rods' own lengths back. Exact at any time, and not chaotic.

use choque_engine::Scene;
use serde_json::Value;

use super::kit::{assert_close, block, continuous, run_watching, wall, worst};

const SPEEDS: [f64; 8] = [-35.0, 36.0, -26.0, 7.0, -13.0, -12.0, 7.0, -27.0];

fn gas(time_step: f64) -> Scene {
    let mut bodies = vec![wall("left", (1.0, 9.0), (-0.5, 0.0)), wall("right", (1.0, 9.0), (12.5, 0.0))];
    for (i, sevenths) in SPEEDS.iter().enumerate() {
        let at = (0.75 + 1.5 * i as f64, 0.0);
        bodies.push(block(&format!("rod{i}"), (0.5, 0.5), at, (sevenths / 7.0, 0.0), 1.0));
    }
    continuous(1.0, time_step, bodies)
}

fn fraction(text: &str) -> f64 {
    let number = |text: &str| text.parse::<f64>().expect("a whole number");
    text.split_once('/').map_or_else(|| number(text), |(over, under)| number(over) / number(under))
}

/// Runs to a time of the reference, in so many steps; gives pair hits and wall hits.
fn assert_state_at(label: &str, steps: u32, tolerance: f64) -> (u64, u64) {
    let reference: Value = serde_json::from_str(include_str!("references/gas_of_rods.json")).expect("a table");
    let row = |k: usize| -> Vec<f64> {
        let rods = reference["states"][label].as_array().expect("a state");
        rods.iter().map(|rod| fraction(rod[k].as_str().expect("a fraction"))).collect()
    };
    let (mut pairs, mut walls, mut deepest) = (0, 0, 0.0_f64);
    let world = run_watching(&gas(fraction(label) / f64::from(steps)), steps, |world, hit| {
        *(if hit.a.index() < 2 { &mut walls } else { &mut pairs }) += 1;
        if (pairs + walls) % 64 == 1 {
            deepest = deepest.max(world.deepest());
        }
    });
    let places: Vec<f64> = world.ids().skip(2).map(|id| world.position(id).x).collect();
    let speeds: Vec<f64> = world.ids().skip(2).map(|id| world.velocity(id).x).collect();
    println!("t = {label}: {pairs} + {walls} hits, off by {:e}, deepest {deepest:e}", worst(&places, &row(0)));
    assert_close(&places, &row(0), tolerance, "places");
    assert_close(&speeds, &row(1), tolerance, "velocities");
    assert!(deepest <= 1e-12);
    (pairs, walls)
}

#[test]
fn e4_a_gas_of_rods_is_where_it_should_be() {
    assert_eq!(assert_state_at("10", 640, 1e-12), (139, 29));
    assert_eq!(assert_state_at("10", 1, 1e-12), (139, 29));
    assert_state_at("100", 6_000, 1e-11);
    assert_eq!(assert_state_at("1000/7", 8192, 1e-11), (1964, 416));
}

#[test]
fn e4_a_gas_of_rods_after_ten_thousand_seconds() {
    assert_state_at("10000", 10_000, 1e-9);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "17 million impacts: a minute in debug, half of one in release")]
fn e4_a_gas_of_rods_after_a_million_seconds() {
    assert_state_at("1000000", 100_000, 1e-8);
}

//! Momenta of bodies that are left to themselves: a heavy box drives into a block of others, from one side of its middle.

use choque_engine::World;
use choque_engine::scene::Body;

use super::kit::{DT, grounded, resting};

/// How much momentum may change, over what the ram brings, and angular momentum over the same times half its height. Observed: 3.2e-14.
const KEPT: f64 = 1e-13;

/// A ram of 8 m at 40 m/s hits so many columns and rows of boxes; gives what each momentum changed by in the end.
fn ram([columns, rows]: [u32; 2], friction: f64, restitution: f64) -> [f64; 3] {
    let ram = Body { velocity: Some((40.0, 0.0)), mass: Some(512.0), ..resting("ram", (8.0, 8.0), (-4.5, 1.0)) };
    let mut bodies = vec![ram];
    for (column, row) in (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row))) {
        let at = (0.2 + 0.4 * f64::from(column), 0.4 * (f64::from(row) - 0.5 * f64::from(rows)));
        bodies.push(Body { mass: Some(0.16), ..resting(&format!("box {column} {row}"), (0.4, 0.4), at) });
    }
    let mut scene = grounded(DT, friction, bodies);
    scene.settings.gravity = (0.0, 0.0);
    scene.settings.restitution = restitution;
    let mut world = World::new(&scene).expect("a valid scene");
    let (momentum, angular) = (world.momentum(), world.angular_momentum());
    for _ in 0..90 {
        world.step();
        assert_eq!(world.fault(), None);
    }
    let brought = momentum.norm();
    let [x, z] = (world.momentum() - momentum).into();
    let changed = [x / brought, z / brought, (world.angular_momentum() - angular) / (4.0 * brought)];
    println!("{columns} × {rows} boxes, μ = {friction}, e = {restitution}: momenta off by {changed:?}");
    changed
}

#[test]
fn what_is_driven_apart_keeps_its_momenta() {
    for size in [[4, 3], [12, 8], [30, 20]] {
        for (friction, restitution) in [(0.0, 0.0), (0.6, 0.0), (0.0, 0.5), (0.6, 0.5)] {
            let changed = ram(size, friction, restitution);
            let what = format!("{size:?}, μ = {friction}, e = {restitution}");
            assert!(changed.iter().all(|by| by.abs() <= KEPT), "{what}: {changed:?}");
        }
    }
}

//! Crowds in continuous motion.

use choque_engine::World;
use choque_engine::scene::{Body, BroadPhaseChoice};

use crate::continuous::{block, impulse, wall};
use crate::random_scenes::Random;

/// An elastic crowd of all sizes in a box with a bar, turning in every third: nothing is ever inside anything, no energy is
/// made where nothing drives it, and a copy made on the way goes on to the same bits, whichever way pairs are found.
#[test]
fn elastic_crowds_never_overlap_and_never_gain_energy() {
    for case in 0..24 {
        let mut random = Random(case + 1);
        let driven = case % 3 == 0;
        let mut bodies: Vec<Body> = [
            ((1.0, 30.0), (8.5, 0.0)),
            ((1.0, 30.0), (-8.5, 0.0)),
            ((30.0, 1.0), (0.0, 8.5)),
            ((30.0, 1.0), (0.0, -8.5)),
        ]
        .iter()
        .enumerate()
        .map(|(i, (size, at))| wall(&format!("wall{i}"), *size, *at))
        .collect();
        let mut bar = wall("bar", (2.5, 0.3), (0.0, 0.0));
        bar.spin = driven.then_some(1.5);
        bodies.push(bar);
        for k in 0..30 {
            let at = (-7.0 + 2.4 * f64::from(k % 6) + 0.5, -7.0 + 2.4 * f64::from(k / 6) + 0.5);
            if libm::hypot(at.0, at.1) < 2.6 {
                continue;
            }
            let size = (random.between(0.05, 1.4), random.between(0.05, 1.4));
            let v = (random.between(-6.0, 6.0), random.between(-6.0, 6.0));
            let mut one = block(&format!("b{k}"), size, at, v, libm::pow(10.0, random.between(-2.0, 2.0)));
            one.angle = random.between(-3.0, 3.0);
            one.spin = Some(random.between(-15.0, 15.0));
            bodies.push(one);
        }
        let scene = impulse(1.0, 1.0 / 30.0, bodies);
        let run_with = |choice| {
            let mut scene = scene.clone();
            scene.settings.broad_phase = choice;
            let mut world = World::new(&scene).expect("a valid scene");
            let mut energy = world.kinetic_energy();
            let mut copy = None;
            for step in 0..90 {
                world.step();
                let deepest = world.deepest();
                assert!(deepest <= 1e-12, "case {case}, step {step}: {deepest:e} deep");
                let now = world.kinetic_energy();
                assert!(driven || now <= energy * (1.0 + 1e-12), "case {case}, step {step}: {energy} became {now}");
                energy = now;
                match step {
                    45 => copy = Some(world.clone()),
                    s if s > 45 => copy.as_mut().expect("it was made").step(),
                    _ => {}
                }
            }
            assert_eq!(world.digest(), copy.expect("it was made").digest(), "case {case}: the copy");
            assert!(world.collisions() > 30);
        };
        run_with(BroadPhaseChoice::AllPairs);
        run_with(BroadPhaseChoice::Strips);
    }
}

//! The same bits: again, through a copy made on the way, and by either broad phase.

use choque_engine::scene::BroadPhaseChoice;
use choque_engine::{Scene, World};

use super::kit::{Random, block, ground, run, standing};

const STEPS: u32 = 500;

/// Eighty boxes let fall in a heap, each turned its own way.
fn eighty() -> Scene {
    let mut random = Random(80);
    let mut bodies = vec![ground(40.0)];
    for i in 0..80 {
        let at = (2.0 * f64::from(i % 8) - 7.0 + random.between(-0.3, 0.3), 1.0 + 1.5 * f64::from(i / 8));
        let mut body = block(&format!("box{i}"), (random.between(0.5, 1.2), 0.8), at);
        body.angle = random.between(-3.0, 3.0);
        bodies.push(body);
    }
    standing(bodies)
}

#[test]
fn a_heap_of_eighty_falls_the_same_way_twice() {
    assert_eq!(run(&eighty(), STEPS).digest(), run(&eighty(), STEPS).digest());
}

#[test]
fn and_through_a_copy_made_on_the_way() {
    let mut world = World::new(&eighty()).expect("a valid scene");
    for _ in 0..200 {
        world.step();
    }
    let mut copy = world.clone();
    for _ in 200..STEPS {
        world.step();
    }
    // The copy goes on only after the other has run away from it.
    for _ in 200..STEPS {
        copy.step();
    }
    assert_eq!(copy.digest(), world.digest());
}

#[test]
fn whichever_broad_phase_finds_the_pairs() {
    let by = |broad_phase| {
        let mut scene = eighty();
        scene.settings.broad_phase = broad_phase;
        run(&scene, 150).digest()
    };
    assert_eq!(by(BroadPhaseChoice::AllPairs), by(BroadPhaseChoice::Strips));
}

//! The books of contacts that stepped motion solves in sub-steps: they close, and say what can be worked by hand.

use choque_engine::ledger::Cause;
use choque_engine::scene::{Body, Kind, MotionRule, Patrol, Scene, Swing};
use choque_engine::{Hit, Vec2, World};

use crate::booked::{assert_energies, booked, steps};
use crate::continuous::{block, impulse, wall};
use crate::ledger::{Audit, command, kept};
use crate::random_scenes::Random;

/// Impulses in stepped motion.
fn stepped(restitution: f64, time_step: f64, bodies: Vec<Body>) -> Scene {
    let mut scene = impulse(restitution, time_step, bodies);
    scene.settings.motion = MotionRule::Stepped;
    scene
}

/// Boxes over a floor between a gate that swings, a blade and a lift: some start within each other, all fall into a heap; every
/// third heap is under drag, every fourth without gravity.
fn heap(seed: u64) -> Scene {
    let mut random = Random(seed);
    let mut lift = wall("lift", (2.0, 1.0), (4.0, -0.4));
    lift.patrol = Some(Patrol { points: vec![(4.0, 1.5)], speed: 1.5 });
    let mut gate = wall("gate", (0.4, 3.0), (-4.0, 1.5));
    gate.swing = Some(Swing { angle: 0.6, period: 1.5 });
    let mut blade = wall("blade", (2.0, 0.3), (0.0, 1.2));
    blade.spin = Some(random.between(-3.0, 3.0));
    let mut bodies = vec![wall("floor", (30.0, 1.0), (0.0, -0.5)), lift, gate, blade];
    for k in 0..4 + random.next() % 16 {
        let at = (random.between(-5.0, 5.0), random.between(0.6, 5.0));
        let velocity = (random.between(-3.0, 3.0), random.between(-3.0, 1.0));
        let size = (random.between(0.4, 1.4), random.between(0.4, 1.0));
        let mut body = block(&format!("b{k}"), size, at, velocity, random.between(0.5, 4.0));
        body.angle = if random.one_in(3) { 0.0 } else { random.between(-1.0, 1.0) };
        body.spin = Some(random.between(-2.0, 2.0));
        bodies.push(body);
    }
    let mut scene = stepped([0.0, 0.3, 0.8][seed as usize % 3], 1.0 / 60.0, bodies);
    let settings = &mut scene.settings;
    settings.friction = random.between(0.0, 0.8);
    settings.drag = if seed.is_multiple_of(3) { (random.between(0.0, 0.5), 0.2) } else { (0.0, 0.0) };
    settings.gravity = if seed.is_multiple_of(4) { (0.0, 0.0) } else { (random.between(-1.0, 1.0), -9.81) };
    scene
}

fn boxes(world: &World) -> Vec<choque_engine::BodyId> {
    world.ids().filter(|id| world.kind(*id) == Kind::Mobile).collect()
}

#[test]
fn the_books_of_heaps_close_in_every_step() {
    let (mut relocated, mut worked) = (0.0, 0.0);
    for seed in 0..16 {
        let mut world = kept(&heap(seed));
        let mut random = Random(seed);
        let mut audit = Audit::of(&world);
        for iteration in 0..120 {
            if seed % 2 == 1 && iteration % 10 == 0 {
                command(&mut world, &mut random);
            }
            world.step();
            audit.look(&world);
        }
        assert!(audit.worst < 1e-14, "heap {seed}: the books are {:e} from closing", audit.worst);
        let ledger = world.ledger().expect("kept");
        relocated += ledger.relocated();
        worked += ledger.booked(Cause::FixedBodies).kinetic_energy.abs();
        assert!(booked(&world, Cause::Friction).kinetic_energy <= 0.0, "heap {seed}: friction takes");
    }
    assert!(relocated > 0.1 && worked > 1.0, "overlaps were let go by {relocated} m, fixed bodies worked {worked} J");
}

/// Gravity works by the height, whatever contacts make of the flight; what was let go of overlaps is no flight.
#[test]
fn gravity_works_by_the_height_in_a_heap() {
    for seed in (0..12).filter(|seed| seed % 4 != 0) {
        let scene = heap(seed);
        let mut world = kept(&scene);
        let gravity = Vec2::new(scene.settings.gravity.0, scene.settings.gravity.1);
        let before: Vec<Vec2> = boxes(&world).iter().map(|id| world.position(*id)).collect();
        steps(&mut world, 90);
        let mut expected = 0.0;
        let mut heaviest = 0.0_f64;
        for (id, stood) in boxes(&world).into_iter().zip(before) {
            expected += world.mass(id) * gravity.dot(&(world.position(id) - stood));
            heaviest = heaviest.max(world.mass(id) * gravity.norm());
        }
        let given = booked(&world, Cause::Gravity).kinetic_energy;
        let tolerance = heaviest * world.ledger().expect("kept").relocated() + 1e-10;
        assert!((given - expected).abs() <= tolerance, "heap {seed}: {given}, not {expected} ± {tolerance}");
    }
}

#[test]
fn a_ledger_decides_nothing_in_a_heap() {
    for seed in 0..8 {
        let scene = heap(seed);
        let (mut with, mut without) = (kept(&scene), World::new(&scene).expect("a valid scene"));
        steps(&mut with, 60);
        steps(&mut without, 60);
        assert_eq!(with.digest(), without.digest(), "heap {seed}");
        assert_eq!(with.work(), without.work(), "heap {seed}");
    }
}

/// Every hit has its entry in its place: two mobile bodies keep the momentum between them, a fixed one gives it along the
/// normal that was told; and what was told took no more than there was.
#[test]
fn entries_stand_in_the_place_of_their_hits() {
    let mut told = 0;
    for seed in 0..12 {
        let mut world = kept(&heap(seed));
        for _ in 0..90 {
            world.begin();
            let hits: Vec<Hit> = std::iter::from_fn(|| world.treat_next()).collect();
            world.finish();
            let ledger = world.ledger().expect("kept");
            assert_eq!(ledger.entries().len(), hits.len(), "heap {seed}");
            for (hit, entry) in hits.iter().zip(ledger.entries()) {
                told += 1;
                let pressed = entry.booked[Cause::Exchange];
                let p = Vec2::new(pressed.momentum_x, pressed.momentum_z);
                let (along, across) = (p.dot(&hit.normal), p.x * hit.normal.y - p.y * hit.normal.x);
                let of_fixed = world.kind(hit.a) == Kind::Fixed || world.kind(hit.b) == Kind::Fixed;
                assert!(across.abs() < 1e-12, "heap {seed}: {p:?} along {:?}", hit.normal);
                assert!((along.abs() > 1e-12) == of_fixed, "heap {seed}: {p:?}");
                let (time, end) = (entry.time, world.time());
                assert!(time > end - 1.0 / 60.0 - 1e-12 && time <= end + 1e-12, "heap {seed}: {time} before {end}");
            }
        }
    }
    assert!(told > 500, "{told}");
}

/// At e = 1/2 a flat drop leaves a quarter of 6 J: on one floor, at its moment; on two side by side one after the other, round
/// after round, which comes near.
#[test]
fn restitution_takes_its_share_of_a_flat_drop() {
    let whole = vec![wall("floor", (9.0, 1.0), (0.0, -0.5))];
    let halves = vec![wall("left", (4.0, 1.0), (-2.0, -0.5)), wall("right", (4.0, 1.0), (2.0, -0.5))];
    for (floors, tolerance) in [(whole, 1e-12), (halves, 1e-6)] {
        let mut bodies = floors;
        bodies.push(block("b", (1.0, 1.0), (0.0, 0.83), (0.0, -2.0), 3.0));
        let mut world = kept(&stepped(0.5, 1.0 / 60.0, bodies));
        steps(&mut world, 20);
        assert_energies(&world, &[(Cause::Restitution, -4.5)], tolerance);
        let held = booked(&world, Cause::Exchange);
        assert!((held.momentum_z - 9.0).abs() < tolerance && held.angular_momentum.abs() < tolerance, "{held:?}");
    }
    // From 1/5 m under 10 m/s²: 6 J again, within a step; the flights are gravity's.
    let bodies = vec![wall("floor", (9.0, 1.0), (0.0, -0.5)), block("b", (1.0, 1.0), (0.0, 0.7), (0.0, 0.0), 3.0)];
    let mut scene = stepped(0.5, 1.0 / 64.0, bodies);
    scene.settings.gravity = (0.0, -10.0);
    let mut world = kept(&scene);
    steps(&mut world, 19);
    let fallen = 0.7 - world.position(world.find("b").expect("it is there")).y;
    assert_energies(&world, &[(Cause::Restitution, -4.5), (Cause::Gravity, 30.0 * fallen)], 1e-12);
}

/// A block slides on a floor at μ = 0.3 under 10 m/s²: after half a second at 1/2 m/s. It stands after 2/3 s; what solving
/// leaves open in that one step is not much.
#[test]
fn friction_takes_what_a_slide_costs() {
    let floor = wall("floor", (99.0, 1.0), (0.0, -0.5));
    let mut scene = stepped(0.0, 1.0 / 64.0, vec![floor, block("b", (1.0, 1.0), (0.0, 0.5), (2.0, 0.0), 3.0)]);
    (scene.settings.gravity, scene.settings.friction) = ((0.0, -10.0), 0.3);
    let mut world = kept(&scene);
    for (count, speed, tolerance) in [(32, 0.5, 1e-12), (32, 0.0, 1e-3)] {
        steps(&mut world, count);
        assert_energies(&world, &[(Cause::Friction, 1.5 * speed * speed - 6.0)], tolerance);
        let (rubbed, held) = (booked(&world, Cause::Friction), booked(&world, Cause::Exchange));
        assert!((rubbed.momentum_x - 3.0 * (speed - 2.0)).abs() < tolerance, "{rubbed:?}");
        assert!((held.momentum_z - 30.0 * world.time()).abs() < tolerance, "{held:?}");
    }
}

/// A wall at 2 m/s takes 3 kg along: it works m v², of which half is lost where nothing is given back.
#[test]
fn a_wall_works_twice_what_it_gives() {
    let mut piston = wall("piston", (1.0, 4.0), (-2.0, 0.0));
    piston.patrol = Some(Patrol { points: vec![(98.0, 0.0)], speed: 2.0 });
    let bodies = vec![piston, block("b", (1.0, 1.0), (0.0, 0.0), (0.0, 0.0), 3.0)];
    let mut world = kept(&stepped(0.0, 1.0 / 60.0, bodies));
    steps(&mut world, 60);
    assert_energies(&world, &[(Cause::FixedBodies, 12.0), (Cause::Restitution, -6.0)], 1e-11);
    assert!((booked(&world, Cause::Exchange).momentum_x - 6.0).abs() < 1e-12);
}

/// A block that starts a tenth of a metre deep in a floor is let go without a velocity: it has the angular momentum of a
/// block that moves along higher up.
#[test]
fn what_starts_in_a_floor_is_relocated() {
    let bodies = vec![wall("floor", (99.0, 1.0), (0.0, -0.5)), block("b", (1.0, 1.0), (0.0, 0.4), (2.0, 0.0), 3.0)];
    let mut world = kept(&stepped(0.0, 1.0 / 60.0, bodies));
    steps(&mut world, 30);
    let id = world.find("b").expect("it is there");
    let raised = world.position(id).y - 0.4;
    assert!(raised > 0.09 && world.velocity(id) == Vec2::new(2.0, 0.0), "{raised}");
    assert_energies(&world, &[], 0.0);
    let ledger = world.ledger().expect("kept");
    assert!((ledger.relocated() - raised).abs() < 1e-14 && ledger.relocations() >= 30);
    assert!((booked(&world, Cause::Relocation).angular_momentum + 3.0 * 2.0 * raised).abs() < 1e-14);
}

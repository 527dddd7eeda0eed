//! What holds whatever stands or falls: energy comes from somewhere, and one body's end is not the others'.

use choque_engine::{Scene, Vec2, World};

use super::kit::{GRAVITY, Random, block, energy_under, ground, pyramid, standing, states, wall, watch};

/// Motion and height together \[J\].
fn energy(world: &World) -> f64 {
    energy_under(world, GRAVITY)
}

/// Energy may not rise in any step by more than 1e-5 of what there was: bodies in each other are moved apart without a change of
/// velocity, and some of them are lifted by it.
fn assert_energy_never_rises(scene: &Scene, steps: u32) {
    let start = energy(&World::new(scene).expect("a valid scene"));
    let (mut before, mut most) = (start, 0.0_f64);
    watch(scene, steps, |world| {
        let now = energy(world);
        most = most.max(now - before);
        before = now;
    });
    assert!(most <= 1e-5 * start, "of {start} J, a step made {most:e} J");
}

#[test]
fn a_falling_pyramid_makes_no_energy() {
    for restitution in [0.0, 0.5, 0.9] {
        let mut bodies = vec![ground(20.0)];
        bodies.extend(pyramid("box", 5, 1.0, (0.0, 0.5), 1.25));
        let mut scene = standing(bodies);
        scene.settings.restitution = restitution;
        assert_energy_never_rises(&scene, 300);
    }
}

#[test]
fn a_heap_makes_no_energy() {
    let mut random = Random(4);
    let mut bodies =
        vec![ground(30.0), wall("left", (1.0, 20.0), (-6.0, 10.0)), wall("right", (1.0, 20.0), (6.0, 10.0))];
    for i in 0..40 {
        let mut body =
            block(&format!("box{i}"), (1.5, 0.5), (f64::from(i % 4) * 2.4 - 3.6, 1.0 + 1.2 * f64::from(i / 4)));
        body.angle = random.between(-0.5, 0.5);
        bodies.push(body);
    }
    assert_energy_never_rises(&standing(bodies), 400);
}

#[test]
fn a_body_thrown_out_of_the_numbers_is_named_and_harms_no_other() {
    let mut bodies = vec![ground(20.0)];
    bodies.extend(pyramid("box", 4, 1.0, (0.0, 0.0), 1.0));
    bodies.push(block("lost", (1.0, 1.0), (10.0, 5.0)));
    let mut world = World::new(&standing(bodies)).expect("a valid scene");
    let lost = world.find("lost").expect("it is there");
    world.push(lost, Vec2::new(f64::MAX, 0.0)).expect("a finite force");
    world.push(lost, Vec2::new(f64::MAX, 0.0)).expect("a finite force");
    world.step();
    let fault = world.fault().expect("it has left the finite numbers").to_string();
    assert!(fault.contains("lost"), "{fault}");
    let finite = |x: f64| x.is_finite();
    let others = states(&world);
    assert!(others[..10].iter().all(|s| [s.x, s.z, s.angle, s.vx, s.vz, s.spin].into_iter().all(finite)));
}

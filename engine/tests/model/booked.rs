//! What is booked, and under which cause, against amounts worked by hand.

use choque_engine::ledger::{Amounts, Cause};
use choque_engine::scene::{Body, Detection, ExchangeRule, Kind, MotionRule, Patrol, Scene, Settings};
use choque_engine::{Vec2, World};

use crate::body;
use crate::continuous::{block, impulse, wall};

/// The world right after its first exchange, the ledger kept from the start.
pub(crate) fn after_first_hit(scene: &Scene) -> World {
    let mut world = World::new(scene).expect("a valid scene");
    world.keep_ledger();
    while world.iteration() < 1000 {
        world.begin();
        if world.treat_next().is_some() {
            return world;
        }
        world.finish();
    }
    panic!("nothing met");
}

pub(crate) fn booked(world: &World, cause: Cause) -> Amounts {
    world.ledger().expect("it is kept").booked(cause)
}

/// Holds the kinetic energy by cause to what is expected; causes that are not named are held to 0.
pub(crate) fn assert_energies(world: &World, expected: &[(Cause, f64)], tolerance: f64) {
    for cause in Cause::ALL {
        let wanted = expected.iter().find(|(known, _)| *known == cause).map_or(0.0, |(_, energy)| *energy);
        let found = booked(world, cause).kinetic_energy;
        assert!((found - wanted).abs() <= tolerance, "{cause:?}: {found}, not {wanted}");
    }
}

/// Two unit squares that meet face to face under the document's exchange.
fn head_on(mu_l: f64, masses: (f64, f64)) -> Scene {
    let settings =
        Settings { detection: Some(Detection::Complete), mu_l, time_step: 1.0 / 64.0, ..Settings::default() };
    let bodies = vec![
        block("a", (1.0, 1.0), (-1.5, 0.0), (2.0, 0.0), masses.0),
        block("b", (1.0, 1.0), (0.0, 0.0), (0.0, 0.0), masses.1),
    ];
    Scene { settings, bodies, ..Scene::default() }
}

/// The light body gets the whole momentum of the heavy one: energy grows from 6 J by m1/m2 = 3.
#[test]
fn the_documents_exchange_adds_energy_and_says_so() {
    let world = after_first_hit(&head_on(1.0, (3.0, 1.0)));
    assert!((world.kinetic_energy() - 18.0).abs() < 1e-14);
    assert_energies(&world, &[(Cause::Exchange, 12.0)], 1e-14);
    // Half of the momentum lost: 3 m/s instead of 6, 4.5 J instead of 18.
    let world = after_first_hit(&head_on(0.5, (3.0, 1.0)));
    assert_energies(&world, &[(Cause::Exchange, 12.0), (Cause::MuL, -13.5)], 1e-14);
    assert!((booked(&world, Cause::MuL).momentum_x + 3.0).abs() < 1e-14);
    // μ_A has nothing to lose here.
    let mut scene = head_on(0.5, (3.0, 1.0));
    scene.settings.mu_a = 0.5;
    assert_energies(&after_first_hit(&scene), &[(Cause::Exchange, 12.0), (Cause::MuL, -13.5)], 1e-14);
}

/// §2.5.3 with v = (3, 2) at a wall, arm along x: what goes along the arm is gone. On the way the body moves back by depth
/// + ε along x, with its velocity across: ΔL = m (shift × v) = −m (depth + ε) v_z.
#[test]
fn relocation_moves_an_angular_momentum() {
    let settings = Settings { detection: Some(Detection::Complete), time_step: 1.0 / 64.0, ..Settings::default() };
    let bodies = vec![block("a", (1.0, 1.0), (-2.0, 7.0), (3.0, 2.0), 5.0), wall("wall", (1.0, 1000.0), (0.0, 0.0))];
    let world = after_first_hit(&Scene { settings, bodies, ..Scene::default() });
    let ledger = world.ledger().expect("kept");
    let entry = ledger.entries()[0];
    let depth = -2.0 + 3.0 * 22.0 / 64.0 + 1.0; // met after 22 iterations
    assert_eq!((ledger.relocations(), world.iteration()), (1, 21));
    assert!((ledger.relocated() - (depth + 0.001)).abs() < 1e-14 && entry.relocated == ledger.relocated());
    let expected = 5.0 * -(depth + 0.001) * 2.0;
    assert!((booked(&world, Cause::Relocation).angular_momentum - expected).abs() < 1e-13);
    assert_energies(&world, &[(Cause::Exchange, -0.5 * 5.0 * 9.0)], 1e-13);
    assert_eq!(entry.time, 22.0 / 64.0);
    assert_eq!(entry.booked[Cause::Exchange], booked(&world, Cause::Exchange));
}

/// C1: a vertex on a face at e = 1/2 leaves 2842/3967 of 9 J; nothing rubs, and nothing of momentum goes anywhere.
#[test]
fn restitution_takes_what_is_not_given_back() {
    for motion in [MotionRule::Stepped, MotionRule::Continuous] {
        let mut a = block("a", (2.0, 1.0), (-2.0, 0.0), (3.0, 0.0), 2.0);
        a.angle = libm::atan2(3.0, 4.0);
        let mut scene = impulse(0.5, 1e-3, vec![a, block("b", (1.0, 3.0), (0.0, 1.25), (0.0, 0.0), 3.0)]);
        scene.settings.motion = motion;
        let world = after_first_hit(&scene);
        assert_energies(&world, &[(Cause::Restitution, -9.0 * 1125.0 / 3967.0)], 1e-13);
        for cause in Cause::ALL {
            let Amounts { momentum_x, momentum_z, angular_momentum, .. } = booked(&world, cause);
            assert!([momentum_x, momentum_z, angular_momentum].iter().all(|amount| amount.abs() < 1e-14), "{cause:?}");
        }
    }
}

/// A vertex at (−3/5, −4/5) of a body of 1 kg comes down on a floor at (u_t, −2).
fn on_a_floor(u_t: f64, friction: f64) -> World {
    let bodies = vec![wall("floor", (100.0, 2.0), (0.0, -1.0)), block("b", (1.2, 1.6), (0.0, 1.0), (u_t, -2.0), 1.0)];
    let mut scene = impulse(0.5, 1.0, bodies);
    scene.settings.detection = Some(Detection::Vertices);
    scene.settings.friction = friction;
    after_first_hit(&scene)
}

/// F1 slips through: p = (−75, 375)/296 and u⁺ = (425/296, 1) give both works.
#[test]
fn friction_takes_what_slip_costs() {
    let world = on_a_floor(4.0, 0.2);
    let (p_t, p_n) = (-75.0 / 296.0, 375.0 / 296.0);
    let (rubbed, pressed) = (0.5 * p_t * (4.0 + 425.0 / 296.0), 0.5 * p_n * (-2.0 + 1.0));
    assert_energies(&world, &[(Cause::Friction, rubbed), (Cause::Restitution, pressed)], 1e-14);
    // The floor takes up the momentum; the vertex stands at x = −3/5 from the centre, which is at x = 4/10, on z = 0.
    let (tangential, normal) = (booked(&world, Cause::Friction), booked(&world, Cause::Exchange));
    let found = [tangential.momentum_x, tangential.momentum_z, tangential.angular_momentum];
    let expected = [p_t, 0.0, 0.0];
    assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-14), "{found:?}");
    let found = [normal.momentum_x, normal.momentum_z, normal.angular_momentum];
    let expected = [0.0, p_n, (0.4 - 0.6) * p_n];
    assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-14), "{found:?}");
}

/// F2 sticks on the way: slip stops after q = 250/1017 of normal impulse, under 9/10 of it; from then on nothing rubs. The
/// normal motion loses ¾ of what compression takes, in two pieces.
#[test]
fn friction_that_stops_slip_takes_no_more() {
    let q = 250.0 / 1017.0;
    let u_n = -2.0 + 3.376 * q;
    let compression = q * (-2.0 + 0.5 * 3.376 * q) - 0.5 * u_n * u_n * 73.0 / 100.0;
    let expected = [(Cause::Friction, -0.9 * q * 0.5), (Cause::Restitution, 0.75 * compression)];
    assert_energies(&on_a_floor(1.0, 0.9), &expected, 1e-14);
}

/// C6 with the block struck at its centre: it leaves at (1 + e) 6 m/s, the blade works p·w = m v 6 m/s.
#[test]
fn a_blade_works_and_restitution_takes_its_share() {
    for (e, worked, taken) in [(1.0, 72.0, 0.0), (0.5, 54.0, -13.5)] {
        let mut blade = wall("blade", (8.0, 1e-9), (0.0, 0.0));
        blade.spin = Some(2.0);
        // A needle of a vertex, so that there is one point, at radius 3.
        let mut block = block("block", (0.5, 0.5), (3.0, 0.5 * libm::sqrt(0.5) + 1e-9), (0.0, 0.0), 1.0);
        block.angle = core::f64::consts::FRAC_PI_4;
        let world = after_first_hit(&impulse(e, 1e-9, vec![blade, block]));
        let expected = [(Cause::FixedBodies, worked), (Cause::Restitution, taken)];
        assert_energies(&world, &expected, 1e-6); // the blade is a nanoradian round
        assert!((booked(&world, Cause::Exchange).momentum_z - (1.0 + e) * 6.0).abs() < 1e-6);
    }
}

/// The document's blade hands over v1→v2 and more; at rest, the same hit would have taken all there is along the arm.
#[test]
fn a_blade_of_the_document_works_too() {
    let settings = Settings { mu_l: 0.5, time_step: 1.0 / 64.0, ..Settings::default() };
    let mut blade = body("blade", Kind::Fixed, 6.0, 0.4);
    blade.spin = Some(2.0);
    let bodies = vec![blade, block("b", (1.0, 1.0), (2.0, 2.0), (0.0, -1.0), 1.0)];
    let world = after_first_hit(&Scene { settings, bodies, ..Scene::default() });
    assert!(booked(&world, Cause::FixedBodies).kinetic_energy > 0.0);
    assert!(booked(&world, Cause::Exchange).kinetic_energy < 0.0);
    assert!(booked(&world, Cause::MuL).kinetic_energy < 0.0);
    let ledger = world.ledger().expect("kept");
    let sum: f64 = Cause::ALL.iter().map(|cause| ledger.booked(*cause).kinetic_energy).sum();
    assert!((0.5 + sum - world.kinetic_energy()).abs() < 1e-15);
}

/// One body, no collisions: gravity, drag and commands.
fn alone(settings: Settings) -> World {
    let bodies = vec![block("b", (1.0, 1.0), (3.0, 5.0), (2.0, 4.0), 6.0)];
    let mut world = World::new(&Scene { settings, bodies, ..Scene::default() }).expect("a valid scene");
    world.keep_ledger();
    world
}

pub(crate) fn steps(world: &mut World, count: u32) {
    (0..count).for_each(|_| world.step());
}

#[test]
fn gravity_works_by_the_height() {
    for motion in [MotionRule::Stepped, MotionRule::Continuous] {
        let mut world = alone(Settings { gravity: (0.0, -10.0), time_step: 0.125, motion, ..Settings::default() });
        steps(&mut world, 8); // 1 s: from z = 5 by 4 − 5 to 4
        let id = world.find("b").expect("it is there");
        assert!((world.position(id).y - 4.0).abs() < 1e-14);
        let Amounts { kinetic_energy, momentum_x, momentum_z, angular_momentum } = booked(&world, Cause::Gravity);
        assert!((kinetic_energy - 60.0).abs() < 1e-13, "m g h: {kinetic_energy}");
        assert!(momentum_x == 0.0 && (momentum_z + 60.0).abs() < 1e-13);
        assert!((angular_momentum + 60.0 * (3.0 + 1.0)).abs() < 1e-12, "−m g ∫x dt: {angular_momentum}");
    }
}

/// v̇ = g − k v: drag takes k m times the way of momentum, whatever gravity does meanwhile.
#[test]
fn drag_takes_by_the_way() {
    for motion in [MotionRule::Stepped, MotionRule::Continuous] {
        let settings =
            Settings { gravity: (0.0, -10.0), drag: (0.5, 0.25), time_step: 0.125, motion, ..Settings::default() };
        let mut world = alone(settings);
        let id = world.find("b").expect("it is there");
        world.set_spin(id, 8.0).expect("finite");
        let before = world.kinetic_energy();
        steps(&mut world, 16);
        let way = world.position(id) - Vec2::new(3.0, 5.0);
        let (drag, gravity) = (booked(&world, Cause::Drag), booked(&world, Cause::Gravity));
        assert!((drag.momentum_x + 0.5 * 6.0 * way.x).abs() < 1e-13);
        assert!((drag.momentum_z + 0.5 * 6.0 * way.y).abs() < 1e-13);
        assert!((gravity.kinetic_energy + 60.0 * way.y).abs() < 1e-12);
        assert!((before + gravity.kinetic_energy + drag.kinetic_energy - world.kinetic_energy()).abs() < 1e-12);
        assert!(drag.kinetic_energy < 0.0 && (world.spin(id) - 8.0 * libm::exp(-0.5)).abs() < 1e-14);
    }
}

#[test]
fn commands_are_booked_as_what_they_change() {
    for motion in [MotionRule::Stepped, MotionRule::Continuous] {
        let mut world = alone(Settings { time_step: 0.5, motion, ..Settings::default() });
        let id = world.find("b").expect("it is there");
        world.set_velocity(id, Vec2::new(1.0, 0.0)).expect("finite"); // 60 J become 3 J
        world.set_spin(id, 2.0).expect("finite"); // I = 1: 2 J more
        world.set_position(id, Vec2::new(0.0, 0.0)).expect("finite"); // L = 3·24 − 5·12 = 12 became −30 + 2, now 2
        world.set_angle(id, 1.0).expect("finite");
        let Amounts { kinetic_energy, momentum_x, momentum_z, angular_momentum } = booked(&world, Cause::Commands);
        assert_eq!([kinetic_energy, momentum_x, momentum_z, angular_momentum], [-55.0, -6.0, -24.0, -10.0]);

        // 12 N for half a second: a = 2, from 1 to 2 m/s over 3/4 m. 4 N·m: α = 4, from 2 to 4 rad/s over 3/2 rad.
        world.push(id, Vec2::new(12.0, 0.0)).expect("finite");
        world.twist(id, 4.0).expect("finite");
        world.step();
        let given = booked(&world, Cause::Commands);
        assert!(
            (given.kinetic_energy + 55.0 - 9.0 - 6.0).abs() < 1e-14 && (given.momentum_x + 6.0 - 6.0).abs() < 1e-14
        );
        assert!((given.angular_momentum + 10.0 - 2.0).abs() < 1e-14);
    }
}

/// A push and gravity at once under drag: each has its own work, and they add up.
#[test]
fn a_push_against_gravity_has_its_own_work() {
    let settings = Settings { gravity: (0.0, -10.0), drag: (0.5, 0.0), time_step: 0.5, ..Settings::default() };
    let mut world = alone(settings);
    let id = world.find("b").expect("it is there");
    let start = world.position(id);
    world.push(id, Vec2::new(30.0, 60.0)).expect("finite");
    world.step();
    let way = world.position(id) - start;
    let (pushed, gravity) = (booked(&world, Cause::Commands), booked(&world, Cause::Gravity));
    assert!((pushed.kinetic_energy - (30.0 * way.x + 60.0 * way.y)).abs() < 1e-13);
    assert!((gravity.kinetic_energy + 60.0 * way.y).abs() < 1e-13);
    assert!((pushed.momentum_x - 15.0).abs() < 1e-14 && (gravity.momentum_z + 30.0).abs() < 1e-14);
}

/// What rests on a floor is held: the floor gives back what gravity takes. On a lift, the lift works m g h.
#[test]
fn what_rests_is_held_and_a_lift_works() {
    let motions = [MotionRule::Stepped, MotionRule::Continuous];
    for (speed, motion) in [0.0, 0.5].into_iter().flat_map(|speed| motions.map(|motion| (speed, motion))) {
        let mut floor = Body::new("floor", Kind::Fixed);
        floor.parts = wall("floor", (9.0, 1.0), (0.0, 0.0)).parts;
        floor.at = (0.0, -0.5);
        if speed > 0.0 {
            floor.patrol = Some(Patrol { points: vec![(0.0, 99.5)], speed });
        }
        let mut scene = impulse(0.0, 1.0 / 64.0, vec![floor, block("b", (1.0, 1.0), (2.0, 0.5), (0.0, speed), 3.0)]);
        (scene.settings.gravity, scene.settings.motion) = ((0.0, -10.0), motion);
        let mut world = World::new(&scene).expect("a valid scene");
        world.keep_ledger();
        steps(&mut world, 128); // 2 s
        let id = world.find("b").expect("it is there");
        assert!((world.position(id).y - 0.5 - 2.0 * speed).abs() < 1e-9, "{}", world.position(id).y);
        let (held, gravity) = (booked(&world, Cause::Exchange), booked(&world, Cause::Gravity));
        assert!((gravity.momentum_z + 60.0).abs() < 1e-12 && (held.momentum_z - 60.0).abs() < 1e-7, "{held:?}");
        assert!((held.angular_momentum - 120.0).abs() < 1e-6);
        assert!((booked(&world, Cause::FixedBodies).kinetic_energy - 60.0 * speed).abs() < 1e-6);
        assert!((gravity.kinetic_energy + 60.0 * speed).abs() < 1e-6);
    }
}

/// A block slides on a floor until it stands: friction takes all it had, and the floor all its momentum.
#[test]
fn lasting_friction_takes_what_a_slide_costs() {
    let bodies = vec![wall("floor", (99.0, 1.0), (0.0, -0.5)), block("b", (1.0, 1.0), (0.0, 0.5), (2.0, 0.0), 3.0)];
    let mut scene = impulse(0.0, 1.0 / 64.0, bodies);
    scene.settings.gravity = (0.0, -10.0);
    scene.settings.friction = 0.3;
    let mut world = World::new(&scene).expect("a valid scene");
    world.keep_ledger();
    steps(&mut world, 64); // it stands after v/(μ g) = 2/3 s
    let id = world.find("b").expect("it is there");
    assert!(world.velocity(id).norm() < 1e-9, "{:?}", world.velocity(id));
    assert_energies(&world, &[(Cause::Friction, -6.0)], 1e-6);
    assert!((booked(&world, Cause::Friction).momentum_x + 6.0).abs() < 1e-6);
    assert!((booked(&world, Cause::Exchange).momentum_z - 30.0).abs() < 1e-6);
}

/// Two equal blocks from both sides at one instant into a third: what each pair changed is entered by itself.
#[test]
fn impacts_at_one_instant_have_entries_of_their_own() {
    for exchange in [ExchangeRule::Document, ExchangeRule::Impulse] {
        let bodies = vec![
            block("left", (1.0, 1.0), (-3.0, 0.0), (2.0, 0.0), 1.0),
            block("middle", (1.0, 1.0), (0.0, 0.0), (0.0, 0.0), 1.0),
            block("right", (1.0, 1.0), (3.0, 0.0), (-2.0, 0.0), 1.0),
        ];
        let mut scene = impulse(0.5, 2.0, bodies);
        scene.settings.exchange = exchange;
        scene.settings.mu_l = 0.5;
        let mut world = World::new(&scene).expect("a valid scene");
        world.keep_ledger();
        world.begin();
        assert!(world.treat_next().is_some() && world.treat_next().is_some());
        let ledger = world.ledger().expect("kept");
        let [left, right] = ledger.entries() else { panic!("{} entries", ledger.entries().len()) };
        let energies = |at: usize| {
            let entry = &ledger.entries()[at];
            Cause::ALL.map(|cause| entry.booked[cause].kinetic_energy)
        };
        assert!((left.time - 1.0).abs() < 1e-15 && left.time == right.time);
        let (one, two) = (energies(0), energies(1));
        assert!(one.iter().zip(two).all(|(a, b)| (a - b).abs() < 1e-14), "{exchange:?}: {one:?} {two:?}");
        let sum: f64 = one.iter().chain(&two).sum();
        assert!((4.0 + sum - world.kinetic_energy()).abs() < 1e-14 && sum < 0.0, "{exchange:?}: {sum}");
    }
}

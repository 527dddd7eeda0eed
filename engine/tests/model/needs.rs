//! Only what a scene needs: what is off does no work, and the plan says so.

use choque_engine::plan::{BroadPhasePlan, ContactPlan};
use choque_engine::scene::{
    Body, BroadPhaseChoice, Detection, ExchangeRule, Kind, MotionRule, Part, Scene, Settings, Swing,
};
use choque_engine::{Extent, Plan, Vec2, Work, World, note};

use crate::{after, body, scene};

fn moving(name: &str, x: f64) -> Body {
    let mut body = body(name, Kind::Mobile, 1.0, 1.0);
    body.at = (x, 0.0);
    body.velocity = Some((1.0, 0.0));
    body
}

/// The counts that are not zero after ten steps.
fn work_of(scene: &Scene) -> Vec<(&'static str, u64)> {
    after(scene, 10).work().rows().into_iter().filter(|(_, count)| *count > 0).collect()
}

#[test]
fn a_lone_body_only_advances() {
    assert_eq!(work_of(&scene(vec![moving("a", 0.0)])), [("iterations", 10), ("bodies advanced", 10)]);
}

#[test]
fn fixed_bodies_at_rest_cost_nothing() {
    let bodies = (0..50).map(|i| body(&format!("wall{i}"), Kind::Fixed, 5.0, 5.0)).collect();
    assert_eq!(work_of(&scene(bodies)), [("iterations", 10)]);
}

#[test]
fn bodies_off_the_plane_are_advanced_and_nothing_else() {
    let bridge = |name: &str| {
        let mut bridge = moving(name, 0.0);
        bridge.parts = vec![Part::Mesh(Extent { x: (-5.0, 5.0), y: (0.0, 1.0), z: (-5.0, 5.0) })];
        bridge.height = 6.0;
        bridge
    };
    let scene = scene(vec![bridge("a"), bridge("b"), moving("car", 0.0)]);
    assert_eq!(work_of(&scene), [("iterations", 10), ("bodies advanced", 30)]);
    let plan = Plan::resolve(&scene).expect("a valid scene");
    assert_eq!((plan.census.not_collidable, plan.broad_phase), (2, BroadPhasePlan::Nothing));
}

#[test]
fn gravity_and_swings_are_paid_for_where_they_are() {
    let mut gate = body("gate", Kind::Fixed, 3.0, 0.2);
    gate.swing = Some(Swing { angle: 1.0, period: 2.0 });
    gate.at = (50.0, 0.0);
    let settings = Settings { gravity: (0.0, -9.81), ..Settings::default() };
    let scene = Scene { settings, ..scene(vec![moving("a", 0.0), gate]) };
    let work = *after(&scene, 10).work();
    assert_eq!((work.bodies_forced, work.prescribed, work.bodies_advanced), (10, 10, 20));
}

#[test]
fn the_document_tests_every_pair_and_the_sweep_next_to_none() {
    let bodies: Vec<Body> = (0..100).map(|i| moving(&format!("b{i}"), 3.0 * f64::from(i))).collect();
    let forced = |broad_phase| {
        let settings = Settings { broad_phase, ..Settings::default() };
        *after(&Scene { settings, ..scene(bodies.clone()) }, 1).work()
    };
    let (every, swept) = (forced(BroadPhaseChoice::AllPairs), forced(BroadPhaseChoice::Strips));
    assert_eq!((every.pairs_tested, every.vertices_transformed, every.bounds), (100 * 99 / 2, 8 * 100 * 99 / 2, 0));
    assert_eq!((swept.pairs_tested, swept.bounds), (0, 100));
}

/// The sweep's comparisons grow as the bodies do, also when long walls cross the field in both directions.
#[test]
fn the_sweep_grows_linearly_among_long_walls() {
    let field = |side: u32| {
        let mut bodies = Vec::new();
        let length = f64::from(side) * 4.0;
        for i in 0..side {
            let along = f64::from(i) * 4.0 - 0.5 * length;
            for k in 0..side {
                let mut car = body(&format!("car{i}_{k}"), Kind::Mobile, 2.0, 1.0);
                car.at = (along, f64::from(k) * 4.0 - 0.5 * length);
                car.angle = f64::from(i * 7 + k * 3);
                bodies.push(car);
            }
            for (name, angle, at) in
                [("row", 0.0, (0.0, along)), ("column", 1.5, (along, 0.0)), ("slant", 0.7, (along, 0.0))]
            {
                let mut wall = body(&format!("{name}{i}"), Kind::Fixed, length, 0.1);
                wall.at = at;
                wall.angle = angle;
                bodies.push(wall);
            }
        }
        scene(bodies)
    };
    let per_body = |side: u32| {
        let scene = field(side);
        let mut world = World::new(&scene).expect("a valid scene");
        world.begin();
        world.work().bounds_compared as f64 / scene.bodies.len() as f64
    };
    let (small, large) = (per_body(20), per_body(120));
    assert!(large < 1.5 * small, "{small} comparisons per body at 20 × 20, {large} at 120 × 120");
}

#[test]
fn a_written_motion_gives_a_fixed_body_physics_from_then_on() {
    let mut world = World::new(&scene(vec![moving("a", 0.0), body("wall", Kind::Fixed, 1.0, 9.0)])).expect("valid");
    let wall = world.find("wall").expect("it is there");
    world.step();
    assert_eq!(world.work().bodies_advanced, 1);
    world.set_velocity(wall, Vec2::new(0.5, 0.0)).expect("finite");
    let before = *world.work();
    world.step();
    assert_eq!(world.work().bodies_advanced - before.bodies_advanced, 2);
    assert!((world.position(wall).x - 0.5 / 60.0).abs() < 1e-15);
    assert!(world.work().exchanges_physics > 0 && before.exchanges_physics == 0);
}

#[test]
fn the_plan_says_what_it_models_and_what_it_leaves_out() {
    let mut blade = body("blade", Kind::Fixed, 6.0, 0.4);
    blade.spin = Some(2.0);
    let plan = Plan::resolve(&scene(vec![blade, moving("car", 9.0)])).expect("a valid scene");
    let expected = "\
bodies: 1 mobile, 1 fixed with physics; 2 rectangles
advance: uniform between collisions (§2.1)
pairs: all tested (§2.3)
detect: vertex in rectangle (§2.3)
relocate: least distance + ε = 0.001 m (§2.4)
exchange: document, μ_L = 1, μ_A = 1: mobile–fixed with physics (§2.5.2)
left out: gravity, drag, prescribed motion, compound bodies, exchange §2.5.1, exchange §2.5.3, lasting contact";
    assert_eq!(plan.to_string(), expected);
}

fn impulses(bodies: Vec<Body>) -> Scene {
    let settings = Settings { exchange: ExchangeRule::Impulse, ..Settings::default() };
    Scene { settings, ..scene(bodies) }
}

/// A mobile body, a fixed one, and another that lies off the plane, with these frictions and restitutions.
fn surfaces(friction: [f64; 3], restitution: [f64; 3]) -> ContactPlan {
    let mut off = body("off", Kind::Mobile, 1.0, 1.0);
    off.parts = vec![Part::Mesh(Extent { x: (-1.0, 1.0), y: (1.0, 2.0), z: (-1.0, 1.0) })];
    let mut bodies = vec![moving("car", 0.0), body("wall", Kind::Fixed, 1.0, 1.0), off];
    for (body, (friction, restitution)) in bodies.iter_mut().zip(friction.into_iter().zip(restitution)) {
        (body.friction, body.restitution) = (Some(friction), Some(restitution));
    }
    let plan = Plan::resolve(&impulses(bodies)).expect("a valid scene");
    plan.contact.expect("stepped impulses")
}

#[test]
fn friction_takes_two_bodies_and_restitution_one() {
    let needs = |friction, restitution| {
        let contact = surfaces(friction, restitution);
        (contact.friction, contact.restitution)
    };
    assert_eq!(needs([0.5, 0.5, 0.0], [0.0; 3]), (true, false));
    assert_eq!(needs([0.5, 0.0, 0.5], [0.0; 3]), (false, false), "what is off the plane meets nothing");
    assert_eq!(needs([0.0, 0.5, 0.5], [0.0; 3]), (false, false));
    assert_eq!(needs([0.0; 3], [0.5, 0.0, 0.0]), (false, true));
    assert_eq!(needs([0.0; 3], [0.0, 0.5, 0.0]), (false, true));
    assert_eq!(needs([0.0; 3], [0.0, 0.0, 0.5]), (false, false));
}

#[test]
fn friction_between_fixed_bodies_is_nobody_s() {
    let mut walls = [body("a", Kind::Fixed, 1.0, 1.0), body("b", Kind::Fixed, 1.0, 1.0)];
    walls.iter_mut().for_each(|wall| wall.friction = Some(0.5));
    let [a, b] = walls;
    let plan = Plan::resolve(&impulses(vec![a, b, moving("car", 9.0)])).expect("a valid scene");
    assert!(!plan.contact.expect("stepped impulses").friction);
}

#[test]
fn contacts_are_planned_where_impulses_meet_in_steps() {
    let two = || impulses(vec![moving("a", 0.0), moving("b", 9.0)]);
    let contact = |change: fn(&mut Settings)| {
        let mut scene = two();
        change(&mut scene.settings);
        Plan::resolve(&scene).expect("a valid scene").contact
    };
    let frugal = ContactPlan { substeps: 4, friction: false, restitution: false, sleeping: false };
    assert_eq!(contact(|_| ()), Some(frugal));
    assert_eq!(contact(|s| s.substeps = Some(1000)), Some(ContactPlan { substeps: 1000, ..frugal }));
    assert_eq!(contact(|s| s.sleeping = true), Some(ContactPlan { sleeping: true, ..frugal }));
    assert_eq!(contact(|s| s.motion = MotionRule::Continuous), None);
    assert_eq!(contact(|s| s.exchange = ExchangeRule::Document), None);
    assert_eq!(contact(|s| s.detection = Some(Detection::Vertices)), None);
    assert_eq!(Plan::resolve(&impulses(vec![moving("a", 0.0)])).expect("a valid scene").contact, None);
}

#[test]
fn the_plan_tells_how_contacts_are_solved() {
    let told = |change: fn(&mut Settings)| {
        let mut scene = impulses(vec![moving("a", 0.0), moving("b", 9.0)]);
        change(&mut scene.settings);
        let plan = Plan::resolve(&scene).expect("a valid scene").to_string();
        plan.split_once("detect: separating axes\n").expect("complete detection").1.to_owned()
    };
    let frugal = "exchange: impulse
contacts: solved in 4 sub-steps
left out: gravity, drag, prescribed motion, compound bodies, relocation, restitution, friction, sleeping";
    assert_eq!(told(|_| ()), frugal);
    let full = "exchange: impulse, restitution and friction of each pair
contacts: solved in 1 sub-step, bodies at rest sleep
left out: gravity, drag, prescribed motion, compound bodies, relocation";
    let everything = |s: &mut Settings| {
        (s.restitution, s.friction, s.substeps, s.sleeping) = (0.5, 0.5, Some(1), true);
    };
    assert_eq!(told(everything), full);
}

/// What the plan says and what the world does are one: with vertices alone impulses act pair by pair.
#[test]
fn contacts_do_not_last_where_only_vertices_are_looked_for() {
    let mut scene = impulses(vec![moving("a", 0.0), moving("b", 0.9)]);
    scene.settings.detection = Some(Detection::Vertices);
    let plan = Plan::resolve(&scene).expect("a valid scene").to_string();
    let pair_by_pair = "detect: vertex in rectangle (§2.3)
exchange: impulse, restitution and friction of each pair
left out: gravity, drag, prescribed motion, compound bodies, relocation, lasting contact";
    assert!(plan.ends_with(pair_by_pair), "{plan}");
    let mut world = World::new(&scene).expect("a valid scene");
    let said: Vec<String> = note::review(&scene, &world).iter().map(ToString::to_string).collect();
    assert!(
        said.len() == 1 && said[0].ends_with("the impulse exchange does not move bodies, so it stays until they part"),
        "{said:?}"
    );
    world.begin();
    assert_eq!(world.listed().len(), 1, "overlaps are listed before any is treated");
}

#[test]
fn a_world_has_one_thread_unless_told_otherwise() {
    let mut world = World::new(&scene(vec![moving("a", 0.0)])).expect("a valid scene");
    assert_eq!(world.threads(), 1);
    world.set_threads(3);
    assert_eq!((world.threads(), world.clone().threads()), (3, 3));
    world.set_threads(0);
    assert_eq!(world.threads(), 1);
}

#[test]
fn every_count_has_a_label_of_its_own() {
    let rows = Work::default().rows();
    let mut labels: Vec<_> = rows.iter().map(|(label, _)| *label).collect();
    labels.sort_unstable();
    labels.dedup();
    assert_eq!(labels.len(), rows.len());
}

/// A stack that has come to rest does no work while it sleeps, stands where it would without sleep to the last bit, and wakes when
/// something is done to it.
#[test]
fn what_sleeps_does_no_work_until_it_is_woken() {
    let stack = |sleeping| {
        let mut bodies = vec![body("floor", Kind::Fixed, 20.0, 2.0)];
        bodies[0].at = (0.0, -1.0);
        for k in 0..5 {
            let mut brick = body(&format!("brick{k}"), Kind::Mobile, 2.0, 1.0);
            brick.at = (0.1 * f64::from(k % 2), 0.5 + f64::from(k));
            bodies.push(brick);
        }
        let mut scene = scene(bodies);
        scene.settings.exchange = ExchangeRule::Impulse;
        scene.settings.gravity = (0.0, -9.8);
        scene.settings.sleeping = sleeping;
        after(&scene, 60)
    };
    let (mut asleep, awake) = (stack(true), stack(false));
    for id in asleep.ids() {
        assert_eq!((asleep.position(id), asleep.angle(id)), (awake.position(id), awake.angle(id)));
    }
    let solved = |world: &World| (world.work().touches_solved, world.work().bounds);
    let before = solved(&asleep);
    (0..10).for_each(|_| asleep.step());
    assert_eq!((solved(&asleep), asleep.time() > 1.1), (before, true));
    let top = asleep.find("brick4").expect("it is there");
    asleep.push(top, Vec2::new(300.0, 0.0)).expect("finite");
    asleep.step();
    assert!(solved(&asleep).0 > before.0 && asleep.velocity(top).x > 0.0, "a push wakes it");
    asleep.set_velocity(top, Vec2::new(0.0, 1.0)).expect("finite");
    (0..5).for_each(|_| asleep.step());
    assert!(asleep.position(top).y > 4.5, "and so does a velocity");
}

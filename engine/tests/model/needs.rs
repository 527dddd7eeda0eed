//! Only what a scene needs: what is off does no work, and the plan says so.

use choque_engine::plan::BroadPhasePlan;
use choque_engine::scene::{Body, BroadPhaseChoice, Kind, Part, Scene, Settings, Swing};
use choque_engine::{Extent, Plan, Vec2, Work, World};

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
left out: gravity, drag, prescribed motion, compound bodies, exchange §2.5.1, exchange §2.5.3";
    assert_eq!(plan.to_string(), expected);
}

#[test]
fn every_count_has_a_label_of_its_own() {
    let rows = Work::default().rows();
    let mut labels: Vec<_> = rows.iter().map(|(label, _)| *label).collect();
    labels.sort_unstable();
    labels.dedup();
    assert_eq!(labels.len(), rows.len());
}

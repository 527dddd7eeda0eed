//! The model's formulas, by hand, on single impacts; and the laws of free flight.

use choque_engine::bodies::{Bodies, Inertia, Motion, Role};
use choque_engine::exchange::document::{Losses, exchange};
use choque_engine::relocate::Placed;
use choque_engine::scene::{Body, Kind, Patrol, Scene, Settings};
use choque_engine::{PairKind, Vec2, World};

use crate::{after, body, columns, scene};

/// Two bodies of the given roles, masses and motions; places and shapes do not enter the exchange.
fn two(of: [(Role, f64, (f64, f64), f64); 2]) -> Bodies {
    columns(of.map(|(role, mass, (vx, vz), omega)| (role, Inertia { mass, moment: 1.0 }, motion(vx, vz, omega))))
}

/// A contact of body 0's vertex in body 1, with these arms.
fn arms(r_owner: (f64, f64), r_reference: (f64, f64)) -> Placed {
    let vec2 = |(x, z)| Vec2::new(x, z);
    Placed {
        owner: 0,
        reference: 1,
        r_owner: vec2(r_owner),
        r_reference: vec2(r_reference),
        normal: Vec2::zeros(),
        point: Vec2::zeros(),
    }
}

fn motion(vx: f64, vz: f64, omega: f64) -> Motion {
    Motion { v: Vec2::new(vx, vz), omega }
}

#[test]
fn along_one_line_the_linear_part_is_handed_over_and_the_spin_reversed() {
    // d1 = (1, 0), d2 = (−1, 0): v1→v2 = ½·2·(−3)(−1, 0) = (3, 0); ω1→ω2 = ¼·(−8)/(1·2)·1 = −1; v1″ = (0, 1).
    let mut bodies = two([(Role::Mobile, 2.0, (3.0, 1.0), 2.0), (Role::Mobile, 1.0, (0.0, 0.0), 0.0)]);
    let kind = exchange(&mut bodies, &arms((2.0, 0.0), (-1.0, 0.0)), Losses { mu_l: 0.5, mu_a: 0.25 });
    assert_eq!(kind, Some(PairKind::Mobile));
    assert_eq!(bodies.motion, [motion(0.0, 1.0, 0.0), motion(3.0, 0.0, -1.0)]);
}

#[test]
fn across_a_right_angle_linear_motion_becomes_spin_and_spin_linear_motion() {
    // d1 = (0, 1), d1⊥ = (−1, 0), d2 = (1, 0), d2⊥ = (0, 1):
    // v1→ω2 = 1/(2·4)·2 = ¼; ω1→v2 = (3·(−1, 0))·(1, 0)/2 = −1.5 along (1, 0); the rest vanishes.
    let mut bodies = two([(Role::Mobile, 1.0, (0.0, 2.0), 1.0), (Role::Mobile, 2.0, (0.0, 0.0), 0.0)]);
    exchange(&mut bodies, &arms((0.0, 3.0), (4.0, 0.0)), Losses { mu_l: 1.0, mu_a: 1.0 });
    assert_eq!(bodies.motion, [motion(0.0, 0.0, 0.0), motion(-1.5, 0.0, 0.25)]);
}

#[test]
fn a_fixed_body_with_physics_hands_over_with_a_mass_ratio_of_one_and_receives_nothing() {
    // As along one line, with m1/m2 = 1 (R7): v1→v2 = ½·(3, 0), ω1→ω2 = ¼·2·(−1); the mass of 7 never enters.
    let mut bodies = two([(Role::FixedWithPhysics, 7.0, (3.0, 1.0), 2.0), (Role::Mobile, 5.0, (0.0, 4.0), 9.0)]);
    let kind = exchange(&mut bodies, &arms((2.0, 0.0), (-1.0, 0.0)), Losses { mu_l: 0.5, mu_a: 0.25 });
    assert_eq!(kind, Some(PairKind::FixedWithPhysics));
    assert_eq!(bodies.motion, [motion(3.0, 1.0, 2.0), motion(1.5, 4.0, -0.5)]);
}

#[test]
fn a_fixed_body_without_physics_takes_the_part_along_the_arm_and_turns_the_spin_round() {
    for losses in [Losses { mu_l: 1.0, mu_a: 1.0 }, Losses { mu_l: 0.1, mu_a: 0.0 }] {
        let mut bodies = two([(Role::Mobile, 2.0, (3.0, 1.0), 2.0), (Role::Fixed, 1.0, (0.0, 0.0), 0.0)]);
        let kind = exchange(&mut bodies, &arms((0.0, 1.5), (-1.0, 0.3)), losses);
        assert_eq!(kind, Some(PairKind::Fixed));
        assert_eq!(bodies.motion[0], motion(3.0, 0.0, -2.0), "no coefficient enters");
    }
}

#[test]
fn nothing_is_exchanged_through_an_arm_of_no_length() {
    let start = [(Role::Mobile, 2.0, (3.0, 1.0), 2.0), (Role::Mobile, 1.0, (1.0, 0.0), 0.5)];
    let mut bodies = two(start);
    assert_eq!(exchange(&mut bodies, &arms((0.0, 0.0), (1.0, 0.0)), Losses { mu_l: 1.0, mu_a: 1.0 }), None);
    assert_eq!(bodies.motion, two(start).motion);
}

#[test]
fn the_mobile_reference_moves_and_a_fixed_one_makes_the_owner_move() {
    // a's vertex (0.5, −0.4) lies 0.1 deep in b across its face at −X; b spans more in z than a.
    for (kind, x_of_a, x_of_b) in [(Kind::Mobile, 0.0, 1.0 + 0.001), (Kind::Fixed, -0.101, 0.9)] {
        let mut b = body("b", kind, 1.0, 4.0);
        b.at = (0.9, 0.0);
        let mut a = body("a", Kind::Mobile, 1.0, 0.8);
        a.velocity = Some((0.0, 0.0));
        let world = after(&scene(vec![a, b]), 1);
        let [a, b] = [0, 1].map(|i| world.position(world.ids().nth(i).expect("two bodies")));
        assert!((a.x - x_of_a).abs() < 1e-15 && (b.x - x_of_b).abs() < 1e-15, "{kind:?}: {} and {}", a.x, b.x);
        assert_eq!((a.y, b.y), (0.0, 0.0));
    }
}

#[test]
fn crossed_bars_pass_as_the_document_says() {
    let mut bar = body("bar", Kind::Mobile, 4.0, 1.0);
    bar.velocity = Some((0.0, 1.0));
    bar.at = (0.0, -1.0);
    let world = after(&scene(vec![bar, body("post", Kind::Mobile, 1.0, 4.0)]), 60);
    assert_eq!(world.collisions(), 0);
    assert!((world.deepest() - 2.5).abs() < 1e-12, "but the overlap is measured: {}", world.deepest());
}

#[test]
fn a_projectile_is_exact_at_any_time_step() {
    // v0 = 5, g = −9.81, T = 1: z = 5 − 9.81/2. A symplectic Euler step of 1/60 would be off by 0.082.
    for steps in [1_u32, 7, 60, 1000] {
        let mut stone = body("stone", Kind::Mobile, 1.0, 1.0);
        stone.velocity = Some((3.0, 5.0));
        let settings = Settings { time_step: 1.0 / f64::from(steps), gravity: (0.0, -9.81), ..Settings::default() };
        let world = after(&Scene { settings, ..scene(vec![stone]) }, steps);
        let id = world.find("stone").expect("it is there");
        let roundings = 4.5e-16 * f64::from(steps + 20); // half a unit in the last place of 5, a step
        assert!((world.position(id) - Vec2::new(3.0, 5.0 - 0.5 * 9.81)).norm() < roundings, "{steps} steps");
        assert!((world.velocity(id).y - (5.0 - 9.81)).abs() < roundings, "{steps} steps");
    }
}

#[test]
fn drag_is_an_exact_exponential() {
    let (k, kw) = (0.8, 2.0);
    for steps in [1_u32, 50] {
        let mut puck = body("puck", Kind::Mobile, 1.0, 1.0);
        puck.velocity = Some((3.0, 0.0));
        puck.spin = Some(2.0);
        let settings = Settings { time_step: 1.0 / f64::from(steps), drag: (k, kw), ..Settings::default() };
        let world = after(&Scene { settings, ..scene(vec![puck]) }, steps);
        let id = world.find("puck").expect("it is there");
        assert!((world.velocity(id).x - 3.0 * libm::exp(-k)).abs() < 1e-14);
        assert!((world.position(id).x - 3.0 * (1.0 - libm::exp(-k)) / k).abs() < 1e-14);
        assert!((world.spin(id) - 2.0 * libm::exp(-kw)).abs() < 1e-14);
        assert!((world.angle(id) - (1.0 - libm::exp(-kw))).abs() < 1e-14);
    }
}

#[test]
fn a_push_over_one_second_moves_by_half_a_t_squared_at_any_time_step() {
    for steps in [1_u32, 64] {
        let mut puck = body("puck", Kind::Mobile, 1.0, 1.0);
        puck.mass = Some(2.0);
        let settings = Settings { time_step: 1.0 / f64::from(steps), ..Settings::default() };
        let mut world = World::new(&Scene { settings, ..scene(vec![puck]) }).expect("a valid scene");
        let id = world.find("puck").expect("it is there");
        for _ in 0..steps {
            world.push(id, Vec2::new(4.0, 0.0)).expect("finite");
            world.push(id, Vec2::new(2.0, 0.0)).expect("they add up");
            world.twist(id, 0.5).expect("finite");
            world.step();
        }
        // a = 6/2 = 3; I = 2·(1 + 1)/12 = 1/3, α = 0.5·3 = 1.5
        assert!((world.position(id).x - 1.5).abs() < 1e-14 && (world.velocity(id).x - 3.0).abs() < 1e-14);
        assert!((world.angle(id) - 0.75).abs() < 1e-14 && (world.spin(id) - 1.5).abs() < 1e-14);
        assert_eq!(world.work().commands, 3 * u64::from(steps));
    }
}

#[test]
fn a_scene_far_out_runs_as_it_does_at_home() {
    // Coordinates on a grid of 2⁻¹⁰ m, so that moving the scene by 2³⁰ m loses none of them.
    let far = 1024.0 * 1024.0 * 1024.0;
    let build = |away: f64| {
        let place = |mut b: Body, x: f64, z: f64| {
            b.at = (away + x, z - away);
            b
        };
        let mut a = place(body("a", Kind::Mobile, 1.0, 1.0), -2.0, 0.25);
        a.velocity = Some((2.0, 0.1));
        a.spin = Some(0.3);
        let mut door = place(body("door", Kind::Fixed, 0.5, 3.0), 1.5, 0.0);
        door.patrol = Some(Patrol { points: vec![(away + 1.5, 2.0 - away)], speed: 0.7 });
        scene(vec![a, place(body("b", Kind::Mobile, 2.0, 1.0), 0.0, 0.0), door])
    };
    let (home, away) = (after(&build(0.0), 300), after(&build(far), 300));
    assert!(home.collisions() > 2);
    for (h, f) in home.ids().zip(away.ids()) {
        assert_eq!(home.velocity(h), away.velocity(f));
        assert_eq!(home.angle(h).to_bits(), away.angle(f).to_bits());
        assert_eq!(home.position(h) + Vec2::new(far, -far), away.position(f));
    }
}

#[test]
fn a_million_steps_of_free_flight_err_by_a_rounding() {
    let mut probe = body("probe", Kind::Mobile, 1.0, 1.0);
    probe.velocity = Some((0.1, -0.7));
    probe.spin = Some(1.3);
    let settings = Settings { time_step: 1e-3, ..Settings::default() };
    let world = after(&Scene { settings, ..scene(vec![probe]) }, 1_000_000);
    let id = world.find("probe").expect("it is there");
    assert!((world.position(id) - Vec2::new(100.0, -700.0)).norm() < 3e-13, "{:?}", world.position(id));
    let exact = 5.663_826_721_005_186 - std::f64::consts::TAU; // 1300 mod 2π
    assert!((world.angle(id) - exact).abs() < 1e-12, "{} instead of {exact}", world.angle(id));
    assert_eq!((world.velocity(id), world.spin(id)), (Vec2::new(0.1, -0.7), 1.3));
}

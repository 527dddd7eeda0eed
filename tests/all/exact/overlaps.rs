//! T1, T2, T4 … T10, T14, T31: overlapping, touching, adjoining.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use choque_engine::scene::{Body, Detection, ExchangeRule, MotionRule, Part};
use choque_engine::{Hit, Rect, Scene, World};

use super::kit::{Ran, assert_close, block, continuous, falling, run, run_watching, state, stepped, wall};

/// Two bodies as they stand: how deep they overlap and across which face. The document's exchange with complete detection tells of every
/// overlap, also of bodies at rest; ε is 0.
fn hit_of(one: &Body, two: &Body) -> Option<Hit> {
    let mut scene = continuous(0.0, 1e-3, vec![one.clone(), two.clone()]);
    (scene.settings.motion, scene.settings.exchange) = (MotionRule::Stepped, ExchangeRule::Document);
    (scene.settings.detection, scene.settings.epsilon) = (Some(Detection::Complete), 0.0);
    let mut world = World::new(&scene).expect("a valid scene");
    world.begin();
    world.treat_next()
}

fn still(name: &str, size: (f64, f64), at: (f64, f64), angle: f64) -> Body {
    Body { angle, ..block(name, size, at, (0.0, 0.0), 1.0) }
}

#[test]
fn t1_t2_crossed_bars_overlap_and_the_first_axis_wins_the_tie() {
    let plus = |x: f64| hit_of(&still("a", (4.0, 1.0), (0.0, 0.0), 0.0), &still("b", (1.0, 4.0), (x, 0.0), 0.0));
    let hit = plus(0.0).expect("an overlap");
    assert_eq!((hit.depth, hit.normal.x, hit.normal.y), (2.5, 1.0, 0.0));
    let hit = plus(0.1).expect("an overlap");
    assert_close(&[hit.depth, hit.normal.x, hit.normal.y], &[2.4, 1.0, 0.0], 1e-15, "shifted");
    let bar = |name: &str, angle: f64| still(name, (10.0, 1.0), (0.0, 0.0), angle);
    let scene = continuous(0.0, 1.0, vec![bar("a", FRAC_PI_4), bar("b", -FRAC_PI_4)]);
    let world = World::new(&scene).expect("a valid scene");
    assert_close(&[world.deepest()], &[5.5], 1e-14, "an X of long bars");
}

/// Two, and a hundred, at the very same place: nothing that is not a number, the same bits every time; the document's relocation parts them.
#[test]
fn t4_identical_poses_stay_finite_and_part() {
    for count in [2, 100] {
        let all = (0..count).map(|k| still(&format!("b{k}"), (1.0, 1.0), (3.0, 4.0), 0.7)).collect();
        let mut scene = continuous(0.5, 1.0 / 60.0, all);
        assert_close(&[World::new(&scene).expect("a valid scene").deepest()], &[1.0], 1e-15, "depth");
        for motion in [MotionRule::Stepped, MotionRule::Continuous] {
            scene.settings.motion = motion;
            let (one, two) = (run(&scene, 60).world, run(&scene, 60).world);
            assert!(one.digest() == two.digest() && one.kinetic_energy().is_finite());
        }
        let mut document = stepped(&scene, 1.0 / 60.0);
        (document.settings.exchange, document.settings.detection) = (ExchangeRule::Document, Some(Detection::Complete));
        let world = run(&document, 1500).world;
        assert!(world.ids().all(|id| world.position(id).norm() < 1e3), "they stay near");
        assert!(count > 2 || world.deepest() == 0.0, "two part: {}", world.deepest());
    }
}

/// A square 0.1 deep in another, whichever of its faces looks at it, and turned by next to nothing: the same depth and normal, and both
/// ends of the face: with one alone the square would be turned.
#[test]
fn t5_t6_parallel_edges_meet_at_two_points_whatever_the_quarter_turn() {
    for quarter in 0..4 {
        for nearly in [0.0, 1e-9, -1e-9, 1e-7, -1e-7] {
            let angle = f64::from(quarter) * FRAC_PI_2 + nearly;
            let (a, b) = (still("a", (1.0, 1.0), (0.0, 0.0), 0.0), still("b", (1.0, 1.0), (0.9, 0.0), angle));
            let hit = hit_of(&a, &b).expect("an overlap");
            assert!((hit.depth - 0.1).abs() <= 2.3e-16 + nearly.abs(), "{} at {angle}", hit.depth);
            assert_eq!((hit.normal.x, hit.normal.y), (1.0, 0.0), "quarter {quarter}, {nearly:e}");
            assert!(hit.point.y.abs() < 1e-6, "the middle of ±1/2: {}", hit.point.y);

            let b = Body { velocity: Some((-1.0, 0.0)), ..b };
            let mut world = World::new(&stepped(&continuous(1.0, 1.0, vec![a, b]), 1e-6)).expect("a valid scene");
            world.step();
            let (a, b) = (state(&world, "a"), state(&world, "b"));
            assert_close(&[a.vx, b.vx, a.spin, b.spin], &[-1.0, 0.0, 0.0, 0.0], 1e-6, "no turn");
        }
    }
}

#[test]
fn t7_exactly_touching_is_touching() {
    let touching = |v: f64| {
        let bodies = vec![
            block("a", (1.0, 1.0), (0.0, 0.0), (0.0, 0.0), 1.0),
            block("b", (1.0, 1.0), (1.0, 0.0), (v, 0.0), 1.0),
        ];
        continuous(1.0, 1e-3, bodies)
    };
    for scene in [touching(0.0), stepped(&touching(0.0), 1e-3)] {
        let ran = run(&scene, 1000);
        assert_eq!((ran.hits.len(), state(&ran.world, "b").x, state(&ran.world, "a").x), (0, 1.0, 0.0));
    }
    let Ran { world, hits } = run(&touching(-1.0), 1);
    assert_eq!((hits.len(), hits[0].0), (1, 0.0), "coming: at once");
    assert_eq!((state(&world, "a").vx, state(&world, "b").vx), (-1.0, 0.0));
    for scene in [touching(1.0), stepped(&touching(1.0), 1e-3)] {
        assert_eq!(run(&scene, 1000).hits.len(), 0, "parting");
    }
}

#[test]
fn t8_vertex_on_vertex_keeps_momentum_and_energy() {
    let meet = |at: (f64, f64), v: (f64, f64)| {
        let bodies = vec![block("a", (1.0, 1.0), (0.0, 0.0), (0.0, 0.0), 1.0), block("b", (1.0, 1.0), at, v, 1.0)];
        run(&continuous(1.0, 0.25, bodies), 4).world
    };
    for at in [(1.0, 1.0), (1.5, 1.5)] {
        let world = meet(at, (-1.0, -1.0));
        assert_close(
            &[world.kinetic_energy(), world.momentum().x, world.momentum().y],
            &[1.0, -1.0, -1.0],
            1e-12,
            "kept",
        );
        assert!(world.collisions() >= 1 && world.deepest() <= 1e-12);
    }
    // A sliver of the faces meets: the normal is theirs.
    let world = meet((1.0, 0.999_999_999), (-1.0, 0.0));
    let (a, b) = (state(&world, "a"), state(&world, "b"));
    assert_close(&[a.vz, b.vz, world.kinetic_energy()], &[0.0, 0.0, 0.5], 1e-12, "along x");
    assert!(a.vx < 0.0 && a.spin != 0.0, "struck at its corner");
}

/// A block that a step has carried past the middle of a thin wall goes back the way it came, not out at the nearer side.
#[test]
fn t9_a_body_past_the_middle_of_a_thin_wall_goes_back_the_way_it_came() {
    let block = block("block", (1.0, 1.0), (-0.8, 0.0), (60.0, 0.0), 1.0);
    let mut scene = continuous(1.0, 1.0 / 60.0, vec![wall("wall", (0.1, 10.0), (0.0, 0.0)), block]);
    for (motion, exchange) in [
        (MotionRule::Stepped, ExchangeRule::Document),
        (MotionRule::Stepped, ExchangeRule::Impulse),
        (MotionRule::Continuous, ExchangeRule::Document),
        (MotionRule::Continuous, ExchangeRule::Impulse),
    ] {
        (scene.settings.motion, scene.settings.exchange) = (motion, exchange);
        scene.settings.detection = Some(Detection::Complete);
        let found = state(&run(&scene, 3).world, "block");
        assert!(found.x <= -0.55 && found.vx <= 0.0, "{motion:?}, {exchange:?}: x = {}, vx = {}", found.x, found.vx);
    }
}

/// Forty boxes whose tops make a floor at z = 0; a block slides over the seams at 10 m/s.
fn slide(seam: impl Fn(usize) -> f64, start: f64, time_step: f64) -> Scene {
    let mut bodies: Vec<Body> =
        (0..40).map(|k| wall(&format!("floor{k}"), (1.0, 1.0), (0.5 + k as f64, -0.5 + seam(k)))).collect();
    bodies.push(block("block", (0.5, 0.5), (start, 0.25), (10.0, 0.0), 1.0));
    falling(0.0, time_step, bodies)
}

#[test]
fn t10_seams_of_a_floor_do_not_trip_a_sliding_block() {
    for time_step in [1.0 / 60.0, 1.0 / 64.0, 0.5] {
        for start in [0.75, 1.25] {
            let scene = slide(|_| 0.0, start, time_step);
            let steps = (3.0 / time_step) as u32;
            run_watching(&scene, steps, |_, _| ());
            let mut world = World::new(&scene).expect("a valid scene");
            for _ in 0..steps {
                world.step();
                let found = state(&world, "block");
                let expected = [start + 10.0 * world.time(), 0.25, 10.0, 0.0];
                assert_close(&[found.x, found.z, found.vx, found.spin], &expected, 1e-9, "sliding");
                assert!((found.vx - 10.0).abs() <= 1e-12);
            }
        }
    }
}

#[test]
fn t10_seams_a_hair_high_or_low_do_not_trip_it_either() {
    for hair in [1e-12, -1e-12] {
        let scene = slide(|k| if k % 2 == 0 { 0.0 } else { hair }, 0.75, 1.0 / 60.0);
        let mut world = World::new(&scene).expect("a valid scene");
        (0..180).for_each(|_| world.step());
        let found = state(&world, "block");
        assert_close(&[found.x, found.z, found.vx, found.spin], &[30.75, 0.25, 10.0, 0.0], 1e-9, "a hair of a step");
    }
}

#[test]
fn t14_a_millionth_of_a_metre_against_a_million_metres() {
    let tiny = |v: f64| block("tiny", (1e-6, 1e-6), (5e5 + 0.5e-6 - 1e-9, 0.0), (v, 0.0), 1e-12);
    let huge = block("huge", (1e6, 1e6), (0.0, 0.0), (0.0, 0.0), 1e12);
    let world = World::new(&continuous(0.5, 1.0, vec![huge.clone(), tiny(0.0)])).expect("a valid scene");
    // ulp(5e5) = 6e-11 is what the coordinates themselves are known to.
    assert_close(&[world.deepest()], &[1e-9], 6e-11, "depth");
    let coming = Body { at: (5e5 + 1.0, 0.0), ..tiny(-1.0) };
    let world = run(&continuous(0.5, 1.0, vec![huge, coming]), 2).world;
    assert_close(&[state(&world, "tiny").vx, state(&world, "huge").vx], &[0.5, 0.0], 1e-15, "it rebounds with e");
}

/// A rectangle of a compound body, by its centre.
pub(super) fn part(size: (f64, f64), at: (f64, f64)) -> Part {
    let Rect { x_min, x_max, z_min, z_max } = Rect::centred(size.0, size.1);
    Part::Rect(Rect { x_min: x_min + at.0, x_max: x_max + at.0, z_min: z_min + at.1, z_max: z_max + at.1 })
}

/// A plus of three boxes slides on its foot along a floor of boxes.
#[test]
fn t31_a_compound_body_slides_over_seams_and_over_its_own() {
    let mut scene = slide(|_| 0.0, 2.0, 1.0 / 60.0);
    let plus = scene.bodies.last_mut().expect("the block");
    plus.parts = vec![part((3.0, 1.0), (0.0, 0.0)), part((1.0, 1.0), (0.0, 1.0)), part((1.0, 1.0), (0.0, -1.0))];
    plus.at.1 = 1.5;
    let mut world = World::new(&scene).expect("a valid scene");
    (0..180).for_each(|_| world.step());
    let found = state(&world, "block");
    assert_close(&[found.x, found.z, found.vx, found.spin], &[32.0, 1.5, 10.0, 0.0], 1e-9, "sliding");
}

/// A block flies into the open side of a U, straight, and out again: one hit at its bottom, none at the seams of its walls; and two L
/// that interlock without touching know nothing of each other.
#[test]
fn t31_a_u_holds_a_block_and_two_l_interlock() {
    let mut u = wall("u", (1.0, 1.0), (0.0, 0.0));
    u.parts = vec![part((3.0, 1.0), (0.0, 0.0)), part((1.0, 2.0), (-1.0, 1.5)), part((1.0, 2.0), (1.0, 1.5))];
    let ball = block("ball", (1.0, 0.5), (0.0, 4.0), (0.0, -1.0), 1.0);
    let ran = run(&continuous(1.0, 0.25, vec![u, ball]), 26);
    let found = state(&ran.world, "ball");
    assert_eq!(ran.hits.len(), 1);
    assert_close(&[ran.hits[0].0, found.x, found.vz, found.spin], &[3.25, 0.0, 1.0, 0.0], 1e-12, "in and out");

    let l = |name: &str, at: (f64, f64), angle: f64| {
        let mut l = still(name, (1.0, 1.0), at, angle);
        l.parts = vec![part((3.0, 1.0), (0.0, 0.0)), part((1.0, 2.0), (-1.0, 1.5))];
        l
    };
    // The second stands on its head, its leg beside the first one's, a quarter of a metre from it above and below.
    let pair = vec![l("a", (0.0, 0.0), 0.0), l("b", (0.0, 3.25), std::f64::consts::PI)];
    let ran = run(&continuous(1.0, 0.25, pair), 8);
    assert_eq!((ran.hits.len(), ran.world.deepest()), (0, 0.0));
}

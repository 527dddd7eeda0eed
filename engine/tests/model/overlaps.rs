//! The complete test finds every overlap: named cases, an independent library, and integral geometry.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use choque_engine::bodies::{Bodies, Inertia, Motion, Role};
use choque_engine::detect::manifold::Manifold;
use choque_engine::detect::sides::Sides;
use choque_engine::detect::{Face, complete, overlap, vertices};
use choque_engine::{Rect, Vec2, Work};

use crate::columns;
use crate::random_scenes::Random;

/// A centred rectangle: (width, depth), (x, z), angle.
type Rectangle = ((f64, f64), (f64, f64), f64);

/// Two bodies of one rectangle each.
fn bodies(of: [Rectangle; 2]) -> Bodies {
    let mut bodies = columns([(Role::Mobile, Inertia { mass: 1.0, moment: 1.0 }, Motion::default()); 2]);
    bodies.first_rect = vec![0, 1, 2];
    for (i, ((width, depth), (x, z), angle)) in of.into_iter().enumerate() {
        bodies.place(i, Vec2::new(x, z));
        bodies.set_angle(i, angle);
        bodies.rects.push(Rect::centred(width, depth));
    }
    bodies
}

fn find(bodies: &Bodies) -> Option<Manifold> {
    complete::find(bodies, 0, 1, &Sides::default(), &mut Work::default())
}

#[test]
fn t1_a_plus_sign_overlaps_and_the_first_axis_wins_the_tie() {
    let plus = find(&bodies([((4.0, 1.0), (0.0, 0.0), 0.0), ((1.0, 4.0), (0.0, 0.0), 0.0)])).expect("an overlap");
    assert_eq!((plus.depth, plus.reference, plus.face), (2.5, 0, Face::XMax));
    let shifted = find(&bodies([((4.0, 1.0), (0.0, 0.0), 0.0), ((1.0, 4.0), (0.1, 0.0), 0.0)])).expect("an overlap");
    assert!((shifted.depth - 2.4).abs() < 1e-15);
}

#[test]
fn t2_long_crossed_bars_overlap() {
    let bars = bodies([((10.0, 1.0), (0.0, 0.0), FRAC_PI_4), ((10.0, 1.0), (0.0, 0.0), -FRAC_PI_4)]);
    assert!((find(&bars).expect("an overlap").depth - 5.5).abs() < 1e-14);
    assert!(vertices::find(&bars, 0, 1, &mut Work::default()).is_none(), "the document does not see it");
}

#[test]
fn t4_identical_poses_give_a_finite_answer() {
    let same = find(&bodies([((1.0, 1.0), (3.0, 4.0), 0.7), ((1.0, 1.0), (3.0, 4.0), 0.7)])).expect("an overlap");
    assert!((same.depth - 1.0).abs() < 1e-15);
    assert_eq!((same.reference, same.face, same.points().len()), (0, Face::XMax, 2));
}

#[test]
fn t5_parallel_edges_give_two_points_whatever_the_quarter_turn() {
    for quarter in 0..4 {
        let turned = f64::from(quarter) * FRAC_PI_2;
        for nearly in [0.0, 1e-9, -1e-9, 1e-7, -1e-7] {
            let pair = bodies([((1.0, 1.0), (0.0, 0.0), 0.0), ((1.0, 1.0), (0.9, 0.0), turned + nearly)]);
            let manifold = find(&pair).expect("an overlap");
            assert!((manifold.depth - 0.1).abs() <= 2.2e-16 + nearly.abs(), "depth {}", manifold.depth);
            assert_eq!((manifold.reference, manifold.face), (0, Face::XMax), "quarter {quarter}, {nearly:e}");
            let mut ends: Vec<f64> = manifold.points().iter().map(|point| point.on_face.y).collect();
            ends.sort_by(f64::total_cmp);
            assert_eq!(ends.len(), 2, "quarter {quarter}, {nearly:e}");
            assert!((ends[0] + 0.5).abs() < 1e-6 && (ends[1] - 0.5).abs() < 1e-6, "{ends:?}");
        }
    }
}

#[test]
fn t7_touching_is_not_overlapping() {
    assert_eq!(find(&bodies([((1.0, 1.0), (0.0, 0.0), 0.0), ((1.0, 1.0), (1.0, 0.0), 0.0)])), None);
}

#[test]
fn t14_a_millionth_of_a_metre_against_a_million_metres() {
    let pair = bodies([((1e6, 1e6), (0.0, 0.0), 0.0), ((1e-6, 1e-6), (5e5 + 0.5e-6 - 1e-9, 0.0), 0.0)]);
    let depth = find(&pair).expect("an overlap").depth;
    assert!((depth - 1e-9).abs() < 6e-11, "{depth}"); // one unit in the last place of 5e5
}

/// Poses at random in a square of side S: P(overlap) = (A₁ + A₂ + L₁ L₂ / 2π) / S² (Santaló's kinematic formula); and
/// which share of the overlaps the vertex test misses.
#[test]
fn q2_overlaps_come_as_often_as_integral_geometry_says() {
    // (one, two, exact excluded area, share of overlaps that a vertex test misses)
    let cases = [
        ((1.0, 1.0), (1.0, 1.0), 4.546_479, 0.017),
        ((2.0, 1.0), (2.0, 1.0), 9.729_578, 0.033),
        ((4.0, 1.0), (4.0, 1.0), 23.915_494, 0.132),
        ((10.0, 1.0), (10.0, 1.0), 97.030_992, 0.406),
        ((10.0, 1.0), (1.0, 1.0), f64::NAN, 0.0),
    ];
    for (one, two, excluded, missed) in cases {
        let exact = if f64::is_nan(excluded) { kinematic(one, two) } else { excluded };
        assert!((kinematic(one, two) - exact).abs() < 1e-5);
        let side = 1.01 * (diagonal(one) + diagonal(two));
        let (mut overlaps, mut seen, samples) = (0_u32, 0_u32, 400_000_u32);
        let mut random = Random(42);
        for _ in 0..samples {
            let half = 0.5 * side;
            let at = (random.between(-half, half), random.between(-half, half));
            let pair = bodies([(one, (0.0, 0.0), 0.0), (two, at, random.between(-PI, PI))]);
            overlaps += u32::from(find(&pair).is_some());
            seen += u32::from(vertices::find(&pair, 0, 1, &mut Work::default()).is_some());
        }
        let p = exact / (side * side);
        let sigma = (p * (1.0 - p) / f64::from(samples)).sqrt();
        let found = f64::from(overlaps) / f64::from(samples);
        assert!((found - p).abs() < 4.0 * sigma, "{one:?} {two:?}: {found} instead of {p} ± {sigma}");
        let share = 1.0 - f64::from(seen) / f64::from(overlaps);
        assert!((share - missed).abs() < 0.005, "{one:?} {two:?}: the vertex test misses {share}");
    }
}

fn diagonal((width, depth): (f64, f64)) -> f64 {
    (width * width + depth * depth).sqrt()
}

fn kinematic(one: (f64, f64), two: (f64, f64)) -> f64 {
    let (area, perimeter) = (|(w, d): (f64, f64)| w * d, |(w, d): (f64, f64)| 2.0 * (w + d));
    area(one) + area(two) + perimeter(one) * perimeter(two) / (2.0 * PI)
}

/// `parry2d` decides the same on random pairs, and its contact is as deep.
#[test]
fn an_independent_library_agrees() {
    use parry2d_f64::math::{Pose, Vector};
    use parry2d_f64::query;
    use parry2d_f64::shape::Cuboid;

    let mut random = Random(1);
    let (mut overlapping, mut apart) = (0, 0);
    for case in 0..50_000 {
        let size = |random: &mut Random| (random.between(0.1, 4.0), random.between(0.1, 4.0));
        let sizes = [size(&mut random), size(&mut random)];
        let place =
            |random: &mut Random| ((random.between(-2.5, 2.5), random.between(-2.5, 2.5)), random.between(-PI, PI));
        let places = [place(&mut random), place(&mut random)];
        let pair = bodies([(sizes[0], places[0].0, places[0].1), (sizes[1], places[1].0, places[1].1)]);
        let shapes = sizes.map(|(width, depth)| Cuboid::new(Vector::new(0.5 * width, 0.5 * depth)));
        let poses = places.map(|((x, z), angle)| Pose::new(Vector::new(x, z), angle));
        let depth = overlap::between(&pair, 0, 1);
        if depth.abs() < 1e-9 {
            continue; // too close to touching for two programs to agree
        }
        let theirs = query::intersection_test(&poses[0], &shapes[0], &poses[1], &shapes[1]).expect("cuboids are known");
        let ours = find(&pair);
        assert_eq!(ours.is_some(), theirs.intersecting, "case {case}, depth {depth}");
        let Some(manifold) = ours else {
            apart += 1;
            continue;
        };
        overlapping += 1;
        assert!((manifold.depth - depth).abs() < 1e-8, "case {case}: {} against {depth}", manifold.depth);
        let contact = query::contact(&poses[0], &shapes[0], &poses[1], &shapes[1], 0.0).expect("cuboids are known");
        let their_depth = -contact.expect("they overlap").dist;
        assert!(manifold.depth <= their_depth + 1e-6, "case {case}: {} against {their_depth}", manifold.depth);
    }
    assert!(overlapping > 10_000 && apart > 10_000, "{overlapping} overlapping, {apart} apart");
}

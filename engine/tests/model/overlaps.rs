//! The complete test finds every overlap: as an independent library does, and as often as integral geometry says.

use std::f64::consts::PI;

use choque_engine::bodies::{Bodies, Inertia, Motion, Role};
use choque_engine::detect::manifold::Manifold;
use choque_engine::detect::sides::Sides;
use choque_engine::detect::{complete, overlap, vertices};
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

/// Poses at random in a square of side S: P(overlap) = (A₁ + A₂ + L₁ L₂ / 2π) / S² (Santaló's kinematic formula); and
/// which share of the overlaps the vertex test misses.
#[test]
fn q2_t3_overlaps_come_as_often_as_integral_geometry_says() {
    // (one, two, exact excluded area, share of overlaps that a vertex test misses)
    let cases = [
        ((1.0, 1.0), (1.0, 1.0), 4.546_479, 0.017),
        ((2.0, 1.0), (2.0, 1.0), 9.729_578, 0.033),
        ((4.0, 1.0), (4.0, 1.0), 23.915_494, 0.132),
        ((10.0, 1.0), (10.0, 1.0), 97.030_992, 0.406),
        ((100.0, 1.0), (100.0, 1.0), 6694.158, 0.904),
        ((100.0, 0.1), (1.0, 1.0), 138.451_3, 0.713),
        ((10.0, 1.0), (1.0, 1.0), f64::NAN, 0.0),
    ];
    for (one, two, excluded, missed) in cases {
        let exact = if f64::is_nan(excluded) { kinematic(one, two) } else { excluded };
        assert!((kinematic(one, two) - exact).abs() < 1e-3);
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
        let sigma = (missed * (1.0 - missed) / f64::from(overlaps)).sqrt();
        assert!((share - missed).abs() < 4.0 * sigma + 0.001, "{one:?} {two:?}: the vertex test misses {share}");
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

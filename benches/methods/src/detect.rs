//! Contacts of a step: pairs from a grid, two-point manifolds by separating axes and clipping, impulses of the last step.

use choque_engine::area::Vec2;

use crate::contact::{Contact, Point};
use crate::world::{Body, World, perp};

/// A later axis must separate by this share of the size more, so that squares face to face do not choose by rounding.
const PREFERENCE: f64 = 1e-6;

/// Points this share of the size apart count as touching soon.
const MARGIN: f64 = 0.02;

/// The contacts that matter during the next `dt`, pairs in the order of creation; impulses from `last` where points persist.
pub(crate) fn contacts(world: &World, last: &[Contact], dt: f64) -> Vec<Contact> {
    let mut found = Vec::new();
    for (i, j) in pairs(world, dt) {
        let (one, two) = (&world.bodies[i], &world.bodies[j]);
        let Some((n, points)) = manifold(one, two, reach(world, one, dt) + reach(world, two, dt)) else { continue };
        let mut contact = Contact::new(world, (i, j), n, &points);
        if let Ok(k) = last.binary_search_by(|old| (old.i, old.j).cmp(&(i, j))) {
            contact.inherit(&last[k]);
        }
        found.push(contact);
    }
    found
}

/// How far a body can come in a step, and a little.
fn reach(world: &World, body: &Body, dt: f64) -> f64 {
    let falls = if body.is_mobile() { -world.gravity * dt * dt } else { 0.0 };
    dt * body.fastest() + falls + 0.5 * MARGIN * body.half.min().min(1.0)
}

/// Half the size of the box around a body that no motion of a step leaves.
fn extent(world: &World, body: &Body, dt: f64) -> Vec2 {
    let (c, s) = (body.turn.x.abs(), body.turn.y.abs());
    let reach = reach(world, body, dt);
    Vec2::new(c * body.half.x + s * body.half.y + reach, s * body.half.x + c * body.half.y + reach)
}

/// Pairs whose boxes meet, i < j. Bodies of the usual size go into a grid, the few large ones meet all.
fn pairs(world: &World, dt: f64) -> Vec<(usize, usize)> {
    let extents: Vec<Vec2> = world.bodies.iter().map(|body| extent(world, body, dt)).collect();
    let mut sizes: Vec<f64> = extents.iter().map(|extent| extent.max()).collect();
    sizes.sort_by(f64::total_cmp);
    let usual = 2.0 * sizes[sizes.len() / 2];
    let cell = 2.0 * sizes.iter().copied().take_while(|size| *size <= usual).last().unwrap_or(1.0);
    let (small, large): (Vec<usize>, Vec<usize>) = (0..extents.len()).partition(|body| extents[*body].max() <= usual);
    let place = |body: &usize| {
        let x = world.bodies[*body].x / cell;
        (x.y.floor() as i64, x.x.floor() as i64)
    };
    let mut cells: Vec<((i64, i64), usize)> = small.iter().map(|body| (place(body), *body)).collect();
    cells.sort_unstable();
    let meets = |i: usize, j: usize| {
        let (apart, room) = (world.bodies[i].x - world.bodies[j].x, extents[i] + extents[j]);
        let moves = world.bodies[i].is_mobile() || world.bodies[j].is_mobile();
        moves && apart.x.abs() < room.x && apart.y.abs() < room.y
    };
    let mut pairs = Vec::new();
    let mut add = |i: usize, j: usize| {
        if meets(i, j) {
            pairs.push((i.min(j), i.max(j)));
        }
    };
    for ((row, column), i) in &cells {
        for row in row - 1..=row + 1 {
            let from = cells.partition_point(|(place, _)| *place < (row, column - 1));
            let near = cells[from..].iter().take_while(|(place, _)| *place <= (row, column + 1));
            near.filter(|(_, j)| j > i).for_each(|(_, j)| add(*i, *j));
        }
    }
    for (k, i) in large.iter().enumerate() {
        small.iter().chain(&large[k + 1..]).for_each(|j| add(*i, *j));
    }
    pairs.sort_unstable();
    pairs
}

/// Normal from one to two, and the points no more than `reach` apart, each with its gap. `None` when there are none.
fn manifold(one: &Body, two: &Body, reach: f64) -> Option<(Vec2, Vec<Point>)> {
    let preference = PREFERENCE * one.half.min().min(two.half.min());
    let ((of_one, n_one), (of_two, n_two)) = (best_face(one, two), best_face(two, one));
    if of_one.max(of_two) > reach {
        return None;
    }
    let first = of_two <= of_one + preference;
    let (reference, other, n) = if first { (one, two, n_one) } else { (two, one, n_two) };
    let points = clipped(reference, other, n);
    let from_one = |(at, gap): (Vec2, f64)| {
        // Half way between the two surfaces.
        let middle = at - n * (0.5 * gap);
        Point::new(middle - one.x, middle - two.x, one.inwards(middle - one.x), gap)
    };
    let points: Vec<Point> = points.into_iter().filter(|(_, gap)| *gap <= reach).map(from_one).collect();
    (!points.is_empty()).then_some((if first { n } else { -n }, points))
}

/// The face of a body from which the other stands furthest: by how much, and its normal.
fn best_face(body: &Body, other: &Body) -> (f64, Vec2) {
    let d = other.x - body.x;
    let mut best = (f64::NEG_INFINITY, Vec2::zeros());
    for (axis, half) in [(body.turn, body.half.x), (perp(body.turn), body.half.y)] {
        let n = if axis.dot(&d) < 0.0 { -axis } else { axis };
        let across = other.half.x * n.dot(&other.turn).abs() + other.half.y * n.dot(&perp(other.turn)).abs();
        let apart = n.dot(&d) - half - across;
        if apart > best.0 {
            best = (apart, n);
        }
    }
    best
}

/// The face of `other` that looks at the reference's face with normal n, cut to it: points on `other` with their distance,
/// from one end of the face to the other.
fn clipped(reference: &Body, other: &Body, n: Vec2) -> Vec<(Vec2, f64)> {
    let t = perp(n);
    let size = |body: &Body, a: Vec2| {
        let own = body.inwards(a);
        own.x.abs() * body.half.x + own.y.abs() * body.half.y
    };
    let (depth, width) = (size(reference, n), size(reference, t));
    let own = other.inwards(n);
    let (facing, along) = if own.x.abs() > own.y.abs() {
        (Vec2::new(-own.x.signum() * other.half.x, 0.0), Vec2::new(0.0, other.half.y))
    } else {
        (Vec2::new(0.0, -own.y.signum() * other.half.y), Vec2::new(other.half.x, 0.0))
    };
    let middle = other.x + other.outwards(facing) - reference.x;
    let along = other.outwards(along);
    let (mut from, mut to) = (-1.0_f64, 1.0_f64);
    let (at, slope) = (middle.dot(&t), along.dot(&t));
    // |at + s·slope| ≤ width
    let (a, b) = ((-width - at) / slope, (width - at) / slope);
    from = from.max(a.min(b));
    to = to.min(a.max(b));
    if from > to {
        return Vec::new();
    }
    let point = |s: f64| (reference.x + middle + along * s, (middle + along * s).dot(&n) - depth);
    vec![point(from), point(to)]
}

//! Weights: a first guess at the pushes in a heap at rest, from the top down.
//!
//! Every body hands its own weight and what lies on it to the points below it, as evenly as balances it; then comes the turn of
//! those below. One pass carries the load of the top of a pyramid to the ground, where improving touch by touch would take
//! as many rounds as there are rows, squared. Friction and pushes from the side are left out: it is only a guess, to be
//! improved upon.

use super::rows::Rows;
use super::touch::Touch;
use crate::area::Vec2;
use crate::bodies::Bodies;

/// A face that leans more than this against the load carries none of it \[cosine\].
const UPRIGHT: f64 = 0.1;

/// What keeps the balance solvable where points cannot hold a load from the side, relative to what they can.
const SLACK: f64 = 1e-6;

/// No point carries more than this many times the load: where the balance says so, it is shared out evenly.
const MOST: f64 = 8.0;

/// A force and its moment about a body's centre.
#[derive(Clone, Copy, Debug, Default)]
struct Load {
    force: Vec2,
    moment: f64,
}

/// Guesses the pushes of touches that are closed, over a sub-step in which gravity gives `pull` \[m/s\].
pub(super) fn guess(
    touches: &mut [Touch],
    of_touch: &[(u32, u32)],
    rows: &Rows,
    bodies: &Bodies,
    pull: Vec2,
    band: f64,
) {
    let down = pull / pull.norm();
    let height = |k: usize| -bodies.frame[rows.mobile[k] as usize].o.dot(&down);
    let mut order: Vec<usize> = (0..rows.mobile.len()).collect();
    order.sort_by(|k, l| height(*l).total_cmp(&height(*k)).then(k.cmp(l)));
    let mut turn = vec![0; order.len()];
    order.iter().enumerate().for_each(|(at, k)| turn[*k] = at);
    let mut of_body: Vec<Vec<u32>> = vec![Vec::new(); order.len()];
    for (k, (a, b)) in of_touch.iter().enumerate() {
        touches[k].push = [0.0; 2];
        touches[k].grip = 0.0;
        for row in [a, b] {
            if let Some(at) = rows.mobile_of(*row) {
                of_body[at].push(k as u32);
            }
        }
    }
    let mut loads: Vec<Load> = rows
        .mobile
        .iter()
        .map(|body| Load { force: pull * bodies.inertia[*body as usize].mass, moment: 0.0 })
        .collect();
    for &k in &order {
        let own = (rows.first() + k) as u32;
        let below = |other: u32| rows.mobile_of(other).is_none_or(|other| turn[other] > turn[k]);
        let mut points: Vec<(usize, usize, Vec2, f64)> = Vec::new();
        for &at in &of_body[k] {
            let (a, b) = of_touch[at as usize];
            let touch = &touches[at as usize];
            let (other, sign, lever) = if a == own { (b, -1.0, touch.lever_a) } else { (a, 1.0, touch.lever_b) };
            let n = touch.n * sign;
            if below(other) && -n.dot(&down) > UPRIGHT {
                let closed = (0..touch.count as usize).filter(|p| touch.gap[*p] <= band);
                points.extend(closed.map(|p| (at as usize, p, n, sign * lever[p])));
            }
        }
        for ((at, p, ..), push) in points.iter().zip(balance(&points, loads[k])) {
            let (a, b) = of_touch[*at];
            let touch = &mut touches[*at];
            touch.push[*p] = push;
            let (other, sign, lever) = if a == own { (b, 1.0, touch.lever_b) } else { (a, -1.0, touch.lever_a) };
            if let Some(other) = rows.mobile_of(other) {
                loads[other].force += touch.n * (sign * push);
                loads[other].moment += sign * lever[*p] * push;
            }
        }
    }
}

/// Pushes at the points that balance a load, the least in squares; none where the balance would draw.
fn balance(points: &[(usize, usize, Vec2, f64)], load: Load) -> Vec<f64> {
    use nalgebra::{Matrix3, Vector3};
    // Moments count in forces at the longest lever: the balance is the same at any scale.
    let longest = points.iter().map(|(.., lever)| lever.abs()).fold(f64::MIN_POSITIVE, f64::max);
    let rows: Vec<Vector3<f64>> = points.iter().map(|(.., n, lever)| Vector3::new(n.x, n.y, lever / longest)).collect();
    let mut square: Matrix3<f64> = rows.iter().map(|row| row * row.transpose()).sum();
    let slack = SLACK * square.trace();
    square += Matrix3::from_diagonal_element(slack);
    let wanted = -Vector3::new(load.force.x, load.force.y, load.moment / longest);
    let Some(inverse) = square.try_inverse() else { return vec![0.0; points.len()] };
    let balanced = |wanted: Vector3<f64>| -> Vec<f64> {
        let multipliers = inverse * wanted;
        rows.iter().map(|row| row.dot(&multipliers)).collect()
    };
    let first = balanced(wanted);
    // What the slack has left unbalanced.
    let borne: Vector3<f64> = rows.iter().zip(&first).map(|(row, push)| row * *push).sum();
    let second = balanced(wanted - borne);
    let pushes: Vec<f64> = first.iter().zip(&second).map(|(p, q)| (p + q).max(0.0)).collect();
    let weight = load.force.norm();
    if pushes.iter().all(|push| *push <= MOST * weight) {
        return pushes;
    }
    vec![weight / points.len() as f64; points.len()]
}

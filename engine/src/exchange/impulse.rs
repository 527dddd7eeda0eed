//! Newton–Euler impulses with restitution and Coulomb friction.
//!
//! ```text
//!              n ^                u = v_j + ω_j × r_j − v_i − ω_i × r_i   at each point, along t and n
//!                │  j             du = K dp: what an impulse p on j (and −p on i) changes,
//!        ────────┼──> t           K_ab = (1/m_i + 1/m_j) δ_ab + (r_i×a)(r_i×b)/I_i + (r_j×a)(r_j×b)/I_j
//!             i  │
//! ```
//!
//! **The law.** One point: Routh's process (1891): the impulse grows from zero, friction opposes slip at every
//! moment and sticks where it can; compression ends when u_n = 0, restitution when the normal impulse has given
//! back e² of the work that compression took (Stronge 1990). Without a change of slip this is Newton's
//! u_n⁺ = −e u_n⁻; with one, Newton's law can create energy, and this cannot. Two points (a flat hit) act together:
//! without friction, impulses ≥ 0 such that no point parts more slowly than Newton's law asks and those that push
//! part exactly so; with friction, sticking or sliding is decided at the end of the impact, and should that create
//! energy, restitution is lowered until it does not.

use super::flat::{Flat, FlatImpulse};
use super::impact::{Components, Impact, Surface};
use crate::area::Vec2;
use crate::bodies::{Bodies, Role};
use crate::detect::manifold::{Manifold, Point};
use crate::frame::perp;
use crate::impact_time::STILL;

/// A point of contact in world directions: the arms from both centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arms {
    /// From the centre of i.
    pub r_i: Vec2,
    /// From the centre of j.
    pub r_j: Vec2,
}

impl Arms {
    /// To the middle of two points.
    pub(crate) fn middle([one, two]: &[Arms; 2]) -> Arms {
        Arms { r_i: (one.r_i + two.r_i) * 0.5, r_j: (one.r_j + two.r_j) * 0.5 }
    }
}

/// The impulses of an impact, on j and against i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Given {
    /// At one point, with the work done on the normal motion \[J\].
    Point {
        /// The point.
        at: Arms,
        /// The impulse.
        p: Components,
        /// What compression took, less what was given back.
        normal_work: f64,
    },
    /// On a face, normal at its two ends and tangential halfway between.
    Face {
        /// The ends.
        ends: [Arms; 2],
        /// The impulses.
        p: FlatImpulse,
    },
}

/// An impact that happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Act {
    /// The body that the normal points out of: the reference.
    pub i: usize,
    /// The other.
    pub j: usize,
    /// From i to j.
    pub normal: Vec2,
    /// The middle of its points, from the plan's origin \[m\].
    pub middle: Vec2,
    /// Its impulses.
    pub given: Given,
}

/// One over the masses and moments of a pair; zero for a body that collisions do not move.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inverse {
    mass_i: f64,
    mass_j: f64,
    moment_i: f64,
    moment_j: f64,
}

fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

impl Inverse {
    pub(super) fn of(bodies: &Bodies, i: usize, j: usize) -> Self {
        let of = |body: usize| match bodies.role[body] {
            Role::Mobile => (1.0 / bodies.inertia[body].mass, 1.0 / bodies.inertia[body].moment),
            Role::FixedWithPhysics | Role::Fixed => (0.0, 0.0),
        };
        let ((mass_i, moment_i), (mass_j, moment_j)) = (of(i), of(j));
        Inverse { mass_i, mass_j, moment_i, moment_j }
    }

    /// K between an impulse along `b` at one point and the change of u along `a` at another.
    pub(super) fn response(&self, at: &Arms, a: Vec2, from: &Arms, b: Vec2) -> f64 {
        (self.mass_i + self.mass_j) * a.dot(&b)
            + self.moment_i * cross(at.r_i, a) * cross(from.r_i, b)
            + self.moment_j * cross(at.r_j, a) * cross(from.r_j, b)
    }
}

/// u: how fast j moves away from i at a point.
pub(crate) fn relative_velocity(bodies: &Bodies, i: usize, j: usize, at: &Arms) -> Vec2 {
    let of = |body: usize, r: Vec2| bodies.motion[body].v + perp(r) * bodies.motion[body].omega;
    of(j, at.r_j) - of(i, at.r_i)
}

/// Whether j comes at i along n at a point, faster than what rounding leaves of the speeds involved.
pub(crate) fn approaches(bodies: &Bodies, i: usize, j: usize, at: &Arms, n: Vec2) -> bool {
    let of = |body: usize, r: Vec2| bodies.motion[body].v.norm() + bodies.motion[body].omega.abs() * r.norm();
    relative_velocity(bodies, i, j, at).dot(&n) < -STILL * (of(i, at.r_i) + of(j, at.r_j))
}

/// Applies p to j and −p to i.
pub(super) fn apply(bodies: &mut Bodies, i: usize, j: usize, inverse: &Inverse, at: &Arms, p: Vec2) {
    bodies.motion[i].v -= p * inverse.mass_i;
    bodies.motion[i].omega -= cross(at.r_i, p) * inverse.moment_i;
    bodies.motion[j].v += p * inverse.mass_j;
    bodies.motion[j].omega += cross(at.r_j, p) * inverse.moment_j;
}

/// Applies two impulses as one, so that it makes no difference which end of a face is called the first.
fn apply_both(bodies: &mut Bodies, (i, j): (usize, usize), inverse: &Inverse, at: &[Arms; 2], p: [Vec2; 2]) {
    let (sum, [one, two]) = (p[0] + p[1], at);
    bodies.motion[i].v -= sum * inverse.mass_i;
    bodies.motion[i].omega -= (cross(one.r_i, p[0]) + cross(two.r_i, p[1])) * inverse.moment_i;
    bodies.motion[j].v += sum * inverse.mass_j;
    bodies.motion[j].omega += (cross(one.r_j, p[0]) + cross(two.r_j, p[1])) * inverse.moment_j;
}

/// Exchanges motion at the points of a manifold; `None` when nothing approaches.
///
/// The point of contact lies halfway between the owner's point and the face it is in, the same for both bodies, so that
/// momentum and angular momentum are kept whatever the depth.
pub fn act(bodies: &mut Bodies, manifold: &Manifold) -> Option<Act> {
    let (reference, owner) = (manifold.reference, manifold.owner);
    let frame = bodies.frame[reference];
    let n = frame.outward(manifold.face.normal());
    let mut both = [Arms { r_i: Vec2::zeros(), r_j: Vec2::zeros() }; 2];
    let points = manifold.points();
    for (slot, point) in both.iter_mut().zip(points) {
        *slot = arms(bodies, manifold, n, point);
    }
    let surface = Surface::of_pair(bodies.surface[reference], bodies.surface[owner]);
    let points = &both[..points.len()];
    let middle = frame.o + points.iter().map(|at| at.r_i).sum::<Vec2>() / points.len() as f64;
    let given = exchange(bodies, (reference, owner), n, points, surface)?;
    Some(Act { i: reference, j: owner, normal: n, middle, given })
}

/// The arms of a point of a manifold whose normal is n, in world directions.
#[must_use]
pub fn arms(bodies: &Bodies, manifold: &Manifold, n: Vec2, point: &Point) -> Arms {
    Arms {
        r_i: bodies.frame[manifold.reference].outward(point.on_face) - n * (0.5 * point.depth),
        r_j: bodies.frame[manifold.owner].outward(point.vertex) + n * (0.5 * point.depth),
    }
}

/// What rounding left between u⁺ and −e u⁻ at the points that pushed is taken out once more. The error of a single impact is
/// rounding either way; without this it has the same sign in every impact of a pair, and a million of them add up.
fn settle_rounding(
    bodies: &mut Bodies,
    (i, j): (usize, usize),
    n: Vec2,
    points: &[Arms; 2],
    (before, pushed): ([f64; 2], [f64; 2]),
    restitution: f64,
) {
    let inverse = Inverse::of(bodies, i, j);
    let rest = [0, 1].map(|k| match pushed[k] > 0.0 {
        true => -restitution * before[k].min(0.0) - relative_velocity(bodies, i, j, &points[k]).dot(&n),
        false => 0.0,
    });
    // Two points of a face share what they push, and together push the bodies straight; one alone turns them too.
    let both = pushed[0] > 0.0 && pushed[1] > 0.0;
    let share = [0, 1].map(|k| match (both, pushed[k] > 0.0) {
        (true, _) => 0.25 * (rest[0] + rest[1]) / (inverse.mass_i + inverse.mass_j),
        (false, true) => rest[k] / inverse.response(&points[k], n, &points[k], n),
        (false, false) => 0.0,
    });
    apply_both(bodies, (i, j), &inverse, points, share.map(|p| n * p));
}

/// Exchanges motion at one or two points, `n` pointing from i to j. `None` when the bodies are parting at every
/// point and nothing happens.
pub fn exchange(
    bodies: &mut Bodies,
    (i, j): (usize, usize),
    n: Vec2,
    points: &[Arms],
    surface: Surface,
) -> Option<Given> {
    let inverse = Inverse::of(bodies, i, j);
    let t = -perp(n);
    if !points.iter().any(|at| approaches(bodies, i, j, at, n)) {
        return None;
    }
    match *points {
        [at] => {
            let u = relative_velocity(bodies, i, j, &at);
            let point = Impact {
                k_tt: inverse.response(&at, t, &at, t),
                k_tn: inverse.response(&at, t, &at, n),
                k_nn: inverse.response(&at, n, &at, n),
            };
            let (p, normal_work) = point.impulse_and_work(u.dot(&t), u.dot(&n), surface);
            apply(bodies, i, j, &inverse, &at, t * p.t + n * p.n);
            Some(Given::Point { at, p, normal_work })
        }
        [one, two] => {
            let ends = [one, two];
            let mean = Arms::middle(&ends);
            let face = Flat {
                k_nn: ends.map(|row| ends.map(|column| inverse.response(&row, n, &column, n))),
                k_nt: ends.map(|row| inverse.response(&row, n, &mean, t)),
                k_tt: inverse.response(&mean, t, &mean, t),
            };
            let u_n = ends.map(|at| relative_velocity(bodies, i, j, &at).dot(&n));
            let u_t = relative_velocity(bodies, i, j, &mean).dot(&t);
            let p = face.impulse(u_t, u_n, surface);
            apply(bodies, i, j, &inverse, &mean, t * p.t);
            apply_both(bodies, (i, j), &inverse, &ends, p.n.map(|p_n| n * p_n));
            if surface.friction == 0.0 {
                settle_rounding(bodies, (i, j), n, &ends, (u_n, p.n), surface.restitution);
            }
            Some(Given::Face { ends, p })
        }
        _ => None,
    }
}

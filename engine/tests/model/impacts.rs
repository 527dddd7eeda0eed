//! Single impacts of the impulse exchange, against exact fractions.

use choque_engine::Vec2;
use choque_engine::bodies::{Bodies, Inertia, Motion, Role};
use choque_engine::exchange::impact::{Components, Impact, Surface};
use choque_engine::exchange::impulse::{Arms, exchange};

use crate::columns;
use crate::random_scenes::Random;

/// The two bodies of the cases C1 and C2: 2 × 1 of 2 kg at v = (3, 0), and 1 × 3 of 3 kg at rest.
fn c_bodies() -> Bodies {
    pair([(2.0, 5.0 / 6.0, (3.0, 0.0), 0.0), (3.0, 5.0 / 2.0, (0.0, 0.0), 0.0)])
}

fn pair(of: [(f64, f64, (f64, f64), f64); 2]) -> Bodies {
    columns(of.map(|(mass, moment, (vx, vz), omega)| {
        (Role::Mobile, Inertia { mass, moment }, Motion { v: Vec2::new(vx, vz), omega })
    }))
}

fn arms(r_i: (f64, f64), r_j: (f64, f64)) -> Arms {
    Arms { r_i: Vec2::new(r_i.0, r_i.1), r_j: Vec2::new(r_j.0, r_j.1) }
}

fn assert_motions(bodies: &Bodies, expected: [f64; 4], over: f64) {
    let [a, b] = [bodies.motion[0], bodies.motion[1]];
    for (found, expected) in [a.v.x, a.omega, b.v.x, b.omega].into_iter().zip(expected) {
        assert!((found - expected / over).abs() < 1e-15 * 4.0, "{found} instead of {}", expected / over);
    }
}

const X: Vec2 = Vec2::new(1.0, 0.0);

fn elastic(restitution: f64) -> Surface {
    Surface { restitution, friction: 0.0 }
}

#[test]
fn c1_a_vertex_hits_a_face_off_centre() {
    let cases = [
        (1.0, [2901.0, 4320.0, 6000.0, 7560.0]),
        (0.5, [5151.0, 3240.0, 4500.0, 5670.0]),
        (0.0, [7401.0, 2160.0, 3000.0, 3780.0]),
    ];
    for (e, expected) in cases {
        let mut bodies = c_bodies();
        assert!(exchange(&mut bodies, (0, 1), X, &[arms((1.1, 0.2), (-0.5, -1.05))], elastic(e)));
        assert_motions(&bodies, expected, 3967.0);
    }
}

#[test]
fn c2_parallel_faces_meet_at_two_points_at_once() {
    // B's centre stands at (3/2, 5/4) from A's; the faces share z from −1/4 to 1/2.
    let points = [arms((1.0, 0.5), (-0.5, -0.75)), arms((1.0, -0.25), (-0.5, -1.5))];
    let cases =
        [(1.0, [87.0, 216.0, 192.0, 216.0]), (0.5, [159.0, 162.0, 144.0, 162.0]), (0.0, [231.0, 108.0, 96.0, 108.0])];
    for (e, expected) in cases {
        for order in [[0, 1], [1, 0]] {
            let mut bodies = c_bodies();
            exchange(&mut bodies, (0, 1), X, &order.map(|k| points[k]), elastic(e));
            let [a, b] = [bodies.motion[0], bodies.motion[1]];
            let found = [a.v.x, a.omega, b.v.x, b.omega];
            let expected = expected.map(|x| x / 125.0);
            let worst = found.iter().zip(expected).map(|(f, e)| (f - e).abs()).fold(0.0, f64::max);
            assert!(worst < 4e-15, "e = {e}: {found:?} instead of {expected:?}");
        }
    }
}

#[test]
fn c6_a_turning_blade_strikes_with_its_own_speed_at_the_contact() {
    // Ω = 2 at radius 3 against a block of 1 kg, 1/2 × 1/2, at rest, struck d beside its centre.
    let cases = [
        (1.0, 0.0, 12.0, 0.0),
        (1.0, 0.1, 300.0 / 31.0, 720.0 / 31.0),
        (1.0, 0.25, 24.0 / 5.0, 144.0 / 5.0),
        (0.5, 0.0, 9.0, 0.0),
        (0.5, 0.1, 225.0 / 31.0, 540.0 / 31.0),
        (0.5, 0.25, 18.0 / 5.0, 108.0 / 5.0),
    ];
    for (e, d, v, w) in cases {
        let blade = Motion { v: Vec2::zeros(), omega: 2.0 };
        let block = Inertia { mass: 1.0, moment: 1.0 / 24.0 };
        let mut bodies = columns([(Role::FixedWithPhysics, block, blade), (Role::Mobile, block, Motion::default())]);
        assert!(exchange(&mut bodies, (0, 1), Vec2::new(0.0, 1.0), &[arms((3.0, 0.0), (d, -0.25))], elastic(e)));
        let after = bodies.motion[1];
        assert!((after.v.y - v).abs() < 1e-14 && (after.omega - w).abs() < 2e-14, "e = {e}, d = {d}: {after:?}");
        assert_eq!(bodies.motion[0], blade, "a fixed body is not moved");
    }
    // A free rotor of 10 kg·m² instead: 2/19 is left of its turning.
    let rotor = (Role::Mobile, Inertia { mass: 1e300, moment: 10.0 }, Motion { v: Vec2::zeros(), omega: 2.0 });
    let mut bodies = columns([rotor, (Role::Mobile, Inertia { mass: 1.0, moment: 1.0 / 24.0 }, Motion::default())]);
    exchange(&mut bodies, (0, 1), Vec2::new(0.0, 1.0), &[arms((3.0, 0.0), (0.0, -0.25))], elastic(1.0));
    assert!((bodies.motion[0].omega - 2.0 / 19.0).abs() < 2e-15 && (bodies.motion[1].v.y - 120.0 / 19.0).abs() < 2e-15);
}

/// r = (−3/5, −4/5) from the centre of a body of 1 kg with R = 1, striking a floor.
const VERTEX: Impact = Impact { k_tt: 73.0 / 25.0, k_tn: -36.0 / 25.0, k_nn: 52.0 / 25.0 };

fn after(impact: Impact, u: (f64, f64), surface: Surface) -> (Components, Components) {
    let p = impact.impulse(u.0, u.1, surface);
    let u_t = u.0 + impact.k_tt * p.t + impact.k_tn * p.n;
    let u_n = u.1 + impact.k_tn * p.t + impact.k_nn * p.n;
    (p, Components { t: u_t, n: u_n })
}

#[test]
fn c3_friction_where_all_laws_agree() {
    // μ, u, then p_n, p_t, u_t⁺, u_n⁺
    let cases = [
        ("F0 without friction", 0.0, (1.0, -2.0), [75.0 / 52.0, 0.0, -14.0 / 13.0, 1.0]),
        ("F1 slips through", 0.2, (4.0, -2.0), [375.0 / 296.0, -75.0 / 296.0, 425.0 / 296.0, 1.0]),
        ("F4 sticks at once", 0.9, (0.0, -2.0), [219.0 / 100.0, 27.0 / 25.0, 0.0, 1.0]),
        ("F5 slips from rest", 0.4, (0.0, -2.0), [375.0 / 188.0, 75.0 / 94.0, -51.0 / 94.0, 1.0]),
        ("F6 slips away", 0.3, (-1.0, -2.0), [375.0 / 206.0, 225.0 / 412.0, -835.0 / 412.0, 1.0]),
    ];
    for (name, friction, u, expected) in cases {
        let (p, u) = after(VERTEX, u, Surface { restitution: 0.5, friction });
        let found = [p.n, p.t, u.t, u.n];
        let worst = found.iter().zip(expected).map(|(f, e)| (f - e).abs()).fold(0.0, f64::max);
        assert!(worst < 2e-15, "{name}: {found:?} instead of {expected:?}");
    }
}

/// Kinetic energy of a body of 1 kg at the contact: p·(u⁻ + u⁺)/2 is what the impact changes.
fn energy_change(p: Components, before: (f64, f64), after: Components) -> f64 {
    0.5 * (p.t * (before.0 + after.t) + p.n * (before.1 + after.n))
}

#[test]
fn c4_where_newtons_law_would_gain_energy_this_one_does_not() {
    let (p, u) = after(VERTEX, (0.5, -1.0), Surface { restitution: 1.0, friction: 0.5 });
    assert!((u.n - (1325.0_f64 / 2117.0).sqrt()).abs() < 1e-15, "Stronge: {}", u.n);
    let start = 0.5 * (0.25 + 1.0);
    let ratio = (start + energy_change(p, (0.5, -1.0), u)) / start;
    assert!((ratio - 28.0 / 29.0).abs() < 1e-15, "Stronge: {ratio}, Newton would give 1.184");
}

#[test]
fn slip_that_stops_turns_or_jams_takes_energy() {
    let jam = Impact { k_tt: 1.0 + 4.0 * 0.6, k_tn: 2.0 * 0.6, k_nn: 1.0 + 0.6 }; // r = (1, −2), I = 5/3
    let cases = [("F2", VERTEX, 0.9, (1.0, -2.0)), ("F3", VERTEX, 0.3, (1.0, -2.0)), ("F7", jam, 1.5, (2.0, -1.0))];
    for (name, impact, friction, before) in cases {
        let (p, u) = after(impact, before, Surface { restitution: 0.5, friction });
        assert!(u.n > 0.0 && p.n > 0.0 && p.t.abs() <= friction * p.n * (1.0 + 1e-12), "{name}: {p:?} {u:?}");
        assert!(energy_change(p, before, u) < 0.0, "{name}");
    }
}

/// No impact gains energy, one point or two, whatever the masses (to 1e12), shapes, friction and restitution; and
/// what the pair has of momentum stays.
#[test]
fn no_impact_of_a_hundred_thousand_gains_energy() {
    let mut random = Random(7);
    let mut hits = 0;
    for case in 0..100_000 {
        let mass = |random: &mut Random| libm::pow(10.0, random.between(-6.0, 6.0));
        let body = |random: &mut Random| {
            let m = mass(random);
            let motion = (random.between(-5.0, 5.0), random.between(-5.0, 5.0));
            (m, m * random.between(0.1, 2.0), motion, random.between(-5.0, 5.0))
        };
        let mut bodies = pair([body(&mut random), body(&mut random)]);
        let heading = random.between(-3.0, 3.0);
        let n = Vec2::new(libm::cos(heading), libm::sin(heading));
        let t = Vec2::new(n.y, -n.x);
        let offsets = Vec2::new(random.between(0.1, 1.5), random.between(0.1, 1.5));
        let point = |random: &mut Random| {
            let along = t * random.between(-1.5, 1.5);
            Arms { r_i: n * offsets.x + along, r_j: n * -offsets.y + along + t * 0.3 }
        };
        let mut points = vec![point(&mut random)];
        if case % 2 == 0 {
            points.push(point(&mut random));
        }
        let surface = Surface { restitution: random.between(0.0, 1.0), friction: random.between(0.0, 2.0) };
        let (energy, momentum) = totals(&bodies);
        hits += u32::from(exchange(&mut bodies, (0, 1), n, &points, surface));
        let (energy_after, momentum_after) = totals(&bodies);
        assert!(energy_after <= energy * (1.0 + 1e-12), "case {case}: {energy} became {energy_after}");
        let scale = bodies.inertia.iter().map(|i| i.mass * 10.0).fold(0.0, f64::max);
        assert!((momentum_after - momentum).norm() <= 1e-13 * scale, "case {case}");
    }
    assert!(hits > 50_000);
}

fn totals(bodies: &Bodies) -> (f64, Vec2) {
    let both = || bodies.motion.iter().zip(&bodies.inertia);
    let energy = both().map(|(m, i)| 0.5 * (i.mass * m.v.norm_squared() + i.moment * m.omega * m.omega)).sum();
    (energy, both().map(|(m, i)| m.v * i.mass).sum())
}

//! Single impacts of the impulse exchange, at random: none gains energy. (Exact fractions: `tests/all/exact` of the whole.)

use choque_engine::Vec2;
use choque_engine::bodies::{Bodies, Inertia, Motion, Role};
use choque_engine::exchange::impact::Surface;
use choque_engine::exchange::impulse::{Arms, exchange};

use crate::columns;
use crate::random_scenes::Random;

fn pair(of: [(f64, f64, (f64, f64), f64); 2]) -> Bodies {
    columns(of.map(|(mass, moment, (vx, vz), omega)| {
        (Role::Mobile, Inertia { mass, moment }, Motion { v: Vec2::new(vx, vz), omega })
    }))
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
        hits += u32::from(exchange(&mut bodies, (0, 1), n, &points, surface).is_some());
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

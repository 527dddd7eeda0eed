//! Impacts per second in continuous motion: `cargo bench --bench gas`, or `-- N IMPACTS` for one gas of N rectangles.
//!
//! A gas of rotating rectangles (e = 1, a fifth of the box filled) at 100, 1,000 and 10,000; the Galperin billiard for
//! k = 6 with its 3,141,592 impacts. Beside the rates: how well energy is kept, and the share of rotation in it, which
//! equipartition puts at a third.

use choque::clock;
use choque_engine::scene::{Body, ExchangeRule, Kind, MotionRule, Part, Settings};
use choque_engine::{Rect, Scene, World};

fn main() {
    let given: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    if given[..] == [0] {
        quiet();
        return;
    }
    if let [count, impacts] = given[..] {
        gas(count, impacts as u64);
        return;
    }
    for count in [100, 1_000, 10_000] {
        gas(count, 200_000);
    }
    galperin();
    quiet();
}

/// What a step without impacts costs beside a stepped one: 10,000 turning rectangles that drift alike, in turns.
fn quiet() {
    let worlds = [MotionRule::Stepped, MotionRule::Continuous].map(|motion| {
        let mut scene = gas_scene(10_000);
        scene.settings.motion = motion;
        scene.settings.time_step = 1.0 / 60.0;
        for body in scene.bodies.iter_mut().filter(|body| body.kind == Kind::Mobile) {
            body.velocity = Some((0.1, 0.05));
        }
        World::new(&scene).expect("a valid scene")
    });
    let mut best = [f64::INFINITY; 2];
    for _ in 0..15 {
        for (best, world) in best.iter_mut().zip(&worlds) {
            let mut world = world.clone();
            world.step();
            let since = clock::now();
            (0..20).for_each(|_| world.step());
            *best = best.min(since.elapsed().as_secs_f64() / 20.0);
            assert_eq!(world.collisions(), 0);
        }
    }
    let [stepped, continuous] = best.map(|time| time * 1e3);
    println!(
        "without impacts: stepped {stepped:.3} ms, continuous {continuous:.3} ms a step: {:.2} times",
        continuous / stepped
    );
}

/// xorshift64*: the bench wants the same gas every time.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11;
        low + (high - low) * (bits as f64 / 9_007_199_254_740_992.0)
    }
}

fn rectangle(name: &str, kind: Kind, size: (f64, f64), at: (f64, f64)) -> Body {
    let mut body = Body::new(name, kind);
    body.parts.push(Part::Rect(Rect::centred(size.0, size.1)));
    body.at = at;
    body
}

fn scene(time_step: f64, bodies: Vec<Body>) -> Scene {
    let settings = Settings {
        exchange: ExchangeRule::Impulse,
        motion: MotionRule::Continuous,
        restitution: 1.0,
        time_step,
        ..Settings::default()
    };
    Scene { settings, bodies, ..Scene::default() }
}

fn gas_scene(count: usize) -> Scene {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let side = libm::ceil(libm::sqrt(count as f64)) as usize;
    let pitch = libm::sqrt(1.2 / 0.2); // a rectangle of 1.2 × 1 in each cell
    let half = 0.5 * pitch * side as f64;
    let wall = 2.0 * half + 20.0;
    let mut bodies = vec![
        rectangle("west", Kind::Fixed, (10.0, wall), (-half - 5.0, 0.0)),
        rectangle("east", Kind::Fixed, (10.0, wall), (half + 5.0, 0.0)),
        rectangle("south", Kind::Fixed, (wall, 10.0), (0.0, -half - 5.0)),
        rectangle("north", Kind::Fixed, (wall, 10.0), (0.0, half + 5.0)),
    ];
    for k in 0..count {
        let at = |n: usize| (n as f64 + 0.5) * pitch - half;
        let mut body = rectangle(&format!("b{k}"), Kind::Mobile, (1.2, 1.0), (at(k % side), at(k / side)));
        body.angle = random.between(-3.0, 3.0);
        body.velocity = Some((random.between(-1.0, 1.0), random.between(-1.0, 1.0)));
        body.spin = Some(random.between(-2.0, 2.0));
        bodies.push(body);
    }
    scene(0.25, bodies)
}

fn gas(count: usize, impacts: u64) {
    let mut world = World::new(&gas_scene(count)).expect("a valid scene");
    let start = world.kinetic_energy();
    let (mut shares, mut samples, mut drift) = (0.0, 0.0, 0.0_f64);
    let since = clock::now();
    while world.collisions() < impacts {
        world.step();
        if world.collisions() > impacts / 4 {
            let turning = world.ids().map(|id| 0.5 * world.inertia(id) * world.spin(id) * world.spin(id));
            let of_mobile = world.ids().zip(turning).filter(|(id, _)| world.kind(*id) == Kind::Mobile);
            shares += of_mobile.map(|(_, energy)| energy).sum::<f64>() / start;
            samples += 1.0;
        }
        drift = drift.max((world.kinetic_energy() / start - 1.0).abs());
    }
    let time = since.elapsed().as_secs_f64();
    println!(
        "gas of {count}: {:.0} impacts/s, {} impacts, {} iterations; energy off by {drift:.1e}, share of rotation {:.4}, \
         deepest {:.1e} m, digest {:016x}",
        world.collisions() as f64 / time,
        world.collisions(),
        world.iteration(),
        shares / samples,
        world.deepest(),
        world.digest()
    );
    println!("{}", world.work());
}

fn galperin() {
    let block = |name: &str, x: f64, v: f64, mass: f64| {
        let mut body = rectangle(name, Kind::Mobile, (1.0, 1.0), (x, 0.0));
        (body.velocity, body.mass) = (Some((v, 0.0)), Some(mass));
        body
    };
    let wall = rectangle("wall", Kind::Fixed, (1.0, 9.0), (-0.5, 0.0));
    let bodies = vec![wall, block("small", 1.5, 0.0, 1.0), block("big", 3.5, -1.0, 1e12)];
    let mut world = World::new(&scene(1.0 / 64.0, bodies)).expect("a valid scene");
    let (since, mut last) = (clock::now(), 0.0);
    for _ in 0..64 * 4 {
        world.begin();
        while world.treat_next().is_some() {
            last = world.time();
        }
        world.finish();
    }
    let time = since.elapsed().as_secs_f64();
    let ids: Vec<_> = world.ids().collect();
    println!(
        "Galperin k = 6: {} impacts, {:.0} impacts/s; V off by {:.1e}, v by {:.1e}, the last hit by {:.1e} s",
        world.collisions(),
        world.collisions() as f64 / time,
        world.velocity(ids[2]).x - 0.999_999_999_999_786_4,
        world.velocity(ids[1]).x - 0.653_590_840_435_749_4,
        last - 3.530_009_201_678_967_5,
    );
}

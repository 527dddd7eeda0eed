//! The ledger: the books close, whatever happens, and decide nothing.

use choque_engine::ledger::{Amounts, Cause};
use choque_engine::scene::{ExchangeRule, Kind, MotionRule, Patrol, Scene};
use choque_engine::{BodyId, Vec2, World};

use crate::continuous::{block, impulse, wall};
use crate::random_scenes::{Random, random_scene};

pub(crate) fn kept(scene: &Scene) -> World {
    let mut world = World::new(scene).expect("a valid scene");
    world.keep_ledger();
    world
}

fn totals(world: &World) -> Amounts {
    let momentum = world.momentum();
    Amounts {
        kinetic_energy: world.kinetic_energy(),
        momentum_x: momentum.x,
        momentum_z: momentum.y,
        angular_momentum: world.angular_momentum(),
    }
}

/// What the rounding of each total is measured by: what the mobile bodies have of it each, added up without signs.
fn sizes(world: &World) -> [f64; 4] {
    let mut sizes = [0.0; 4];
    for id in world.ids().filter(|id| world.kind(*id) == Kind::Mobile) {
        let (m, o, v) = (world.mass(id), world.position(id), world.velocity(id));
        let momentum = m * v.norm();
        sizes[0] += 0.5 * (m * v.norm_squared() + world.inertia(id) * world.spin(id) * world.spin(id));
        sizes[1] += momentum;
        sizes[2] += momentum;
        sizes[3] += momentum * o.norm() + world.inertia(id) * world.spin(id).abs();
    }
    sizes
}

/// Holds the books of a world to closing.
pub(crate) struct Audit {
    /// The largest amounts there have been: what bodies had, what was booked in all, and of one exchange. Rounding is
    /// measured by them.
    sizes: [f64; 4],
    /// The largest gap there has been, of the sizes.
    pub(crate) worst: f64,
}

impl Audit {
    pub(crate) fn of(world: &World) -> Self {
        Audit { sizes: sizes(world), worst: 0.0 }
    }

    pub(crate) fn look(&mut self, world: &World) {
        let ledger = world.ledger().expect("it is kept");
        let of_ledger = Cause::ALL.map(|cause| ledger.booked(cause).to_array());
        let of_entries = ledger.entries().iter().map(|entry| Cause::ALL.map(|cause| entry.booked[cause].to_array()));
        let turned_over: Vec<_> = of_entries.chain([of_ledger]).collect();
        let (initial, now, of_bodies) = (ledger.initial().to_array(), totals(world).to_array(), sizes(world));
        for k in 0..4 {
            let largest = turned_over.iter().map(|booked| booked.iter().map(|amounts| amounts[k].abs()).sum());
            self.sizes[k] = largest.fold(self.sizes[k].max(of_bodies[k]), f64::max);
            let gap = (initial[k] + of_ledger.iter().map(|amounts| amounts[k]).sum::<f64>() - now[k]).abs();
            if gap > 0.0 {
                self.worst = self.worst.max(gap / self.sizes[k]);
            }
        }
    }
}

/// Random scenes of every model, some under gravity, in either motion. Their bodies start within each other, and what impulses
/// make of that in continuous motion takes its time: that pairing has [`pile`].
fn varied(seed: u64) -> Scene {
    let mut scene = random_scene(seed);
    let mut random = Random(seed ^ 0xabcd);
    let settings = &mut scene.settings;
    let continuous = random.one_in(2) && settings.exchange == ExchangeRule::Document;
    settings.motion = if continuous { MotionRule::Continuous } else { MotionRule::Stepped };
    settings.gravity = if random.one_in(2) { (random.between(-3.0, 3.0), -9.81) } else { (0.0, 0.0) };
    scene
}

/// Boxes that fall on a floor and come to rest there, one of them on a lift.
fn pile(seed: u64) -> Scene {
    let mut random = Random(seed);
    let mut lift = wall("lift", (2.0, 1.0), (9.0, -0.5));
    lift.patrol = Some(Patrol { points: vec![(9.0, 3.0)], speed: 0.5 });
    let mut bodies = vec![wall("floor", (14.0, 1.0), (0.0, -0.5)), lift];
    for (k, x) in [-6.0, -3.0, 0.0, 3.0, 9.0].into_iter().enumerate() {
        let velocity = (random.between(-1.0, 1.0), 0.0);
        let mut fallen = block(&format!("b{k}"), (1.0, 0.7), (x, 1.0), velocity, random.between(1.0, 3.0));
        fallen.angle = random.between(-0.5, 0.5);
        bodies.push(fallen);
    }
    let mut scene = impulse(0.3, 1.0 / 60.0, bodies);
    (scene.settings.gravity, scene.settings.friction) = ((0.0, -9.81), random.between(0.1, 0.8));
    scene.settings.drag = (random.between(0.0, 0.2), 0.0);
    scene
}

/// What a script may do before an iteration.
pub(crate) fn command(world: &mut World, random: &mut Random) {
    let ids: Vec<BodyId> = world.ids().collect();
    let id = ids[random.next() as usize % ids.len()];
    let vector = Vec2::new(random.between(-5.0, 5.0), random.between(-5.0, 5.0));
    let number = random.between(-5.0, 5.0);
    match random.next() % 8 {
        0 => world.set_velocity(id, vector),
        1 => world.set_spin(id, number),
        2 => world.set_position(id, world.position(id) + vector * 0.1),
        3 => world.set_angle(id, number),
        4 => world.push(id, vector * 20.0).or(Ok(())), // refused of a fixed body
        5 => world.twist(id, number).or(Ok(())),
        _ => Ok(()),
    }
    .expect("finite");
}

#[test]
fn the_books_of_random_scenes_close() {
    for seed in 0..100 {
        let mut world = kept(&varied(seed));
        let mut random = Random(seed);
        let mut audit = Audit::of(&world);
        for _ in 0..40 {
            command(&mut world, &mut random);
            world.begin();
            let mut hits = 0;
            while world.treat_next().is_some() {
                hits += 1;
                if hits % 5 == 1 {
                    command(&mut world, &mut random); // as on_collision may
                }
                if hits % 19 == 1 {
                    audit.look(&world); // also while an iteration is under way
                }
            }
            world.finish();
            audit.look(&world);
            assert_eq!(world.ledger().expect("kept").entries().len(), hits, "scene {seed}");
        }
        assert!(audit.worst < 1e-14, "scene {seed}: the books are {:e} from closing", audit.worst);
    }
}

/// Also where forces hold what rests, and a lift works.
#[test]
fn the_books_of_a_pile_close() {
    for seed in 0..12 {
        let mut world = kept(&pile(seed));
        let mut audit = Audit::of(&world);
        for _ in 0..120 {
            world.step();
            audit.look(&world);
        }
        assert!(audit.worst < 1e-14, "scene {seed}: the books are {:e} from closing", audit.worst);
        let booked = |cause| world.ledger().expect("kept").booked(cause);
        assert!(booked(Cause::Exchange).momentum_z > 0.0, "the floor holds");
        assert!(booked(Cause::Friction).kinetic_energy < 0.0, "friction takes");
        assert!(booked(Cause::Restitution).kinetic_energy < 0.0, "so does restitution");
        assert!(booked(Cause::FixedBodies).kinetic_energy > 0.0, "the lift works");
    }
}

/// What is booked of exchanges is what their entries say; the rest has none. (So do the impulses of contacts that last, which
/// stepped motion has after every hit: `booked_contacts.rs`.)
#[test]
fn the_entries_of_random_scenes_add_up() {
    let mut exchanges = 0;
    let scenes = (24..84).map(|seed| (seed, varied(seed)));
    for (seed, scene) in scenes.filter(|(_, scene)| scene.settings.exchange == ExchangeRule::Document) {
        let mut world = kept(&scene);
        let mut sums = Cause::ALL.map(|_| [0.0; 4]);
        let mut sizes = 1e-300;
        let mut relocated = 0.0;
        for _ in 0..40 {
            world.step();
            for entry in world.ledger().expect("kept").entries() {
                exchanges += 1;
                relocated += entry.relocated;
                for (sum, cause) in sums.iter_mut().zip(Cause::ALL) {
                    let amounts = entry.booked[cause].to_array();
                    sizes += amounts.iter().map(|amount| amount.abs()).sum::<f64>();
                    sum.iter_mut().zip(amounts).for_each(|(sum, amount)| *sum += amount);
                }
            }
        }
        let ledger = world.ledger().expect("kept");
        assert!((relocated - ledger.relocated()).abs() <= 1e-12 * relocated, "scene {seed}");
        let flown = [Cause::Gravity, Cause::Drag];
        let of_exchanges = Cause::ALL.into_iter().zip(&sums).filter(|(cause, _)| !flown.contains(cause));
        for (cause, sum) in of_exchanges {
            for (entered, booked) in sum.iter().zip(ledger.booked(cause).to_array()) {
                assert!((entered - booked).abs() <= 1e-13 * sizes, "scene {seed}, {cause:?}: {entered} and {booked}");
            }
        }
    }
    assert!(exchanges > 2000, "{exchanges}");
}

#[test]
fn a_ledger_decides_nothing() {
    for seed in 0..40 {
        let scene = varied(seed);
        let (mut with, mut without) = (kept(&scene), World::new(&scene).expect("a valid scene"));
        let (mut one, mut two) = (Random(seed), Random(seed));
        for _ in 0..40 {
            command(&mut with, &mut one);
            command(&mut without, &mut two);
            with.step();
            without.step();
        }
        assert_eq!(with.digest(), without.digest(), "scene {seed}");
        assert_eq!(with.work(), without.work(), "scene {seed}");
        assert!(without.ledger().is_none());
    }
}

/// A ledger may be begun late, and a copy of a world goes on with its own.
#[test]
fn a_ledger_begins_when_it_is_asked_for() {
    for seed in 0..20 {
        let mut world = World::new(&varied(seed)).expect("a valid scene");
        (0..20).for_each(|_| world.step());
        world.begin();
        let _ = world.treat_next(); // continuous motion is on its way now
        world.keep_ledger();
        let mut audit = Audit::of(&world);
        while world.treat_next().is_some() {}
        world.finish();
        let copy = world.clone();
        for _ in 0..20 {
            world.step();
            audit.look(&world);
        }
        audit.look(&copy);
        assert!(audit.worst < 1e-14, "scene {seed}: {:e}", audit.worst);
        let initial = world.ledger().expect("kept").initial();
        world.keep_ledger();
        assert_eq!(world.ledger().expect("kept").initial(), initial, "it is kept, not begun again");
    }
}

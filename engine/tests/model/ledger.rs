//! The ledger: the books close, whatever happens, and decide nothing.

use choque_engine::ledger::{Amounts, Cause};
use choque_engine::plan::FlightPlan;
use choque_engine::scene::{ExchangeRule, Kind, MotionRule, Scene, Settings};
use choque_engine::{BodyId, Vec2, World};

use crate::random_scenes::{Random, random_scene};

fn kept(scene: &Scene) -> World {
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
struct Audit {
    /// The largest amounts there have been: what bodies had, what was booked in all, and of one exchange. Rounding is
    /// measured by them.
    sizes: [f64; 4],
    /// The largest gap there has been, of the sizes.
    worst: f64,
}

impl Audit {
    fn of(world: &World) -> Self {
        Audit { sizes: sizes(world), worst: 0.0 }
    }

    fn look(&mut self, world: &World) {
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

/// Random scenes of every model, some under gravity, in either motion.
fn varied(seed: u64) -> Scene {
    let scene = random_scene(seed);
    let mut random = Random(seed ^ 0xabcd);
    let motion = if random.one_in(2) { MotionRule::Continuous } else { MotionRule::Stepped };
    let gravity = if random.one_in(2) { (random.between(-3.0, 3.0), -9.81) } else { (0.0, 0.0) };
    Scene { settings: Settings { motion, gravity, ..scene.settings.clone() }, ..scene }
}

/// What a script may do before an iteration.
fn command(world: &mut World, random: &mut Random) {
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

/// What is booked of exchanges is what their entries say; the rest has none.
#[test]
fn the_entries_of_random_scenes_add_up() {
    let mut exchanges = 0;
    for seed in 24..84 {
        let scene = varied(seed);
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
        // Under forces, what rests is held without exchanges.
        let Settings { motion, exchange, .. } = scene.settings;
        let holds = motion == MotionRule::Continuous
            && exchange == ExchangeRule::Impulse
            && world.plan().flight != FlightPlan::Free;
        let flown = [Cause::Gravity, Cause::Drag];
        let of_exchanges = Cause::ALL.into_iter().zip(&sums).filter(|(cause, _)| !holds && !flown.contains(cause));
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

//! E8, E9: a rectangle in a box, not turning and turning.

use choque_engine::Scene;
use choque_engine::World;

use super::kit::{assert_close, block, continuous, room, run, run_watching, state, worst};

fn billiard(spin: f64, time_step: f64) -> Scene {
    let mut bodies = room((2.0, 1.5));
    let mut body = block("box", (1.0, 0.5), (0.0, 0.0), (1.0, 0.7), 1.0);
    body.spin = Some(spin);
    bodies.push(body);
    continuous(1.0, time_step, bodies)
}

/// Every hit is flat: any asymmetry of its two corners would turn the body, and grow.
#[test]
fn e8_flat_hits_never_turn_a_billiard() {
    let ran = run(&billiard(0.0, 0.5), 20_000);
    let found = state(&ran.world, "box");
    let on = |wall: &str| ran.times_of(wall).len();
    assert_eq!((on("+x") + on("-x"), on("+y") + on("-y")), (3333, 2800));
    let found = [found.x, found.z, found.vx, found.vz, found.angle];
    assert_close(&found, &[-1.0, 0.0, -1.0, 0.7, 0.0], 1e-9, "after 10,000 s");
}

/// 24 events computed to 60 digits.
struct Event {
    time: f64,
    wall: String,
    /// x, z, vx, vz, spin.
    state: [f64; 5],
}

fn reference() -> Vec<Event> {
    let event = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |k: usize| cells[k].parse::<f64>().expect("a number");
        Event { time: number(1), wall: cells[2].to_owned(), state: [4, 5, 7, 8, 9].map(number) }
    };
    include_str!("references/rect_billiard.csv").lines().skip(1).map(event).collect()
}

/// The rotating billiard's first events against the reference, matched by index: greatest error of each; and the first index at which
/// another wall is hit.
fn errors(time_step: f64) -> (Vec<f64>, usize) {
    let reference = reference();
    let mut errors = Vec::new();
    let mut parted = reference.len() + 1;
    let steps = libm::ceil(30.0 / time_step) as u32;
    run_watching(&billiard(1.3, time_step), steps, |world, hit| {
        let Some(event) = reference.get(errors.len()) else { return };
        let found = state(world, "box");
        let error = worst(&[found.x, found.z, found.vx, found.vz, found.spin], &event.state);
        errors.push(error.max((world.time() - event.time).abs()));
        if world.name(hit.a) != event.wall {
            parted = parted.min(errors.len());
        }
        assert!(world.deepest() <= 1e-12, "event {}", errors.len());
    });
    (errors, parted)
}

/// N_pred, the number of events that f64 can predict to a tolerance when it loses a factor of 4.5 at each: 1e-16 · 4.5ⁿ < 1e-6 up to n = 15.
const PREDICTABLE: usize = 15;

#[test]
fn e9_the_rotating_billiard_keeps_its_digits() {
    for time_step in [1.0 / 60.0, 0.5, 30.0] {
        let (errors, parted) = errors(time_step);
        for (n, error) in errors.iter().enumerate() {
            println!("event {:2}: {error:e}", n + 1);
        }
        assert_eq!(errors.len(), 24, "time_step {time_step}");
        assert!(parted > PREDICTABLE, "time_step {time_step}: the walls differ from event {parted} on");
        let worst = |until: usize| errors[..until].iter().copied().fold(0.0, f64::max);
        assert!(worst(1) <= 1e-14 && worst(5) <= 4e-13, "{:e}, {:e}", worst(1), worst(5));
        assert!(worst(10) <= 1e-9, "time_step {time_step}: {:e} within ten events", worst(10));
        assert!(worst(PREDICTABLE) <= 1e-5 && worst(20) <= 0.1, "{:e}, {:e}", worst(PREDICTABLE), worst(20));
    }
}

/// Runs until `events` hits have happened and a moment more, turns every velocity round, and runs back.
fn return_error(events: u64) -> f64 {
    let mut world = World::new(&billiard(1.3, 1e-3)).expect("a valid scene");
    let id = world.find("box").expect("it is there");
    while world.collisions() < events {
        world.step();
    }
    assert_eq!(world.collisions(), events, "no two within a millisecond");
    let (there, v, spin) = (world.iteration(), world.velocity(id), world.spin(id));
    world.set_velocity(id, -v).expect("finite");
    world.set_spin(id, -spin).expect("finite");
    (0..there).for_each(|_| world.step());
    let back = world.position(id);
    back.x.abs().max(back.y.abs())
}

#[test]
fn e9_turned_round_the_billiard_comes_back() {
    // What a good f64 event code reaches; within ten times that.
    let rows = [(2, 5e-16), (5, 2e-14), (8, 3e-12), (10, 3e-10), (12, 6e-10), (15, 1e-6)];
    for (events, good) in rows {
        let error = return_error(events);
        println!("{events} events there and back: {error:e} (a good code: {good:e})");
        assert!(error <= 10.0 * good, "{events} events: {error:e}");
    }
}

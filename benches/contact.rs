//! What lasting contacts cost a step, and how much of that is finding them: `cargo bench --bench contact`, or `-- NAME STEPS` for
//! one scene.
//!
//! Crowds of boxes that bounce between four walls, and a pyramid that stands. A figure is the CPU time of the best step and of
//! the middle one; finding alone is timed by looking for the touches of the next step once more.

mod arena;

use choque::clock;
use choque_engine::scene::{Body, BroadPhaseChoice, ExchangeRule, Kind, Settings};
use choque_engine::{Scene, World};

fn main() {
    let given: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    println!("{}, ms a step: best, middle", clock::CPU_IS);
    for (name, scene, steps) in scenes() {
        match &given[..] {
            [] => measure(name, &scene(), steps),
            [wanted, rest @ ..] if wanted == name => {
                measure(name, &scene(), rest.first().and_then(|steps| steps.parse().ok()).unwrap_or(steps));
            }
            _ => {}
        }
    }
}

type Case = (&'static str, fn() -> Scene, usize);

fn scenes() -> [Case; 4] {
    [
        ("pileup-1000", || pileup(1_000), 300),
        ("pileup-10000", || pileup(10_000), 120),
        ("pileup-100000", || pileup(100_000), 30),
        ("pyramid-100", || pyramid(100), 100),
    ]
}

fn measure(name: &str, scene: &Scene, steps: usize) {
    let mut world = World::new(scene).expect("a valid scene");
    let (mut whole, mut finding, mut touches) = (Vec::new(), Vec::new(), 0);
    for _ in 0..steps {
        whole.push(timed(|| world.step()));
        finding.push(timed(|| touches = world.find_touches()));
    }
    let [(best, middle), (best_find, middle_find)] = [whole, finding].map(best_and_middle);
    println!(
        "{name:<14} whole {best:8.3} {middle:8.3}   find {best_find:8.3} {middle_find:8.3}   {touches} touches, {} hits, digest {:016x}",
        world.collisions(),
        world.digest()
    );
}

fn timed(work: impl FnOnce()) -> f64 {
    let since = clock::cpu();
    work();
    (clock::cpu() - since).as_secs_f64() * 1e3
}

/// The first step, which allocates, is left out.
fn best_and_middle(mut times: Vec<f64>) -> (f64, f64) {
    times.remove(0);
    times.sort_by(f64::total_cmp);
    (times.first().copied().unwrap_or(f64::NAN), times.get(times.len() / 2).copied().unwrap_or(f64::NAN))
}

/// The arena, as the impulse exchange has it.
fn pileup(count: usize) -> Scene {
    let mut scene = arena::arena(count, BroadPhaseChoice::Auto);
    let settings = Settings { friction: 0.3, restitution: 0.5, drag: (0.1, 0.0), ..scene.settings };
    scene.settings = Settings { exchange: ExchangeRule::Impulse, time_step: 1.0 / 60.0, ..settings };
    scene
}

/// Boxes of 1 m, `base` in the lowest row and one fewer in each above it, on the ground.
fn pyramid(base: usize) -> Scene {
    let mut bodies = vec![arena::rectangle("ground".to_owned(), Kind::Fixed, 4.0 * base as f64, 2.0)];
    bodies[0].at = (0.0, -1.0);
    for row in 0..base {
        for k in 0..base - row {
            let mut body: Body = arena::rectangle(format!("{row}_{k}"), Kind::Mobile, 1.0, 1.0);
            body.at = (0.5 * (row as f64 + 1.0 - base as f64) + k as f64, row as f64 + 0.5);
            bodies.push(body);
        }
    }
    let settings =
        Settings { exchange: ExchangeRule::Impulse, friction: 0.6, gravity: (0.0, -10.0), ..Settings::default() };
    Scene { settings: Settings { time_step: 1.0 / 60.0, ..settings }, bodies, ..Scene::default() }
}

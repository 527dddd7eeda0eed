//! What must hold of every scene whatever it shows: the same bits where nothing that matters changed, and results
//! that move, turn or grow exactly as the scene does.
//!
//! Scenes are taken from every scenario and run without its callbacks, fewer iterations where they are large.

use std::path::Path;

use choque::harness::cases;
use choque_engine::area::Vec2;
use choque_engine::scene::{Body, BroadPhaseChoice, Part};
use choque_engine::{BodyId, Extent, Rect, Scene, World};
use choque_scripting::{Options, Overrides, Scenario, Step};

use crate::support::iterations_within;

/// Bodies times iterations of one run; fewer where nothing is optimised for speed, so that all tests stay a matter of minutes.
const BUDGET: u64 = if cfg!(debug_assertions) { 4_000 } else { 15_000 };

fn iterations(scene: &Scene) -> u64 {
    iterations_within(BUDGET, scene)
}

/// Checks every scenario; fails with all that do not hold.
fn of_every_scenario(check: impl Fn(&Path, &Scenario) -> Result<(), String>) {
    let cases = cases(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the folder can be read");
    assert!(!cases.is_empty(), "there are no scenarios");
    let failures: Vec<String> = cases
        .iter()
        .filter_map(|case| {
            let scenario = Scenario::load(&case.script, &Options::default()).map_err(|error| error.to_string());
            let checked = scenario.and_then(|scenario| check(&case.script, &scenario));
            checked.err().map(|why| format!("{}: {why}", case.name()))
        })
        .collect();
    assert!(failures.is_empty(), "{} of {} scenarios:\n{}", failures.len(), cases.len(), failures.join("\n"));
}

fn of_every_scene(check: impl Fn(&Scene) -> Result<(), String>) {
    of_every_scenario(|_, scenario| check(scenario.scene()));
}

fn world(scene: &Scene) -> Result<World, String> {
    World::new(scene).map_err(|error| error.to_string())
}

/// The world after so many iterations, without callbacks.
fn ran(scene: &Scene, iterations: u64) -> Result<World, String> {
    let mut world = world(scene)?;
    for _ in 0..iterations {
        world.step();
    }
    match world.fault() {
        Some(fault) => Err(fault.to_string()),
        None => Ok(world),
    }
}

fn same<T: PartialEq + std::fmt::Debug>(what: &str, found: &T, expected: &T) -> Result<(), String> {
    if found == expected { Ok(()) } else { Err(format!("{what}: {found:?} instead of {expected:?}")) }
}

#[test]
fn both_broad_phases_give_the_same_bits() {
    of_every_scene(|scene| {
        let with = |broad_phase| {
            let mut scene = scene.clone();
            scene.settings.broad_phase = broad_phase;
            ran(&scene, iterations(&scene))
        };
        let (all_pairs, strips) = (with(BroadPhaseChoice::AllPairs)?, with(BroadPhaseChoice::Strips)?);
        same("collisions", &strips.collisions(), &all_pairs.collisions())?;
        same("deepest overlap", &strips.deepest(), &all_pairs.deepest())?;
        same("digest", &strips.digest(), &all_pairs.digest())
    });
}

#[test]
fn names_and_labels_change_nothing() {
    of_every_scene(|scene| {
        let mut renamed = scene.clone();
        for (i, body) in renamed.bodies.iter_mut().enumerate() {
            body.name = format!("{:x}", i.wrapping_mul(0x9e37_79b9)); // in another order when sorted
            body.tags = vec!["renamed".to_owned()];
        }
        let iterations = iterations(scene);
        same("digest", &ran(&renamed, iterations)?.digest(), &ran(scene, iterations)?.digest())
    });
}

#[test]
fn a_run_in_two_halves_gives_the_same_bits() {
    of_every_scene(|scene| {
        let iterations = iterations(scene);
        let mut first = ran(scene, iterations / 2)?;
        let mut second = first.clone();
        let parted = first.digest();
        for _ in iterations / 2..iterations {
            second.step();
        }
        same("digest of the first half after the second ran", &first.digest(), &parted)?;
        let whole = ran(scene, iterations)?.digest();
        same("digest of the second half", &second.digest(), &whole)?;
        for _ in iterations / 2..iterations {
            first.step();
        }
        same("digest of the first half run on", &first.digest(), &whole)
    });
}

/// Digest and collisions of a scenario with its callbacks.
fn with_callbacks(script: &Path, overrides: Overrides) -> Result<(u64, u64), String> {
    let options = Options { overrides, ..Options::default() };
    let play = || {
        let mut run = Scenario::load(script, &options)?.start()?;
        while run.world().iteration() < run.world().plan().steps && run.step()? == Step::Going {}
        Ok((run.world().digest(), run.world().collisions()))
    };
    play().map_err(|error: choque_scripting::Diagnostic| error.to_string())
}

#[test]
fn a_scenario_played_again_gives_the_same_bits_under_either_broad_phase() {
    of_every_scenario(|script, scenario| {
        let steps = Some(iterations(scenario.scene()).min(300));
        let play = |broad_phase| with_callbacks(script, Overrides { steps, broad_phase, ..Overrides::default() });
        let once = play(None)?;
        same("digest and collisions, again", &play(None)?, &once)?;
        same("digest and collisions, all pairs", &play(Some(BroadPhaseChoice::AllPairs))?, &once)?;
        same("digest and collisions, strips", &play(Some(BroadPhaseChoice::Strips))?, &once)
    });
}

/// Applies to every place a scene names: where bodies stand and where patrols turn.
fn map_places(scene: &mut Scene, map: impl Fn((f64, f64)) -> (f64, f64)) {
    for body in &mut scene.bodies {
        body.at = map(body.at);
        for point in body.patrol.iter_mut().flat_map(|patrol| &mut patrol.points) {
            *point = map(*point);
        }
    }
}

/// A power of two by which a scene may be shifted without losing a bit: 2²⁰ m, or more than the cells that the
/// engine counts a larger scene's coordinates from.
fn shift_for(scene: &Scene) -> f64 {
    let furthest = scene.bodies.iter().map(|body| body.at.0.abs().max(body.at.1.abs())).fold(1.0, f64::max);
    let mut shift = 1_048_576.0;
    while shift < 64.0 * furthest {
        shift *= 2.0;
    }
    shift
}

#[test]
fn a_scene_shifted_by_a_thousand_kilometres_moves_the_same() {
    const GRAIN: f64 = 1_048_576.0; // places on multiples of 2⁻²⁰ m can be shifted without rounding
    of_every_scene(|scene| {
        let mut near = scene.clone();
        map_places(&mut near, |(x, z)| ((x * GRAIN).round() / GRAIN, (z * GRAIN).round() / GRAIN));
        let shift = Vec2::new(shift_for(&near), -2.0 * shift_for(&near));
        let mut far = near.clone();
        map_places(&mut far, |(x, z)| (x + shift.x, z + shift.y));

        let (near, far) = (ran(&near, iterations(scene))?, ran(&far, iterations(scene))?);
        same("collisions", &far.collisions(), &near.collisions())?;
        same("deepest overlap", &far.deepest(), &near.deepest())?;
        for id in near.ids() {
            let motion = |world: &World| (world.velocity(id), world.spin(id), world.angle(id));
            same(near.name(id), &motion(&far), &motion(&near))?;
            shifted_exactly(&near, &far, id, shift)?;
        }
        Ok(())
    });
}

/// A place is the engine's own coordinate plus its origin, rounded once: exactly what adding the shift here gives,
/// unless the unshifted scene had been rounded already.
fn shifted_exactly(near: &World, far: &World, id: BodyId, shift: Vec2) -> Result<(), String> {
    let (expected, found) = (near.position(id) + shift, far.position(id));
    if near.plan().origin == Vec2::zeros() {
        return same(&format!("{}'s place", near.name(id)), &found, &expected);
    }
    let rounding = f64::EPSILON * (shift.x.abs() + shift.y.abs() + expected.norm());
    if (found - expected).norm() <= rounding {
        Ok(())
    } else {
        Err(format!("{}'s place: {found:?} instead of {expected:?}", near.name(id)))
    }
}

/// The scene twice as large in every length; times, angles, masses and coefficients as they are.
fn doubled(scene: &Scene) -> Scene {
    let twice = |(x, z): (f64, f64)| (2.0 * x, 2.0 * z);
    let mut scene = scene.clone();
    map_places(&mut scene, twice);
    scene.settings.epsilon *= 2.0;
    scene.settings.plane *= 2.0;
    scene.settings.gravity = twice(scene.settings.gravity);
    for body in &mut scene.bodies {
        double_body(body);
    }
    scene
}

fn double_body(body: &mut Body) {
    let twice = |(x, z): (f64, f64)| (2.0 * x, 2.0 * z);
    body.height *= 2.0;
    body.velocity = body.velocity.map(twice);
    body.inertia = body.inertia.map(|inertia| 4.0 * inertia);
    if let Some(patrol) = &mut body.patrol {
        patrol.speed *= 2.0;
    }
    for part in &mut body.parts {
        *part = match *part {
            Part::Rect(r) => Part::Rect(Rect {
                x_min: 2.0 * r.x_min,
                x_max: 2.0 * r.x_max,
                z_min: 2.0 * r.z_min,
                z_max: 2.0 * r.z_max,
            }),
            Part::Mesh(m) => Part::Mesh(Extent { x: twice(m.x), y: twice(m.y), z: twice(m.z) }),
        };
    }
}

#[test]
fn a_scene_twice_as_large_moves_twice_as_far() {
    of_every_scene(|scene| {
        let (small, large) = (ran(scene, iterations(scene))?, ran(&doubled(scene), iterations(scene))?);
        same("collisions", &large.collisions(), &small.collisions())?;
        same("deepest overlap", &large.deepest(), &(2.0 * small.deepest()))?;
        same("kinetic energy", &large.kinetic_energy(), &(4.0 * small.kinetic_energy()))?;
        for id in small.ids() {
            let name = small.name(id);
            same(name, &large.position(id), &(small.position(id) * 2.0))?;
            same(name, &large.velocity(id), &(small.velocity(id) * 2.0))?;
            // The least numbers there are do not scale.
            let turns = |world: &World| [world.angle(id), world.spin(id)].map(|x| if x.is_normal() { x } else { 0.0 });
            same(name, &turns(&large), &turns(&small))?;
        }
        Ok(())
    });
}

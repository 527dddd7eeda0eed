//! What each thing costs where a scene has it, and that it costs nothing where it does not:
//! `cargo bench --bench needs`.

mod arena;

use choque_engine::World;
use choque_engine::scene::{BroadPhaseChoice, Kind, Scene, Swing};
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};

const COUNT: usize = 10_000;

/// The field with something changed, and its counted work of ten iterations beside the time.
fn measure(criterion: &mut Criterion, name: &str, change: impl FnOnce(&mut Scene)) {
    let mut scene = arena::arena(COUNT, BroadPhaseChoice::Auto);
    change(&mut scene);
    measure_from(criterion, name, &World::new(&scene).expect("a valid scene"));
}

fn measure_from(criterion: &mut Criterion, name: &str, start: &World) {
    let run = |mut world: World| {
        (0..10).for_each(|_| world.step());
        world
    };
    let work = *run(start.clone()).work();
    eprintln!(
        "{name}: {} advanced, {} with forces, {} prescribed, {} bounds, {} pairs tested",
        work.bodies_advanced, work.bodies_forced, work.prescribed, work.bounds, work.pairs_tested
    );
    criterion.bench_function(name, |bencher| bencher.iter_batched(|| start.clone(), run, BatchSize::PerIteration));
}

fn only_flight(scene: &mut Scene) {
    scene.bodies.retain(|body| body.kind == Kind::Mobile);
    for body in &mut scene.bodies {
        off_the_plane(body);
    }
}

/// Turns a rectangle into a mesh that stands above the plane.
fn off_the_plane(body: &mut choque_engine::scene::Body) {
    use choque_engine::{Extent, scene::Part};
    body.parts = vec![Part::Mesh(Extent { x: (-1.0, 1.0), y: (0.0, 1.0), z: (-0.5, 0.5) })];
    body.height = 10.0;
}

fn needs(criterion: &mut Criterion) {
    measure(criterion, "flight alone: nothing is collidable", only_flight);
    measure(criterion, "flight alone, at rest without spin", |scene| {
        only_flight(scene);
        scene.bodies.iter_mut().for_each(|body| body.spin = Some(0.0));
    });
    measure(criterion, "flight alone, with gravity and drag", |scene| {
        only_flight(scene);
        scene.settings.gravity = (0.0, -9.81);
        scene.settings.drag = (0.1, 0.1);
    });
    measure(criterion, "the field", |_| {});
    let mut field = World::new(&arena::arena(COUNT, BroadPhaseChoice::Auto)).expect("a valid scene");
    field.keep_ledger();
    measure_from(criterion, "the field, its ledger kept", &field);
    measure(criterion, "the field, friction and restitution set but not used", |scene| {
        scene.settings.friction = 0.5;
        scene.settings.restitution = 0.5;
    });
    measure(criterion, "the field, with gravity and drag", |scene| {
        scene.settings.gravity = (0.0, -9.81);
        scene.settings.drag = (0.1, 0.1);
    });
    measure(criterion, "the field, its walls swinging", |scene| {
        for wall in scene.bodies.iter_mut().filter(|body| body.kind == Kind::Fixed) {
            wall.swing = Some(Swing { angle: 1e-3, period: 1.0 });
        }
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = needs
}
criterion_main!(benches);

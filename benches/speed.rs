//! How fast an iteration is, and how its cost grows: `cargo bench --bench speed`.
//!
//! Every figure is the time of the first 60 iterations of the field in `arena`, under the document's model, on
//! one thread; divide by 60 for an iteration. The digests show that a faster version still gives the same bits.

mod arena;

use choque_engine::World;
use choque_engine::scene::BroadPhaseChoice;
use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

/// Long enough that the field is well mixed, short enough for 100,000 bodies.
const ITERATIONS: usize = 60;

fn run(mut world: World) -> World {
    (0..ITERATIONS).for_each(|_| world.step());
    world
}

fn world(count: usize, broad_phase: BroadPhaseChoice) -> World {
    World::new(&arena::arena(count, broad_phase)).expect("a valid scene")
}

/// Growth from 100 to 100,000 bodies.
fn growth(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("60 iterations");
    group.sample_size(20);
    for count in [100, 1_000, 10_000, 100_000] {
        let start = world(count, BroadPhaseChoice::Auto);
        let end = run(start.clone());
        eprintln!("{count} boxes: {} collisions, digest {:016x}", end.collisions(), end.digest());
        group.throughput(Throughput::Elements((ITERATIONS * count) as u64));
        group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
            bencher.iter_batched(|| start.clone(), run, BatchSize::PerIteration);
        });
    }
    group.finish();
}

/// From how many bodies on the sweep is cheaper than testing every pair: the plan's choice rests on it.
fn crossover(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("crossover");
    group.sample_size(20);
    for count in [1, 2, 3, 4, 8, 32] {
        for choice in [BroadPhaseChoice::AllPairs, BroadPhaseChoice::Strips] {
            let start = world(count, choice);
            group.bench_function(BenchmarkId::new(choice.word(), count), |bencher| {
                bencher.iter_batched(|| start.clone(), run, BatchSize::SmallInput);
            });
        }
    }
    group.finish();
}

criterion_group!(speed, growth, crossover);
criterion_main!(speed);

//! A step allocates nothing once it is warm, and a body costs at most 500 bytes all in.

use std::alloc::{GlobalAlloc, Layout, System};
use std::f64::consts::FRAC_PI_2;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use choque_engine::scene::{Body, Kind, Part, Scene, Settings};
use choque_engine::{Rect, World};

/// Counts what goes through the system's allocator.
struct Counting;

static CALLS: AtomicUsize = AtomicUsize::new(0);
static LIVE: AtomicUsize = AtomicUsize::new(0);

#[global_allocator]
static ALLOCATOR: Counting = Counting;

// SAFETY: every call is handed to the system's allocator unchanged; the counters allocate nothing.
#[allow(unsafe_code, reason = "a counting allocator has to be one")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        CALLS.fetch_add(1, Relaxed);
        LIVE.fetch_add(layout.size(), Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        LIVE.fetch_sub(layout.size(), Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }
}

/// A walled field of cars with enough loss that it neither heats up nor goes quiet.
fn field(side: u32) -> Scene {
    let mut bodies = Vec::new();
    let length = f64::from(side) * 2.6;
    for (i, (x, z, angle)) in
        [(0.5, 0.0, 0.0), (0.5, 1.0, 0.0), (0.0, 0.5, FRAC_PI_2), (1.0, 0.5, FRAC_PI_2)].into_iter().enumerate()
    {
        let mut wall = Body::new(format!("wall{i}"), Kind::Fixed);
        wall.parts.push(Part::Rect(Rect::centred(length + 2.0, 0.5)));
        wall.at = (x * length, z * length);
        wall.angle = angle;
        bodies.push(wall);
    }
    for i in 0..side * side {
        let mut car = Body::new(format!("car{i}"), Kind::Mobile);
        car.parts.push(Part::Rect(Rect::centred(2.0, 1.0)));
        car.at = ((f64::from(i % side) + 0.5) * 2.6, (f64::from(i / side) + 0.5) * 2.6);
        let heading = f64::from(i.wrapping_mul(2_654_435_761) % 6283) * 1e-3;
        car.angle = 0.3 * heading;
        car.velocity = Some((5.0 * libm::cos(heading), 5.0 * libm::sin(heading)));
        bodies.push(car);
    }
    let settings = Settings { mu_l: 0.7, mu_a: 0.7, ..Settings::default() };
    Scene { settings, bodies, ..Scene::default() }
}

/// One test, for the counters belong to the whole process.
#[test]
fn a_warm_step_allocates_nothing_and_a_body_is_small() {
    let side = 100;
    let before = LIVE.load(Relaxed);
    let mut world = {
        let scene = field(side);
        World::new(&scene).expect("a valid scene")
    };
    (0..120).for_each(|_| world.step());
    let per_body = (LIVE.load(Relaxed) - before) as f64 / f64::from(side * side);
    assert!(per_body <= 500.0, "{per_body} bytes per body");

    let (calls, collisions) = (CALLS.load(Relaxed), world.collisions());
    (0..120).for_each(|_| world.step());
    assert!(world.collisions() > collisions + 1000, "a quiet field shows nothing");
    assert_eq!(CALLS.load(Relaxed) - calls, 0, "allocations in 120 warm steps");
    println!("{per_body:.0} bytes per body");
}

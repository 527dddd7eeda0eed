//! A thousand random scenes: the sweep in strips finds what testing every pair finds, to the bit.

use choque_engine::detect::deepest::{Depths, Poses};
use choque_engine::scene::{
    Body, BroadPhaseChoice, Detection, ExchangeRule, Kind, Part, Patrol, Scene, Settings, Swing,
};
use choque_engine::{Rect, World};

/// SplitMix64 (Steele, Lea, Flood 2014): all the randomness these tests need.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From `least` up to `greatest`.
    pub(crate) fn between(&mut self, least: f64, greatest: f64) -> f64 {
        least + (greatest - least) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    pub(crate) fn one_in(&mut self, n: u64) -> bool {
        self.next().is_multiple_of(n)
    }
}

/// A scene of 2 to 60 bodies of all sorts and sizes, some of them touching exactly, some far away.
pub(crate) fn random_scene(seed: u64) -> Scene {
    let mut random = Random(seed);
    let count = 2 + random.next() % 59;
    let arena = random.between(2.0, 30.0);
    let away = if random.one_in(4) { 1e6 } else { 0.0 };
    let bodies = (0..count).map(|i| random_body(&mut random, i, arena, away)).collect();
    let (exchange, detection) = models(seed);
    let settings = Settings {
        exchange,
        detection,
        restitution: 0.8,
        friction: 0.3,
        time_step: 1.0 / 60.0,
        mu_l: random.between(0.0, 1.0),
        mu_a: random.between(0.0, 1.0),
        drag: if random.one_in(2) { (random.between(0.0, 2.0), random.between(0.0, 2.0)) } else { (0.0, 0.0) },
        ..Settings::default()
    };
    Scene { settings, bodies, ..Scene::default() }
}

/// Most scenes run the document's model, the rest every other pairing of exchange and detection.
fn models(seed: u64) -> (ExchangeRule, Option<Detection>) {
    match seed % 10 {
        7 => (ExchangeRule::Document, Some(Detection::Complete)),
        8 => (ExchangeRule::Impulse, None),
        9 => (ExchangeRule::Impulse, Some(Detection::Vertices)),
        _ => (ExchangeRule::Document, None),
    }
}

fn random_body(random: &mut Random, i: u64, arena: f64, away: f64) -> Body {
    let kind = if random.one_in(4) { Kind::Fixed } else { Kind::Mobile };
    let mut body = Body::new(format!("b{i}"), kind);
    let long = kind == Kind::Fixed && random.one_in(2);
    for _ in 0..if random.one_in(5) { 3 } else { 1 } {
        body.parts.push(Part::Rect(random_rect(random, long)));
    }
    body.at = (away + random.between(-arena, arena), random.between(-arena, arena));
    if random.one_in(3) {
        body.at = (away + libm::round(body.at.0 - away), libm::round(body.at.1)); // exact touches
    } else {
        body.angle = random.between(-4.0, 4.0);
    }
    body.mass = Some(random.between(0.2, 5.0));
    match kind {
        Kind::Mobile => {
            body.velocity = Some((random.between(-9.0, 9.0), random.between(-9.0, 9.0)));
            body.spin = Some(random.between(-5.0, 5.0));
        }
        Kind::Fixed if random.one_in(4) => {
            body.patrol =
                Some(Patrol { points: vec![(away, 1.5), (away + 3.0, -2.0)], speed: random.between(0.5, 6.0) });
        }
        Kind::Fixed if random.one_in(3) => body.swing = Some(Swing { angle: 1.0, period: random.between(0.5, 3.0) }),
        Kind::Fixed if random.one_in(2) => body.spin = Some(random.between(-6.0, 6.0)),
        Kind::Fixed => {}
    }
    body
}

fn random_rect(random: &mut Random, long: bool) -> Rect {
    if long {
        return Rect::centred(random.between(10.0, 80.0), random.between(0.05, 0.5));
    }
    if random.one_in(3) {
        return Rect::centred(1.0, 1.0);
    }
    let (x_min, z_min) = (random.between(-2.0, 0.5), random.between(-2.0, 0.5));
    Rect { x_min, x_max: x_min + random.between(0.1, 3.0), z_min, z_max: z_min + random.between(0.1, 3.0) }
}

fn world(scene: &Scene, broad_phase: BroadPhaseChoice) -> World {
    let settings = Settings { broad_phase, ..scene.settings.clone() };
    World::new(&Scene { settings, ..scene.clone() }).expect("a valid scene")
}

#[test]
fn strips_find_what_all_pairs_find() {
    let mut collisions = 0;
    for seed in 0..1000 {
        let scene = random_scene(seed);
        let mut every = world(&scene, BroadPhaseChoice::AllPairs);
        let mut swept = world(&scene, BroadPhaseChoice::Strips);
        for step in 0..60 {
            every.step();
            swept.step();
            assert_eq!(every.digest(), swept.digest(), "scene {seed} parted in step {step}");
            assert_eq!(every.fault(), swept.fault(), "scene {seed}");
        }
        assert_eq!(every.work().pairs_listed, swept.work().pairs_listed, "scene {seed}");
        collisions += every.collisions();
    }
    assert!(collisions > 50_000, "scenes in which little happens show little: {collisions} collisions");
}

#[test]
fn a_search_that_is_kept_finds_the_deepest_overlap_that_a_fresh_one_finds() {
    let mut deep = 0;
    for seed in 0..200 {
        let mut world = world(&random_scene(seed), BroadPhaseChoice::Strips);
        let (mut kept, mut poses) = (Depths::of(&world), Poses::default());
        for step in 0..30 {
            world.step();
            world.take_poses(&mut poses);
            let fresh = world.deepest();
            assert_eq!(kept.deepest(&poses).to_bits(), fresh.to_bits(), "scene {seed}, step {step}");
            deep += u32::from(fresh > 0.0);
        }
    }
    assert!(deep > 1000, "{deep}");
}

#[test]
fn a_copy_made_halfway_runs_on_to_the_same_bits() {
    for seed in 0..50 {
        let mut world = world(&random_scene(seed), BroadPhaseChoice::Strips);
        (0..37).for_each(|_| world.step());
        let mut copy = world.clone();
        (0..41).for_each(|_| world.step());
        (0..41).for_each(|_| copy.step());
        assert_eq!(world.digest(), copy.digest(), "scene {seed}");
    }
}

/// The digests of ten scenes, of every model, after 200 steps, whatever the profile: debug, release, no optimisation at all.
#[test]
fn every_profile_gives_the_same_bits() {
    let digests: Vec<String> = (0..10)
        .map(|seed| {
            let mut world = world(&random_scene(seed), BroadPhaseChoice::Auto);
            (0..200).for_each(|_| world.step());
            format!("{:016x}", world.digest())
        })
        .collect();
    assert_eq!(digests, PINNED);
}

const PINNED: [&str; 10] = [
    "0558ffc1f9e634e5",
    "6803d93c3976950f",
    "926a5ae60a713ea3",
    "c14bb9512637ce00",
    "afa41a04a3b0dcd5",
    "3b2136f5bb27ad1f",
    "3db1f406224e9862",
    "06a15a67339e7727",
    "8dfed2d2de0cd376",
    "d8053e999405d404",
];

//! The search and the look at eight pairs abreast are held to the plain way: every pair, one after the other.

use super::Contacts;
use super::swept::ROOM;
use super::touch::Touch;
use crate::advance::frame_before;
use crate::area::{Rect, Vec2};
use crate::broad_phase::bounds::sweep;
use crate::broad_phase::met::Bounds;
use crate::detect::manifold::Placed;
use crate::detect::overlap;
use crate::flight::{Path, Pull};
use crate::plan::BroadPhasePlan;
use crate::scene::{Body, BroadPhaseChoice, ExchangeRule, Kind, Part, Scene, Settings};
use crate::width::Width;
use crate::world::World;

/// All touches of a step, as they are meant.
fn plainly(world: &World, contacts: &Contacts, dt: f64) -> Vec<Touch> {
    let bodies = &world.bodies;
    let earlier = |body: usize| frame_before(bodies, world.plan.flight, dt, body);
    let all: Vec<Placed> = (0..bodies.len()).flat_map(|body| Placed::all(bodies, body)).collect();
    let bounds = all.iter().map(|placed| {
        let (low, high) = sweep(&Path::of(bodies, &contacts.pulls.all(), placed.body), placed.rect, dt);
        let room = Vec2::repeat(ROOM * placed.rect.half().min());
        let (low, high) = (low - room, high + room);
        Bounds([low.x, low.y, high.x, high.y])
    });
    let bounds: Vec<Bounds> = bounds.collect();
    let mut touches = Vec::new();
    for (i, one) in all.iter().enumerate() {
        for (j, two) in all.iter().enumerate().skip(i + 1) {
            let can = one.body != two.body && (bodies.is_mobile(one.body) || bodies.is_mobile(two.body));
            if !can || !bounds[i].meet(&bounds[j]) {
                continue;
            }
            let [path, other] = [one, two].map(|placed| Path::of(bodies, &contacts.pulls.all(), placed.body));
            let margin = path.closing(&other, one.rect.far(), two.rect.far(), dt)
                + ROOM * (one.rect.half().min() + two.rect.half().min());
            let last = contacts.touches.iter().find(|touch| touch.rects == (i as u32, j as u32));
            touches.extend(Touch::find(bodies, (*one, *two), margin, last, earlier));
        }
    }
    touches
}

/// Numbers in 0 … 1, of no pattern.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f64 / (1u64 << 24) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// A crowd: piles of boxes face to face, turned ones, some in each other, compound ones, walls and specks among them; at rest or
/// fast, with or without gravity and drag, near the origin or far from it.
fn crowd(seed: u64) -> Scene {
    let mut numbers = Numbers(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) + 1);
    let far = if seed % 5 == 4 { 1e5 } else { 0.0 };
    let mut bodies = Vec::new();
    let mut add = |kind, at: (f64, f64), size: (f64, f64), change: &mut dyn FnMut(&mut Body)| {
        let mut body = Body::new(format!("b{}", bodies.len()), kind);
        body.parts.push(Part::Rect(Rect::centred(size.0, size.1)));
        body.at = (at.0 + far, at.1);
        change(&mut body);
        bodies.push(body);
    };
    let speed = if seed.is_multiple_of(3) { 0.0 } else { 20.0 };
    for k in 0..3 {
        add(Kind::Fixed, (4.0 * f64::from(k) - 4.0, -0.5), (4.0, 1.0), &mut |_| {});
    }
    add(Kind::Fixed, (0.0, 6.0), (30.0, 0.2), &mut |wall| wall.angle = 0.7);
    for k in 0..20 {
        let (column, row) = (f64::from(k % 5), f64::from(k / 5));
        add(Kind::Mobile, (column - 2.0 + 0.5 * (row % 2.0), row + 0.5), (1.0, 1.0), &mut |_| {});
    }
    for k in 0..40 {
        let at = (numbers.within(-6.0, 6.0), numbers.within(0.0, 9.0));
        let size = if k % 8 == 0 { 1e-3 } else { numbers.within(0.3, 1.5) };
        let (angle, v) = (numbers.within(-3.0, 3.0), (numbers.next() * speed, -numbers.next() * speed));
        let spin = numbers.within(-3.0, 3.0) * speed;
        add(Kind::Mobile, at, (size, 0.6 * size), &mut |body| {
            body.angle = angle;
            (body.velocity, body.spin) = (Some(v), Some(spin));
            if k % 6 == 1 {
                let arm = Rect { x_min: -0.1, x_max: 0.1, z_min: -size, z_max: size };
                body.parts.push(Part::Rect(arm));
            }
        });
    }
    let gravity = if seed.is_multiple_of(2) { (0.0, -10.0) } else { (0.0, 0.0) };
    let drag = if seed.is_multiple_of(7) { (0.3, 0.1) } else { (0.0, 0.0) };
    let settings = Settings { exchange: ExchangeRule::Impulse, friction: 0.4, gravity, drag, ..Settings::default() };
    Scene { settings, bodies, ..Scene::default() }
}

/// Two rectangles do not touch within the time, fly as they may: under what pulls at each, or held against it.
fn assert_stay_apart(world: &World, contacts: &Contacts, pair: (u32, u32), dt: f64) {
    let all: Vec<Placed> = (0..world.len()).flat_map(|body| Placed::all(&world.bodies, body)).collect();
    let pair = [all[pair.0 as usize], all[pair.1 as usize]];
    for held in 0..4 {
        let paths = [0, 1].map(|side| {
            let path = Path::of(&world.bodies, &contacts.pulls.all(), pair[side].body);
            if held >> side & 1 == 1 { Path { pull: Pull::NONE, ..path } } else { path }
        });
        for k in 0..=16 {
            let frames = paths.map(|path| path.after(f64::from(k) / 16.0 * dt).frame);
            let depth = overlap::depth(&frames[0], pair[0].rect, &frames[1], pair[1].rect);
            assert!(depth <= 1e-9, "{:?} and {:?} are {depth:e} m deep, {k}/16 on", pair[0].index, pair[1].index);
        }
    }
}

/// At any width, by grids or by all pairs, through the steps of many crowds.
#[test]
fn touches_are_found_as_by_the_plain_way() {
    let (mut count, mut deep, mut left) = (0, 0, 0);
    for seed in 0..32 {
        let mut scene = crowd(seed);
        scene.settings.broad_phase = BroadPhaseChoice::Strips;
        let mut world = World::new(&scene).expect("a valid scene");
        let dt = world.plan.time_step;
        for step in 0..12 {
            let mut contacts = *world.contacts.clone().expect("it has contacts");
            contacts.pull(&world);
            let plain = plainly(&world, &contacts, dt);
            for width in Width::available() {
                for plan in [world.plan.broad_phase, BroadPhasePlan::AllPairs] {
                    let (mut contacts, mut world) = (contacts.clone(), world.clone());
                    (contacts.width, world.plan.broad_phase) = (width, plan);
                    contacts.find(&mut world, dt);
                    let apart = contacts.apart.pairs();
                    let is_apart = |touch: &&Touch| apart.binary_search(&touch.rects).is_ok();
                    let plain: Vec<Touch> = plain.iter().filter(|touch| !is_apart(touch)).copied().collect();
                    assert_eq!(contacts.touches, plain, "scene {seed}, step {step}, {width:?}, {plan}");
                    if width == Width::best() && plan != BroadPhasePlan::AllPairs {
                        apart.iter().for_each(|pair| assert_stay_apart(&world, &contacts, *pair, dt));
                        left += apart.len();
                    }
                }
            }
            count += plain.len();
            deep += plain.iter().filter(|touch| touch.gap[0] < -0.1).count();
            world.step();
        }
    }
    assert!(count > 20_000 && deep > 500, "{count} touches, {deep} of them deep: crowds in which little is found");
    assert!(left > 4_000, "{left} pairs that stay apart: crowds in which all touch");
}

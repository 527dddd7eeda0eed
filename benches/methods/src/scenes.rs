//! The scenes, each with what is known of it.

use choque_engine::area::Vec2;

use crate::world::{Body, World};

/// Seconds a step.
pub(crate) const DT: f64 = 1.0 / 60.0;

/// A scene.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    pub(crate) name: String,
    pub(crate) world: World,
    pub(crate) steps: usize,
    pub(crate) known: Known,
}

/// What its exact answer is.
#[derive(Clone, Debug)]
pub(crate) enum Known {
    /// All stays where it is. For scenes that are their own mirror image about x = 0: pairs of images.
    Stands(Vec<(usize, usize)>),
    /// As it stands, but the last body ends so much lower, m.
    Sinks(f64, Vec<(usize, usize)>),
    /// The last body rises so high above where it started to touch, m; the others stay.
    Apex(f64),
    /// The last body ends so far from its start, m.
    Moves(f64),
    /// Nothing but that nothing escapes.
    Stays,
}

/// Square boxes in so many rows, each in exact contact with its neighbours.
pub(crate) fn pyramid(base: usize) -> Scene {
    let mut bodies = vec![ground(0.6 * base as f64 + 10.0)];
    let mut images = Vec::new();
    for row in 0..base {
        let count = base - row;
        let first = bodies.len();
        for k in 0..count {
            let x = k as f64 - 0.5 * (count - 1) as f64;
            bodies.push(Body::mobile(Vec2::new(0.5, 0.5), Vec2::new(x, row as f64 + 0.5), 1.0));
        }
        images.extend((0..count.div_ceil(2)).map(|k| (first + k, first + count - 1 - k)));
    }
    scene(&format!("pyramid {base}"), bodies, 0.6, 500, Known::Stands(images))
}

/// The same with its rows so far apart, to be dropped.
pub(crate) fn dropped(base: usize, gap: f64) -> Scene {
    let mut scene = pyramid(base);
    for body in scene.world.bodies.iter_mut().skip(1) {
        body.x.y += gap * (body.x.y - 0.5);
    }
    if let Known::Stands(images) = scene.known {
        scene.known = Known::Sinks(gap * (base - 1) as f64, images);
    }
    scene.name = format!("dropped pyramid {base}");
    scene
}

/// Boxes of given half sizes and densities one on another.
pub(crate) fn stack(name: &str, boxes: &[(f64, f64)], friction: f64, steps: usize) -> Scene {
    let widest = boxes.iter().map(|(half, _)| *half).fold(1.0, f64::max);
    let mut bodies = vec![ground(2.0 * widest)];
    let mut top = 0.0;
    for (half, density) in boxes {
        bodies.push(Body::mobile(Vec2::new(*half, *half), Vec2::new(0.0, top + half), *density));
        top += 2.0 * half;
    }
    let images = (1..bodies.len()).map(|body| (body, body)).collect();
    scene(name, bodies, friction, steps, Known::Stands(images))
}

/// Unit boxes, offset a little to the left and to the right by turns.
pub(crate) fn leaning(count: usize) -> Scene {
    let mut scene = stack(&format!("stack {count}, offset"), &vec![(0.5, 1.0); count], 0.3, 600);
    for (k, body) in scene.world.bodies.iter_mut().enumerate().skip(1) {
        body.x.x = if k % 2 == 0 { 0.01 } else { -0.01 };
    }
    scene.known = Known::Stands(Vec::new());
    scene
}

/// A box dropped flat from 1 m beside a stack of five.
pub(crate) fn drop(restitution: f64) -> Scene {
    let mut scene = stack(&format!("drop, e = {restitution}"), &[(0.5, 1.0); 5], 0.6, 200);
    scene.world.bodies.push(Body::mobile(Vec2::new(0.5, 0.5), Vec2::new(3.0, 1.5), 1.0));
    scene.world.bodies[0].half.x = 10.0;
    scene.world.restitution = restitution;
    scene.known = Known::Apex(restitution * restitution);
    scene
}

/// A block slides to rest from 5 m/s at μ = 0.3.
pub(crate) fn slide() -> Scene {
    let mut block = Body::mobile(Vec2::new(0.5, 0.25), Vec2::new(0.0, 0.25), 1.0);
    block.v.x = 5.0;
    let mut scene = scene("slide", vec![ground(20.0), block], 0.3, 120, Known::Moves(25.0 / (2.0 * 0.3 * 9.81)));
    scene.world.gravity = -9.81;
    scene
}

/// A block on a slope of 30° that friction just holds, for 100 s.
pub(crate) fn creep() -> Scene {
    let angle = std::f64::consts::PI / 6.0;
    let slope = Body::fixed(Vec2::new(20.0, 1.0), Vec2::zeros()).turned(angle);
    let at = slope.outwards(Vec2::new(0.0, 1.25));
    let block = Body::mobile(Vec2::new(0.5, 0.25), at, 1.0).turned(angle);
    let mut scene = scene("creep", vec![slope, block], 0.5774, 6000, Known::Moves(0.0));
    scene.world.gravity = -9.81;
    scene
}

/// Boxes in a square drum that turns.
pub(crate) fn tumbler(side: usize) -> Scene {
    let centre = Vec2::new(0.0, 10.0);
    let mut bodies = Vec::new();
    for (half, at) in [
        ((0.5, 10.0), (10.0, 0.0)),
        ((0.5, 10.0), (-10.0, 0.0)),
        ((10.0, 0.5), (0.0, 10.0)),
        ((10.0, 0.5), (0.0, -10.0)),
    ] {
        let mut wall = Body::fixed(Vec2::new(half.0, half.1), centre + Vec2::new(at.0, at.1));
        wall.centre = Some(centre);
        wall.w = 25.0_f64.to_radians();
        wall.v = crate::world::perp(wall.x - centre) * wall.w;
        bodies.push(wall);
    }
    for k in 0..side * side {
        let at = Vec2::new(-9.0 + 0.4 * (k / side) as f64, 1.0 + 0.4 * (k % side) as f64);
        bodies.push(Body::mobile(Vec2::new(0.125, 0.125), at, 1.0));
    }
    scene(&format!("tumbler {side}×{side}"), bodies, 0.6, 200, Known::Stays)
}

/// Cards leaning on each other in so many storeys.
pub(crate) fn cards(storeys: usize) -> Scene {
    let (half, lean) = (Vec2::new(0.2, 0.001), 25.0_f64.to_radians());
    let (sine, cosine) = libm::sincos(lean);
    // A leaning card: how far its corners are from its centre, upwards and sideways.
    let (up, out) = (half.x * cosine + half.y * sine, half.x * sine - half.y * cosine);
    let pitch = 4.0 * out + 4.0 * half.y * cosine;
    let mut bodies = vec![ground(5.0)];
    let mut floor = 0.0;
    for storey in 0..storeys {
        let count = storeys - storey;
        let middle = |k: usize| pitch * (k as f64 - 0.5 * (count - 1) as f64);
        for k in 0..count {
            for side in [-1.0, 1.0] {
                let at = Vec2::new(middle(k) + side * (out + 2.0 * half.y * cosine), floor + up);
                let angle = 0.5 * std::f64::consts::PI + side * lean;
                bodies.push(Body::mobile(half, at, 1.0).turned(angle));
            }
        }
        for k in 1..count {
            let at = Vec2::new(0.5 * (middle(k - 1) + middle(k)), floor + 2.0 * up + half.y);
            bodies.push(Body::mobile(half, at, 1.0));
        }
        floor += 2.0 * (up + half.y);
    }
    scene(&format!("cards {storeys}"), bodies, 0.7, 600, Known::Stands(Vec::new()))
}

fn ground(half: f64) -> Body {
    Body::fixed(Vec2::new(half, 1.0), Vec2::new(0.0, -1.0))
}

fn scene(name: &str, bodies: Vec<Body>, friction: f64, steps: usize, known: Known) -> Scene {
    let world = World { bodies, gravity: -10.0, friction, restitution: 0.0 };
    Scene { name: name.to_owned(), world, steps, known }
}

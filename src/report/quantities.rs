//! What is measured of a run that cannot be foretold body by body.

use choque_engine::scene::{ExchangeRule, Kind};
use choque_engine::{BodyId, Hit, Rect, Scene, World, load};

use super::course::watch;
use super::recipe::{Recipe, Variant};
use super::statistics::quantile;
use crate::Error;

/// At rest is what is slower than this share of the fastest start, for half a second.
const REST_SPEED: f64 = 1e-3;
const REST_TIME: f64 = 0.5;

/// What is measured of every copy: what the scene makes sense of.
#[derive(Clone, Debug)]
pub struct Quantities {
    /// Nothing but the bodies themselves changes their momentum.
    keeps_momentum: bool,
    /// No single hit loses energy, and turning takes part in it.
    is_elastic: bool,
    moves: bool,
    /// Least half width of a rectangle \[m\].
    thinnest: f64,
    /// The box around the fixed bodies, when it holds all mobile ones.
    container: Option<Rect>,
    /// Speed below which a body is at rest \[m/s\].
    rest: f64,
}

impl Quantities {
    /// Those of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let settings = &scene.settings;
        let rects = || scene.bodies.iter().flat_map(load::all_areas);
        let fastest = scene.bodies.iter().filter_map(|body| body.velocity).map(|(x, z)| (x * x + z * z).sqrt());
        let elastic =
            settings.exchange == ExchangeRule::Impulse && settings.restitution == 1.0 && settings.friction == 0.0;
        let plain = scene.bodies.iter().all(|body| body.restitution.is_none() && body.friction.is_none());
        let free = settings.gravity == (0.0, 0.0) && settings.drag == (0.0, 0.0);
        Quantities {
            keeps_momentum: free && scene.bodies.iter().all(|body| body.kind == Kind::Mobile),
            is_elastic: elastic && plain && free,
            moves: scene
                .bodies
                .iter()
                .any(|body| body.kind == Kind::Mobile && (body.velocity.is_some() || body.spin.is_some())),
            thinnest: rects().map(|rect| rect.half().min()).fold(f64::INFINITY, f64::min),
            container: container(scene),
            rest: REST_SPEED * fastest.fold(0.0, f64::max).max(1e-3),
        }
    }

    /// Their names, in order.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        let mut names = vec![
            "exchanges",
            "contact depth, greatest / least half width",
            "contact depth, 99.9 % / least half width",
            "deepest overlap / least half width",
            "time to rest, or the whole run [s]",
            "x, 5 % of bodies [m]",
            "x, middle [m]",
            "x, 95 % [m]",
            "z, 5 % of bodies [m]",
            "z, middle [m]",
            "z, 95 % [m]",
        ];
        let also = [
            (self.moves, "kinetic energy, end / start"),
            (self.moves, "kinetic energy, greatest / start"),
            (self.keeps_momentum, "momentum changed / all there is"),
            (self.is_elastic, "share of energy in turning"),
            (self.container.is_some(), "bodies outside"),
        ];
        names.extend(also.into_iter().filter_map(|(makes_sense, name)| makes_sense.then_some(name)));
        names
    }

    /// All quantities of one run, in the order of their names; the world is looked at every so many iterations.
    ///
    /// # Errors
    /// What is wrong with the scenario; a body that left the finite numbers.
    pub fn read(&self, recipe: &Recipe, variant: &Variant, every: u64) -> Result<Vec<f64>, Error> {
        let start = recipe.load(variant)?.start()?.world().clone();
        let mut seen = Seen::new(&start);
        let run = watch(recipe, variant, |world, hits| seen.look(world, hits, every, self.rest))?;
        let world = run.world();
        let places =
            |axis: usize| seen.mobile.iter().map(|i| world.position(ids(&world)[*i])[axis]).collect::<Vec<_>>();
        let (xs, zs) = (places(0), places(1));
        let mut values = vec![
            world.collisions() as f64,
            quantile(&seen.depths, 1.0).max(0.0) / self.thinnest,
            quantile(&seen.depths, 0.999).max(0.0) / self.thinnest,
            seen.deepest / self.thinnest,
            seen.rest_since.filter(|since| world.time() - since >= REST_TIME).unwrap_or(world.time()),
        ];
        values.extend([&xs, &zs].iter().flat_map(|all| [0.05, 0.5, 0.95].map(|share| quantile(all, share))));
        let energy = start.kinetic_energy();
        let changed = (world.momentum() - start.momentum()).norm() / seen.greatest_momentum.max(f64::MIN_POSITIVE);
        let outside =
            self.container.map(|container| xs.iter().zip(&zs).filter(|(x, z)| !holds(container, **x, **z)).count());
        let also = [
            (self.moves, world.kinetic_energy() / energy),
            (self.moves, seen.greatest_energy / energy),
            (self.keeps_momentum, changed),
            (self.is_elastic, seen.turning / seen.looks.max(1.0)),
            (outside.is_some(), outside.unwrap_or(0) as f64),
        ];
        values.extend(also.into_iter().filter_map(|(makes_sense, value)| makes_sense.then_some(value)));
        Ok(values)
    }
}

fn ids(world: &World) -> Vec<BodyId> {
    world.ids().collect()
}

/// What was seen on the way.
struct Seen {
    mobile: Vec<usize>,
    depths: Vec<f64>,
    deepest: f64,
    greatest_energy: f64,
    greatest_momentum: f64,
    rest_since: Option<f64>,
    /// Shares of energy in turning, added up over the looks.
    turning: f64,
    looks: f64,
}

impl Seen {
    fn new(world: &World) -> Self {
        let mobile = world.ids().filter(|id| world.kind(*id) == Kind::Mobile).map(BodyId::index).collect();
        Seen {
            mobile,
            depths: vec![0.0],
            deepest: 0.0,
            greatest_energy: world.kinetic_energy(),
            greatest_momentum: 0.0,
            rest_since: None,
            turning: 0.0,
            looks: 0.0,
        }
    }

    fn look(&mut self, world: &World, hits: &[Hit], every: u64, rest: f64) {
        self.depths.extend(hits.iter().map(|hit| hit.depth));
        if !world.iteration().is_multiple_of(every) {
            return;
        }
        let (mut momentum, mut turning, mut is_at_rest) = (0.0, 0.0, true);
        for id in world.ids().filter(|id| world.kind(*id) == Kind::Mobile) {
            let (speed, spin) = (world.velocity(id).norm(), world.spin(id));
            let rim = spin.abs() * (3.0 * world.inertia(id) / world.mass(id)).sqrt(); // I/m = R²/3 of a rectangle
            momentum += world.mass(id) * speed;
            turning += 0.5 * world.inertia(id) * spin * spin;
            is_at_rest &= speed < rest && rim < rest;
        }
        let energy = world.kinetic_energy();
        self.deepest = self.deepest.max(world.deepest());
        self.greatest_energy = self.greatest_energy.max(energy);
        self.greatest_momentum = self.greatest_momentum.max(momentum);
        self.rest_since = is_at_rest.then(|| self.rest_since.unwrap_or(world.time()));
        if energy > 0.0 {
            self.turning += turning / energy;
            self.looks += 1.0;
        }
    }
}

/// The box around all fixed bodies, when every mobile one starts in it and there are at least two.
fn container(scene: &Scene) -> Option<Rect> {
    let fixed: Vec<_> = scene.bodies.iter().filter(|body| body.kind == Kind::Fixed).collect();
    let around = fixed.iter().flat_map(|body| {
        let (sin, cos) = libm::sincos(body.angle);
        load::areas(body, scene.settings.plane).map(move |rect| {
            let corners =
                rect.vertices().map(|v| (body.at.0 + cos * v.x - sin * v.y, body.at.1 + sin * v.x + cos * v.y));
            corners.into_iter().fold(EMPTY, |around, (x, z)| Rect {
                x_min: around.x_min.min(x),
                x_max: around.x_max.max(x),
                z_min: around.z_min.min(z),
                z_max: around.z_max.max(z),
            })
        })
    });
    let around = around.reduce(|a, b| Rect {
        x_min: a.x_min.min(b.x_min),
        x_max: a.x_max.max(b.x_max),
        z_min: a.z_min.min(b.z_min),
        z_max: a.z_max.max(b.z_max),
    })?;
    let mut mobile = scene.bodies.iter().filter(|body| body.kind == Kind::Mobile);
    (fixed.len() > 1 && mobile.all(|body| holds(around, body.at.0, body.at.1))).then_some(around)
}

const EMPTY: Rect =
    Rect { x_min: f64::INFINITY, x_max: f64::NEG_INFINITY, z_min: f64::INFINITY, z_max: f64::NEG_INFINITY };

fn holds(rect: Rect, x: f64, z: f64) -> bool {
    (rect.x_min..=rect.x_max).contains(&x) && (rect.z_min..=rect.z_max).contains(&z)
}

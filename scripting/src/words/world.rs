//! The words of callbacks and expectations: the world, its bodies, a hit.

use choque_engine::{BodyId, World as EngineWorld};
use rhai::plugin::*;
use rhai::{Array, Dynamic};

use super::Text;
use crate::error::Complaint;
use crate::handles::{Body, Hit, World};
use crate::number;
use crate::session::{self, RhaiResultOf, Session};
use crate::suggest::did_you_mean;

/// What `world.` can be followed by; a body's name in its place is looked up as `world[name]`.
const PROPERTIES: [&str; 10] = [
    "time",
    "time_step",
    "iteration",
    "collisions",
    "kinetic_energy",
    "momentum_x",
    "momentum_z",
    "angular_momentum",
    "deepest",
    "ledger",
];

#[export_module]
pub(crate) mod module {
    /// The time at which the bodies stand where they stand \[s\].
    ///
    /// ```rhai
    /// fn on_step(world) { if world.time > 2 { world["blade"].spin = 0; } }
    /// ```
    #[rhai_fn(get = "time", pure, return_raw)]
    pub fn time(context: NativeCallContext, world: &mut World) -> RhaiResultOf<f64> {
        of_world(&context, *world, "time", EngineWorld::time)
    }

    /// The length of one iteration \[s\].
    ///
    /// ```rhai
    /// fn on_step(world) { if world.time < world.time_step { print("the first iteration"); } }
    /// ```
    #[rhai_fn(get = "time_step", pure, return_raw)]
    pub fn world_time_step(context: NativeCallContext, world: &mut World) -> RhaiResultOf<f64> {
        of_world(&context, *world, "time_step", |world| world.plan().time_step)
    }

    /// How many iterations have been made.
    ///
    /// ```rhai
    /// fn stop_when(world) { world.iteration == 2 }
    /// ```
    #[rhai_fn(get = "iteration", pure, return_raw)]
    pub fn iteration(context: NativeCallContext, world: &mut World) -> RhaiResultOf<i64> {
        of_world(&context, *world, "iteration", |world| world.iteration() as f64).map(|count| count as i64)
    }

    /// How many exchanges there have been.
    ///
    /// ```rhai
    /// fn stop_when(world) { world.collisions >= 1 }
    /// ```
    #[rhai_fn(get = "collisions", pure, return_raw)]
    pub fn collisions(context: NativeCallContext, world: &mut World) -> RhaiResultOf<i64> {
        of_world(&context, *world, "collisions", |world| world.collisions() as f64).map(|count| count as i64)
    }

    /// The kinetic energy of all mobile bodies \[J\].
    ///
    /// ```rhai
    /// always("nothing explodes", |world| world.kinetic_energy < 1e7);
    /// ```
    #[rhai_fn(get = "kinetic_energy", pure, return_raw)]
    pub fn kinetic_energy(context: NativeCallContext, world: &mut World) -> RhaiResultOf<f64> {
        of_world(&context, *world, "kinetic_energy", EngineWorld::kinetic_energy)
    }

    /// The momentum of all mobile bodies along X \[kg·m/s\].
    ///
    /// ```rhai
    /// expect("momentum is kept", |world| abs(world.momentum_x) < 1e-9);
    /// ```
    #[rhai_fn(get = "momentum_x", pure, return_raw)]
    pub fn momentum_x(context: NativeCallContext, world: &mut World) -> RhaiResultOf<f64> {
        of_world(&context, *world, "momentum_x", |world| world.momentum().x)
    }

    /// The momentum of all mobile bodies along Z \[kg·m/s\].
    ///
    /// ```rhai
    /// expect("momentum is kept", |world| abs(world.momentum_z) < 1e-9);
    /// ```
    #[rhai_fn(get = "momentum_z", pure, return_raw)]
    pub fn momentum_z(context: NativeCallContext, world: &mut World) -> RhaiResultOf<f64> {
        of_world(&context, *world, "momentum_z", |world| world.momentum().y)
    }

    /// The angular momentum of all mobile bodies about the world's origin \[kg·m²/s\].
    ///
    /// ```rhai
    /// expect("all turn one way", |world| world.angular_momentum >= 0);
    /// ```
    #[rhai_fn(get = "angular_momentum", pure, return_raw)]
    pub fn angular_momentum(context: NativeCallContext, world: &mut World) -> RhaiResultOf<f64> {
        of_world(&context, *world, "angular_momentum", EngineWorld::angular_momentum)
    }

    /// How deep the deepest overlap of any two bodies is now \[m\]; 0 when none overlap.
    ///
    /// ```rhai
    /// always("nothing goes in deep", |world| world.deepest < 2);
    /// ```
    #[rhai_fn(get = "deepest", pure, return_raw)]
    pub fn deepest(context: NativeCallContext, world: &mut World) -> RhaiResultOf<f64> {
        of_world(&context, *world, "deepest", EngineWorld::deepest)
    }

    /// The body of that name, to read and to write: `world["blade"].spin = 0`.
    ///
    /// ```rhai
    /// fn on_step(world) { world["blade"].spin = 1; }
    /// ```
    #[rhai_fn(index_get, pure, return_raw)]
    pub fn body_named(context: NativeCallContext, world: &mut World, name: Text) -> RhaiResultOf<Body> {
        find(&context, *world, &name)
    }

    /// Never a new body: writing through `world["blade"].spin = 0` puts the same body back.
    #[rhai_fn(index_set, pure, return_raw)]
    pub fn put_back(context: NativeCallContext, world: &mut World, name: Text, value: Dynamic) -> RhaiResultOf<()> {
        put(&context, *world, &name, &value)
    }

    /// The body of that name, to read. To write, say `world["blade"].spin = 0`.
    ///
    /// ```rhai
    /// expect("the blade turns", |world| world.body("blade").spin >= 0);
    /// ```
    #[rhai_fn(return_raw, pure)]
    pub fn body(context: NativeCallContext, world: &mut World, name: Text) -> RhaiResultOf<Body> {
        find(&context, *world, &name)
    }

    /// All bodies, in the order they were made.
    ///
    /// ```rhai
    /// always("all stay near", |world| world.bodies().all(|body| abs(body.x) < 100));
    /// ```
    #[rhai_fn(return_raw, pure)]
    pub fn bodies(context: NativeCallContext, world: &mut World) -> RhaiResultOf<Array> {
        list(&context, *world, |world| world.ids().collect())
    }

    /// All bodies with that tag, in the order they were made.
    ///
    /// ```rhai
    /// expect("no car flies off", |world| world.tagged("car").all(|car| car.speed < 30));
    /// ```
    #[rhai_fn(return_raw, pure)]
    pub fn tagged(context: NativeCallContext, world: &mut World, text: Text) -> RhaiResultOf<Array> {
        let tag = number::text("tagged", &text).map_err(|wrong| session::complain(wrong, context.call_position()))?;
        list(&context, *world, |world| world.tagged(&tag))
    }

    /// The one of the two bodies that was made first.
    ///
    /// ```rhai
    /// fn on_collision(world, hit) { print(hit.a.name); }
    /// ```
    #[rhai_fn(get = "a", pure)]
    pub fn hit_a(hit: &mut Hit) -> Body {
        hit.a
    }

    /// The one of the two bodies that was made last.
    ///
    /// ```rhai
    /// fn on_collision(world, hit) { if hit.b.kind == "mobile" { hit.b.spin = 0; } }
    /// ```
    #[rhai_fn(get = "b", pure)]
    pub fn hit_b(hit: &mut Hit) -> Body {
        hit.b
    }

    /// Where they touched, along X \[m\].
    ///
    /// ```rhai
    /// fn on_collision(world, hit) { print(`${hit.x}, ${hit.z}`); }
    /// ```
    #[rhai_fn(get = "x", pure)]
    pub fn hit_x(hit: &mut Hit) -> f64 {
        hit.x
    }

    /// Where they touched, along Z \[m\].
    ///
    /// ```rhai
    /// fn on_collision(world, hit) { if hit.z > 5 { print("at the far side"); } }
    /// ```
    #[rhai_fn(get = "z", pure)]
    pub fn hit_z(hit: &mut Hit) -> f64 {
        hit.z
    }

    /// How deep they overlapped when they were found \[m\].
    ///
    /// ```rhai
    /// fn on_collision(world, hit) { if hit.depth > 0.1 { print("a deep one"); } }
    /// ```
    #[rhai_fn(get = "depth", pure)]
    pub fn hit_depth(hit: &mut Hit) -> f64 {
        hit.depth
    }

    /// The iteration it happened in, the first being 0.
    ///
    /// ```rhai
    /// fn on_collision(world, hit) { print(`in iteration ${hit.iteration}`); }
    /// ```
    #[rhai_fn(get = "iteration", pure)]
    pub fn hit_iteration(hit: &mut Hit) -> i64 {
        hit.iteration as i64
    }

    /// The world as a string: how many bodies it has, and its time.
    #[rhai_fn(name = "to_string", name = "to_debug", return_raw, pure)]
    pub fn world_to_string(context: NativeCallContext, world: &mut World) -> RhaiResultOf<String> {
        session::with(&context, |session| {
            let World = *world;
            let world = session.running()?.world.borrow();
            Ok(format!("world of {} bodies at {} s", world.len(), world.time()))
        })
    }
}

fn of_world(
    context: &NativeCallContext,
    World: World,
    property: &'static str,
    read: impl FnOnce(&EngineWorld) -> f64,
) -> RhaiResultOf<f64> {
    session::with(context, |session| {
        let value = read(&session.running()?.world.borrow());
        Ok(session.read(None, property, value))
    })
}

fn list(
    context: &NativeCallContext,
    World: World,
    select: impl FnOnce(&EngineWorld) -> Vec<BodyId>,
) -> RhaiResultOf<Array> {
    session::with(context, |session| {
        let ids = select(&session.running()?.world.borrow());
        Ok(ids.into_iter().map(|id| Dynamic::from(Body { index: id.index() as u32 })).collect())
    })
}

fn find(context: &NativeCallContext, World: World, name: &Dynamic) -> RhaiResultOf<Body> {
    session::with(context, |session| look_up(session, &number::text("the name of a body", name)?))
}

fn look_up(session: &Session, name: &str) -> Result<Body, Complaint> {
    let world = session.running()?.world.borrow();
    if let Some(id) = world.find(name) {
        return Ok(Body { index: id.index() as u32 });
    }
    if PROPERTIES.contains(&name) {
        return Err(Complaint::new(format!("there is no body \"{name}\"")).hint(format!("write world.{name}")));
    }
    let bodies = did_you_mean(name, world.ids().map(|id| world.name(id)), |near| format!("world[\"{near}\"]"));
    let properties = did_you_mean(name, PROPERTIES, |near| format!("world.{near}"));
    Err(Complaint::new(format!("the world has no body \"{name}\", and no property of that name"))
        .maybe_hint(bodies.or(properties)))
}

fn put(context: &NativeCallContext, World: World, name: &Dynamic, value: &Dynamic) -> RhaiResultOf<()> {
    session::with(context, |session| {
        let name = number::text("the name of a body", name)?;
        if PROPERTIES.contains(&name.as_str()) {
            return Err(Complaint::new(format!("world.{name} can be read only")));
        }
        let body = look_up(session, &name)?;
        if value.read_lock::<Body>().is_some_and(|value| *value == body) {
            return Ok(());
        }
        Err(Complaint::new(format!("world[\"{name}\"] cannot be replaced"))
            .hint(format!("write its properties: world[\"{name}\"].vx = 1")))
    })
}

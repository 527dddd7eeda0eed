//! The words of bodies in callbacks and expectations: where they are, how they move, what pushes them.

use choque_engine::area::Vec2;
use choque_engine::{BodyId, CommandError, World, scene};
use rhai::Dynamic;
use rhai::plugin::*;

use super::Number;
use crate::error::Complaint;
use crate::handles::Body;
use crate::number;
use crate::session::{self, Phase, RhaiResultOf};

#[export_module]
pub(crate) mod module {
    /// Where the body's centre is along X \[m\]. Callbacks may write it.
    ///
    /// ```rhai
    /// fn on_step(world) { if world["car"].x > 50 { world["car"].x -= 100; } }
    /// ```
    #[rhai_fn(get = "x", pure, return_raw)]
    pub fn x(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<f64> {
        of_body(&context, *body, "x", |body| body.at.0, |world, id| world.position(id).x)
    }

    #[rhai_fn(set = "x", pure, return_raw)]
    pub fn set_x(context: NativeCallContext, body: &mut Body, x: Number) -> RhaiResultOf<()> {
        write(&context, *body, "x", &x, |world, id, x| world.set_position(id, Vec2::new(x, world.position(id).y)))
    }

    /// Where the body's centre is along Z \[m\]. Callbacks may write it.
    ///
    /// ```rhai
    /// expect("it stays in its lane", |world| abs(world["car"].z) < 2);
    /// ```
    #[rhai_fn(get = "z", pure, return_raw)]
    pub fn z(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<f64> {
        of_body(&context, *body, "z", |body| body.at.1, |world, id| world.position(id).y)
    }

    #[rhai_fn(set = "z", pure, return_raw)]
    pub fn set_z(context: NativeCallContext, body: &mut Body, z: Number) -> RhaiResultOf<()> {
        write(&context, *body, "z", &z, |world, id, z| world.set_position(id, Vec2::new(world.position(id).x, z)))
    }

    /// The body's angle \[rad\], in (−π, π] while running. Callbacks may write it.
    ///
    /// ```rhai
    /// fn on_step(world) { if world.iteration == 1 { world["car"].angle = deg(90); } }
    /// ```
    #[rhai_fn(get = "angle", pure, return_raw)]
    pub fn angle(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<f64> {
        of_body(&context, *body, "angle", |body| body.angle, World::angle)
    }

    #[rhai_fn(set = "angle", pure, return_raw)]
    pub fn set_angle(context: NativeCallContext, body: &mut Body, rad: Number) -> RhaiResultOf<()> {
        write(&context, *body, "angle", &rad, World::set_angle)
    }

    /// The body's velocity along X \[m/s\]. Callbacks may write it, a fixed body's too: so a wall turns back.
    ///
    /// ```rhai
    /// fn on_step(world) { if world["wall"].x > 6 { world["wall"].vx = -2; } }
    /// ```
    #[rhai_fn(get = "vx", pure, return_raw)]
    pub fn vx(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<f64> {
        of_body(&context, *body, "vx", |body| initial_velocity(body).x, |world, id| world.velocity(id).x)
    }

    #[rhai_fn(set = "vx", pure, return_raw)]
    pub fn set_vx(context: NativeCallContext, body: &mut Body, vx: Number) -> RhaiResultOf<()> {
        write(&context, *body, "vx", &vx, |world, id, vx| world.set_velocity(id, Vec2::new(vx, world.velocity(id).y)))
    }

    /// The body's velocity along Z \[m/s\]. Callbacks may write it, a fixed body's too.
    ///
    /// ```rhai
    /// fn on_step(world) { if world["wall"].z > 6 { world["wall"].vz = -2; } }
    /// ```
    #[rhai_fn(get = "vz", pure, return_raw)]
    pub fn vz(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<f64> {
        of_body(&context, *body, "vz", |body| initial_velocity(body).y, |world, id| world.velocity(id).y)
    }

    #[rhai_fn(set = "vz", pure, return_raw)]
    pub fn set_vz(context: NativeCallContext, body: &mut Body, vz: Number) -> RhaiResultOf<()> {
        write(&context, *body, "vz", &vz, |world, id, vz| world.set_velocity(id, Vec2::new(world.velocity(id).x, vz)))
    }

    /// The body's spin \[rad/s\]. Callbacks may write it, a fixed body's too: so a blade stops.
    ///
    /// ```rhai
    /// fn on_step(world) { if world.time > 2 { world["blade"].spin = 0; } }
    /// ```
    #[rhai_fn(get = "spin", pure, return_raw)]
    pub fn spin(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<f64> {
        of_body(&context, *body, "spin", |body| body.spin.unwrap_or(0.0), World::spin)
    }

    #[rhai_fn(set = "spin", pure, return_raw)]
    pub fn set_spin(context: NativeCallContext, body: &mut Body, rad_per_s: Number) -> RhaiResultOf<()> {
        write(&context, *body, "spin", &rad_per_s, World::set_spin)
    }

    /// How fast the body's centre moves \[m/s\].
    ///
    /// ```rhai
    /// expect("it has slowed down", |world| world["car"].speed < 8);
    /// ```
    #[rhai_fn(get = "speed", pure, return_raw)]
    pub fn speed(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<f64> {
        of_body(&context, *body, "speed", |body| initial_velocity(body).norm(), |world, id| world.velocity(id).norm())
    }

    /// The body's mass \[kg\].
    ///
    /// ```rhai
    /// fn on_step(world) { world["car"].push(0, 0.5 * world["car"].mass); }      // 0.5 m/s²
    /// ```
    #[rhai_fn(get = "mass", pure, return_raw)]
    pub fn mass(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<f64> {
        of_body(&context, *body, "mass", |body| body.mass.unwrap_or(1.0), World::mass)
    }

    /// The body's name.
    ///
    /// ```rhai
    /// fn on_collision(world, hit) { print(hit.a.name + " meets " + hit.b.name); }
    /// ```
    #[rhai_fn(get = "name", pure, return_raw)]
    pub fn name(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<String> {
        told(&context, *body, |body| body.name.clone(), |world, id| world.name(id).to_owned())
    }

    /// `"mobile"` or `"fixed"`.
    ///
    /// ```rhai
    /// fn on_collision(world, hit) { if hit.a.kind == "fixed" { print("a wall is hit"); } }
    /// ```
    #[rhai_fn(get = "kind", pure, return_raw)]
    pub fn kind(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<String> {
        told(&context, *body, |body| body.kind.word().to_owned(), |world, id| world.kind(id).word().to_owned())
    }

    /// A force on a mobile body's centre over this iteration \[N\]; several add up.
    ///
    /// ```rhai
    /// fn on_step(world) { if world.time < 1 { world["car"].push(3000, 0); } }
    /// ```
    #[rhai_fn(return_raw, pure)]
    pub fn push(context: NativeCallContext, body: &mut Body, fx: Number, fz: Number) -> RhaiResultOf<()> {
        command(&context, *body, |world, id| {
            let force = Vec2::new(number::any("push: fx", &fx)?, number::any("push: fz", &fz)?);
            Ok(world.push(id, force)?)
        })
    }

    /// A torque on a mobile body over this iteration \[N·m\], turning from +X towards +Z; several add up.
    ///
    /// ```rhai
    /// fn on_step(world) { if world.time < 1 { world["car"].twist(500); } }
    /// ```
    #[rhai_fn(return_raw, pure)]
    pub fn twist(context: NativeCallContext, body: &mut Body, torque: Number) -> RhaiResultOf<()> {
        command(&context, *body, |world, id| Ok(world.twist(id, number::any("twist: torque", &torque)?)?))
    }

    /// Whether two handles are of one body.
    #[rhai_fn(name = "==")]
    pub fn same(a: Body, b: Body) -> bool {
        a == b
    }

    /// Whether two handles are of different bodies.
    #[rhai_fn(name = "!=")]
    pub fn different(a: Body, b: Body) -> bool {
        a != b
    }

    /// The body as a string: its kind and its name.
    #[rhai_fn(name = "to_string", name = "to_debug", return_raw, pure)]
    pub fn body_to_string(context: NativeCallContext, body: &mut Body) -> RhaiResultOf<String> {
        let called = |kind: scene::Kind, name: &str| format!("{}(\"{name}\")", kind.word());
        told(&context, *body, |body| called(body.kind, &body.name), |world, id| called(world.kind(id), world.name(id)))
    }
}

fn initial_velocity(body: &scene::Body) -> Vec2 {
    let (x, z) = body.velocity.unwrap_or_default();
    Vec2::new(x, z)
}

fn told<T>(
    context: &NativeCallContext,
    body: Body,
    building: impl FnOnce(&scene::Body) -> T,
    running: impl FnOnce(&World, BodyId) -> T,
) -> RhaiResultOf<T> {
    session::with(context, |session| match &mut session.phase {
        Phase::Building(draft) => Ok(building(draft.body(body.index)?)),
        Phase::Running(run) => Ok(running(&run.world.borrow(), run.id(body.index)?)),
    })
}

fn of_body(
    context: &NativeCallContext,
    body: Body,
    property: &'static str,
    building: impl FnOnce(&scene::Body) -> f64,
    running: impl FnOnce(&World, BodyId) -> f64,
) -> RhaiResultOf<f64> {
    session::with(context, |session| match &mut session.phase {
        Phase::Building(draft) => Ok(building(draft.body(body.index)?)),
        Phase::Running(run) => {
            let value = running(&run.world.borrow(), run.id(body.index)?);
            Ok(session.read(Some(body.index), property, value))
        }
    })
}

fn command(
    context: &NativeCallContext,
    body: Body,
    command: impl FnOnce(&mut World, BodyId) -> Result<(), Complaint>,
) -> RhaiResultOf<()> {
    session::with(context, |session| {
        let run = session.changing()?;
        let id = run.id(body.index)?;
        command(&mut run.world.borrow_mut(), id)
    })
}

fn write(
    context: &NativeCallContext,
    body: Body,
    property: &str,
    value: &Dynamic,
    write: impl FnOnce(&mut World, BodyId, f64) -> Result<(), CommandError>,
) -> RhaiResultOf<()> {
    session::with(context, |session| {
        if let Phase::Building(_) = session.phase {
            return Err(Complaint::new(format!(".{property} can be written in callbacks only")).hint(
                "while the scene is being built, say .at(x, z), .angle(rad), .velocity(x, z), .spin(rad_per_s)",
            ));
        }
        let run = session.changing()?;
        let id = run.id(body.index)?;
        Ok(write(&mut run.world.borrow_mut(), id, number::any(property, value)?)?)
    })
}

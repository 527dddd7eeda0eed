//! The words that make bodies.

use choque_engine::area::{Extent, Rect};
use choque_engine::scene::{self, Kind, Part, Patrol, Swing};
use rhai::plugin::*;

use super::{List, Number, Text};
use crate::draft::Draft;
use crate::error::Complaint;
use crate::handles::Body;
use crate::number;
use crate::obj;
use crate::session::{self, RhaiResultOf, Site};

/// Characters a name or a tag may have.
const LONGEST_NAME: usize = 100;

#[export_module]
pub(crate) mod module {
    /// Makes a mobile body, one that collisions move: a vehicle. Names are unique. Gives its handle, and so does
    /// every word below, so that they chain.
    ///
    /// ```rhai
    /// mobile("car").rect(4.2, 1.8).mass(1200).at(0, 5).velocity(10, 0);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn mobile(context: NativeCallContext, name: Text) -> RhaiResultOf<Body> {
        add(&context, &name, Kind::Mobile)
    }

    /// Makes a fixed body, one that no collision moves: a building. With a velocity, a spin, a patrol or a swing it
    /// moves all the same, as that says: a travelling wall, a blade.
    ///
    /// ```rhai
    /// fixed("blade").rect(6, 0.4).at(0, 0).spin(2);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn fixed(context: NativeCallContext, name: Text) -> RhaiResultOf<Body> {
        add(&context, &name, Kind::Fixed)
    }

    /// Gives the body a rectangle centred on it, `width` along X and `depth` along Z \[m\]. Repeat it for a body
    /// of several rectangles.
    ///
    /// ```rhai
    /// mobile("car").rect(4.2, 1.8);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn rect(context: NativeCallContext, body: Body, width: Number, depth: Number) -> RhaiResultOf<Body> {
        on_body(&context, body, |draft| {
            let width = number::positive("rect: width", &width)?;
            let depth = number::positive("rect: depth", &depth)?;
            draft.add_part(body.index, Part::Rect(Rect::centred(width, depth)))
        })
    }

    /// Gives the body a rectangle anywhere in its own frame \[m\].
    ///
    /// ```rhai
    /// fixed("door").rect(0, 2, -0.1, 0.1);                 // hinged at its end
    /// ```
    #[rhai_fn(name = "rect", return_raw)]
    pub fn rect_between(
        context: NativeCallContext,
        body: Body,
        x_min: Number,
        x_max: Number,
        z_min: Number,
        z_max: Number,
    ) -> RhaiResultOf<Body> {
        on_body(&context, body, |draft| {
            let (x_min, x_max) = span("x", &x_min, &x_max)?;
            let (z_min, z_max) = span("z", &z_min, &z_max)?;
            draft.add_part(body.index, Part::Rect(Rect { x_min, x_max, z_min, z_max }))
        })
    }

    /// Gives the body a 3D mesh: its vertices `[[x, y, z], …]` in the body's frame \[m\], y upwards. Its area is
    /// the rectangle around them, and it counts where the mesh crosses the collision plane. Repeat it for a
    /// body of several rectangles.
    ///
    /// ```rhai
    /// mobile("ramp").mesh([[-1, 0, -1], [1, 0, 1], [1, 0.5, 0]]);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn mesh(context: NativeCallContext, body: Body, vertices: List) -> RhaiResultOf<Body> {
        on_body(&context, body, |draft| {
            let vertices = number::tuples::<3>("mesh", "[x, y, z]", &vertices)?;
            draft.add_part(body.index, Part::Mesh(extent("mesh", vertices)?))
        })
    }

    /// Gives the body a 3D mesh from a Wavefront `.obj` file below the script's folder or below the library.
    ///
    /// ```rhai
    /// mobile("car").model("lib/car.obj").mass(1200);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn model(context: NativeCallContext, body: Body, file: Text) -> RhaiResultOf<Body> {
        let library = session::with(&context, |session| Ok(session.library.clone()))?;
        on_body(&context, body, |draft| {
            let found = library.find("model", &number::text("model: file", &file)?, "")?;
            draft.add_part(body.index, Part::Mesh(extent("model", obj::read_vertices(&library, &found)?)?))
        })
    }

    /// How high the mesh stands over the ground \[m\]. Default: 0.
    ///
    /// ```rhai
    /// fixed("bridge").mesh([[-2, 0, -8], [2, 1, 8]]).height(4);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn height(context: NativeCallContext, body: Body, y: Number) -> RhaiResultOf<Body> {
        let y = number::finite("height", &y);
        set(&context, body, y, |body, y| body.height = y)
    }

    /// Scales the body's rectangles and meshes, all axes alike; greater than 0. Default: 1.
    ///
    /// ```rhai
    /// mobile("truck").rect(4, 2).scale(1.5);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn scale(context: NativeCallContext, body: Body, s: Number) -> RhaiResultOf<Body> {
        let s = number::positive("scale", &s);
        set(&context, body, s, |body, s| body.scale = (s, s, s))
    }

    /// Scales the body's rectangles and meshes along each axis; each greater than 0.
    ///
    /// ```rhai
    /// mobile("plank").rect(1, 1).scale(4, 1, 0.2);
    /// ```
    #[rhai_fn(name = "scale", return_raw)]
    pub fn scale_axes(
        context: NativeCallContext,
        body: Body,
        sx: Number,
        sy: Number,
        sz: Number,
    ) -> RhaiResultOf<Body> {
        change(&context, body, |body| {
            let (sx, sy) = (number::positive("scale: sx", &sx)?, number::positive("scale: sy", &sy)?);
            body.scale = (sx, sy, number::positive("scale: sz", &sz)?);
            Ok(())
        })
    }

    /// Where the body's centre stands \[m\]. Default: (0, 0).
    ///
    /// ```rhai
    /// mobile("car").rect(4.2, 1.8).at(-12, 5);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn at(context: NativeCallContext, body: Body, x: Number, z: Number) -> RhaiResultOf<Body> {
        let place = number::pair(number::finite, ("at: x", &x), ("at: z", &z));
        set(&context, body, place, |body, place| body.at = place)
    }

    /// The body's angle \[rad\], turning from +X towards +Z. Default: 0. `deg(90)` is a right angle.
    ///
    /// ```rhai
    /// mobile("car").rect(4.2, 1.8).angle(deg(90));
    /// ```
    #[rhai_fn(return_raw)]
    pub fn angle(context: NativeCallContext, body: Body, rad: Number) -> RhaiResultOf<Body> {
        let rad = number::finite("angle", &rad);
        set(&context, body, rad, |body, rad| body.angle = rad)
    }

    /// The body's velocity \[m/s\]. Default: (0, 0). A fixed body that is given one, even (0, 0), has physics: what it
    /// hits feels its motion.
    ///
    /// ```rhai
    /// mobile("car").rect(4.2, 1.8).velocity(0, -8);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn velocity(context: NativeCallContext, body: Body, x: Number, z: Number) -> RhaiResultOf<Body> {
        change(&context, body, |body| {
            refuse_both(body, body.patrol.is_some(), "patrol", "velocity")?;
            body.velocity = Some(number::pair(number::finite, ("velocity: x", &x), ("velocity: z", &z))?);
            Ok(())
        })
    }

    /// The body's spin \[rad/s\], turning from +X towards +Z. Default: 0. A fixed body that is given one, even 0, has
    /// physics.
    ///
    /// ```rhai
    /// fixed("blade").rect(6, 0.4).spin(2);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn spin(context: NativeCallContext, body: Body, rad_per_s: Number) -> RhaiResultOf<Body> {
        change(&context, body, |body| {
            refuse_both(body, body.swing.is_some(), "swing", "spin")?;
            body.spin = Some(number::finite("spin", &rad_per_s)?);
            Ok(())
        })
    }

    /// Fixed bodies only: travels from where it stands through the points `[[x, z], …]` and back to its start,
    /// round and round, at that speed \[m/s\].
    ///
    /// ```rhai
    /// fixed("wall").rect(1, 4).at(0, 0).patrol([[8, 0], [8, 6]], 2);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn patrol(context: NativeCallContext, body: Body, points: List, speed: Number) -> RhaiResultOf<Body> {
        change(&context, body, |body| {
            refuse_mobile(body, "patrol")?;
            refuse_both(body, body.velocity.is_some(), "velocity", "patrol")?;
            let points = number::tuples::<2>("patrol", "[x, z]", &points)?;
            if points.is_empty() {
                return Err(Complaint::new("patrol needs a point to travel to").hint("write .patrol([[x, z]], speed)"));
            }
            let speed = number::positive("patrol: speed", &speed)?;
            body.patrol = Some(Patrol { points: points.into_iter().map(|[x, z]| (x, z)).collect(), speed });
            Ok(())
        })
    }

    /// Fixed bodies only: swings to and fro about its own centre, up to ±`angle` \[rad\] from where it stands, once
    /// in `period` \[s\], at uniform speed.
    ///
    /// ```rhai
    /// fixed("gate").rect(0, 5, -0.2, 0.2).swing(deg(60), 4);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn swing(context: NativeCallContext, body: Body, angle: Number, period: Number) -> RhaiResultOf<Body> {
        change(&context, body, |body| {
            refuse_mobile(body, "swing")?;
            refuse_both(body, body.spin.is_some(), "spin", "swing")?;
            let angle = number::finite("swing: angle", &angle)?;
            let period = number::positive("swing: period", &period)?;
            body.swing = Some(Swing { angle, period });
            Ok(())
        })
    }

    /// The body's mass \[kg\], greater than 0. Default: 1.
    ///
    /// ```rhai
    /// mobile("car").rect(4.2, 1.8).mass(1200);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn mass(context: NativeCallContext, body: Body, kg: Number) -> RhaiResultOf<Body> {
        let kg = number::positive("mass", &kg);
        set(&context, body, kg, |body, kg| body.mass = Some(kg))
    }

    /// The body's moment of inertia about its centre \[kg·m²\], greater than 0. Default: that of its rectangles
    /// with the mass spread evenly.
    ///
    /// ```rhai
    /// mobile("flywheel").rect(1, 1).mass(20).inertia(40);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn inertia(context: NativeCallContext, body: Body, kg_m2: Number) -> RhaiResultOf<Body> {
        let inertia = number::positive("inertia", &kg_m2);
        set(&context, body, inertia, |body, inertia| body.inertia = Some(inertia))
    }

    /// The body's own coefficient of restitution, 0 to 1, in place of the scene's. Impulse exchange only.
    ///
    /// ```rhai
    /// exchange("impulse");
    /// mobile("ball").rect(1, 1).restitution(0.9);
    /// ```
    #[rhai_fn(name = "restitution", return_raw)]
    pub fn body_restitution(context: NativeCallContext, body: Body, e: Number) -> RhaiResultOf<Body> {
        let e = number::unit_range("restitution", &e);
        set(&context, body, e, |body, e| body.restitution = Some(e))
    }

    /// The body's own coefficient of friction, 0 or more, in place of the scene's. Impulse exchange only.
    ///
    /// ```rhai
    /// exchange("impulse");
    /// mobile("tyre").rect(1, 1).friction(1.2);
    /// ```
    #[rhai_fn(name = "friction", return_raw)]
    pub fn body_friction(context: NativeCallContext, body: Body, mu: Number) -> RhaiResultOf<Body> {
        let mu = number::not_negative("friction", &mu);
        set(&context, body, mu, |body, mu| body.friction = Some(mu))
    }

    /// Gives the body a free label; it may have several. `world.tagged(text)` lists all bodies of a label.
    ///
    /// ```rhai
    /// mobile("car1").rect(4.2, 1.8).tag("car").tag("red");
    /// ```
    #[rhai_fn(return_raw)]
    pub fn tag(context: NativeCallContext, body: Body, text: Text) -> RhaiResultOf<Body> {
        on_body(&context, body, |draft| draft.add_tag(body.index, &number::label("tag", &text, LONGEST_NAME)?))
    }
}

fn add(context: &NativeCallContext, name: &rhai::Dynamic, kind: Kind) -> RhaiResultOf<Body> {
    session::build(context, |draft| {
        let name = number::label(&format!("{}: name", kind.word()), name, LONGEST_NAME)?;
        draft.add(name, kind, Site::of(context)).map(|index| Body { index })
    })
}

/// Has a word work on a body of the scene being built; what it complains of is said of that body.
fn on_body(
    context: &NativeCallContext,
    body: Body,
    work: impl FnOnce(&mut Draft) -> Result<(), Complaint>,
) -> RhaiResultOf<Body> {
    session::build(context, |draft| match work(draft) {
        Ok(()) => Ok(body),
        Err(complaint) => Err(complaint.about_body(&draft.body(body.index)?.name)),
    })
}

fn change(
    context: &NativeCallContext,
    body: Body,
    change: impl FnOnce(&mut scene::Body) -> Result<(), Complaint>,
) -> RhaiResultOf<Body> {
    on_body(context, body, |draft| change(draft.body(body.index)?))
}

fn set<T>(
    context: &NativeCallContext,
    body: Body,
    value: Result<T, Complaint>,
    write: impl FnOnce(&mut scene::Body, T),
) -> RhaiResultOf<Body> {
    change(context, body, |body| {
        write(body, value?);
        Ok(())
    })
}

fn span(axis: &str, min: &rhai::Dynamic, max: &rhai::Dynamic) -> Result<(f64, f64), Complaint> {
    let min = number::finite(&format!("rect: {axis}_min"), min)?;
    let max = number::finite(&format!("rect: {axis}_max"), max)?;
    if min < max {
        return Ok((min, max));
    }
    Err(Complaint::new(format!("rect: {axis}_min must be less than {axis}_max, but {min} is not less than {max}"))
        .hint("the order is rect(x_min, x_max, z_min, z_max)"))
}

fn extent(word: &str, vertices: Vec<[f64; 3]>) -> Result<Extent, Complaint> {
    let extent = Extent::of(vertices).ok_or_else(|| Complaint::new(format!("{word} has no vertices")))?;
    for (axis, (least, greatest)) in [("x", extent.x), ("z", extent.z)] {
        if least == greatest {
            return Err(Complaint::new(format!("{word} is flat: all its vertices have {axis} = {least}"))
                .hint("an area needs a width along X and a depth along Z"));
        }
    }
    Ok(extent)
}

fn refuse_mobile(body: &scene::Body, word: &str) -> Result<(), Complaint> {
    if body.kind == Kind::Fixed {
        return Ok(());
    }
    Err(Complaint::new(format!("{word} is for fixed bodies, and \"{}\" is mobile", body.name))
        .hint(format!("make it with fixed(\"{}\"), or give it a .velocity or a .spin", body.name)))
}

fn refuse_both(body: &scene::Body, has_other: bool, other: &str, word: &str) -> Result<(), Complaint> {
    if !has_other {
        return Ok(());
    }
    Err(Complaint::new(format!(
        "\"{}\" has a {other} already; {word} would prescribe the same motion again",
        body.name
    ))
    .hint(format!("leave out .{other} or .{word}")))
}

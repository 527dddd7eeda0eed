//! Loading: bodies of a scene are checked, their areas computed (§2.2), their columns filled.

use std::collections::BTreeSet;

use crate::area::{Rect, Vec2};
use crate::bodies::{Bodies, Inertia, Motion, Role};
use crate::check::{self, BadNumber};
use crate::error::SceneError;
use crate::exchange::impact::Surface;
use crate::frame::{Angle, Frame};
use crate::prescribed::{Course, Prescription, Swing};
use crate::scene::{Body, ExchangeRule, Kind, Part, Scene, Settings};

/// Bodies and rectangles are counted by u32.
const MOST: usize = u32::MAX as usize / 4;

/// Checks every body.
///
/// # Errors
/// The first body that cannot be, with the value.
pub fn check_bodies(scene: &Scene) -> Result<(), SceneError> {
    let rectangles = scene.bodies.iter().map(|body| body.parts.len()).sum();
    for (what, count) in [("bodies", scene.bodies.len()), ("rectangles", rectangles)] {
        if count > MOST {
            return Err(SceneError::TooMany { what, count, limit: MOST });
        }
    }
    let mut names = BTreeSet::new();
    for body in &scene.bodies {
        if !names.insert(body.name.as_str()) {
            return Err(SceneError::DuplicateName { body: body.name.clone() });
        }
        check_numbers(body).map_err(|number| SceneError::Number { body: body.name.clone(), number })?;
        check_sense(body).map_err(|reason| SceneError::Body { body: body.name.clone(), reason })?;
    }
    Ok(())
}

fn check_numbers(body: &Body) -> Result<(), BadNumber> {
    check_pose(body)?;
    for part in &body.parts {
        match part {
            Part::Rect(rect) => check_rect(&rect.scaled(body.scale.0, body.scale.2))?,
            Part::Mesh(extent) => {
                for (what, (least, greatest)) in [("x", extent.x), ("y", extent.y), ("z", extent.z)] {
                    check::finite(&format!("mesh: {what}"), least)?;
                    check::finite(&format!("mesh: {what}"), greatest)?;
                }
                check_rect(&extent.area(body.scale.0, body.scale.2))?;
            }
        }
    }
    for (what, value) in [("mass", body.mass), ("inertia", body.inertia)] {
        value.map(|value| check::positive(what, value)).transpose()?;
    }
    if !body.parts.is_empty() {
        check::positive("inertia", inertia(body).moment)?; // a tiny mass times a tiny size can underflow to 0
    }
    body.restitution.map(|e| check::unit_range("restitution", e)).transpose()?;
    body.friction.map(|f| check::not_negative("friction", f)).transpose()?;
    check_prescription(body)
}

fn check_pose(body: &Body) -> Result<(), BadNumber> {
    for (what, value) in [("scale: x", body.scale.0), ("scale: y", body.scale.1), ("scale: z", body.scale.2)] {
        check::positive(what, value)?;
    }
    check::finite("height", body.height)?;
    check::finite("at: x", body.at.0)?;
    check::finite("at: z", body.at.1)?;
    check::finite("angle", body.angle)?;
    if let Some((x, z)) = body.velocity {
        check::finite("velocity: x", x)?;
        check::finite("velocity: z", z)?;
    }
    body.spin.map(|spin| check::finite("spin", spin)).transpose()?;
    Ok(())
}

/// Sizes must be positive and such that areas and moments are normal numbers: a size of 1e-160 m would
/// give a moment of exactly 0.
fn check_rect(rect: &Rect) -> Result<(), BadNumber> {
    for (what, least, greatest) in [("width", rect.x_min, rect.x_max), ("depth", rect.z_min, rect.z_max)] {
        check::finite(what, least)?;
        check::finite(what, greatest)?;
        let size = check::positive(what, greatest - least)?;
        if !(1e-12..=1e12).contains(&size) {
            return Err(BadNumber { what: what.to_owned(), must: "between 1e-12 and 1e12 m", value: size });
        }
    }
    Ok(())
}

fn check_prescription(body: &Body) -> Result<(), BadNumber> {
    if let Some(patrol) = &body.patrol {
        check::positive("patrol: speed", patrol.speed)?;
        for point in &patrol.points {
            check::finite("patrol: x", point.0)?;
            check::finite("patrol: z", point.1)?;
        }
    }
    if let Some(swing) = &body.swing {
        check::finite("swing: angle", swing.angle)?;
        check::positive("swing: period", swing.period)?;
    }
    Ok(())
}

/// What no single number is at fault for.
fn check_sense(body: &Body) -> Result<(), String> {
    let refuse = |reason: &str| Err(reason.to_owned());
    if body.parts.is_empty() {
        return refuse("it has no rectangle; give it one with .rect, .mesh or .model");
    }
    if body.kind == Kind::Mobile && (body.patrol.is_some() || body.swing.is_some()) {
        return refuse("patrol and swing prescribe the motion of fixed bodies; this one is mobile");
    }
    if body.patrol.is_some() && body.velocity.is_some() {
        return refuse("patrol and velocity both say how it travels; keep one");
    }
    if body.swing.is_some() && body.spin.is_some() {
        return refuse("swing and spin both say how it turns; keep one");
    }
    if body.patrol.is_some() && course(body, Vec2::zeros()).is_none() {
        return refuse("its patrol goes nowhere; give it a point away from where it stands");
    }
    Ok(())
}

fn vec2((x, z): (f64, f64)) -> Vec2 {
    Vec2::new(x, z)
}

/// The rectangles with which a body takes part in collisions (§2.2): none when it does not cross the plane.
pub fn areas(body: &Body, plane: f64) -> impl Iterator<Item = Rect> {
    let (scale_x, scale_y, scale_z) = body.scale;
    body.parts.iter().filter_map(move |part| match part {
        Part::Rect(rect) => Some(rect.scaled(scale_x, scale_z)),
        Part::Mesh(extent) => extent.crosses(scale_y, body.height, plane).then(|| extent.area(scale_x, scale_z)),
    })
}

/// The areas of every part, whether or not it crosses the plane: what a body weighs does not depend on that.
pub fn all_areas(body: &Body) -> impl Iterator<Item = Rect> {
    body.parts.iter().map(|part| match part {
        Part::Rect(rect) => rect.scaled(body.scale.0, body.scale.2),
        Part::Mesh(extent) => extent.area(body.scale.0, body.scale.2),
    })
}

/// What collisions may do to a body; a fixed one has physics when it was given a motion (R9).
pub fn role(body: &Body) -> Role {
    let prescribed = body.patrol.is_some() || body.swing.is_some();
    match body.kind {
        Kind::Mobile => Role::Mobile,
        Kind::Fixed if body.velocity.is_some() || body.spin.is_some() || prescribed => Role::FixedWithPhysics,
        Kind::Fixed => Role::Fixed,
    }
}

/// How deep a strip of the sweep is best made: the mean diagonal of the mobile bodies' rectangles, so that
/// a body reaches into two strips or so, rounded to a power of two so that no later rounding matters.
#[must_use]
pub fn strip_depth(scene: &Scene) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for body in scene.bodies.iter().filter(|body| body.kind == Kind::Mobile) {
        for rect in areas(body, scene.settings.plane) {
            sum += rect.half().norm() * 2.0;
            count += 1.0;
        }
    }
    power_of_two_from(sum / f64::max(count, 1.0))
}

/// The smallest power of two that is at least the value; 1 for what is not positive.
fn power_of_two_from(value: f64) -> f64 {
    if value > 0.0 { libm::ldexp(1.0, libm::ceil(libm::log2(value)) as i32) } else { 1.0 }
}

/// The point coordinates are counted from: (0, 0), unless the scene lies many times its own size away.
///
/// It moves with the scene by whole cells of a power of two, so a scene shifted by such a cell gives the
/// same bits, and 1e8 m out nothing is lost that the given coordinates have not lost already.
#[must_use]
pub fn origin(scene: &Scene) -> Vec2 {
    let bounds = scene.bodies.iter().map(|body| (vec2(body.at), vec2(body.at)));
    let Some((low, high)) = bounds.reduce(|a, b| (a.0.inf(&b.0), a.1.sup(&b.1))) else {
        return Vec2::zeros();
    };
    let (middle, size) = ((low + high) * 0.5, high - low);
    let cell = CELLS_PER_SCENE * power_of_two_from(f64::max(1.0, size.x.max(size.y)));
    if cell.is_finite() { middle.map(|x| libm::round(x / cell) * cell) } else { Vec2::zeros() }
}

/// A scene within half a cell of the world's origin keeps that origin; 16 times its own size is near enough
/// for a loss of four bits at most.
const CELLS_PER_SCENE: f64 = 16.0;

/// The moment of inertia about O of uniform rectangles that share the mass by area (M4 of the mass
/// properties; overlapping parts count twice).
#[must_use]
pub fn uniform_moment(rects: &[Rect], mass: f64) -> f64 {
    let area: f64 = rects.iter().map(|rect| rect.width() * rect.depth()).sum();
    rects
        .iter()
        .map(|rect| {
            let (w, d, c) = (rect.width(), rect.depth(), rect.centre());
            mass * (w * d / area) * ((w * w + d * d) / 12.0 + c.x * c.x + c.y * c.y)
        })
        .sum()
}

/// The columns of all bodies of a checked scene, placed relative to the origin.
#[must_use]
pub fn bodies(scene: &Scene, origin: Vec2) -> Bodies {
    let count = scene.bodies.len();
    let mut bodies =
        Bodies { lost: vec![Vec2::zeros(); count], first_rect: Vec::with_capacity(count + 1), ..Bodies::default() };
    bodies.first_rect.push(0);
    for body in &scene.bodies {
        let angle = Angle::new(body.angle);
        bodies.angle.push(angle);
        bodies.frame.push(Frame::new(vec2(body.at) - origin, angle.value));
        bodies.motion.push(Motion { v: vec2(body.velocity.unwrap_or_default()), omega: body.spin.unwrap_or_default() });
        bodies.role.push(role(body));
        bodies.inertia.push(inertia(body));
        if scene.settings.exchange == ExchangeRule::Impulse {
            bodies.surface.push(surface(body, &scene.settings));
        }
        bodies.rects.extend(areas(body, scene.settings.plane));
        bodies.first_rect.push(bodies.rects.len() as u32);
    }
    bodies.rects.shrink_to_fit();
    bodies
}

/// A body's own restitution and friction, or else the scene's.
#[must_use]
pub fn surface(body: &Body, settings: &Settings) -> Surface {
    Surface {
        restitution: body.restitution.unwrap_or(settings.restitution),
        friction: body.friction.unwrap_or(settings.friction),
    }
}

fn inertia(body: &Body) -> Inertia {
    let mass = body.mass.unwrap_or(1.0);
    let moment = body.inertia.unwrap_or_else(|| uniform_moment(&all_areas(body).collect::<Vec<_>>(), mass));
    Inertia { mass, moment }
}

/// The prescribed motions of a checked scene.
#[must_use]
pub fn prescriptions(scene: &Scene, origin: Vec2) -> Vec<Prescription> {
    let prescribed = |body: &&Body| body.patrol.is_some() || body.swing.is_some();
    let index = |(i, body): (usize, &Body)| Prescription {
        body: i,
        course: course(body, origin),
        swing: body.swing.map(|swing| Swing::new(body.angle, swing)),
    };
    scene.bodies.iter().enumerate().filter(|(_, body)| prescribed(body)).map(index).collect()
}

fn course(body: &Body, origin: Vec2) -> Option<Course> {
    let patrol = body.patrol.as_ref()?;
    let points: Vec<Vec2> = patrol.points.iter().map(|point| vec2(*point) - origin).collect();
    Course::new(vec2(body.at) - origin, &points, patrol.speed)
}

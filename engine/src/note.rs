//! Notes: where the physics will not do what a scene seems to hope.

use core::fmt;
use std::collections::BTreeMap;

use crate::area::{Rect, Vec2};
use crate::broad_phase::BroadPhase;
use crate::check::shown;
use crate::detect::{self, overlap};
use crate::load;
use crate::plan::ExchangePlan;
use crate::scene::{Body, Detection, ExchangeRule, Kind, MotionRule, Scene, Settings};
use crate::work::Work;
use crate::world::{BodyId, World};

/// Something a designer should know; not an error.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// The body it is about, if it is about one.
    pub body: Option<String>,
    /// What is the matter, and what can be done.
    pub text: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.body {
            Some(body) => write!(f, "body \"{body}\": {}", self.text),
            None => f.write_str(&self.text),
        }
    }
}

/// All notes on a scene and the world at its start, body after body.
#[must_use]
pub fn review(scene: &Scene, world: &World) -> Vec<Note> {
    let mut notes = without_effect(&scene.settings);
    for (about, look) in [
        ("do not cross the collision plane", misses_plane as fn(&Body, &Scene) -> Option<String>),
        ("have their rectangles' centre elsewhere", centre_elsewhere),
        ("are fast for their thickness", too_fast),
    ] {
        let mut found = scene.bodies.iter().filter_map(|body| Some((body, look(body, scene)?)));
        notes.extend(found.by_ref().take(NAMED).map(|(body, text)| Note { body: Some(body.name.clone()), text }));
        let more = found.count();
        if more > 0 {
            notes.push(Note { body: None, text: format!("{more} more bodies {about}") });
        }
    }
    notes.extend(starts_overlapped(world));
    notes
}

/// What only the contacts of stepped impulses read.
fn without_effect(settings: &Settings) -> Vec<Note> {
    if settings.solves_contacts() {
        return Vec::new();
    }
    let is_unseen = settings.motion == MotionRule::Stepped && settings.exchange == ExchangeRule::Impulse;
    let needed = if is_unseen { "detection(\"complete\")" } else { "exchange(\"impulse\") with motion(\"stepped\")" };
    let substeps = settings.substeps.map(|count| format!("substeps({count})"));
    let sleeping = settings.sleeping.then(|| "sleeping(true)".to_owned());
    let note = |word: String| Note { body: None, text: format!("{word} does nothing here: it is for {needed}") };
    substeps.into_iter().chain(sleeping).map(note).collect()
}

fn misses_plane(body: &Body, scene: &Scene) -> Option<String> {
    let plane = scene.settings.plane;
    let crossing = load::areas(body, plane).count();
    (crossing < body.parts.len()).then(|| {
        let which = match body.parts.len() {
            1 => "its mesh does".to_owned(),
            all => format!("{} of its {all} parts do", all - crossing),
        };
        let left = if crossing == 0 { "it is not collidable" } else { "they are left out of collisions" };
        format!("{which} not cross the collision plane at height {plane} m: {left}")
    })
}

/// O is the centre of mass by definition; rectangles that lie elsewhere are perhaps not meant so.
fn centre_elsewhere(body: &Body, _: &Scene) -> Option<String> {
    if body.kind == Kind::Fixed {
        return None;
    }
    let rects: Vec<Rect> = load::all_areas(body).collect();
    let area: f64 = rects.iter().map(|rect| rect.width() * rect.depth()).sum();
    let middle: Vec2 = rects.iter().map(|rect| rect.centre() * (rect.width() * rect.depth() / area)).sum();
    let size = rects.iter().map(|rect| rect.half().norm()).fold(0.0, f64::max);
    (middle.norm() > 0.01 * size).then(|| {
        format!(
            "its rectangles' own centre is at ({}, {}) in its frame, but it turns about (0, 0), which is its centre \
             of mass by definition",
            shown(rounded(middle.x)),
            shown(rounded(middle.y)),
        )
    })
}

/// Found only after a step, an overlap deeper than half a thickness is pushed out on the wrong side. Where contacts are solved, what is
/// fast is followed to its impacts.
fn too_fast(body: &Body, scene: &Scene) -> Option<String> {
    if scene.settings.motion == MotionRule::Continuous || scene.settings.solves_contacts() {
        return None;
    }
    let rects: Vec<Rect> = load::areas(body, scene.settings.plane).collect();
    let thickness = rects.iter().map(|rect| rect.width().min(rect.depth())).reduce(f64::min)?;
    let reach = rects.iter().flat_map(|rect| rect.vertices()).map(|vertex| vertex.norm()).fold(0.0, f64::max);
    let (vx, vz) = body.velocity.unwrap_or_default();
    let travel = body.patrol.as_ref().map_or(libm::hypot(vx, vz), |patrol| patrol.speed);
    let spin = body.swing.map_or(body.spin.unwrap_or(0.0), |swing| 4.0 * swing.angle / swing.period);
    let dt = scene.settings.time_step;
    let per_step = (travel + spin.abs() * reach) * dt;
    (per_step > thickness && per_step.is_finite()).then(|| {
        format!(
            "its fastest point moves {} m a step but it is only {} m thick, so it may pass through others; \
             use time_step({:.1e}) or less",
            shown(rounded(per_step)),
            shown(rounded(thickness)),
            dt * (0.5 * thickness / per_step),
        )
    })
}

/// To three decimals: a note is read, not computed with.
fn rounded(value: f64) -> f64 {
    if value < 1e12 { libm::round(value * 1e3) / 1e3 } else { value }
}

/// How many notes of a kind name their body; the rest are counted.
const NAMED: usize = 5;

fn starts_overlapped(world: &World) -> Vec<Note> {
    // Only the first pairs are kept: a forgotten .at in a loop makes millions.
    let mut first = BTreeMap::new();
    let mut more = false;
    BroadPhase::new(world.plan.broad_phase).visit(&world.bodies, &mut Work::default(), |i, j, _| {
        let is_early = first.len() < NAMED || first.last_key_value().is_some_and(|(last, _)| (i, j) <= *last);
        let depth = if is_early || !more { overlap::between(&world.bodies, i, j) } else { 0.0 };
        if depth > touching(world, i).min(touching(world, j))
            && first.insert((i, j), depth).is_none()
            && first.len() > NAMED
        {
            first.pop_last();
            more = true;
        }
    });
    let mut notes: Vec<Note> = first.iter().map(|(&(i, j), &depth)| overlap_note(world, i, j, depth)).collect();
    if more {
        notes.push(Note { body: None, text: "more pairs start overlapped".to_owned() });
    }
    notes
}

/// Less than this is a touch that rounding has made an overlap \[m\].
fn touching(world: &World, body: usize) -> f64 {
    1e-9 * world.bodies.smallest_half(body)
}

fn overlap_note(world: &World, i: usize, j: usize, depth: f64) -> Note {
    let name = |i: usize| world.name(BodyId(i as u32));
    let is_seen = match world.plan.detection {
        Detection::Vertices => detect::vertices::find(&world.bodies, i, j, &mut Work::default()).is_some(),
        Detection::Complete => true,
    };
    let outcome = match (is_seen, world.plan.exchange) {
        (false, _) => "no vertex of one lies in the other, so detection(\"vertices\") does not see it",
        (true, ExchangePlan::Document { .. }) => "the first iteration will begin to part them",
        (true, ExchangePlan::Impulse) if world.plan.contact.is_some() => {
            "contacts will part them within a few iterations"
        }
        (true, ExchangePlan::Impulse) => "the impulse exchange does not move bodies, so it stays until they part",
    };
    let text = format!("it starts {} m deep in \"{}\"; {outcome}", shown(rounded(depth)), name(j));
    Note { body: Some(name(i).to_owned()), text }
}

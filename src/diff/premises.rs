//! What was said or modelled otherwise before anything moved.

use choque_engine::scene::{MotionRule, Settings};

use crate::recording::{Body, Recording};

/// Bodies made otherwise that are named.
const MOST_BODIES: usize = 6;

/// Which parts of an iteration the premises make different. Where a recording does not show all of an iteration this says what a
/// difference cannot come from: whatever is the same in the premises came out the same from the same bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Otherwise {
    /// How bodies move that nothing touches.
    pub(super) flies: bool,
    /// Which bodies are found to touch, when, and where.
    pub(super) finds: bool,
    /// What they hand each other.
    pub(super) hands: bool,
}

impl Otherwise {
    pub(super) fn of(a: &Recording, b: &Recording) -> Self {
        let (one, other) = (&a.about.settings, &b.about.settings);
        let flight = |recording: &Recording| {
            let settings = &recording.about.settings;
            (recording.about.time_step, settings.gravity, settings.drag)
        };
        let search = |s: &Settings| (s.exchange, s.detection_that_holds(), s.motion, s.plane);
        let law = |s: &Settings| (s.exchange, s.mu_l, s.mu_a, s.restitution, s.friction, s.substeps, s.sleeping);
        let surfaces = told_surfaces([a, b]);
        let of_body = |body: &Body| (body.mass, body.inertia, surfaces(body));
        let bodies = || a.bodies.iter().zip(&b.bodies);
        Otherwise {
            flies: flight(a) != flight(b),
            finds: search(one) != search(other) || bodies().any(|(a, b)| a.rects != b.rects),
            hands: law(one) != law(other) || bodies().any(|(a, b)| of_body(a) != of_body(b)),
        }
    }
}

/// What is told of a body's own restitution and friction: nothing where one of the two runs is of the first recordings, which do not
/// tell of them.
fn told_surfaces(runs: [&Recording; 2]) -> impl Fn(&Body) -> [Option<f64>; 2] {
    let own = |body: &Body| [body.restitution, body.friction];
    let tells = |run: &Recording| run.about.surfaces || run.bodies.iter().any(|body| own(body) != [None; 2]);
    let both_tell = runs.into_iter().all(tells);
    move |body| if both_tell { own(body) } else { [None; 2] }
}

/// Whether an iteration's overlaps are listed before any of them is treated.
pub(super) fn lists(recording: &Recording) -> bool {
    let settings = &recording.about.settings;
    settings.motion == MotionRule::Stepped && !settings.solves_contacts()
}

/// Lines that name what differs: version, build, sources, what was set, the plan.
pub(super) fn premises(a: &Recording, b: &Recording) -> Vec<String> {
    let (one, other) = (&a.about, &b.about);
    let mut lines = Vec::new();
    let note = |lines: &mut Vec<String>, what: &str, a: &str, b: &str| {
        if a != b {
            lines.push(format!("{what}: {a} against {b}"));
        }
    };
    note(&mut lines, "choque", &one.choque, &other.choque);
    note(&mut lines, "built by", &one.build.rustc, &other.build.rustc);
    note(&mut lines, "built for", &one.build.target, &other.build.target);
    note(&mut lines, "processor", &one.build.cpu, &other.build.cpu);
    note(&mut lines, "scenario", &one.scenario, &other.scenario);
    for (name, a, b) in settings(&one.settings, &other.settings) {
        note(&mut lines, &name, &a, &b);
    }
    for param in &one.params {
        if let Some(same) = other.params.iter().find(|same| same.name == param.name) {
            note(&mut lines, &format!("param {}", param.name), &param.value.to_string(), &same.value.to_string());
        }
    }
    let bodies = a.bodies.iter().filter_map(|one| Some((one, b.bodies.iter().find(|other| other.name == one.name)?)));
    let surfaces = told_surfaces([a, b]);
    for (one, other) in bodies.filter(|(one, other)| one != other).take(MOST_BODIES) {
        let [own_a, own_b] = [surfaces(one), surfaces(other)];
        let own = |number: Option<f64>| number.map_or_else(|| "the scene's".to_owned(), |number| number.to_string());
        let rows = [
            ("mass [kg]", one.mass.to_string(), other.mass.to_string()),
            ("inertia [kg·m²]", one.inertia.to_string(), other.inertia.to_string()),
            ("restitution", own(own_a[0]), own(own_b[0])),
            ("friction", own(own_a[1]), own(own_b[1])),
        ];
        for (what, a, b) in rows {
            note(&mut lines, &format!("{}, {what}", one.name), &a, &b);
        }
        if one.rects != other.rects {
            lines.push(format!("{} is of another shape", one.name));
        }
    }
    if one.scenario == other.scenario {
        for source in &one.sources {
            let same = |other: &&crate::recording::Source| last_part(&other.name) == last_part(&source.name);
            if other.sources.iter().find(same).is_some_and(|other| other.text != source.text) {
                lines.push(format!("the text of {} is another", last_part(&source.name)));
            }
        }
    }
    lines
}

/// Settings that differ, by name, as they would be written.
fn settings(a: &Settings, b: &Settings) -> Vec<(String, String, String)> {
    let (a, b) = (fields(a), fields(b));
    let differ = a.into_iter().zip(b).filter(|(a, b)| a != b);
    differ.map(|((name, a), (_, b))| (name, a, b)).collect()
}

fn fields(s: &Settings) -> Vec<(String, String)> {
    let numbers = [
        ("time_step", s.time_step),
        ("mu_l", s.mu_l),
        ("mu_a", s.mu_a),
        ("epsilon", s.epsilon),
        ("plane", s.plane),
        ("restitution", s.restitution),
        ("friction", s.friction),
    ];
    let rest = [
        ("steps", s.steps.to_string()),
        ("exchange", s.exchange.word().to_owned()),
        ("detection", s.detection_that_holds().word().to_owned()),
        ("motion", s.motion.word().to_owned()),
        ("gravity", pair(s.gravity)),
        ("drag", pair(s.drag)),
        ("substeps", s.substeps.map_or_else(|| "as the plan picks".to_owned(), |n| n.to_string())),
        ("sleeping", s.sleeping.to_string()),
        ("seed", s.seed.to_string()),
    ];
    let numbers = numbers.into_iter().map(|(name, number)| (name.to_owned(), number.to_string()));
    numbers.chain(rest.into_iter().map(|(name, text)| (name.to_owned(), text))).collect()
}

fn pair((x, z): (f64, f64)) -> String {
    format!("({x}, {z})")
}

fn last_part(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

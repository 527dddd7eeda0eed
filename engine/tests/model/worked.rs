//! Four scenes worked out by an independent program, every number of which must come out again.

use choque_engine::scene::{Body, Kind, Part, Scene, Settings};
use choque_engine::{Rect, World};
use serde_json::Value;

const WORKED: &str = include_str!("worked.json");

/// Relative to 1 or to the value, whichever is greater: room for a few thousand roundings, amplified by up
/// to twenty collisions.
const TOLERANCE: f64 = 1e-12;

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or(0.0)
}

fn body(json: &Value) -> Body {
    let kind = Kind::from_word(json["kind"].as_str().unwrap_or("mobile")).expect("a kind");
    let mut body = Body::new(json["name"].as_str().expect("a name"), kind);
    for rect in json["rects"].as_array().expect("rects") {
        let [x_min, x_max, z_min, z_max] = [0, 1, 2, 3].map(|i| rect[i].as_f64().expect("a number"));
        body.parts.push(Part::Rect(Rect { x_min, x_max, z_min, z_max }));
    }
    body.at = (number(json, "x"), number(json, "z"));
    body.angle = number(json, "angle");
    if json["vx"].is_number() || json["vz"].is_number() {
        body.velocity = Some((number(json, "vx"), number(json, "vz")));
    }
    body.spin = json["spin"].as_f64();
    body.mass = json["mass"].as_f64();
    body
}

fn scene(json: &Value) -> Scene {
    let settings = Settings {
        time_step: number(json, "dt"),
        steps: json["steps"].as_u64().expect("steps"),
        mu_l: number(json, "mu_l"),
        mu_a: number(json, "mu_a"),
        epsilon: number(json, "epsilon"),
        ..Settings::default()
    };
    Scene {
        settings,
        bodies: json["bodies"].as_array().expect("bodies").iter().map(body).collect(),
        ..Scene::default()
    }
}

fn assert_near(what: &str, found: f64, expected: f64) {
    let allowed = TOLERANCE * expected.abs().max(1.0);
    assert!((found - expected).abs() <= allowed, "{what}: {found} instead of {expected}");
}

fn assert_same_angle(what: &str, found: f64, expected: f64) {
    let apart = libm::remainder(found - expected, std::f64::consts::TAU);
    assert!(apart.abs() <= TOLERANCE, "{what}: angle {found} instead of {expected}");
}

fn check(name: &str) {
    let worked: Value = serde_json::from_str(WORKED).expect("worked.json is JSON");
    let case = &worked[name];
    let mut world = World::new(&scene(&case["scene"])).expect("a valid scene");
    let mut hits = Vec::new();
    for _ in 0..world.plan().steps {
        world.begin();
        hits.extend(std::iter::from_fn(|| world.treat_next()));
        world.finish();
    }
    for (hit, expected) in hits.iter().zip(case["first_events"].as_array().expect("events")) {
        assert_eq!(Some(hit.iteration), expected["iteration"].as_u64());
        assert_eq!(Some(world.name(hit.a)), expected["a"].as_str());
        assert_eq!(Some(world.name(hit.b)), expected["b"].as_str());
        assert_near("depth", hit.depth, number(expected, "depth"));
    }
    assert_eq!(Some(world.collisions()), case["collisions"].as_u64());
    for (id, expected) in world.ids().zip(case["bodies"].as_array().expect("bodies")) {
        let (o, v) = (world.position(id), world.velocity(id));
        assert_near("x", o.x, number(expected, "x"));
        assert_near("z", o.y, number(expected, "z"));
        assert_same_angle(world.name(id), world.angle(id), number(expected, "angle"));
        assert_near("vx", v.x, number(expected, "vx"));
        assert_near("vz", v.y, number(expected, "vz"));
        assert_near("spin", world.spin(id), number(expected, "spin"));
    }
}

#[test]
fn two_squares_come_out_as_worked() {
    check("two_squares");
}

#[test]
fn a_square_and_a_wall_come_out_as_worked() {
    check("square_and_wall");
}

#[test]
fn a_blade_and_a_square_come_out_as_worked() {
    check("blade_and_square");
}

#[test]
fn mixed_masses_and_a_compound_come_out_as_worked() {
    check("mixed_masses");
}

//! The documentation that words carry.

use std::collections::BTreeSet;
use std::fs;

use choque_scripting::{Options, words};

use crate::support::Folder;

/// The words of the contract, as one writes them.
const CONTRACT: &str = "title time_step steps mu_l mu_a epsilon plane exchange detection motion substeps sleeping broad_phase restitution \
    friction gravity drag seed random random_int param deg mobile fixed rect mesh model height scale at angle velocity \
    spin patrol swing mass inertia tag on_step on_collision stop_when expect always time iteration collisions \
    kinetic_energy momentum_x momentum_z angular_momentum deepest [] body bodies tagged x z vx vz name speed kind push \
    twist a b depth ledger initial relocated relocations restitution relocation commands fixed_bodies sin cos tan sqrt abs min max div PI";

#[test]
fn every_word_of_the_contract_is_there_and_every_word_is_documented() {
    let words = words::all();
    for name in CONTRACT.split_whitespace() {
        assert!(words.iter().any(|word| word.name == name), "{name} is missing");
    }
    for word in &words {
        assert!(!word.docs.is_empty(), "{} has no documentation", word.name);
        assert!(!word.signatures.is_empty());
        let text = format!("{} {:?}", word.docs, word.signatures);
        for noise in ["Dynamic", "NativeCallContext", "i64", "f64", "&mut", "\\[", "get$"] {
            assert!(!text.contains(noise), "{}: {text}", word.name);
        }
    }
}

#[test]
fn a_word_shows_all_ways_of_writing_it() {
    let words = words::all();
    let signatures = |group: &str, name: &str| {
        let found = words.iter().filter(|word| word.group == group && word.name == name);
        found.flat_map(|word| word.signatures.clone()).collect::<Vec<_>>()
    };
    assert_eq!(signatures("bodies", "rect"), ["body.rect(width, depth)", "body.rect(x_min, x_max, z_min, z_max)"]);
    assert_eq!(signatures("settings", "param"), ["param(name, default)", "param(name, default, min, max)"]);
    assert_eq!(signatures("motion", "spin"), ["body.spin", "body.spin = …"]);
    assert_eq!(signatures("expectations", "expect"), ["expect(text, |world| …)"]);
    assert_eq!(signatures("callbacks", "on_collision"), ["fn on_collision(world, hit)"]);
    assert_eq!(signatures("world", "x"), ["hit.x"]);
    assert_eq!(signatures("world", "[]"), ["world[name]"]);
}

#[test]
fn definitions_for_editors_hold_every_group() {
    let folder = tempfile::TempDir::new().unwrap();
    let files = words::write_definitions(&folder.path().join("new")).unwrap();
    let mut names: Vec<String> =
        files.iter().map(|file| file.file_name().unwrap().to_string_lossy().into_owned()).collect();
    names.sort();
    let groups = [
        "bodies",
        "callbacks",
        "expectations",
        "fit",
        "ledger",
        "mathematics",
        "motion",
        "random",
        "settings",
        "world",
    ];
    assert_eq!(names, groups.map(|group| format!("{group}.d.rhai")));
    let all: String = files.iter().map(|file| fs::read_to_string(file).unwrap()).collect();
    for line in [
        "fn rect(body: Body, width: Number, depth: Number) -> Body;",
        "fn get vx(body: Body) -> float;",
        "fn set vx(body: Body, vx: Number) -> ();",
        "fn time_step(seconds: Number) -> ();",
        "fn on_step(world: World) -> ?;",
        "fn sin(rad: Number) -> float;",
        "const PI: float;",
    ] {
        assert!(all.lines().any(|known| known == line), "{line}");
    }
    for noise in ["index$", "Dynamic", "Result", "Box", "context", "choque"] {
        assert!(!all.contains(noise), "{noise}");
    }
}

/// The examples in a text, as they are fenced.
fn examples(docs: &str) -> impl Iterator<Item = &str> {
    docs.split("```rhai\n").skip(1).filter_map(|rest| rest.split("```").next())
}

/// An example with what it speaks of and does not make: bodies that meet in the first iteration, a tunable number.
fn completed(example: &str) -> String {
    let mut script =
        format!("{example}\nmobile(\"one\").rect(1, 1); mobile(\"two\").rect(1, 1).at(0.5, 0.5);\nsteps(3);\n");
    let named = ["world[\"", "world.body(\""].into_iter().flat_map(|before| example.split(before).skip(1));
    let named: BTreeSet<&str> = named.filter_map(|rest| rest.split('"').next()).collect();
    let is_made = |name: &str| ["mobile", "fixed"].iter().any(|kind| example.contains(&format!("{kind}(\"{name}\")")));
    for name in named.into_iter().filter(|name| !is_made(name)) {
        let kind = if matches!(name, "blade" | "wall") { "fixed" } else { "mobile" };
        script += &format!("{kind}(\"{name}\").rect(1, 1).at(20, 0);\n");
    }
    if example.contains("vary(\"push\"") && !example.contains("param(") {
        script = format!("param(\"push\", 8, 0, 30);\n{script}");
    }
    script
}

#[test]
fn every_word_of_a_scene_has_an_example_and_every_example_runs() {
    let car = "v -1 0 -1\nv 1 1 1\n";
    let mut run = 0;
    for word in words::all() {
        let of_numbers = word.group == "mathematics";
        assert!(of_numbers || word.docs.contains("```rhai"), "{} {} has no example", word.group, word.name);
        for example in examples(&word.docs) {
            let script = completed(example);
            let folder = Folder::with(&[("scene.rhai", &script), ("lib/car.obj", car)]);
            folder.run("scene.rhai", &Options::default()).unwrap_or_else(|error| panic!("{error}\n{script}"));
            run += 1;
        }
    }
    assert!(run > 90, "{run}");
}

/// Within the digits that are shown.
#[test]
fn every_word_of_mathematics_tells_a_value_and_it_is_true() {
    for word in words::all().iter().filter(|word| word.group == "mathematics") {
        let mut told = 0;
        for (call, rest) in word.docs.split('`').skip(1).step_by(2).zip(word.docs.split('`').skip(2).step_by(2)) {
            let Some(value) = rest.strip_prefix(" is ").and_then(|rest| rest.split([',', ' ', '`']).next()) else {
                continue;
            };
            let value = value.trim_end_matches('.');
            let holds = match value.parse::<f64>() {
                Ok(number) => format!("abs(({call}) - ({number:?})) < 0.0005"),
                Err(_) if matches!(value, "true" | "false") => format!("({call}) == {value}"),
                Err(_) => continue,
            };
            let script = format!("if !({holds}) {{ throw `{call} is not {value}`; }}");
            let folder = Folder::with(&[("scene.rhai", &script)]);
            folder.run("scene.rhai", &Options::default()).unwrap_or_else(|error| panic!("{error}"));
            told += 1;
        }
        assert!(told > 0, "{} tells no value", word.name);
    }
}

//! The documentation that words carry.

use std::fs;

use choque_scripting::words;

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

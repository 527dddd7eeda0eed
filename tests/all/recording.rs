//! Recordings: what is written is read back to the last bit, and what is broken is refused with its place.

use std::fs;
use std::path::Path;

use choque::recording::{Recording, Settings, record};
use choque_scripting::{Options, Scenario};

use crate::support::{choque, folder, stderr, stdout};

/// A scene with everything that frames hold: commands, pushes, exchanges, drag, a patrol, a ledger.
const LIVELY: &str = r#"
title("Lively");
time_step(1.0 / 64); steps(96); drag(0.1, 0.2); mu_l(0.9);
let speed = param("speed", 3, 0, 10);
fixed("door").rect(1, 4).at(4, 0).patrol([[4, 3]], 1);
fixed("wall").rect(1, 9).at(-4, 0);
mobile("a").rect(1, 1).at(-2, 0).velocity(speed, 0.3).spin(0.5).tag("fast");
mobile("b").rect(1, 2).rect(2, 0.5).at(0.5, 0.4).mass(3);
mobile("still").rect(1, 1).at(0, 30);
fn on_step(world) {
    if world.iteration == 20 { world["b"].vz = 1; world["b"].push(3, 4); }
}
fn on_collision(world, hit) { hit.a.spin = 0; }
expect("a is somewhere", |world| world["a"].x > -100);
"#;

fn recorded(script: &str, settings: &Settings) -> Recording {
    let folder = folder(&[("lively.rhai", script)]);
    let scenario = Scenario::load(&folder.path().join("lively.rhai"), &Options::default()).expect("a scenario");
    record(&scenario, settings).expect("a run")
}

fn with_ledger() -> Settings {
    Settings { ledger: true, command: vec!["choque".to_owned()], ..Settings::default() }
}

#[test]
fn what_is_written_is_read_back_to_the_last_bit() {
    let stacked = "exchange(\"impulse\"); gravity(0, -10); friction(0.5); fixed(\"floor\").rect(20, 1);
        for i in 0..4 { mobile(\"box\" + i).rect(1, 1).at(0.1 * i, 1 + i); } steps(50);";
    for (script, settings) in [
        (LIVELY.to_owned(), with_ledger()),
        (LIVELY.replace("drag(0.1, 0.2)", "motion(\"continuous\"); exchange(\"impulse\")"), Settings::default()),
        (stacked.to_owned(), Settings { every: 7, ..with_ledger() }),
    ] {
        let recording = recorded(&script, &settings);
        let bytes = recording.to_bytes().expect("bytes");
        let again = Recording::from_bytes(&bytes).expect("the same");
        assert_eq!(again, recording);
        let bits = |recording: &Recording| -> Vec<u64> {
            let states = recording.frames.iter().flat_map(|frame| &frame.states);
            states.flat_map(|state| state.to_array().map(f64::to_bits)).collect()
        };
        assert_eq!(bits(&again), bits(&recording), "also the sign of 0");
        assert_eq!(again.to_bytes().expect("bytes"), bytes);
    }
}

#[test]
fn a_recording_holds_what_a_run_was_made_of() {
    let recording = recorded(LIVELY, &with_ledger());
    let about = &recording.about;
    assert_eq!((about.title.as_str(), about.scenario.as_str(), about.steps), ("Lively", "lively", 96));
    assert_eq!(about.sources.len(), 1);
    assert_eq!(about.sources[0].text, LIVELY);
    assert_eq!((about.params[0].name.as_str(), about.params[0].value), ("speed", 3.0));
    assert_eq!(about.settings.mu_l, 0.9);
    assert_eq!(about.choque, env!("CARGO_PKG_VERSION"));
    assert!(about.plan.iter().any(|line| line.starts_with("left out:")));
    assert!(about.build.rustc.contains("rustc"));
    let b = &recording.bodies[3];
    assert_eq!((b.name.as_str(), b.mass, b.rects.len()), ("b", 3.0, 2));
    assert_eq!(recording.bodies[2].tags, ["fast"]);
    let last = recording.frames.last().expect("frames");
    assert_eq!((recording.frames.len(), last.iteration, last.time), (97, 96, 1.5));
    assert!(recording.ending.expectations[0].held);
    assert!(last.books.as_ref().is_some_and(|books| books.booked.len() == about.causes.len()));
    let hits: usize = recording.frames.iter().map(|frame| frame.hits.len()).sum();
    assert!(hits > 0 && hits as u64 == recording.ending.collisions);
    let commands: Vec<(u64, u32)> =
        recording.frames.iter().flat_map(|frame| &frame.commands).map(|c| (c.iteration, c.body)).collect();
    assert!(commands.contains(&(20, 3)), "{commands:?}");
    assert_eq!(recording.frames[21].pushes[0].force, [3.0, 4.0]);
}

#[test]
fn frames_may_be_few_and_the_end_is_always_one() {
    let recording = recorded(LIVELY, &Settings { every: 10, ..Settings::default() });
    let iterations: Vec<u64> = recording.frames.iter().map(|frame| frame.iteration).collect();
    assert_eq!(iterations, [0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 96]);
    let hits: usize = recording.frames.iter().map(|frame| frame.hits.len()).sum();
    assert_eq!(hits as u64, recording.ending.collisions, "what happened in between is kept");
    let stopped = format!("{LIVELY}\nfn stop_when(world) {{ world.iteration == 33 }}");
    let recording = recorded(&stopped, &Settings { every: 10, ..Settings::default() });
    assert_eq!(recording.frames.last().map(|frame| frame.iteration), Some(33));
}

#[test]
fn a_broken_file_is_refused_with_its_place_whatever_is_broken() {
    let script = "steps(3); mobile(\"a\").rect(1, 1).velocity(1, 0); mobile(\"b\").rect(1, 1).at(0.9, 0);";
    let bytes = recorded(script, &Settings::default()).to_bytes().expect("bytes");
    for at in 0..bytes.len() {
        let broken = Recording::from_bytes(&bytes[..at]).expect_err("a file that is cut off");
        assert!(broken.offset <= at as u64, "{broken}");
        for bit in [0, 3, 7] {
            let mut flipped = bytes.clone();
            flipped[at] ^= 1 << bit;
            let broken = Recording::from_bytes(&flipped).expect_err("a flipped bit");
            assert!(broken.offset <= bytes.len() as u64, "{broken}");
        }
    }
    let longer = [bytes.as_slice(), b"more"].concat();
    let broken = Recording::from_bytes(&longer).expect_err("something follows");
    assert_eq!(broken.to_string(), format!("byte {}: 4 bytes follow after the end", bytes.len()));
}

#[test]
fn a_run_writes_its_recording_whole_or_not_at_all() {
    let failing = LIVELY.replace("hit.a.spin = 0", "hit.a.spin = nothing");
    let folder = folder(&[("lively.rhai", LIVELY), ("failing.rhai", &failing)]);
    let call = |arguments: &[&str]| choque().current_dir(folder.path()).args(arguments).output().expect("it runs");
    let run = call(&["run", "lively.rhai", "--record", "run.choque", "--set", "speed=4"]);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let recording = Recording::read(&folder.path().join("run.choque")).expect("a recording");
    assert_eq!(recording.about.given.set, [("speed".to_owned(), 4.0)]);
    assert_eq!(recording.about.command[1..4], ["run", "lively.rhai", "--record"]);
    let failed = call(&["run", "failing.rhai", "--record", "failed.choque"]);
    assert_eq!(failed.status.code(), Some(2));
    assert!(!folder.path().join("failed.choque").exists());
    let refused = call(&["run", "lively.rhai", "--record", "lively.rhai"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("a recording's file name ends in .choque"), "{}", stderr(&refused));
    assert_eq!(fs::read_to_string(folder.path().join("lively.rhai")).expect("the script"), LIVELY);
}

/// Also how deep bodies overlap, which is searched for by the thread that writes; over several blocks.
#[test]
fn a_file_holds_what_is_kept_in_memory() {
    let crossed = "mobile(\"bar\").rect(4, 0.4).at(0, 50).spin(0.1); mobile(\"post\").rect(0.4, 4).at(0.1, 50);";
    let long = format!("{}{crossed}", LIVELY.replace("steps(96)", "steps(300)"));
    let folder = folder(&[("lively.rhai", &long)]);
    let words = ["run", "lively.rhai", "--record", "run.choque"];
    let run = choque().current_dir(folder.path()).args(words).output().expect("it runs");
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let written = Recording::read(&folder.path().join("run.choque")).expect("a recording");
    let kept = recorded(&long, &with_ledger());
    assert_eq!(written.frames, kept.frames);
    assert!(kept.frames.iter().filter(|frame| frame.totals.deepest > 0.0).count() > 10);
}

#[test]
fn a_recording_of_the_first_version_is_read_for_ever() {
    let old = Recording::read(Path::new("tests/recordings/lively.0.1.0.choque")).expect("an old recording");
    assert_eq!((old.about.choque.as_str(), old.about.title.as_str()), ("0.1.0", "Lively"));
    assert_eq!(old.about.sources[0].text, LIVELY);
    let last = old.frames.last().expect("frames");
    assert_eq!((old.frames.len(), last.iteration), (97, 96));
    let a = last.states[2];
    assert_eq!([a.x, a.z, a.angle, a.vx, a.vz, a.spin].map(f64::to_bits), LAST_OF_A);
}

#[test]
fn a_recording_of_the_first_version_is_drawn_and_compared() {
    let folder = folder(&[("lively.rhai", LIVELY)]);
    fs::copy("tests/recordings/lively.0.1.0.choque", folder.path().join("old.choque")).expect("a copy");
    let call = |words: &str| choque().current_dir(folder.path()).args(words.split(' ')).output().expect("it runs");
    let drawn = call("render old.choque -o old.svg");
    assert_eq!(drawn.status.code(), Some(0), "{}", stderr(&drawn));
    let picture = fs::read_to_string(folder.path().join("old.svg")).expect("a picture");
    assert!(picture.contains("<title>Lively at iteration 96</title>"), "{picture}");
    let same = call("diff old.choque old.choque");
    assert!(stdout(&same).contains("the same to the last bit in every one of 97 moments"), "{}", stdout(&same));
    let parted = call("diff old.choque lively.rhai --set-b speed=4.5");
    assert_eq!(parted.status.code(), Some(1), "{}", stderr(&parted));
    assert!(stdout(&parted).contains("they differ from the start"), "{}", stdout(&parted));
}

#[test]
fn what_is_no_recording_is_refused_by_every_call() {
    let good = recorded(LIVELY, &Settings::default()).to_bytes().expect("bytes");
    let folder = folder(&[("empty.choque", ""), ("text.choque", "not one")]);
    fs::create_dir(folder.path().join("folder.choque")).expect("a folder");
    let newer = [&good[..8], &2u32.to_le_bytes(), &good[12..]].concat();
    // Lengths that nobody has room for.
    let giant = [&good[..16], &(u64::MAX / 2).to_le_bytes(), &good[24..]].concat();
    for (name, bytes) in
        [("newer.choque", newer), ("giant.choque", giant), ("cut.choque", good[..good.len() / 2].to_vec())]
    {
        fs::write(folder.path().join(name), bytes).expect("a file");
    }
    for (name, said) in [
        ("empty.choque", "byte 0"),
        ("text.choque", "byte 0"),
        ("newer.choque", "byte 8"),
        ("giant.choque", "byte"),
        ("cut.choque", "byte"),
        ("folder.choque", "cannot read folder.choque"),
        ("none.choque", "cannot read none.choque"),
    ] {
        for call in [vec!["render", name, "-o", "a.svg"], vec!["diff", name, name]] {
            let refused = choque().current_dir(folder.path()).args(&call).output().expect("it runs");
            assert_eq!((refused.status.code(), stdout(&refused).as_str()), (Some(2), ""), "{call:?}");
            assert!(stderr(&refused).contains(said), "{call:?}: {}", stderr(&refused));
        }
    }
}

/// What the body `a` came to, in the version that recorded it.
const LAST_OF_A: [u64; 6] = [
    0xbfc9_c884_0287_f93b,
    0x3f99_8999_e8cb_4dd5,
    0x3fc5_42c2_ee42_bf6b,
    0x3fe4_b094_2f6d_4705,
    0xbfaf_63b0_a002_815a,
    0x0000_0000_0000_0000,
];

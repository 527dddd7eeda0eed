//! Two runs that part: for each stage a pair that first differs there, named with iteration, body, pair and numbers.

use choque::diff::{Parting, Stage, parting};
use choque::recording::{Recording, Settings, record};
use choque_engine::scene::Detection;
use choque_scripting::{Options, Overrides, Scenario};

use crate::support::{choque, folder, stderr, stdout, write};

/// Two bodies meet; what may differ can be set.
const MEETING: &str = r#"
time_step(1.0 / 64); steps(60); mu_l(0.9);
gravity(0, param("pull", 0));
let kick = param("kick", 1); let stop = param("stop", 0);
fixed("far").rect(1, 1).at(0, 50);
mobile("a").rect(1, 1).at(-2, 0.2).velocity(3, 0).spin(0.3);
mobile("b").rect(1, 1).at(0, 0).mass(2);
mobile("alone").rect(1, 1).at(0, -9).velocity(1, 0);
fn on_step(world) { if world.iteration == 7 { world["alone"].vx = param("kick", 1); } }
fn on_collision(world, hit) { if param("stop", 0) > 0 { hit.b.spin = param("stop", 0); } }
"#;

fn run(script: &str, options: &Options) -> Recording {
    let folder = folder(&[("scene.rhai", script)]);
    let scenario = Scenario::load(&folder.path().join("scene.rhai"), options).expect("a scenario");
    record(&scenario, &Settings::default()).expect("a run")
}

fn set(assignments: &[(&str, f64)]) -> Options {
    Options {
        set: assignments.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect(),
        ..Options::default()
    }
}

/// Where the script parts from itself with other settings.
fn parted(script: &str, [a, b]: [&Options; 2]) -> (Parting, Recording) {
    let (a, b) = (run(script, a), run(script, b));
    (parting(&a, &b).expect("they part"), a)
}

fn first_hit(recording: &Recording) -> u64 {
    recording.frames.iter().flat_map(|frame| &frame.hits).map(|hit| hit.iteration).next().expect("they meet")
}

fn names(recording: &Recording, bodies: &[u32]) -> Vec<String> {
    bodies.iter().map(|body| recording.bodies[*body as usize].name.clone()).collect()
}

fn check(
    settings: [&[(&str, f64)]; 2],
    stage: Stage,
    body: &str,
    row: (&str, Option<[f64; 2]>),
) -> (Parting, Recording) {
    let (found, recording) = parted(MEETING, [&set(settings[0]), &set(settings[1])]);
    assert_eq!(found.stage, stage, "{found:?}");
    assert_eq!(names(&recording, &found.body.into_iter().collect::<Vec<_>>()), [body], "{found:?}");
    let given = found.rows.iter().find(|known| known.name == row.0).unwrap_or_else(|| panic!("{found:?}"));
    assert!(row.1.is_none_or(|values| values == given.values), "{found:?}");
    (found, recording)
}

#[test]
fn a_command_that_differs_is_named() {
    let (found, _) = check([&[], &[("kick", 1.5)]], Stage::Command, "alone", ("vx", Some([1.0, 1.5])));
    assert_eq!(found.iteration, 7);
    let answered = [[("stop", 1.0)], [("stop", 2.0)]];
    let (found, run) = check([&answered[0], &answered[1]], Stage::Command, "b", ("spin", Some([1.0, 2.0])));
    assert_eq!(found.iteration, first_hit(&run), "what on_collision does is told from the exchange before it");
}

#[test]
fn a_push_that_differs_is_a_command() {
    let script = format!(
        "{}\nparam(\"force\", 1);",
        MEETING.replace("world[\"alone\"].vx = param(\"kick\", 1)", "world[\"alone\"].push(param(\"force\", 1), 0)")
    );
    let (found, run) = parted(&script, [&set(&[]), &set(&[("force", 2.0)])]);
    assert_eq!((found.stage, found.iteration), (Stage::Command, 7), "{found:?}");
    assert_eq!(names(&run, &found.body.into_iter().collect::<Vec<_>>()), ["alone"]);
    assert_eq!((found.rows[0].name, found.rows[0].values), ("push fx", [1.0, 2.0]));
}

#[test]
fn an_advance_that_differs_is_named() {
    let (found, _) = check([&[], &[("pull", -0.5)]], Stage::Advance, "a", ("vz", None));
    assert_eq!(found.iteration, 0);
}

#[test]
fn a_detection_that_differs_is_named() {
    let crossed = "time_step(1.0 / 64); steps(40); mobile(\"bar\").rect(6, 0.5).at(0, 0.3).velocity(0, -3);
        mobile(\"other\").rect(0.5, 6).at(0, 0);";
    let with = |detection| Options {
        overrides: Overrides { detection: Some(detection), ..Overrides::default() },
        ..Options::default()
    };
    let (found, run) = parted(crossed, [&with(Detection::Vertices), &with(Detection::Complete)]);
    assert_eq!(found.stage, Stage::Detect, "{found:?}");
    assert_eq!(names(&run, &found.pair.expect("a pair")), ["bar", "other"]);
}

#[test]
fn a_relocation_that_differs_is_named() {
    let (found, run) = check([&[], &[("epsilon", 0.002)]], Stage::Relocate, "b", ("x", None));
    assert_eq!(found.iteration, first_hit(&run));
    assert_eq!(names(&run, &found.pair.expect("a pair")), ["a", "b"]);
}

#[test]
fn an_exchange_that_differs_is_named() {
    let (found, run) = check([&[], &[("mu_l", 0.8)]], Stage::Exchange, "b", ("vx", None));
    assert_eq!(found.iteration, first_hit(&run));
    assert_eq!(names(&run, &found.pair.expect("a pair")), ["a", "b"]);
}

#[test]
fn lasting_contacts_and_continuous_motion_have_stages_too() {
    for setting in
        ["exchange(\"impulse\");", "motion(\"continuous\");", "motion(\"continuous\"); exchange(\"impulse\");"]
    {
        let script = format!("{setting}{MEETING}");
        let of = |settings: [&[(&str, f64)]; 2]| parted(&script, [&set(settings[0]), &set(settings[1])]).0.stage;
        let law: [&[(&str, f64)]; 2] =
            if setting.contains("impulse") { [&[], &[("restitution", 0.5)]] } else { [&[], &[("mu_l", 0.5)]] };
        assert_eq!(of(law), Stage::Exchange, "{setting}");
        assert_eq!(of([&[], &[("pull", -0.5)]]), Stage::Advance, "{setting}");
        assert_eq!(of([&[], &[("kick", 2.0)]]), Stage::Command, "{setting}");
    }
}

#[test]
fn a_scene_that_differs_is_no_stage_of_an_iteration() {
    let (a, b) = (run(MEETING, &set(&[])), run(&MEETING.replace("-2, 0.2", "-2, 0.25"), &set(&[])));
    let found = parting(&a, &b).expect("they part");
    assert_eq!((found.stage, found.rows[0].name, found.rows[0].values), (Stage::Scene, "z", [0.2, 0.25]));
    let b = run(&format!("{MEETING}mobile(\"new\").rect(1, 1).at(30, 0);"), &set(&[]));
    assert_eq!(parting(&a, &b).expect("they part").what, "only B has a body \"new\"");
    assert_eq!(parting(&a, &a), None);
}

#[test]
fn the_command_says_where_and_exits_with_what_it_found() {
    let folder = folder(&[("scene.rhai", MEETING)]);
    let call = |words: &str| choque().current_dir(folder.path()).args(words.split(' ')).output().expect("it runs");
    let same = call("diff scene.rhai");
    assert_eq!(same.status.code(), Some(0), "{}", stderr(&same));
    assert!(stdout(&same).contains("the same to the last bit in every one of 61 moments"), "{}", stdout(&same));
    assert_eq!(call("run scene.rhai --record a.choque").status.code(), Some(0));
    assert_eq!(call("run scene.rhai --record b.choque --set mu_l=0.8").status.code(), Some(0));
    for words in ["diff a.choque b.choque", "diff a.choque scene.rhai --set-b mu_l=0.8"] {
        let parted = call(words);
        assert_eq!(parted.status.code(), Some(1), "{}", stderr(&parted));
        let said = stdout(&parted);
        assert!(said.contains("stage exchange of a – b: b") && said.contains("how it grew"), "{said}");
        assert!(said.contains("mu_l: 0.9 against 0.8"), "{said}");
    }
    for words in [
        "diff scene.rhai --set-b mu_l=two",
        "diff scene.rhai --set-b nothing=2",
        "diff no.choque",
        "diff a.choque --set-b mu_l=2",
    ] {
        let bad = call(words);
        assert_eq!((bad.status.code(), stdout(&bad).as_str()), (Some(2), ""), "{words}");
    }
}

#[test]
fn a_run_is_compared_with_its_snapshot() {
    let script = "steps(64); time_step(1.0 / 64); mobile(\"a\").rect(1, 1).velocity(1, 0);
        mobile(\"b\").rect(1, 1).at(1.4, 0.2);";
    let folder = folder(&[("scenarios/one.rhai", script)]);
    let case = choque::harness::cases(folder.path()).expect("cases").remove(0);
    let snapshot = choque::harness::record(&case).expect("a snapshot").to_text().expect("text");
    write(&case.snapshot, &format!("---\nsource: tests/scenarios.rs\n---\n{snapshot}"));
    let call = |words: &str| choque().current_dir(folder.path()).args(words.split(' ')).output().expect("it runs");
    let same = call("diff scenarios/one.rhai --snapshot");
    assert_eq!(same.status.code(), Some(0), "{}{}", stdout(&same), stderr(&same));
    let parted = call("diff scenarios/one.rhai --snapshot --set mu_l=0.5");
    assert_eq!(parted.status.code(), Some(1), "{}", stderr(&parted));
    assert!(stdout(&parted).contains("they part after iteration 24 and before 32"), "{}", stdout(&parted));
    // A recording kept beside the snapshot names the stage.
    assert_eq!(call("run scenarios/one.rhai --record snapshots/one.choque").status.code(), Some(0));
    let parted = call("diff scenarios/one.rhai snapshots/one.snap --set mu_l=0.5");
    assert!(stdout(&parted).contains("stage exchange of a – b: b"), "{}", stdout(&parted));
}

//! Two runs that part: for each stage a pair that first differs there, named with iteration, body, pair and numbers.

use choque::diff::growth::growth;
use choque::diff::told::comparison;
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
    for setting in [
        "exchange(\"impulse\");",
        "exchange(\"impulse\"); detection(\"vertices\");",
        "motion(\"continuous\");",
        "motion(\"continuous\"); exchange(\"impulse\");",
    ] {
        let script = format!("{setting}{MEETING}");
        let of = |settings: [&[(&str, f64)]; 2]| parted(&script, [&set(settings[0]), &set(settings[1])]).0.stage;
        let law: [&[(&str, f64)]; 2] =
            if setting.contains("impulse") { [&[], &[("restitution", 0.5)]] } else { [&[], &[("mu_l", 0.5)]] };
        assert_eq!(of(law), Stage::Exchange, "{setting}");
        assert_eq!(of([&[], &[("pull", -0.5)]]), Stage::Advance, "{setting}");
        assert_eq!(of([&[], &[("kick", 2.0)]]), Stage::Command, "{setting}");
    }
}

/// A box slides, another lands, a third rides on a swinging plank.
const TOUCHING: &str = r#"
time_step(1.0 / 64); steps(40); exchange("impulse"); gravity(0, -10); friction(0.3);
fixed("ground").rect(60, 1).at(0, -0.5);
mobile("box").rect(1, 1).at(0, 0.5).velocity(5, 0);
mobile("drop").rect(1, 1).at(-5, 1).angle(0.2);
fixed("plank").rect(4, 0.4).at(20, 2).swing(deg(10), param("period", 2));
mobile("rider").rect(1, 1).at(20, 2.7);
"#;

/// Friction acts where a box stands, without any exchange being told; restitution only where one lands.
#[test]
fn what_holds_bodies_in_contact_is_the_exchange() {
    for setting in ["", "motion(\"continuous\");"] {
        let script = format!("{TOUCHING}{setting}");
        let of = |name: &'static str, value| parted(&script, [&set(&[]), &set(&[(name, value)])]);
        let (found, run) = of("friction", 0.4);
        assert_eq!((found.stage, found.iteration), (Stage::Exchange, 0), "{setting}: {found:?}");
        assert!(!found.rows.is_empty() && found.body.is_some(), "{found:?}");
        let pair = names(&run, &found.pair.expect("a pair"));
        assert!(pair == ["ground", "box"] || pair == ["plank", "rider"], "{pair:?}");
        assert_eq!(of("restitution", 0.5).0.stage, Stage::Exchange, "{setting}");
    }
}

/// Nothing is ever handed to a fixed body, whoever lies on it.
#[test]
fn a_fixed_body_that_moves_otherwise_advances_otherwise() {
    let script = |turn: f64| {
        format!("{TOUCHING}fn on_step(world) {{ if world.iteration == 9 {{ world[\"plank\"].angle = {turn:?}; }} }}")
    };
    let (a, b) = (run(&script(0.1), &set(&[])), run(&script(0.2), &set(&[])));
    let found = parting(&a, &b).expect("they part");
    assert_eq!((found.stage, found.iteration), (Stage::Command, 9), "{found:?}");
    let patrol = |speed: f64| {
        let script = format!("{TOUCHING}fixed(\"lift\").rect(1, 1).at(40, 0).patrol([[40, {speed:?}], [41, 0]], 4);");
        run(&script, &set(&[]))
    };
    let found = parting(&patrol(1.0), &patrol(2.0)).expect("they part");
    assert_eq!(found.stage, Stage::Advance, "{found:?}");
}

#[test]
fn bodies_that_only_one_has_are_named_and_the_others_compared() {
    let say = |script: &str| {
        let folder = folder(&[("a.rhai", MEETING), ("b.rhai", script)]);
        let call = choque().current_dir(folder.path()).args(["diff", "a.rhai", "b.rhai"]).output().expect("it runs");
        assert_eq!(call.status.code(), Some(1), "{}", stderr(&call));
        stdout(&call)
    };
    let same = "the bodies that both have are the same to the last bit at every moment";
    let said = say(&format!("{MEETING}mobile(\"new\").rect(1, 1).at(30, 0);"));
    assert!(said.contains("only B has a body \"new\"") && said.contains(same), "{said}");
    let said = say(&MEETING.replace("mobile(\"b\")", "mobile(\"bee\")"));
    assert!(said.contains("\"b\" of A is called \"bee\" in B") && said.contains(same), "{said}");
    let said = say(&MEETING.replace("mobile(\"b\").rect(1, 1).at(0, 0).mass(2);", ""));
    assert!(said.contains("only A has a body \"b\"") && said.contains("stage detect of a – b: a"), "{said}");
    let line = "mobile(\"a\").rect(1, 1).at(-2, 0.2).velocity(3, 0).spin(0.3);";
    let said = say(&format!("{}{line}", MEETING.replace(line, "")));
    assert!(said.contains("the bodies were made in another order"), "{said}");
}

/// A body that is only turned, and one that only moves otherwise, are told of; never one that is the same in both.
#[test]
fn growth_names_a_body_that_differs() {
    let (a, b) = (run(MEETING, &set(&[])), run(MEETING, &set(&[("mu_l", 0.8)])));
    let found = parting(&a, &b).expect("they part");
    let all = growth(&a, &b, found.iteration + 1).moments;
    let first = all[0];
    assert_eq!(
        (first.distance, first.bodies, first.body),
        (0.0, 1, found.body),
        "only its velocity differs: {first:?}"
    );
    assert!(all.last().is_some_and(|last| last.distance > 0.01 && last.iteration == 60), "{all:?}");
    let turned = run(&MEETING.replace(".mass(2)", ".angle(0.01).mass(2)"), &set(&[]));
    let start = growth(&a, &turned, 0).moments[0];
    // A corner is √½ from the middle: turned by 0.01 it is 2 sin(0.005) of that away.
    assert!((start.distance - 2.0 * libm::sin(0.005) * libm::sqrt(0.5)).abs() < 1e-15, "{start:?}");
    assert_eq!(names(&a, &[start.body.expect("a body")]), ["b"]);
    // With half the time step, moments are those of the same time.
    let halved = Options {
        overrides: Overrides { time_step: Some(1.0 / 128.0), steps: Some(120), ..Overrides::default() },
        ..Options::default()
    };
    let growth = growth(&a, &run(MEETING, &halved), 1);
    let fine = growth.moments;
    assert!(growth.is_by_time);
    assert_eq!((fine.len(), fine[0].distance, fine[0].body), (60, 0.0, None), "free flight is exact: {:?}", fine[0]);
}

#[test]
fn a_recording_that_ends_earlier_agrees_as_long_as_it_lasts() {
    let folder = folder(&[("scene.rhai", MEETING)]);
    let call = |words: &str| choque().current_dir(folder.path()).args(words.split(' ')).output().expect("it runs");
    let short = call("diff scene.rhai --set-b steps=30");
    assert_eq!(short.status.code(), Some(1), "{}", stderr(&short));
    assert!(stdout(&short).contains("they agree as long as both last: 60 and 30 iterations"), "{}", stdout(&short));
    for name in ["a", "b"] {
        let law = if name == "a" { "mu_l=0.9" } else { "mu_l=0.8" };
        let made = call(&format!("run scene.rhai --record {name}.choque --record-every 16 --set {law}"));
        assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
    }
    let said = stdout(&call("diff a.choque b.choque"));
    assert!(
        said.contains("at some iteration from 16 to 31, no later than the exchange of a – b in iteration"),
        "{said}"
    );
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

/// The first recordings tell of no body's own restitution and friction: that says nothing of whether they had some.
#[test]
fn what_the_first_recordings_do_not_tell_is_no_difference() {
    let lively = MEETING.replace(".mass(2)", ".mass(2).restitution(0.5)");
    let new = run(&lively, &set(&[]));
    let mut old = new.clone();
    old.about.surfaces = false;
    old.bodies.iter_mut().for_each(|body| body.restitution = None);
    let said = comparison(["old", "new"], [&old, &new]);
    assert!(said.same && !said.text.contains("restitution"), "{}", said.text);
    let dull = comparison(["dull", "lively"], [&run(MEETING, &set(&[])), &new]);
    assert!(dull.text.contains("b, restitution: the scene's against 0.5"), "{}", dull.text);
}

/// The same said of both, and another outcome: as after a change of the program.
#[test]
fn a_difference_that_nothing_told_explains_is_the_programs() {
    let old = run(MEETING, &set(&[]));
    let mut new = old.clone();
    for frame in &mut new.frames[20..] {
        frame.states[1].x += 1e-9;
    }
    let said = comparison(["old", "new"], [&old, &new]).text;
    assert!(
        said.contains("they part in iteration 19")
            && said.contains(&format!("both are of choque {}: the programs differ", old.about.choque)),
        "{said}"
    );
    let set_otherwise = comparison(["a", "b"], [&old, &run(MEETING, &set(&[("mu_l", 0.8)]))]).text;
    assert!(!set_otherwise.contains("the programs differ"), "{set_otherwise}");
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
    // One of another run than the snapshot's would tell of the wrong numbers.
    assert_eq!(call("run scenarios/one.rhai --set mu_l=0.7 --record snapshots/one.choque").status.code(), Some(0));
    let parted = stdout(&call("diff scenarios/one.rhai snapshots/one.snap --set mu_l=0.5"));
    assert!(parted.contains("one.choque is passed over"), "{parted}");
    assert!(parted.contains("they part after iteration 24 and before 32"), "{parted}");
}

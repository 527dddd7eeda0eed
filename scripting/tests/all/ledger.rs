//! What a script reads of the ledger, when it is kept, and what misspelling it says.

use choque_scripting::{Options, Step};
use insta::assert_snapshot;

use crate::support::{Folder, listening, run, while_running};

/// Two blocks that meet head-on: the light one gets the whole momentum of the heavy one, half of it lost on the way.
const MEETING: &str = r#"
    time_step(1.0 / 64); steps(64); detection("complete"); mu_l(0.5);
    mobile("heavy").rect(1, 1).mass(3).at(-1.5, 0).velocity(2, 0);
    mobile("light").rect(1, 1).mass(1);
"#;

#[test]
fn a_script_reads_what_each_cause_did() {
    let (run, expectations) = run(&format!(
        r#"{MEETING}
        expect("the exchange added", |world| (world.ledger.kinetic_energy.exchange - 12).abs() < 1e-12);
        expect("μ_L took", |world| (world.ledger.kinetic_energy.mu_l + 13.5).abs() < 1e-12);
        expect("of the momentum too", |world| (world.ledger.momentum_x.mu_l + 3).abs() < 1e-12);
        expect("no more", |world| {{
            let energy = world.ledger.kinetic_energy;
            energy.mu_a == 0 && energy.restitution == 0 && energy.friction == 0 && energy.drag == 0
                && energy.gravity == 0 && energy.commands == 0 && energy.fixed_bodies == 0 && energy.relocation == 0
        }});
        expect("it adds up", |world| {{
            let energy = world.ledger.kinetic_energy;
            (energy.initial + energy.exchange + energy.mu_l - world.kinetic_energy).abs() < 1e-12
        }});
        expect("it was moved once", |world| world.ledger.relocations == 1 && world.ledger.relocated > 0);
        "#
    ));
    assert!(run.world().ledger().is_some());
    for told in expectations {
        assert!(told.held, "{told:?}");
    }
}

#[test]
fn an_expectation_that_fails_tells_what_it_read() {
    let (_, expectations) = run(&format!(
        r#"{MEETING} expect("all is lost", |world| world.ledger.kinetic_energy.initial - world.ledger.relocated < 0);"#
    ));
    let names: Vec<&str> = expectations[0].numbers.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["world.ledger.kinetic_energy.initial", "world.ledger.relocated"]);
}

#[test]
fn a_ledger_can_be_printed() {
    let script = format!(
        "{MEETING} expect(\"shown\", |world| {{ print(world.ledger.kinetic_energy); print(world.ledger); true }});"
    );
    let folder = Folder::with(&[("scene.rhai", &script)]);
    let (options, lines) = listening();
    folder.run("scene.rhai", &options).unwrap();
    assert_snapshot!(lines.take().join("\n"), @r#"
    initial 6, exchange 12, mu_l -13.5
    kinetic_energy: initial 6, exchange 12, mu_l -13.5
    momentum_x: initial 6, mu_l -3
    momentum_z: initial 0
    angular_momentum: initial 0
    "#);
}

/// Also in the middle of an iteration of continuous motion, when most bodies are still on their way.
#[test]
fn the_books_close_whenever_a_script_looks() {
    let (_, expectations) = run(r#"
        time_step(0.1); steps(40); exchange("impulse"); motion("continuous"); restitution(0.5); friction(0.4);
        gravity(0, -9.81); drag(0.2, 0.1);
        fixed("floor").rect(30, 1).at(0, -0.5);
        for i in 0..4 { mobile(`b${i}`).rect(1, 0.6).at(i * 1.4 - 2, 1 + i * 0.7).angle(0.3 * i).velocity(1 - i, 0).tag("all"); }
        fn gap(world) {
            let gap = 0.0;
            for pair in [
                [world.ledger.kinetic_energy, world.kinetic_energy], [world.ledger.momentum_x, world.momentum_x],
                [world.ledger.momentum_z, world.momentum_z], [world.ledger.angular_momentum, world.angular_momentum],
            ] {
                let of = pair[0];
                let booked = of.exchange + of.mu_l + of.mu_a + of.restitution + of.friction + of.relocation + of.drag
                    + of.gravity + of.commands + of.fixed_bodies;
                gap = max(gap, abs(of.initial + booked - pair[1]));
            }
            gap
        }
        fn on_collision(world, hit) { if gap(world) > 1e-11 { throw `${gap(world)} at ${world.time}`; } }
        expect("in the end too", |world| gap(world) < 1e-11 && world.collisions > 5);
        "#);
    assert!(expectations[0].held, "{:?}", expectations[0]);
}

/// Who does not read it does not pay for it; who does finds it in whatever runs the scenario.
#[test]
fn it_is_kept_when_something_in_the_script_speaks_of_it() {
    let lib = "fn lost(world) { world.ledger.kinetic_energy.mu_l }";
    let folder = Folder::with(&[
        ("plain.rhai", "mobile(\"a\").rect(1, 1);"),
        (
            "reads.rhai",
            "mobile(\"a\").rect(1, 1); import \"lib\" as lib; expect(\"all\", |world| lib::lost(world) == 0);",
        ),
        ("late.rhai", "mobile(\"a\").rect(1, 1); fn on_step(world) { import \"lib\" as lib; lib::lost(world); }"),
        ("lib.rhai", lib),
    ]);
    let is_kept = |name: &str| {
        let run = folder.load(name, &Options::default()).unwrap().start().unwrap();
        run.world().ledger().is_some()
    };
    assert!(!is_kept("plain.rhai") && is_kept("reads.rhai") && !is_kept("late.rhai"));
    let Err(error) = folder.run("late.rhai", &Options::default()) else { panic!("it was not kept") };
    assert_snapshot!(error, @r#"
    error: no ledger was kept: nothing spoke of it when the run began
     --> lib.rhai:1:46
      |
    1 | fn lost(world) { world.ledger.kinetic_energy.mu_l }
      |                                              ^^^^
      |
      = note: in `lost`, called at late.rhai:1:71
      = note: in `on_step`
      = help: import the module that reads it at the top of the script, not within a function
    "#);

    let mut run = folder.load("late.rhai", &Options::default()).unwrap().start().unwrap();
    run.keep_ledger();
    while run.step().unwrap() == Step::Going {}
    assert_eq!(run.world().ledger().unwrap().initial().kinetic_energy, 0.0);
}

#[test]
fn misspelt_names_find_theirs() {
    assert_snapshot!(while_running("fn on_step(world) { print(world.ledgr); }"), @r#"
    error: the world has no body "ledgr", and no property of that name
     --> scene.rhai:2:33
      |
    2 | fn on_step(world) { print(world.ledgr); }
      |                                 ^^^^^
      |
      = note: in `on_step`
      = help: did you mean `world.ledger`?
    "#);
    assert_snapshot!(while_running("fn on_step(world) { print(world.ledger.kinetic_enrgy); }"), @r#"
    error: the ledger has no property `kinetic_enrgy`
     --> scene.rhai:2:40
      |
    2 | fn on_step(world) { print(world.ledger.kinetic_enrgy); }
      |                                        ^^^^^^^^^^^^^
      |
      = note: in `on_step`
      = help: did you mean `.kinetic_energy`?
    "#);
    assert_snapshot!(while_running("fn on_step(world) { print(world.ledger.kinetic_energy.frction); }"), @r#"
    error: an account of the ledger has no property `frction`
     --> scene.rhai:2:55
      |
    2 | fn on_step(world) { print(world.ledger.kinetic_energy.frction); }
      |                                                       ^^^^^^^
      |
      = note: in `on_step`
      = help: did you mean `.friction`?
    "#);
    assert_snapshot!(while_running("fn on_step(world) { print(world.ledger.kinetic_energy[0]); }"), @r#"
    error: an account of the ledger has no entries to reach with [ ]
     --> scene.rhai:2:54
      |
    2 | fn on_step(world) { print(world.ledger.kinetic_energy[0]); }
      |                                                      ^
      |
      = note: in `on_step`
    "#);
    assert_snapshot!(while_running("fn on_step(world) { world.ledger.kinetic_energy.mu_l = 0; }"), @r#"
    error: `mu_l` of an account of the ledger can be read only
     --> scene.rhai:2:49
      |
    2 | fn on_step(world) { world.ledger.kinetic_energy.mu_l = 0; }
      |                                                 ^^^^
      |
      = note: in `on_step`
    "#);
    assert_snapshot!(while_running("fn on_step(world) { world.ledger = 0; }"), @r#"
    error: world.ledger can be read only
     --> scene.rhai:2:27
      |
    2 | fn on_step(world) { world.ledger = 0; }
      |                           ^^^^^^
      |
      = note: in `on_step`
    "#);
}

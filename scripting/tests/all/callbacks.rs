//! What a script may do while the world runs.

use std::thread;
use std::time::Duration;

use choque_engine::World;
use choque_scripting::{Callbacks, Options, Step};

use crate::support::{Folder, listening, run, scene};

#[track_caller]
fn told(script: &str) -> Vec<String> {
    let (options, lines) = listening();
    let folder = Folder::with(&[("scene.rhai", script)]);
    folder.run("scene.rhai", &options).unwrap_or_else(|error| panic!("{error}"));
    lines.take()
}

#[test]
fn an_iteration_calls_its_callbacks_in_order() {
    let lines = told(
        r#"
        time_step(0.5); steps(9);
        mobile("car").rect(1, 1).at(-1.5, 0).velocity(1, 0);
        fixed("wall").rect(1, 1);
        fn on_step(world) { print(`step ${world.iteration} ${world.time}`); }
        fn on_collision(world, hit) { print(`hit ${hit.iteration} ${world.iteration} ${world.time} ${hit.a.name} ${hit.b.name}`); }
        always("told", |world| true);
        fn stop_when(world) { print(`stop? ${world.iteration} ${world.time}`); world.iteration == 2 }
        "#,
    );
    assert_eq!(
        lines,
        ["step 0 0.0", "hit 0 0 0.5 car wall", "stop? 1 0.5", "step 1 0.5", "hit 1 1 1.0 car wall", "stop? 2 1.0"]
    );
}

#[test]
fn a_hit_tells_the_pair_the_point_and_the_depth() {
    let lines = told(
        r#"
        time_step(1); steps(1);
        mobile("car").rect(2, 2).at(-2.5, 0.25).velocity(1, 0);
        fixed("wall").rect(2, 4);
        fn on_collision(world, hit) {
            print(`${hit.x} ${hit.z} ${hit.depth} ${hit.iteration}`);
            print(hit.a == world["car"] && hit.b != hit.a);
        }
        "#,
    );
    // The car's corner (-0.5, -0.75) lies 0.5 deep in the wall's face x = -1, and is put onto it.
    assert_eq!(lines, ["-1.0 -0.75 0.5 0", "true"]);
}

#[test]
fn properties_are_read_and_written() {
    let (run, _) = run(r#"
        time_step(1); steps(1);
        mobile("a").rect(1, 1); mobile("b").rect(1, 1).at(10, 0); fixed("wall").rect(1, 1).at(0, 10);
        fn on_step(world) {
            let a = world["a"];
            a.x = 1; a.z = 2.5; a.angle = 0.5; a.vx = 3; a.vz = -1; a.spin = 0.25;
            world["b"].vx = 4;
            world["b"].vx += 1;
            world.b.vz = -2;
            world["wall"].vz = 1;
        }
        "#);
    let world = run.world();
    let (a, b, wall) = (world.find("a").unwrap(), world.find("b").unwrap(), world.find("wall").unwrap());
    assert_eq!((world.position(a).x, world.position(a).y, world.angle(a)), (4.0, 1.5, 0.75));
    assert_eq!((world.position(b).x, world.position(b).y), (15.0, -2.0));
    assert_eq!((world.position(wall).x, world.position(wall).y), (0.0, 11.0));
}

#[test]
fn pushes_and_twists_act_over_one_iteration_and_add_up() {
    let (run, _) = run(r#"
        time_step(0.5); steps(2);
        mobile("a").rect(1, 1).mass(2).inertia(4);
        fn on_step(world) {
            if world.iteration > 0 { return; }
            world["a"].push(1, 0); world["a"].push(3, -2); world["a"].twist(8);
        }
        "#);
    let world = run.world();
    let a = world.find("a").unwrap();
    // v = F/m · dt, once: (4, −2)/2 · 0.5; ω = τ/I · dt = 8/4 · 0.5
    assert_eq!((world.velocity(a).x, world.velocity(a).y, world.spin(a)), (1.0, -0.5, 1.0));
}

#[test]
fn the_world_tells_its_totals_and_lists_its_bodies() {
    let lines = told(
        r#"
        time_step(0.5); steps(1);
        mobile("a").rect(1, 1).mass(2).velocity(3, 4).tag("car");
        fixed("b").rect(1, 1).at(9, 9);
        mobile("c").rect(1, 1).at(-9, 9).tag("car").tag("red");
        fn on_step(world) {
            print([world.kinetic_energy, world.momentum_x, world.momentum_z, world.angular_momentum, world.deepest]);
            print(world.bodies().map(|body| body.name));
            print(world.tagged("car").map(|body| body.name));
            print(world.tagged("none"));
            print([world.time, world.time_step, world.iteration, world.collisions]);
            print([world["a"].speed, world["a"].mass, world["b"].kind, world.body("c").name]);
        }
        "#,
    );
    let expected = [
        "[25.0, 6.0, 8.0, 0.0, 0.0]",
        "[\"a\", \"b\", \"c\"]",
        "[\"a\", \"c\"]",
        "[]",
        "[0.0, 0.5, 0, 0]",
        "[5.0, 2.0, \"fixed\", \"c\"]",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn a_handle_of_the_main_part_serves_in_closures() {
    let (_, expectations) = run(r#"
        time_step(1); steps(3);
        let car = mobile("car").rect(1, 1).velocity(2, 0);
        expect("it went its way", |world| car.x == 6 && car.speed == 2 && car == world["car"]);
        "#);
    assert!(expectations[0].held);
}

#[test]
fn a_constant_handle_reaches_its_body_from_everywhere() {
    let (_, expectations) = run(r#"
        const CAR = mobile("car").rect(1, 1);
        time_step(1); steps(2);
        fn on_step(world) { global::CAR.vx = 3; global::CAR.vz += 1; global::CAR.push(0, 0); }
        fn on_collision(world, hit) { hit.a.vx = 0; }
        expect("written", |world| CAR.x == 6 && CAR.z == 3 && CAR.vz == 2);
        "#);
    assert!(expectations[0].held, "{expectations:?}");
}

#[test]
fn callbacks_see_imports_and_constants_of_the_script() {
    let script = r#"
        import "lib/helpers" as helpers;
        const LIMIT = 2;
        steps(9);
        mobile("a").rect(1, 1);
        fn later(n) { helpers::later(n) }
        fn stop_when(world) { world.iteration == later(global::LIMIT) }
        expect("imports", |world| helpers::later(1) == 2);
    "#;
    let module = "const STEP = 1; fn later(n) { n + step() } fn step() { global::STEP }";
    let folder = Folder::with(&[("scene.rhai", script), ("lib/helpers.rhai", module)]);
    let (run, expectations) = folder.run("scene.rhai", &Default::default()).unwrap();
    assert_eq!(run.world().iteration(), 3);
    assert!(expectations[0].held);
}

#[test]
fn random_numbers_go_on_where_the_main_part_stopped() {
    let in_main = r#"seed(7); random(0, 1); let x = random(0, 1); mobile("a").rect(1, 1).at(x, 0); steps(1);"#;
    let in_callback = r#"
        seed(7); random(0, 1); mobile("a").rect(1, 1); steps(1);
        fn on_step(world) { world["a"].x = random(0, 1); }
    "#;
    assert_eq!(run(in_main).0.world().digest(), run(in_callback).0.world().digest());
}

#[test]
fn runs_of_one_scenario_know_nothing_of_each_other() {
    let script = r#"
        steps(20);
        let count = 0;
        mobile("a").rect(1, 1);
        fn on_step(world) { world["a"].vx = random(0, 1); }
        always("no more than twenty", |world| { count += 1; count <= 20 });
    "#;
    let folder = Folder::with(&[("scene.rhai", script)]);
    let scenario = folder.load("scene.rhai", &Default::default()).unwrap();
    let finish = || {
        let mut run = scenario.start().unwrap();
        while run.step().unwrap() == Step::Going {}
        let digest = run.world().digest();
        (digest, run.conclude().unwrap())
    };
    let (first, second) = (finish(), finish());
    assert!(first.1[0].held);
    assert_eq!(first, second);
}

#[test]
fn a_script_without_callbacks_runs_as_the_engine_does() {
    let script = r#"
        steps(200); seed(3);
        for i in 0..12 { mobile("b" + i).rect(1, 1).at(random(-5, 5), random(-5, 5)).velocity(random(-3, 3), random(-3, 3)); }
    "#;
    let mut world = World::new(&scene(script)).unwrap();
    for _ in 0..200 {
        world.step();
    }
    let with_idle_callbacks = format!("{script} fn on_step(world) {{ }} fn on_collision(world, hit) {{ 1 }}");
    assert!(world.collisions() > 0);
    assert_eq!(run(script).0.world().digest(), world.digest());
    assert_eq!(run(&with_idle_callbacks).0.world().digest(), world.digest());
}

#[test]
fn a_scenario_tells_which_callbacks_it_has() {
    let folder = Folder::with(&[
        ("none.rhai", "fn helper(world) { }"),
        (
            "all.rhai",
            "fn on_step(w) { } fn on_collision(a, b) { } fn stop_when(w) { false } \
                      expect(\"a\", |w| true); always(\"b\", |w| true); always(\"c\", |w| true);",
        ),
    ]);
    let callbacks = |name| folder.load(name, &Default::default()).unwrap().callbacks();
    assert_eq!(callbacks("none.rhai"), Callbacks::default());
    let all = Callbacks { on_step: true, on_collision: true, stop_when: true, expect: 1, always: 2 };
    assert_eq!(callbacks("all.rhai"), all);
}

#[test]
fn no_step_is_made_once_a_run_is_done() {
    let (mut done, _) = run(r#"mobile("a").rect(1, 1); steps(2);"#);
    assert_eq!(done.step().unwrap(), Step::Done);
    assert_eq!(done.world().iteration(), 2);
    assert_eq!(run(r#"mobile("a").rect(1, 1); steps(0);"#).0.world().iteration(), 0);
}

#[test]
fn a_script_is_stopped_from_another_thread() {
    let options = Options::default();
    let stop = options.stop.clone();
    let stopping = thread::spawn(move || {
        thread::sleep(Duration::from_millis(30));
        stop.ask();
    });
    let folder = Folder::with(&[("scene.rhai", "loop { }")]);
    let error = folder.load("scene.rhai", &options).unwrap_err();
    assert!(error.contains("the script was stopped before its end"), "{error}");
    stopping.join().unwrap();
}

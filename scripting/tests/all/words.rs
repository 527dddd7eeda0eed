//! Every word of the contract, and what it makes of the scene.

use choque_engine::area::{Extent, Rect};
use choque_engine::scene::{BroadPhaseChoice, Detection, ExchangeRule, Kind, MotionRule, Part, Patrol, Swing};

use crate::support::{Folder, printed, run, scene};

const BLADE: &str = r#"
// A blade sweeps a row of cars off the road.
title("Spinning blade");
time_step(1.0 / 120.0);
steps(600);
mu_l(0.9);
mu_a(0.8);
epsilon(0.001);

fixed("blade").rect(6, 0.4).at(0, 0).spin(2);

fn car(i) { mobile("car" + i).rect(4.2, 1.8).mass(1200).at(-12 + 6 * i, 5).angle(deg(90)) }

let push = param("push", 8, 0, 30);
for i in 0..5 { car(i).velocity(0, -push); }

fn on_step(world) {
    if world.time > 2.0 { world["blade"].spin = 0; }
}
fn on_collision(world, hit) { }

expect("the blade throws a car out", |world| world["car2"].speed > 3);
always("nothing explodes",           |world| world.kinetic_energy < 1e7);
"#;

#[test]
fn the_example_of_the_contract_makes_its_scene_and_runs() {
    let scene = scene(BLADE);
    assert_eq!(scene.title, "Spinning blade");
    assert_eq!(scene.settings.time_step, 1.0 / 120.0);
    assert_eq!((scene.settings.mu_l, scene.settings.mu_a), (0.9, 0.8));
    let names: Vec<&str> = scene.bodies.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["blade", "car0", "car1", "car2", "car3", "car4"]);
    let car = &scene.bodies[3];
    assert_eq!((car.at, car.velocity, car.mass), ((0.0, 5.0), Some((0.0, -8.0)), Some(1200.0)));
    assert_eq!(car.angle, std::f64::consts::FRAC_PI_2);

    let (run, expectations) = run(BLADE);
    assert_eq!(run.world().iteration(), 600);
    assert_eq!(expectations.len(), 2);
    let blade = run.world().find("blade").unwrap();
    assert_eq!(run.world().spin(blade), 0.0, "on_step stopped it");
}

#[test]
fn settings_say_what_holds_for_the_scene() {
    let settings = scene(
        r#"
        time_step(0.25); steps(7); mu_l(0.5); mu_a(2); epsilon(0); plane(-1); restitution(1); friction(3);
        exchange("impulse"); detection("complete"); motion("continuous"); broad_phase("strips");
        gravity(0, -9.81); drag(0.1, 0); seed(-4); substeps(8.0); sleeping(true);
        "#,
    )
    .settings;
    assert_eq!((settings.time_step, settings.steps), (0.25, 7));
    assert_eq!((settings.mu_l, settings.mu_a, settings.epsilon, settings.plane), (0.5, 2.0, 0.0, -1.0));
    assert_eq!((settings.restitution, settings.friction), (1.0, 3.0));
    assert_eq!((settings.exchange, settings.detection), (ExchangeRule::Impulse, Some(Detection::Complete)));
    assert_eq!((settings.motion, settings.broad_phase), (MotionRule::Continuous, BroadPhaseChoice::Strips));
    assert_eq!((settings.gravity, settings.drag, settings.seed), ((0.0, -9.81), (0.1, 0.0), -4));
    assert_eq!((settings.substeps, settings.sleeping), (Some(8), true));
}

#[test]
fn a_script_that_says_nothing_has_the_default_scene() {
    assert_eq!(scene("").settings, choque_engine::scene::Settings::default());
}

#[test]
fn of_a_setting_given_twice_the_last_counts() {
    let settings = scene("steps(3); steps(5.0); mu_l(0); mu_l(0.25);").settings;
    assert_eq!((settings.steps, settings.mu_l), (5, 0.25));
}

#[test]
fn bodies_get_what_their_words_say() {
    let scene = scene(
        r#"
        mobile("a").rect(4, 2).rect(-1, 1.5, 2, 3).height(1).scale(2).at(1, -2).angle(1).velocity(3, 0).spin(-1)
            .mass(5).inertia(7).restitution(0.5).friction(0.25).tag("car").tag("red").tag("car");
        fixed("b").rect(1, 1).scale(1, 2, 3).patrol([[1, 2], [3.5, 4]], 2).swing(0.5, 4);
        "#,
    );
    let a = &scene.bodies[0];
    assert_eq!(a.kind, Kind::Mobile);
    let anywhere = Rect { x_min: -1.0, x_max: 1.5, z_min: 2.0, z_max: 3.0 };
    assert_eq!(a.parts, [Part::Rect(Rect::centred(4.0, 2.0)), Part::Rect(anywhere)]);
    assert_eq!((a.height, a.scale, a.at, a.angle), (1.0, (2.0, 2.0, 2.0), (1.0, -2.0), 1.0));
    assert_eq!((a.velocity, a.spin, a.mass, a.inertia), (Some((3.0, 0.0)), Some(-1.0), Some(5.0), Some(7.0)));
    assert_eq!((a.restitution, a.friction), (Some(0.5), Some(0.25)));
    assert_eq!(a.tags, ["car", "red"]);
    let b = &scene.bodies[1];
    assert_eq!((b.kind, b.scale), (Kind::Fixed, (1.0, 2.0, 3.0)));
    assert_eq!(b.patrol, Some(Patrol { points: vec![(1.0, 2.0), (3.5, 4.0)], speed: 2.0 }));
    assert_eq!(b.swing, Some(Swing { angle: 0.5, period: 4.0 }));
    assert_eq!((b.velocity, b.spin), (None, None), "what is not said stays unsaid");
}

#[test]
fn a_velocity_of_zero_is_said_all_the_same() {
    let scene = scene(r#"fixed("wall").rect(1, 1).velocity(0, 0).spin(0);"#);
    assert_eq!((scene.bodies[0].velocity, scene.bodies[0].spin), (Some((0.0, 0.0)), Some(0.0)));
}

#[test]
fn meshes_and_models_give_their_extent() {
    let script = r#"
        mobile("mesh").mesh([[-1, 0, -2], [1, 0.5, 2], [0, 0.25, 0]]);
        mobile("model").model("parts/plate.obj").model("parts/plate.obj");
    "#;
    let plate = "# two corners\nv -3 0 -1\nv 3 1 1.5\nf 1 2 1\n";
    let folder = Folder::with(&[("scene.rhai", script), ("parts/plate.obj", plate)]);
    let scenario = folder.load("scene.rhai", &Default::default()).unwrap();
    let bodies = &scenario.scene().bodies;
    assert_eq!(bodies[0].parts, [Part::Mesh(Extent { x: (-1.0, 1.0), y: (0.0, 0.5), z: (-2.0, 2.0) })]);
    assert_eq!(bodies[1].parts, [Part::Mesh(Extent { x: (-3.0, 3.0), y: (0.0, 1.0), z: (-1.0, 1.5) }); 2]);
}

#[test]
fn a_handle_reads_the_initial_values_while_the_scene_is_built() {
    let lines = printed(
        r#"
        let car = mobile("car").rect(1, 1);
        print(car.x); print(car.vx); print(car.mass); print(car.spin);
        car.at(1, 2).velocity(3, -4).angle(0.5).spin(6).mass(7);
        for number in [car.x, car.z, car.angle, car.vx, car.vz, car.spin, car.speed, car.mass] { print(number); }
        print(car.name); print(car.kind); print(car); print(car == car); print(car != fixed("b"));
        "#,
    );
    let initial = ["0.0", "0.0", "1.0", "0.0"];
    let changed = ["1.0", "2.0", "0.5", "3.0", "-4.0", "6.0", "5.0", "7.0"];
    let texts = ["car", "mobile", "mobile(\"car\")", "true", "true"];
    assert_eq!(lines, [&initial[..], &changed, &texts].concat());
}

#[test]
fn helper_functions_and_modules_use_all_words() {
    let script = r#"import "lib/vehicles" as v; v::truck("t", 3).at(1, 1); steps(v::STEPS);"#;
    let module = r#"
        export const STEPS = 9;
        fn truck(name, length) { mobile(name).rect(length * scale_of(name), 2).mass(param("mass", 9000)) }
        fn scale_of(name) { 2.0 }
    "#;
    let folder = Folder::with(&[("scene.rhai", script), ("lib/vehicles.rhai", module)]);
    let scenario = folder.load("scene.rhai", &Default::default()).unwrap();
    assert_eq!(scenario.scene().settings.steps, 9);
    let truck = &scenario.scene().bodies[0];
    assert_eq!((truck.name.as_str(), truck.mass), ("t", Some(9000.0)));
    assert_eq!(truck.parts, [Part::Rect(Rect::centred(6.0, 2.0))]);
}

#[test]
fn a_module_runs_once_however_often_it_is_imported() {
    let script = r#"import "wall" as a; import "wall.rhai" as b; fn f() { import "wall" as c; } f();"#;
    let folder = Folder::with(&[("scene.rhai", script), ("wall.rhai", r#"fixed("wall").rect(1, 1);"#)]);
    assert_eq!(folder.load("scene.rhai", &Default::default()).unwrap().scene().bodies.len(), 1);
}

#[test]
fn the_title_is_the_file_s_name_unless_the_script_says_otherwise() {
    let folder = Folder::with(&[("crash.rhai", ""), ("other.rhai", r#"title("Crash");"#)]);
    let load = |name| folder.load(name, &Default::default()).unwrap();
    assert_eq!((load("crash.rhai").title(), load("crash.rhai").name()), ("crash".to_owned(), "crash"));
    assert_eq!((load("other.rhai").title(), load("other.rhai").name()), ("Crash".to_owned(), "other"));
}

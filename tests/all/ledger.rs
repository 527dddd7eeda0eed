//! The ledger of a run: the books close on every scenario, and what is printed and written adds up.

use std::path::Path;

use choque::harness::cases;
use choque_engine::World;
use choque_engine::ledger::{Amounts, Cause};
use choque_engine::scene::{Detection, ExchangeRule, Kind, MotionRule};
use choque_scripting::{Options, Overrides, Scenario, Step};
use serde_json::Value;

use crate::support::{choque, folder, iterations_within, stderr};

/// Books that close to this share are closed: ten times better than promised. Long free flight rounds places, and that is not booked.
const CLOSED: f64 = 1e-13;

/// Bodies times iterations of one run, and of one under a scenario's own models: to its end but where nothing is optimised for speed, so
/// that all tests stay a matter of minutes.
const BUDGET: u64 = 3_000;
const OWN: u64 = if cfg!(debug_assertions) { 10_000 } else { u64::MAX };

/// How far the books of a world are from closing, of what was booked and of what its bodies have each.
fn gap(world: &World) -> f64 {
    let ledger = world.ledger().expect("it is kept");
    let now = world.totals().to_array();
    let initial = ledger.initial().to_array();
    let booked = Cause::ALL.map(|cause| ledger.booked(cause).to_array());
    let energy = initial[0] + booked.iter().map(|amounts| amounts[0].abs()).sum::<f64>();
    let taken: f64 = booked.iter().map(|amounts| amounts[1].abs() + amounts[2].abs()).sum();
    let mut sizes = [0.0; 4];
    for id in world.ids().filter(|id| world.kind(*id) == Kind::Mobile) {
        // What is left where all is at rest is rounding of what there was, or was given and taken: that much counts as something.
        let rounded = f64::EPSILON * ((2.0 * energy * world.mass(id)).sqrt() + taken);
        let momentum = world.mass(id) * world.velocity(id).norm() + rounded;
        let spin = world.inertia(id) * world.spin(id);
        sizes[1] += momentum;
        sizes[2] += momentum;
        sizes[3] += momentum * world.position(id).norm() + spin.abs();
    }
    let of = |k: usize| {
        let sum: f64 = booked.iter().map(|amounts| amounts[k]).sum();
        let turned_over: f64 = booked.iter().map(|amounts| amounts[k].abs()).sum();
        let size = turned_over.max(initial[k].abs()).max(now[k].abs()).max(sizes[k]);
        let gap = (initial[k] + sum - now[k]).abs();
        if gap == 0.0 { 0.0 } else { gap / size }
    };
    (0..4).map(of).fold(0.0, f64::max)
}

/// Plays a scenario, callbacks included, with the ledger kept; gives the gap and the collisions.
fn audited(scenario: &Scenario) -> Result<(f64, u64), String> {
    let mut run = scenario.start().map_err(|error| error.to_string())?;
    run.keep_ledger();
    while run.step().map_err(|error| error.to_string())? == Step::Going {}
    let world = run.world();
    Ok((gap(&world), world.collisions()))
}

/// Under its own models, and under every other pairing of them that it can be run with; impulses in continuous motion only where
/// a scenario asks for them, for scenes made for overlaps can take very long there.
#[test]
fn the_books_of_every_scenario_close() {
    let cases = cases(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the folder can be read");
    let (mut closed, mut collisions) = (0, 0);
    for case in &cases {
        let whole = Scenario::load(&case.script, &Options::default()).expect("it loads");
        let own = Overrides { steps: Some(iterations_within(OWN, whole.scene())), ..Overrides::default() };
        let scenario =
            Scenario::load(&case.script, &Options { overrides: own, ..Options::default() }).expect("it loads");
        let (gap, _) = audited(&scenario).expect("it runs");
        assert!(gap <= CLOSED, "{}: {gap:e}", case.name());
        let steps = Some(iterations_within(BUDGET, whole.scene()));
        for exchange in [ExchangeRule::Document, ExchangeRule::Impulse] {
            for motion in [MotionRule::Stepped, MotionRule::Continuous] {
                if exchange == ExchangeRule::Impulse && motion == MotionRule::Continuous {
                    continue;
                }
                for detection in [Detection::Vertices, Detection::Complete] {
                    let overrides = Overrides {
                        steps,
                        exchange: Some(exchange),
                        motion: Some(motion),
                        detection: Some(detection),
                        ..Overrides::default()
                    };
                    let options = Options { overrides, ..Options::default() };
                    let run = Scenario::load(&case.script, &options).map_err(|error| error.to_string());
                    let Ok((gap, hits)) = run.and_then(|scenario| audited(&scenario)) else { continue };
                    let how = format!("{} {exchange:?} {motion:?} {detection:?}", case.name());
                    assert!(gap <= CLOSED, "{how}: {gap:e}");
                    closed += 1;
                    collisions += hits;
                }
            }
        }
    }
    assert!(closed >= 5 * cases.len() && collisions > 20_000, "{closed} runs of {}, {collisions} hits", cases.len());
}

/// A car that a blade throws about, in every cause but drag and gravity; and one of the impulse exchange under those.
const SCENES: [&str; 2] = [
    r#"
    time_step(1.0 / 120); steps(240); mu_l(0.9); mu_a(0.8);
    fixed("blade").rect(12, 0.6).spin(2);
    for i in 0..3 { mobile(`car, "${i}"`).rect(4.2, 1.8).mass(1200).at(6 * i - 6, 5).angle(deg(90)).velocity(0, -8); }
    fn on_step(world) { if world.iteration == 100 { world["car, \"1\""].push(2000, 0); } }
    "#,
    r#"
    time_step(1.0 / 60); steps(120); exchange("impulse"); restitution(0.4); friction(0.3); gravity(0, -9.81); drag(0.1, 0.2);
    fixed("floor").rect(60, 2).at(0, -1); fixed("gate").rect(0.4, 4).at(3, 2).swing(deg(40), 2);
    for i in 0..4 { mobile(`b${i}`).rect(1, 0.7).at(1.2 * i - 2, 1 + 0.4 * i).angle(0.2 * i).velocity(3 - i, 0); }
    "#,
];

/// Boxes between walls, of which one moves, never two of them near: there are impacts, and no contact lasts.
const IMPACTS: &str = r#"
    time_step(1.0 / 60); steps(300); exchange("impulse"); restitution(0.8); friction(0.3); drag(0.1, 0.2);
    fixed("left").rect(1, 99).at(-5, 0); fixed("right").rect(1, 99).at(6, 0).velocity(-0.5, 0);
    for i in 0..4 { mobile(`b${i}`).rect(1, 0.7).at(i - 1.5, 9 * i).angle(0.4 * i).velocity(6 - 3 * i, 1).spin(i); }
    "#;

fn run(folder: &Path, arguments: &[&str]) -> Value {
    let output = choque().current_dir(folder).args(arguments).output().expect("the command can be started");
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {}", stderr(&output)))
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// `initial` and `booked` of a quantity, for anyone to add up.
fn account(json: &Value, quantity: &str) -> (f64, Vec<(String, f64)>) {
    let ledger = &json["ledger"];
    let booked = ledger["booked"][quantity].as_object().expect("causes");
    let booked = booked.iter().map(|(cause, amount)| (cause.clone(), number(amount))).collect();
    (number(&ledger["initial"][quantity]), booked)
}

#[test]
fn what_a_run_prints_adds_up() {
    for script in SCENES {
        let folder = folder(&[("scene.rhai", script)]);
        for motion in ["stepped", "continuous"] {
            let json = run(folder.path(), &["run", "scene.rhai", "--format", "json", "--motion", motion]);
            assert!(number(&json["collisions"]) > 2.0, "{motion}");
            let totals = [
                ("kinetic_energy", &json["kinetic_energy"]),
                ("momentum_x", &json["momentum"][0]),
                ("momentum_z", &json["momentum"][1]),
                ("angular_momentum", &json["angular_momentum"]),
            ];
            for (quantity, total) in totals {
                let (initial, booked) = account(&json, quantity);
                let mut causes = Cause::WORDS;
                causes.sort_unstable(); // as the reader of JSON gives them
                assert!(booked.iter().map(|(cause, _)| cause.as_str()).eq(causes), "every cause, every time");
                let sum: f64 = booked.iter().map(|(_, amount)| amount).sum();
                let size: f64 = booked.iter().map(|(_, amount)| amount.abs()).sum();
                let gap = (initial + sum - number(total)).abs();
                assert!(gap <= 1e-12 * size.max(initial.abs()), "{motion} {quantity}: off by {gap:e} of {size}");
                assert!(size > 0.0, "{motion} {quantity}: something happened");
            }
        }
    }
}

#[test]
fn ron_has_the_same_numbers() {
    let folder = folder(&[("scene.rhai", SCENES[0])]);
    let ron = choque().current_dir(folder.path()).args(["run", "scene.rhai", "--format", "ron"]).output();
    let ron = String::from_utf8(ron.expect("the command can be started").stdout).expect("text");
    let ron: ron::Value = ron::from_str(&ron).expect("RON");
    let ron = serde_json::to_value(ron).expect("the same as JSON");
    let json = run(folder.path(), &["run", "scene.rhai", "--format", "json"]);
    for quantity in Amounts::NAMES {
        let ((of_ron, from_ron), (of_json, from_json)) = (account(&ron, quantity), account(&json, quantity));
        assert_eq!(of_ron, of_json);
        for ((cause, one), (same, two)) in from_ron.iter().zip(&from_json) {
            assert!(cause == same && (one - two).abs() <= 1e-15 * two.abs(), "{quantity} {cause}: {one} and {two}");
        }
    }
}

#[test]
fn the_rows_of_a_ledger_add_up_to_its_totals() {
    let apart = ["drag", "gravity", "commands"];
    // Impulses relocate nothing in an exchange: overlaps are let go step by step.
    let of_impulses = ["drag", "gravity", "commands", "relocation"];
    for (script, apart) in [(SCENES[0], &apart[..]), (IMPACTS, &of_impulses)] {
        let folder = folder(&[("scene.rhai", script), ("ledger.csv", "what was there before")]);
        let call = ["run", "scene.rhai", "--format", "json", "--ledger", "ledger.csv"];
        let json = run(folder.path(), &call);
        let mut rows = csv::Reader::from_path(folder.path().join("ledger.csv")).expect("it was written");
        let headings = rows.headers().expect("headings").clone();
        let rows: Vec<csv::StringRecord> = rows.records().collect::<Result<_, _>>().expect("rows of one length");
        assert_eq!(rows.len() as f64, number(&json["collisions"]));
        assert!(rows.len() > 5);
        let column = |name: &str| headings.iter().position(|heading| heading == name).expect("it is there");
        let sum = |name: &str| rows.iter().map(|row| row[column(name)].parse::<f64>().expect("a number")).sum::<f64>();
        let names: Vec<&str> =
            json["bodies"].as_array().expect("bodies").iter().filter_map(|b| b["name"].as_str()).collect();
        for row in &rows {
            assert!(names.contains(&&row[column("a")]) && names.contains(&&row[column("b")]), "{row:?}");
        }
        let (_, energy) = account(&json, "kinetic_energy");
        let size: f64 = energy.iter().map(|(_, amount)| amount.abs()).sum();
        for (cause, amount) in
            energy.iter().filter(|(cause, _)| !["drag", "gravity", "commands", "relocation"].contains(&cause.as_str()))
        {
            let rows = sum(&format!("kinetic_energy_{cause}"));
            assert!((rows - amount).abs() <= 1e-12 * size, "{cause}: {rows} and {amount}");
        }
        for quantity in ["momentum_x", "momentum_z", "angular_momentum"] {
            let (_, booked) = account(&json, quantity);
            let of_exchanges = booked.iter().filter(|(cause, _)| !apart.contains(&cause.as_str()));
            let amount: f64 = of_exchanges.clone().map(|(_, amount)| amount).sum();
            let size: f64 = of_exchanges.map(|(_, amount)| amount.abs()).sum();
            assert!((sum(quantity) - amount).abs() <= 1e-12 * size, "{quantity}: {} and {amount}", sum(quantity));
        }
        let relocated = if apart.contains(&"relocation") { 0.0 } else { number(&json["ledger"]["relocated"]) };
        assert!((sum("relocated") - relocated).abs() <= 1e-12);
    }
}

#[test]
fn a_ledger_is_written_whole_or_not_at_all_and_never_over_a_script() {
    let folder =
        folder(&[("scene.rhai", SCENES[0]), ("ends.rhai", "mobile(\"a\").rect(1, 1); fn on_step(world) { throw 1; }")]);
    let call = |file: &str, ledger: &str| {
        let output = choque().current_dir(folder.path()).args(["run", file, "--ledger", ledger]).output();
        output.expect("the command can be started")
    };
    for refused in ["scene.rhai", ".", "ledger", "nowhere/ledger.csv", "-"] {
        let output = call("scene.rhai", refused);
        assert_eq!(output.status.code(), Some(2), "{refused}");
        assert!(stderr(&output).contains("ledger.csv"), "{}", stderr(&output));
    }
    assert_eq!(call("ends.rhai", "ledger.csv").status.code(), Some(2));
    let mut left: Vec<_> =
        std::fs::read_dir(folder.path()).expect("it is there").map(|entry| entry.expect("it is").file_name()).collect();
    left.sort();
    assert_eq!(left, ["ends.rhai", "scene.rhai"]);
    assert_eq!(std::fs::read_to_string(folder.path().join("scene.rhai")).expect("still there"), SCENES[0]);
}

//! `choque sweep` and `choque merge`: the same table however it was made, and nothing lost or mixed on the way.

use std::fs;
use std::path::Path;
use std::process::Output;

use tempfile::TempDir;

use crate::support::{choque, folder, stderr, stdout, write};

const CRASH: &str = r#"
steps(60);
let speed = param("speed", 3, 0, 9);
let aside = param("aside", 0);
mobile("a").rect(1, 1).at(-2, aside).velocity(speed, 0);
mobile("b").rect(1, 1).at(0, random(-0.2, 0.2)).mass(2);
if speed > 8 { throw "too fast"; }
expect("b is hit", |world| world["b"].vx > 0);
"#;

const PLAN: &str = r#"(
    scenarios: ["crash.rhai"],
    vary: [
        (name: "speed", from: 1, to: 9, count: 5),
        (name: "mu_l", values: [0.5, 1]),
        (name: "exchange", values: ["document", "impulse"]),
    ],
    set: { "epsilon": 0.01 },
    seeds: (first: 4, count: 2),
    read: ["b.speed"],
    plots: [HeatMap(x: "speed", y: "mu_l", value: "b.speed"), Curves(x: "speed", y: ["b.speed"], by: "exchange")],
)"#;
const RUNS: usize = 5 * 2 * 2 * 2;

fn set_up() -> TempDir {
    folder(&[("crash.rhai", CRASH), ("plan.ron", PLAN)])
}

fn call(folder: &Path, arguments: &[&str]) -> Output {
    choque().current_dir(folder).args(arguments).output().expect("the command can be started")
}

/// A call that ends with that code; gives what it said.
fn said(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = call(folder, arguments);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
    assert_eq!(stdout(&output), "", "a table goes to its file");
    stderr(&output)
}

fn read(folder: &Path, file: &str) -> String {
    fs::read_to_string(folder.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// The cells under a heading.
fn column(table: &str, name: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let at = reader.headers().expect("headings").iter().position(|heading| heading == name).expect("a column");
    reader.records().map(|row| row.expect("a row")[at].to_owned()).collect()
}

#[test]
fn the_table_is_the_same_at_any_number_of_jobs_and_shards() {
    let folder = set_up();
    let at = folder.path();
    said(at, &["sweep", "plan.ron", "-o", "one", "--jobs", "1"], 1);
    said(at, &["sweep", "plan.ron", "-o", "two", "--jobs", "2"], 1);
    for shard in ["3/3", "1/3", "2/3"] {
        let told = said(at, &["sweep", "plan.ron", "-o", "three", "--shard", shard], 0);
        assert!(told.contains("choque merge three"), "{told}");
    }
    said(at, &["merge", "three"], 1);
    let table = read(at, "one/rows.csv");
    assert_eq!(column(&table, "run"), (0..RUNS).map(|run| run.to_string()).collect::<Vec<_>>());
    for other in ["two", "three"] {
        assert_eq!(read(at, &format!("{other}/rows.csv")), table, "{other}");
        for plot in ["crash_b.speed_over_speed_mu_l.svg", "crash_b.speed_over_speed_exchange.svg"] {
            let svg = read(at, &format!("{other}/{plot}"));
            assert_eq!(svg, read(at, &format!("one/{plot}")), "{other}/{plot}");
            roxmltree::Document::parse(&svg).expect("XML");
        }
    }
}

#[test]
fn a_param_that_is_named_like_a_column_has_one_of_its_own() {
    let script = "steps(30);
        mobile(\"a\").rect(1, 1).velocity(param(\"time\", 1) + param(\"point\", 0) * param(\"seed\", 1), 0);";
    let plan = "(scenarios: [\"named.rhai\"], vary: [(name: \"time\", values: [1, -1]), (name: \"point\", from: 1, to: 3, count: 2)],
        set: { \"seed\": 2 }, seeds: [7], read: [\"a.x\"])";
    let folder = folder(&[("named.rhai", script), ("plan.ron", plan)]);
    let at = folder.path();
    said(at, &["sweep", "plan.ron", "-o", "out"], 0);
    let table = read(at, "out/rows.csv");
    let cells = |name| column(&table, name).join(" ");
    assert_eq!([cells("time"), cells("point"), cells("seed")], ["0.5 0.5 0.5 0.5", "0 1 2 3", "7 7 7 7"]);
    let asked = ["param.time", "param.point", "param.seed", "a.x"].map(cells);
    assert_eq!(asked, ["1.0 1.0 -1.0 -1.0", "1.0 3.0 1.0 3.0", "2.0 2.0 2.0 2.0", "1.5 3.5 0.5 2.5"]);
    assert!(at.join("out/named_a.x_over_param.time_param.point.svg").is_file(), "what suits the points");
    write(
        &at.join("drawn.ron"),
        &plan.replace("read:", "plots: [HeatMap(x: \"time\", y: \"param.time\", value: \"a.x\")], read:"),
    );
    said(at, &["sweep", "drawn.ron", "-o", "drawn"], 0);
}

#[test]
fn a_sweep_that_was_stopped_goes_on_where_it_was() {
    let folder = set_up();
    let at = folder.path();
    said(at, &["sweep", "plan.ron", "-o", "whole"], 1);
    let (table, shard) = (read(at, "whole/rows.csv"), read(at, "whole/shard_1_of_1.csv"));
    let second_line = 1 + shard.find('\n').expect("a line");
    let head = second_line + 1 + shard[second_line..].find('\n').expect("a line");
    let rows_before = |cut: usize| shard[..cut].matches('\n').count().saturating_sub(2);
    for cut in [0, 10, second_line, head - 1, head, head + 1, shard.len() / 2, shard.len() - 1, shard.len()] {
        write(&at.join("stopped/shard_1_of_1.csv"), &shard[..cut]);
        let told = said(at, &["sweep", "plan.ron", "-o", "stopped"], 1);
        let before = rows_before(cut);
        assert_eq!(told.contains(&format!("{before} of them made before")), before > 0, "{cut}: {told}");
        assert_eq!(read(at, "stopped/rows.csv"), table, "cut at {cut}");
        assert_eq!(read(at, "stopped/shard_1_of_1.csv").lines().count(), RUNS + 2, "no run was made twice");
        fs::remove_dir_all(at.join("stopped")).expect("the folder");
    }
}

#[test]
fn a_run_that_came_out_differently_twice_is_named() {
    let folder = set_up();
    let at = folder.path();
    said(at, &["sweep", "plan.ron", "-o", "out"], 1);
    said(at, &["sweep", "plan.ron", "-o", "half", "--shard", "1/2"], 0);
    let half = read(at, "half/shard_1_of_2.csv");
    write(&at.join("out/shard_1_of_2.csv"), &half);
    said(at, &["merge", "out"], 1);
    let digest = column(&read(at, "out/rows.csv"), "digest")[2].clone();
    write(&at.join("out/shard_1_of_2.csv"), &half.replace(&digest, "00000000deadbeef"));
    let told = said(at, &["merge", "out"], 2);
    for part in ["run 2 ", "point 1", "seed 4", &digest, "00000000deadbeef", "shard_1_of_1.csv", "shard_1_of_2.csv"] {
        assert!(told.contains(part), "{part}: {told}");
    }
}

#[test]
fn what_is_missing_is_named_and_nothing_is_written() {
    let folder = set_up();
    let at = folder.path();
    said(at, &["sweep", "plan.ron", "-o", "out", "--shard", "1/2"], 0);
    let told = said(at, &["merge", "out"], 2);
    assert!(told.contains("20 of 40 runs are missing: 1, 3, 5, 7, 9 and 15 more"), "{told}");
    assert!(!at.join("out/rows.csv").exists());
}

#[test]
fn rows_of_another_plan_script_or_version_are_not_mixed_in() {
    let folder = set_up();
    let at = folder.path();
    said(at, &["sweep", "plan.ron", "-o", "out", "--shard", "1/2"], 0);
    let shard = read(at, "out/shard_1_of_2.csv");
    write(&at.join("other.ron"), &PLAN.replace("to: 9", "to: 8"));
    let told = said(at, &["sweep", "other.ron", "-o", "out"], 2);
    assert!(told.contains("belongs to another plan") && told.contains("another folder"), "{told}");
    write(&at.join("crash.rhai"), &CRASH.replace("mass(2)", "mass(3)"));
    assert!(said(at, &["sweep", "plan.ron", "-o", "out"], 2).contains("its scenarios have changed"));
    write(&at.join("crash.rhai"), CRASH);
    write(&at.join("out/shard_1_of_2.csv"), &shard.replacen("choque 0.", "choque 7.", 1));
    assert!(said(at, &["sweep", "plan.ron", "-o", "out"], 2).contains("was made by choque 7."));
    write(&at.join("out/shard_1_of_2.csv"), &shard.replacen(",run,", ",walk,", 1));
    assert!(said(at, &["sweep", "plan.ron", "-o", "out"], 2).contains("shard_1_of_2.csv: line 3 is no row"));
    write(&at.join("out/shard_1_of_2.csv"), &shard);
    write(&at.join("plots.ron"), &PLAN.replace("Curves(x: \"speed\"", "Curves(x: \"mu_l\""));
    said(at, &["sweep", "plots.ron", "-o", "out"], 1);
}

#[test]
fn a_run_that_fails_has_a_row_of_its_own_kind() {
    let folder = set_up();
    let at = folder.path();
    let told = said(at, &["sweep", "plan.ron", "-o", "rows.csv"], 1);
    assert!(told.contains("8 runs ended in an error; the first is run 32: crash.rhai:7"), "{told}");
    let table = read(at, "rows.csv");
    assert!(at.join("rows.sweep/shard_1_of_1.csv").is_file(), "what it goes on from lies beside");
    let (kinds, errors, digests) = (column(&table, "kind"), column(&table, "error"), column(&table, "digest"));
    for (run, speed) in column(&table, "speed").iter().enumerate() {
        let fails = speed == "9.0";
        assert_eq!(kinds[run], if fails { "error" } else { "run" }, "run {run}");
        assert_eq!(errors[run].contains("too fast"), fails, "run {run}: {}", errors[run]);
        assert_eq!(digests[run].is_empty(), fails, "run {run}");
    }
}

#[test]
fn a_row_is_what_run_says_of_the_same_numbers() {
    let folder = set_up();
    let at = folder.path();
    said(at, &["sweep", "plan.ron", "-o", "rows.csv"], 1);
    let table = read(at, "rows.csv");
    let cell = |run: usize, name: &str| column(&table, name)[run].clone();
    for run in [0, 3, 13, 30] {
        let speed = format!("speed={}", cell(run, "speed"));
        let mu_l = format!("mu_l={}", cell(run, "mu_l"));
        let (exchange, seed) = (cell(run, "exchange"), cell(run, "seed"));
        let set = ["--set", &speed, "--set", &mu_l, "--set", "epsilon=0.01", "--exchange", &exchange, "--seed", &seed];
        let output = call(at, &[&["run", "crash.rhai", "--format", "json"], &set[..]].concat());
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).expect("an object");
        assert_eq!(told["digest"].as_str(), Some(cell(run, "digest").as_str()), "run {run}");
        assert_eq!(told["collisions"].to_string(), cell(run, "collisions"), "run {run}");
        assert_eq!(told["work"]["pairs_tested"].to_string(), cell(run, "pairs_tested"), "run {run}");
        let b = &told["bodies"][1];
        let [vx, vz] = ["vx", "vz"].map(|key| b[key].as_f64().expect("a number"));
        assert_eq!((vx * vx + vz * vz).sqrt(), cell(run, "b.speed").parse::<f64>().expect("a number"), "run {run}");
    }
}

#[test]
fn points_of_a_latin_hypercube_fall_into_each_stratum_once() {
    let plan = r#"(
        scenarios: ["*.rhai"],
        points: LatinHypercube(count: 12, seed: 3),
        vary: [(name: "speed", from: 1, to: 7), (name: "aside", from: -0.5, to: 0.5)],
    )"#;
    let folder = folder(&[("crash.rhai", CRASH), ("plan.ron", plan), ("lib/cars.rhai", "fn car() { 1 }")]);
    said(folder.path(), &["sweep", "plan.ron", "-o", "out"], 0);
    let table = read(folder.path(), "out/rows.csv");
    for (name, from, to) in [("speed", 1.0, 7.0), ("aside", -0.5, 0.5)] {
        let share = |text: &String| (text.parse::<f64>().expect("a number") - from) / (to - from);
        let mut strata: Vec<usize> =
            column(&table, name).iter().map(|text| (12.0 * share(text)).floor() as usize).collect();
        strata.sort_unstable();
        assert_eq!(strata, (0..12).collect::<Vec<_>>(), "{name}");
    }
    assert!(folder.path().join("out/crash_kinetic_energy_over_speed_aside.svg").is_file(), "drawn without being asked");
}

#[test]
#[cfg(feature = "parquet")]
fn a_table_as_parquet_says_what_the_csv_says() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    let folder = set_up();
    let at = folder.path();
    said(at, &["sweep", "plan.ron", "-o", "rows.csv"], 1);
    said(at, &["sweep", "plan.ron", "-o", "rows.parquet"], 1);
    let table = read(at, "rows.csv");
    let file = SerializedFileReader::new(fs::File::open(at.join("rows.parquet")).expect("a file")).expect("Parquet");
    let rows: Vec<_> = file.get_row_iter(None).expect("rows").map(|row| row.expect("a row")).collect();
    assert_eq!(rows.len(), RUNS);
    let place = |name: &str| table.lines().next().expect("headings").split(',').position(|heading| heading == name);
    let [digest, speed, energy, error] =
        ["digest", "speed", "kinetic_energy", "error"].map(|name| place(name).expect("a column"));
    let (digests, energies) = (column(&table, "digest"), column(&table, "kinetic_energy"));
    for (run, row) in rows.iter().enumerate() {
        assert_eq!(
            row.get_double(speed).expect("a number").to_string(),
            column(&table, "speed")[run].trim_end_matches(".0")
        );
        assert_eq!(row.get_string(digest).ok().map_or("", String::as_str), digests[run]);
        assert_eq!(row.get_double(energy).ok(), energies[run].parse().ok());
        assert_eq!(row.get_string(error).is_ok(), digests[run].is_empty());
    }
}

const LIBRARY: &str = "fn car(name) { mobile(name).model(\"cars/box.obj\") }";
const MODEL: &str = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 1\nv -1 1 1\nf 1 2 3 4\n";
const IMPORTING: &str = "import \"cars/cars\" as cars;\nsteps(9);\nlet other = param(\"other\", 0, 0, 1);\n\
    cars::car(\"a\");\nif other > 0.5 { mobile(\"b\").model(\"cars/other.obj\").at(9, 0); }";

#[test]
fn a_library_is_given_and_what_is_read_from_it_belongs_to_the_sweep() {
    let plan = "(scenarios: [\"c.rhai\"], vary: [(name: \"other\", from: 0, to: 1, count: 2)])";
    let folder = folder(&[
        ("game/c.rhai", IMPORTING),
        ("game/plan.ron", plan),
        ("library/cars/cars.rhai", LIBRARY),
        ("library/cars/box.obj", MODEL),
        ("library/cars/other.obj", MODEL),
    ]);
    let at = folder.path();
    let told = said(at, &["sweep", "game/plan.ron", "-o", "out"], 2);
    assert!(told.contains("there is no file \"cars/cars\""), "{told}");
    let call = ["sweep", "game/plan.ron", "-o", "out", "--library", "library", "--script-timeout", "5"];
    said(at, &call, 0);
    assert!(said(at, &call, 0).contains("2 of them made before"));
    for (file, text) in [("cars.rhai", LIBRARY), ("box.obj", MODEL), ("other.obj", MODEL)] {
        let file = at.join("library/cars").join(file);
        write(&file, &format!("{text}\n"));
        let told = said(at, &call, 2);
        assert!(told.contains("its scenarios have changed"), "{}: {told}", file.display());
        write(&file, text);
    }
    fs::rename(at.join("library"), at.join("zoo")).expect("it can be renamed");
    assert!(
        said(at, &[&call[..5], &["zoo"]].concat(), 0).contains("2 of them made before"),
        "folders may be elsewhere"
    );
}

#[test]
fn two_sweeps_do_not_write_one_shard_at_once() {
    let folder = set_up();
    let at = folder.path();
    write(&at.join("out/shard_1_of_1.csv"), "");
    let held = fs::File::open(at.join("out/shard_1_of_1.csv")).expect("the shard");
    held.lock().expect("it can be locked");
    let told = said(at, &["sweep", "plan.ron", "-o", "out"], 2);
    assert!(told.contains("another sweep is writing out/shard_1_of_1.csv"), "{told}");
    drop(held);
    said(at, &["sweep", "plan.ron", "-o", "out"], 1);
}

#[test]
#[cfg(unix)]
fn a_sweep_that_is_killed_again_and_again_comes_to_its_end() {
    let plan = PLAN.replace("count: 5", "count: 200").replace("to: 9", "to: 7");
    let folder = folder(&[("crash.rhai", CRASH), ("plan.ron", &plan)]);
    let at = folder.path();
    said(at, &["sweep", "plan.ron", "-o", "whole"], 1);
    let mut rows = Vec::new();
    for wait in [40, 90, 60, 120, 75] {
        let mut child = choque();
        let child = child.current_dir(at).args(["sweep", "plan.ron", "-o", "killed"]);
        let mut child = child.stderr(std::process::Stdio::null()).spawn().expect("it starts");
        std::thread::sleep(std::time::Duration::from_millis(wait));
        child.kill().expect("it can be killed");
        child.wait().expect("it has ended");
        rows.push(fs::read_to_string(at.join("killed/shard_1_of_1.csv")).map_or(0, |text| text.lines().count()));
    }
    assert!(rows.is_sorted(), "nothing is lost: {rows:?}");
    said(at, &["sweep", "plan.ron", "-o", "killed"], 1);
    assert_eq!(read(at, "killed/rows.csv"), read(at, "whole/rows.csv"));
    assert_eq!(read(at, "killed/shard_1_of_1.csv").lines().count(), 200 * 8 + 2, "no run was made twice");
}

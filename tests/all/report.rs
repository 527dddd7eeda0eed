//! `choque report`: what it measures, what it refuses to, and the files it writes.

use std::fs;
use std::path::Path;

use choque::arguments::ScenarioArguments;
use choque::report::assemble::{Depth, study};
use choque::report::method::ALL;
use choque::report::recipe::Recipe;
use choque::report::reference::Earned;
use choque::report::study::{Row, Study};
use choque::report::told;
use choque_engine::scene::{Detection, MotionRule};

use crate::support::{choque, folder, stderr, stdout};

/// Two squares that meet once, at a moment that no time step is lucky with.
const MEETING: &str = r#"
title("A meeting");
exchange("impulse");
restitution(1);
steps(30);
mobile("a").rect(1, 1).at(-1.7, 0.3).velocity(3, 0).spin(1);
mobile("b").rect(1, 1);
"#;

const STEPPED: usize = 1;
const CONTINUOUS: usize = 3;

fn quick(script: &str) -> Study {
    let folder = folder(&[("scene.rhai", script)]);
    studied(&folder.path().join("scene.rhai"), None, 2)
}

fn studied(file: &Path, reference: Option<&Path>, threads: usize) -> Study {
    let recipe = Recipe::new(file, &ScenarioArguments::default());
    study(&recipe, reference, Depth::QUICK, threads).unwrap_or_else(|error| panic!("{error}"))
}

fn errors(study: &Study, method: usize) -> Vec<Option<f64>> {
    study.rows_of(ALL[method]).map(|row| row.error).collect()
}

#[test]
fn a_single_meeting_is_exact_in_continuous_motion_and_in_steps() {
    let study = quick(MEETING);
    assert!(matches!(study.references[1].earned, Some(Earned::Exact { to_itself, .. }) if to_itself < 1e-13));
    assert!(errors(&study, CONTINUOUS).iter().all(|error| error.is_some_and(|error| error < 1e-13)));
    let stepped = study.summary_of(ALL[STEPPED]).expect("a summary");
    assert!(stepped.error_at_sixtieth.is_some_and(|error| error < 1e-13), "a lone pair has its moment: {stepped:?}");
    assert!(study.comparisons.is_empty(), "it is not chaotic");
}

#[test]
fn nothing_but_times_depends_on_the_number_of_threads() {
    let folder = folder(&[("scene.rhai", MEETING)]);
    let file = folder.path().join("scene.rhai");
    let numbers = |threads| {
        let study = studied(&file, None, threads);
        let number = |row: &Row| (row.error, row.error_rms, row.moved_by_halving, row.digest.clone(), row.work);
        study.rows.iter().map(number).collect::<Vec<_>>()
    };
    assert_eq!(numbers(1), numbers(3));
}

/// A spring by hand: forces of the iteration's start act over all of it, so positions are first order in the time step.
#[test]
fn a_scene_with_forces_by_hand_converges_and_its_order_is_shown() {
    let study = quick(
        r#"steps(60); mobile("bob").rect(1, 1).at(1, 0);
           fn on_step(world) { let bob = world["bob"]; bob.push(-9 * bob.x, 0); }"#,
    );
    let Some(Earned::Converged { order, .. }) = study.references[0].earned else { panic!("{:?}", study.references) };
    assert!((order - 1.0).abs() < 0.1, "{order}");
    assert!(told::text(&study).contains("converged with order"), "{}", told::text(&study));
    let last = errors(&study, STEPPED).pop().flatten();
    assert!(last.is_none(), "too close to the reference to be judged by it: {last:?}");
    assert!(study.notes.iter().any(|note| note.contains("callbacks run once an iteration")), "{:?}", study.notes);
}

#[test]
fn a_scene_that_nothing_converges_in_has_no_errors() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/blades/spinning_blade.rhai");
    let study = studied(&file, None, 2);
    assert!(study.references.iter().all(|referred| referred.earned.is_none()));
    assert!(study.rows.iter().all(|row| row.error.is_none()));
    assert!(study.rows_of(study.own).all(|row| row.moved_by_halving.is_none_or(|moved| moved > 0.1)));
    assert!(told::text(&study).contains("no reference"), "{}", told::text(&study));
}

/// Four boxes that turn and bounce in a fifth: chaotic, elastic, walled in.
const GAS: &str = r#"
exchange("impulse");
restitution(1);
steps(600);
fixed("east").rect(1, 9).at(3.5, 0);
fixed("west").rect(1, 9).at(-3.5, 0);
fixed("north").rect(9, 1).at(0, 3.5);
fixed("south").rect(9, 1).at(0, -3.5);
for i in 0..4 {
    mobile("box" + i).rect(1, 0.5).at(-1.5 + 3 * (i % 2), -1.5 + 3 * div(i, 2)).velocity(3 - i, 1 + i).spin(2 - i);
}
"#;

#[test]
fn a_chaotic_scene_is_measured_up_to_its_horizon_and_then_told_in_statistics() {
    let study = quick(GAS);
    let growth = study.growth.expect("it runs");
    let horizon = growth.horizon.expect("it is chaotic");
    assert!(study.measured_until < horizon && horizon < study.time, "{growth:?}, {}", study.measured_until);
    let of = |quantity: &str, motion| {
        let is_it = |c: &&choque::report::copies::Comparison| {
            c.quantity == quantity && c.method.motion == motion && c.method.detection == Detection::Complete
        };
        study
            .comparisons
            .iter()
            .find(is_it)
            .unwrap_or_else(|| panic!("no {quantity} in {:?}", study.comparisons))
            .clone()
    };
    let outside = of("bodies outside", MotionRule::Continuous);
    assert_eq!((outside.median, outside.reference, outside.agree), (0.0, 0.0, true));
    let energy = of("kinetic energy, end / start", MotionRule::Continuous);
    assert!((energy.median - 1.0).abs() < 1e-12, "{energy:?}");
    let turning = of("share of energy in turning", MotionRule::Continuous);
    assert!((0.1..0.6).contains(&turning.median), "about a third: {turning:?}");
    let depth = of("contact depth, greatest / least half width", MotionRule::Stepped);
    assert!(!depth.agree && depth.median > depth.reference, "steps find overlaps, impacts have none: {depth:?}");
    assert_eq!(study.comparisons, quick(GAS).comparisons, "the same every time");
}

const RODS: &str = "time,body,x,z,angle\n\
    10,rod0,0.75,0,0\n10,rod1,1.6785714285714286,0,0\n10,rod2,2.75,0,0\n10,rod3,3.6785714285714286,0,0\n\
    10,rod4,4.75,0,0\n10,rod5,5.392857142857143,0,0\n10,rod6,7.607142857142857,0,0\n10,rod7,8.678571428571429,0,0\n";

#[test]
fn a_reference_that_is_given_is_what_errors_are_measured_against() {
    let folder = folder(&[("rods.csv", RODS)]);
    let gas = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/hard/e4_gas_of_rods.rhai");
    let study = studied(&gas, Some(&folder.path().join("rods.csv")), 2);
    assert!(study.references.iter().all(|referred| referred.earned == Some(Earned::Given)));
    assert!(errors(&study, CONTINUOUS).iter().all(|error| error.is_some_and(|error| error < 1e-12)));
    assert!(errors(&study, STEPPED).iter().any(|error| error.is_some_and(|error| error > 1e-2)));
}

#[test]
fn a_reference_in_ron_is_read_too() {
    let known = r#"[(time: 0.5, body: "a", x: 1.0, z: 0, angle: 0)]"#;
    let folder = folder(&[("a.rhai", "steps(30); mobile(\"a\").rect(1, 1).velocity(1, 0);"), ("known.ron", known)]);
    let study = studied(&folder.path().join("a.rhai"), Some(&folder.path().join("known.ron")), 1);
    let off = errors(&study, 0)[0].expect("an error");
    assert!((off - f64::sqrt(0.5)).abs() < 1e-14, "half a metre of √½ m: {off}");
}

#[test]
fn the_files_are_whole_and_agree() {
    let folder = folder(&[("meeting.rhai", MEETING)]);
    let output = choque()
        .current_dir(folder.path())
        .args(["report", "meeting.rhai", "--quick", "-o", "measured/here"])
        .output()
        .expect("it runs");
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(
        stdout(&output).contains("Speed against error") && stdout(&output).contains("1/960"),
        "{}",
        stdout(&output)
    );
    let read = |extension: &str| fs::read(folder.path().join(format!("measured/here/meeting.report.{extension}")));
    let text = |extension: &str| String::from_utf8(read(extension).expect("the file")).expect("text");

    let study: Study = ron::from_str(&text("ron")).expect("the study as RON");
    let csv = text("csv");
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), study.rows.len() + 1);
    let column = |name: &str| rows[0].iter().position(|head| *head == name).unwrap_or_else(|| panic!("no {name}"));
    for (line, row) in rows[1..].iter().zip(&study.rows) {
        assert_eq!(line.len(), rows[0].len());
        let number = |name: &str| line[column(name)].parse::<f64>().ok();
        assert_eq!(number("error"), row.error);
        assert_eq!(number("time_step"), Some(row.time_step));
        assert_eq!(number("cpu_per_second"), Some(row.cpu_per_second));
        assert_eq!(number("bodies_advanced"), Some(row.work.bodies_advanced as f64));
        assert_eq!(line[column("digest")], row.digest);
        assert_eq!(line[column("motion")], row.method.motion.word());
    }

    let svg = text("svg");
    let document = roxmltree::Document::parse(&svg).expect("well-formed");
    let numbers =
        |node: roxmltree::Node<'_, '_>| node.attribute("d").is_some_and(|d| !d.contains("NaN") && !d.contains("inf"));
    assert!(document.descendants().filter(|node| node.has_tag_name("path")).all(numbers));
    assert!(svg.contains("<title>A meeting: speed against error</title>"));
    let png = tiny_skia::Pixmap::decode_png(&read("png").expect("the file")).expect("a picture");
    assert_eq!((png.width(), png.height()), (1520, 1040));
    let colours = png.pixels().iter().filter(|pixel| pixel.red() != pixel.green() || pixel.green() != pixel.blue());
    assert!(colours.count() > 1000, "curves in colour");
    let files = fs::read_dir(folder.path().join("measured/here")).expect("the folder").count();
    assert_eq!(files, 4, "nothing is left beside them");
}

#[test]
fn a_scene_beside_its_report_is_left_alone() {
    let scene = r#"(settings: (steps: 8), bodies: [(name: "a", kind: mobile, parts: [rect((x_min: -1.0, x_max: 1.0, z_min: -1.0, z_max: 1.0))])])"#;
    let folder = folder(&[("scene.ron", scene)]);
    let output = choque()
        .current_dir(folder.path())
        .args(["report", "scene.ron", "--quick", "-o", "."])
        .output()
        .expect("it runs");
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(fs::read_to_string(folder.path().join("scene.ron")).expect("the scene"), scene);
    assert!(folder.path().join("scene.report.ron").is_file());
}

#[test]
fn a_bad_scenario_among_several_is_told_before_anything_is_measured() {
    let folder = folder(&[("good.rhai", MEETING), ("bad.rhai", "mobile(\"a\").rect(1, 1).mass(-1);")]);
    let output =
        choque().current_dir(folder.path()).args(["report", "good.rhai", "bad.rhai"]).output().expect("it runs");
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(2), ""));
    assert!(stderr(&output).contains("bad.rhai:1"), "{}", stderr(&output));
    assert!(!folder.path().join("report").exists());
}

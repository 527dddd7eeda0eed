//! Each known way out of the sandbox, and each way of never coming to an end: an error, and soon.

use std::fs;
use std::time::Duration;

use choque_scripting::Options;
use insta::assert_snapshot;

use crate::support::{Folder, error, error_in, error_with};

/// An error's first line: what was wrong.
#[track_caller]
fn what(script: &str) -> String {
    error(script).lines().next().unwrap().to_owned()
}

/// Little time, so that what only the clock stops is stopped soon.
fn hurried() -> Options {
    Options { script_timeout: Duration::from_millis(50), ..Options::default() }
}

#[test]
fn a_path_that_leads_upwards_is_refused() {
    assert_snapshot!(error(r#"import "../secret" as s;"#), @r#"
    error: import: "../secret" leads upwards
     --> scene.rhai:1:8
      |
    1 | import "../secret" as s;
      |        ^^^^^^^^^^^
      |
      = help: write a path below the script's folder or below the library, with `/` between folders
    "#);
    assert_snapshot!(what(r#"import "lib/../../secret" as s;"#), @r#"error: import: "lib/../../secret" leads upwards"#);
    assert_snapshot!(what(r#"mobile("a").model("../secret.obj");"#), @r#"error: body "a": model: "../secret.obj" leads upwards"#);
}

#[test]
fn an_absolute_path_is_refused() {
    assert_snapshot!(what(r#"import "/etc/passwd" as s;"#), @r#"error: import: "/etc/passwd" is an absolute path"#);
    assert_snapshot!(what(r#"mobile("a").model("/etc/passwd");"#), @r#"error: body "a": model: "/etc/passwd" is an absolute path"#);
}

#[test]
fn signs_that_lead_elsewhere_on_some_systems_are_refused() {
    assert_snapshot!(what(r#"import "..\\secret" as s;"#), @r#"error: import: "..\secret" has a sign that no path of a script has"#);
    assert_snapshot!(what(r#"import "C:secret" as s;"#), @r#"error: import: "C:secret" has a sign that no path of a script has"#);
    assert_snapshot!(what(r#"import "" as s;"#), @r#"error: import: "" is empty"#);
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_out_is_refused() {
    let outside = Folder::with(&[("secret.rhai", "fn tell() { 1 }"), ("secret.obj", "v 0 0 0\n")]);
    let folder = Folder::with(&[
        ("script.rhai", r#"import "link" as s;"#),
        ("folder.rhai", r#"import "out/secret" as s;"#),
        ("model.rhai", r#"mobile("a").model("link.obj");"#),
        ("near.rhai", r#"import "out/secre" as s;"#),
        ("inside.rhai", r#"import "alias" as s; s::tell();"#),
        ("lib/own.rhai", "fn tell() { 1 }"),
    ]);
    let link = |to, name: &str| std::os::unix::fs::symlink(to, folder.path(name)).unwrap();
    link(outside.path("secret.rhai"), "link.rhai");
    link(outside.path("secret.obj"), "link.obj");
    link(outside.path(""), "out");
    link(folder.path("lib/own.rhai"), "alias.rhai");
    let load = |name| folder.load(name, &Options::default()).map(|_| ());
    assert_snapshot!(load("script.rhai").unwrap_err(), @r#"
    error: import: "link" is a link that leads out of the script's folder
     --> script.rhai:1:8
      |
    1 | import "link" as s;
      |        ^^^^^^
      |
      = help: a script reads files below its own folder and below the library only
    "#);
    assert!(load("folder.rhai").unwrap_err().contains("leads out"));
    assert!(load("model.rhai").unwrap_err().contains("leads out"));
    assert!(!load("near.rhai").unwrap_err().contains("secret"), "no hint of what is outside");
    assert_eq!(load("inside.rhai"), Ok(()), "a link that stays inside is as good as a file");
}

#[test]
fn the_library_is_the_nearest_folder_named_scenarios_or_the_one_given() {
    let folder = Folder::with(&[
        ("scenarios/walls/scene.rhai", r#"import "lib/shapes" as s; s::wall();"#),
        ("scenarios/lib/shapes.rhai", r#"fn wall() { fixed("wall").rect(1, 1) }"#),
        ("other/lib/shapes.rhai", r#"fn wall() { fixed("other").rect(1, 1) }"#),
    ]);
    let name =
        |options: &Options| folder.load("scenarios/walls/scene.rhai", options).unwrap().scene().bodies[0].name.clone();
    assert_eq!(name(&Options::default()), "wall");
    assert_eq!(name(&Options { library: Some(folder.path("other")), ..Options::default() }), "other");
    fs::write(folder.path("scenarios/walls/lib.rhai"), "").unwrap();
    let missing = Options { library: Some(folder.path("none")), ..Options::default() };
    assert!(folder.load("scenarios/walls/scene.rhai", &missing).unwrap_err().contains("there is no such folder"));
}

#[test]
fn a_circle_of_imports_is_an_error() {
    let files =
        [("scene.rhai", r#"import "a" as a;"#), ("a.rhai", r#"import "b" as b;"#), ("b.rhai", "\nimport \"a\" as a;")];
    assert_snapshot!(error_in(&files, &Options::default()), @r#"
    error: import: "a" imports itself
     --> b.rhai:2:8
      |
    2 | import "a" as a;
      |        ^^^
      |
      = note: imported at a.rhai:1:8
      = note: imported at scene.rhai:1:8
      = help: the circle is a.rhai → b.rhai → a.rhai
    "#);
    assert_snapshot!(what(r#"import "scene" as me;"#), @r#"error: import: "scene" imports itself"#);
}

#[test]
fn there_is_no_clock_no_sleep_and_no_eval() {
    assert_snapshot!(error("sleep(1);"), @r#"
    error: `sleep` is not available in a scenario
     --> scene.rhai:1:1
      |
    1 | sleep(1);
      | ^^^^^
      |
      = help: simulated time does not wait; let the world step, and read `world.time`
    "#);
    assert_snapshot!(error("let t = timestamp();"), @r#"
    error: `timestamp` is not available in a scenario
     --> scene.rhai:1:9
      |
    1 | let t = timestamp();
      |         ^^^^^^^^^
      |
      = help: a scenario must run alike every time, and a clock never does; read `world.time`
    "#);
    assert_snapshot!(error("eval(\"1\");"), @r#"
    error: `eval` is not available in a scenario
     --> scene.rhai:1:1
      |
    1 | eval("1");
      | ^^^^
      |
      = help: a script is checked before it runs; text made while it runs could not be
    "#);
    assert_snapshot!(what("let f = |x| x; f.curry(1);"), @"error: `curry` is not available in a scenario");
    assert_snapshot!(what("fn f() { this }"), @"error: `this` is not available in a scenario");
}

#[test]
fn an_endless_loop_in_the_main_part_ends() {
    assert_snapshot!(error("loop { }"), @r#"
    error: the script made 100000000 operations and came to no end
     --> scene.rhai:1:6
      |
    1 | loop { }
      |      ^
      |
      = help: is there an endless loop?
    "#);
    assert_snapshot!(error_with("let x = 0;\nloop { x += 1; }", &hurried()), @r#"
    error: the script ran for more than 0.05 s and came to no end
     --> scene.rhai:2:10
      |
    2 | loop { x += 1; }
      |          ^
      |
      = help: is there an endless loop? --script-timeout gives it more time
    "#);
}

#[test]
fn an_endless_loop_in_any_callback_ends() {
    let body = r#"steps(3); mobile("a").rect(1, 1).velocity(1, 0); fixed("b").rect(1, 1).at(1, 0);"#;
    let stopped = |callback: &str| error_with(&format!("{body}\n{callback}"), &hurried());
    assert_snapshot!(stopped("fn on_step(world) { loop { } }"), @r#"
    error: the script ran for more than 0.05 s and came to no end
     --> scene.rhai:2:4
      |
    2 | fn on_step(world) { loop { } }
      |    ^^^^^^^
      |
      = help: is there an endless loop? --script-timeout gives it more time
    "#);
    assert_snapshot!(stopped("fn on_collision(world, hit) { loop { } }"), @r#"
    error: the script ran for more than 0.05 s and came to no end
     --> scene.rhai:2:4
      |
    2 | fn on_collision(world, hit) { loop { } }
      |    ^^^^^^^^^^^^
      |
      = help: is there an endless loop? --script-timeout gives it more time
    "#);
    assert_snapshot!(stopped("fn stop_when(world) { loop { } }"), @r#"
    error: the script ran for more than 0.05 s and came to no end
     --> scene.rhai:2:4
      |
    2 | fn stop_when(world) { loop { } }
      |    ^^^^^^^^^
      |
      = help: is there an endless loop? --script-timeout gives it more time
    "#);
    assert_snapshot!(stopped("always(\"ends\", |world| { loop { } });"), @r#"
    error: the script ran for more than 0.05 s and came to no end
     --> scene.rhai:2:1
      |
    2 | always("ends", |world| { loop { } });
      | ^^^^^^
      |
      = note: in always "ends"
      = help: is there an endless loop? --script-timeout gives it more time
    "#);
    assert_snapshot!(stopped("expect(\"ends\", |world| { loop { } });"), @r#"
    error: the script ran for more than 0.05 s and came to no end
     --> scene.rhai:2:1
      |
    2 | expect("ends", |world| { loop { } });
      | ^^^^^^
      |
      = note: in expect "ends"
      = help: is there an endless loop? --script-timeout gives it more time
    "#);
    assert_snapshot!(stopped("let a = [2, 1]; a.sort(|p, q| { loop { } });"), @r#"
    error: the script ran for more than 0.05 s and came to no end
     --> scene.rhai:2:19
      |
    2 | let a = [2, 1]; a.sort(|p, q| { loop { } });
      |                   ^^^^
      |
      = help: is there an endless loop? --script-timeout gives it more time
    "#);
}

#[test]
fn each_callback_has_its_own_time() {
    let script = r#"
        steps(200); mobile("a").rect(1, 1);
        fn on_step(world) { let x = 0; while x < 5000 { x += 1; } }
    "#;
    let folder = Folder::with(&[("scene.rhai", script)]);
    let options = Options { script_timeout: Duration::from_millis(300), ..Options::default() };
    assert!(folder.run("scene.rhai", &options).is_ok(), "200 times a few milliseconds");
}

#[test]
fn an_endless_loop_in_a_module_ends() {
    let files = [("scene.rhai", "import \"m\" as m;\nm::spin();"), ("m.rhai", "fn spin() { loop { } }")];
    assert_snapshot!(error_in(&files, &hurried()), @r#"
    error: the script ran for more than 0.05 s and came to no end
     --> scene.rhai:2:4
      |
    2 | m::spin();
      |    ^^^^
      |
      = help: is there an endless loop? --script-timeout gives it more time
    "#);
}

#[test]
fn giant_texts_are_refused() {
    assert_snapshot!(error("let s = \"x\";\nloop { s += s; }"), @r#"
    error: a string may have 50000 bytes at most
     --> scene.rhai:2:10
      |
    2 | loop { s += s; }
      |          ^
    "#);
    for script in [
        r#"let s = "x"; s.pad(1000000000, "y");"#,
        r#"let s = "x"; s.pad(40000, "x"); s.replace("x", s);"#,
        r#"let s = "x"; loop { s = `${s}${s}`; }"#,
        r#"let s = "x"; s.pad(40000, "x"); let m = #{}; let i = 0; loop { m[s + i] = 1; i += 1; }"#,
        r#"let s = "x"; s.pad(40000, "x"); let a = [0, 0, 0]; loop { a[0] = s + 1; a[1] = s + 2; }"#,
    ] {
        let error = what(script);
        assert!(error.contains("a string may have") || error.contains("the string would have"), "{script}\n{error}");
    }
}

#[test]
fn giant_arrays_and_maps_are_refused() {
    assert_snapshot!(error("let a = [0];\nloop { a += a; }"), @r#"
    error: an array or a map may have 100000 entries at most, all within it counted
     --> scene.rhai:2:10
      |
    2 | loop { a += a; }
      |          ^
    "#);
    for script in [
        "let a = []; a.pad(1000000000, 0);",
        "let a = []; loop { a = [a, a]; }",
        "let a = [0, 0]; loop { a[0] = a; a[1] = a; }",
        "let m = #{}; loop { m = #{a: m, b: m}; }",
        "let m = #{a: 1, b: 1}; loop { m.a = m; m.b = m; }",
        "let m = #{}; let i = 0; loop { m[`${i}`] = i; i += 1; }",
        "fn grow(a) { [a, a] } let a = 1; loop { a = grow(a); }",
        "let a = 1; let grow = || { a = [a, a]; }; loop { grow.call(); }",
    ] {
        let error = what(script);
        assert!(error.contains("entries at most") || error.contains("a string may have"), "{script}\n{error}");
    }
}

#[test]
fn arrays_that_nest_too_deeply_are_refused() {
    assert_snapshot!(error("let a = [];\nloop { a = [a]; }"), @r#"
    error: arrays and maps may lie 64 deep within each other at most
     --> scene.rhai:2:8
      |
    2 | loop { a = [a]; }
      |        ^
    "#);
    for script in
        ["let a = [0]; loop { a[0] = a; }", "let m = #{}; loop { m = #{m: m}; }", "let m = #{}; loop { m.m = m; }"]
    {
        assert!(what(script).contains("deep within each other"), "{script}");
    }
}

/// A chain of closures would end in a stack overflow when it is dropped, and captured arrays fill the memory.
#[test]
fn what_closures_capture_is_weighed_too() {
    for script in [
        "let f = || 1; for i in 0..50000 { let g = f; f = || g; }",
        "let x = [|| 1]; for i in 0..50000 { let g = x; let f = || g; x = [f]; }",
        "let x = #{a: || 1}; for i in 0..50000 { let g = x; let f = || g; x = #{a: f}; }",
    ] {
        assert!(what(script).contains("deep within each other"), "{script}: {}", what(script));
    }
    let hoard = "let fs = []; for i in 0..100000 { let a = []; a.pad(50000, 1); let f = || a; fs.push(f); }";
    assert!(what(hoard).contains("entries at most"), "{}", what(hoard));
    // Sharing a number, or a small array, between a few closures is what closures are for.
    let fine = "let total = 0; let fs = []; for i in 0..50 { fs.push(|| { total += i; }); } fs[3].call();";
    assert!(Folder::with(&[("scene.rhai", fine)]).load("scene.rhai", &Options::default()).is_ok());
}

#[test]
fn a_comment_that_is_never_closed_is_an_error() {
    assert_snapshot!(error("mobile(\"a\").rect(1, 1);\n/* and so on\nexpect(\"no\", |world| false);"), @r#"
    error: this comment is not closed
     --> scene.rhai:2:1
      |
    2 | /* and so on
      | ^
      |
      = help: end it with */
    "#);
    let closed = "/* a */ mobile(\"/*\").rect(1, 1); // and /* that";
    assert!(Folder::with(&[("scene.rhai", closed)]).load("scene.rhai", &Options::default()).is_ok());
}

#[test]
fn names_are_plain_text_on_one_line() {
    assert_snapshot!(
        what("mobile(\"a\\u001b[31m\").rect(1, 1);"),
        @"error: mobile: name must be plain text on one line, without control characters"
    );
}

#[test]
fn deep_recursion_is_refused() {
    assert_snapshot!(error("fn f(n) { f(n + 1) }\nf(0);"), @r#"
    error: functions call each other more than 32 deep
     --> scene.rhai:2:1
      |
    2 | f(0);
      | ^
      |
      = help: does a function call itself without end?
    "#);
    let sums = format!("fn f(n) {{ {}f(n + 1){} }} f(0);", "(1 + ".repeat(18), ")".repeat(18));
    assert!(what(&sums).contains("call each other"), "the deepest nesting within the deepest recursion");
    assert!(what("fn f(n) { [1].map(|x| f(n + 1)) } f(0);").contains("call each other"));
    let callback = "mobile(\"a\").rect(1, 1);\nfn on_step(world) { on_step(world) }";
    assert!(what(callback).contains("call each other"));
}

#[test]
fn deep_nesting_of_expressions_is_refused() {
    assert_snapshot!(what(&format!("let x = {}1{};", "(".repeat(500), ")".repeat(500))), @"error: this nests too deeply");
    for (open, close) in [("[", "]"), ("(1 + ", ")"), ("if true {", "}"), ("!", ""), ("|x| ", "")] {
        let script = format!("let x = {}1{};", open.repeat(20_000), close.repeat(20_000));
        assert!(what(&script).starts_with("error: "), "{open}");
    }
}

#[test]
fn a_million_bodies_are_the_most() {
    let patient = Options { script_timeout: Duration::from_secs(3600), ..Options::default() };
    let told = error_with("for i in 0..1000001 { mobile(\"b\" + i); }", &patient);
    assert_snapshot!(told.lines().next().unwrap(), @"error: a scene may have 1000000 bodies at most");
}

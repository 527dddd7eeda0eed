//! What a script wants of a run, and what may vary for it.

use choque_scripting::{Options, Target, Varied};

use crate::support::{Folder, run, set};

fn varied(script: &str, options: &Options) -> Result<Vec<Varied>, String> {
    let folder = Folder::with(&[("scene.rhai", script)]);
    folder.load("scene.rhai", options).map(|scenario| scenario.varied().to_vec())
}

fn refused(script: &str) -> String {
    varied(script, &Options::default()).expect_err("this cannot vary")
}

const CAR: &str = "steps(60); mobile(\"car\").rect(4, 2).at(1, 0).velocity(2, 0);\n";

#[test]
fn targets_are_measured_at_the_end_with_their_weights() {
    let (run, expectations) = run(&format!(
        "{CAR} target(\"at 5\", |world| world[\"car\"].x - 5); target(\"no spin\", 2, |w| 7); expect(\"e\", |w| true);"
    ));
    let targets = run.measure().unwrap();
    assert!((targets[0].residual + 2.0).abs() < 1e-12, "it drove 2 m from 1 m: {targets:?}");
    assert_eq!(targets[1], Target { text: "no spin".to_owned(), weight: 2.0, residual: 7.0 });
    assert_eq!((targets[0].weight, expectations.len()), (1.0, 1));
}

#[test]
fn a_target_only_looks_and_gives_a_number() {
    let folder =
        Folder::with(&[("scene.rhai", &format!("{CAR}target(\"t\", |world| {{ world[\"car\"].x = 1; 0 }});"))]);
    let (run, _) = folder.run("scene.rhai", &Options::default()).unwrap();
    assert!(run.measure().unwrap_err().message.contains("a target only looks"));
    let folder = Folder::with(&[("scene.rhai", &format!("{CAR}target(\"t\", |world| world[\"car\"].x > 1);"))]);
    let (run, _) = folder.run("scene.rhai", &Options::default()).unwrap();
    let wrong = run.measure().unwrap_err();
    assert_eq!((wrong.line, wrong.message.as_str()), (Some(2), "target \"t\" must be a number, not true or false"));
}

#[test]
fn a_wrong_target_is_refused() {
    assert!(refused("target(\"t\", 3);").contains("target \"t\": the number must be a closure, not a whole number"));
    assert!(refused("target(\"t\", -1, |world| 0);").contains("target \"t\": weight must be greater than 0, not -1"));
    assert!(refused("target(\"t\", |a, b| 0);").contains("the closure takes the world and nothing else"));
    assert!(refused("target(\"\", |w| 0);").contains("target: text must not be empty"));
}

#[test]
fn settings_vary_by_their_bare_names_and_params_by_theirs() {
    let script = "mu_l(0.5); vary(mu_l, 0, 1); vary( /* the gap */ epsilon , 0.0, 0.1); vary(\"mu_a\", 0.25, 1);\n\
                  let push = param(\"push\", 8, 0, 30); vary(\"push\"); vary(\"far\", -1, 1); let far = param(\"far\", 0);";
    let told = varied(script, &set(&[("push", 12.0)])).unwrap();
    let names: Vec<(&str, (f64, f64), f64)> = told.iter().map(|v| (v.name.as_str(), v.range, v.value)).collect();
    assert_eq!(
        names,
        [
            ("mu_l", (0.0, 1.0), 0.5),
            ("epsilon", (0.0, 0.1), 0.001),
            ("mu_a", (0.25, 1.0), 1.0),
            ("push", (0.0, 30.0), 12.0),
            ("far", (-1.0, 1.0), 0.0)
        ]
    );
}

#[test]
fn a_bare_name_means_a_setting_nowhere_else() {
    assert!(refused("let x = mu_l;").contains("there is no variable `mu_l` here"));
    assert!(refused("print(mu_l > 0.5);").contains("there is no variable `mu_l` here"));
    let own = "let mu_l = 0.25; mu_l(mu_l); vary(mu_l, 0, 1);"; // a variable of one's own does not get in the way
    assert_eq!(varied(own, &Options::default()).unwrap()[0].value, 0.25);
}

#[test]
fn what_cannot_vary_is_refused_where_it_stands() {
    let message = refused("mu_l(0.5);\nvary(\"frction\", 0, 1);");
    assert!(message.contains("the scenario has no param of that name") && message.contains("did you mean `friction`?"));
    assert!(message.contains("scene.rhai:2:1") && message.contains("^^^^"), "{message}");
    let push = "let push = param(\"push\", 8, 0, 30);\n";
    for (script, why) in [
        ("vary(mu_l, 1, 0);", "vary mu_l: min must be below max, but 1 is not below 0"),
        ("vary(mu_l, 1, 1);", "min must be below max"),
        ("vary(mu_l, -1, 1);", "vary mu_l: mu_l must be 0 or more, not -1"),
        ("vary(restitution, 0, 2);", "vary restitution: restitution must be between 0 and 1"),
        ("vary(mu_l, 0, 0.0/0.0);", "vary: max must be"),
        ("vary(mu_l);", "vary mu_l: nothing says between what it may vary"),
        ("vary(push, 0, 1);", "vary: name must be a string, not a whole number"),
        ("vary(\"push\", -1, 1);", "vary push: -1 … 1 is wider than the 0 … 30 that its param allows"),
        ("vary(\"push\"); vary(\"push\");", "vary push: that stands in line 2 already"),
        ("fn f(w) { vary(mu_l, 0, 1); } always(\"a\", |w| { f(w); true });", ""),
    ] {
        match varied(&format!("{push}{script}"), &Options::default()) {
            Err(message) => assert!(message.contains(why), "{script}: {message}"),
            Ok(varied) => assert!(why.is_empty() && varied.is_empty(), "{script}"),
        }
    }
}

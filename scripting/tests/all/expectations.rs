//! What must hold, and what is told when it does not.

use choque_scripting::Expectation;

use crate::support::run;

fn numbers(expectation: &Expectation) -> Vec<(&str, f64)> {
    expectation.numbers.iter().map(|(name, value)| (name.as_str(), *value)).collect()
}

#[test]
fn a_failure_names_the_first_iteration_and_the_numbers() {
    let (_, expectations) = run(r#"
        time_step(1); steps(10);
        let car = mobile("car").rect(1, 1).velocity(2, 0);
        always("stays near", |world| world["car"].x < 5 || car.vz > 1);
        always("moves",      |world| car.speed > 1);
        expect("is far",     |world| world.time > 9 && car.x > 100);
        expect("is there",   |world| world.bodies().len() == 1);
        "#);
    let told: Vec<(&str, bool, Option<u64>)> =
        expectations.iter().map(|told| (told.text.as_str(), told.held, told.first_failure)).collect();
    let expected =
        [("stays near", false, Some(3)), ("moves", true, None), ("is far", false, Some(10)), ("is there", true, None)];
    assert_eq!(told, expected, "in the order of the script");
    assert_eq!(numbers(&expectations[0]), [("car.x", 6.0), ("car.vz", 0.0)]);
    assert_eq!(numbers(&expectations[2]), [("world.time", 10.0), ("car.x", 20.0)]);
    assert!(expectations[1].numbers.is_empty());
}

#[test]
fn a_number_read_twice_is_told_once() {
    let (_, expectations) = run(r#"
        steps(1);
        mobile("a").rect(1, 1); mobile("b").rect(1, 1).at(5, 0);
        expect("somewhere", |world| {
            for body in world.bodies() { if body.x > 9 || body.x < -9 { return true; } }
            false
        });
        "#);
    assert_eq!(numbers(&expectations[0]), [("a.x", 0.0), ("b.x", 5.0)]);
}

#[test]
fn one_that_failed_is_not_judged_again() {
    let (_, expectations) = run(r#"
        steps(10);
        mobile("a").rect(1, 1);
        let judged = 0;
        always("only twice", |world| { judged += 1; world.iteration != 2 });
        expect("judged twice", |world| judged == 2);
        "#);
    assert_eq!((expectations[0].first_failure, expectations[1].held), (Some(2), true));
}

#[test]
fn judging_changes_nothing() {
    let script = |expectation: &str| {
        format!(
            r#"
        steps(50);
        mobile("a").rect(1, 1).velocity(1, 0); fixed("wall").rect(1, 4).at(2, 0);
        fn on_step(world) {{ world["a"].vz = random(-1, 1); }}
        {expectation}
        "#,
        )
    };
    let without = run(&script("")).0.world().digest();
    let with = run(&script(r#"always("slow", |world| world["a"].vx > 100); expect("x", |world| world.deepest > 1);"#));
    assert_eq!(with.0.world().digest(), without);
}

#[test]
fn a_run_of_no_iterations_breaks_no_always() {
    let (_, expectations) = run(r#"steps(0); mobile("a").rect(1, 1); always("never asked", |world| false);"#);
    assert!(expectations[0].held);
}

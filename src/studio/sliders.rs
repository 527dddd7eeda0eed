//! What can be tuned, as sliders: how far each goes and in which steps.

use choque_engine::scene::{ExchangeRule, Scene};
use choque_scripting::Control;
use serde::Serialize;

/// A control as the page shows it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Slider {
    name: String,
    is_param: bool,
    value: f64,
    written: f64,
    min: f64,
    max: f64,
    step: f64,
    /// The script's own bounds: what is beyond them is refused, and not only off the slider.
    is_bound: bool,
    /// Why it does nothing in this scene; empty where it does something.
    idle: &'static str,
}

/// A slider for each control.
pub(super) fn of(controls: &[Control], scene: &Scene) -> Vec<Slider> {
    controls.iter().map(|control| slider(control, scene)).collect()
}

fn slider(control: &Control, scene: &Scene) -> Slider {
    let Control { name, is_param, value, written, range, is_whole } = control;
    let (min, max) = range.unwrap_or_else(|| sensible(name, *written, *value));
    let step = if *is_whole { 1.0 } else { fine_step(max - min) };
    let idle = if *is_param { "" } else { idle(name, scene.settings.exchange) };
    let (name, is_param, is_bound) = (name.clone(), *is_param, range.is_some());
    Slider { name, is_param, value: *value, written: *written, min, max, step, is_bound, idle }
}

/// How far a slider goes that the script gives no bounds.
fn sensible(name: &str, written: f64, value: f64) -> (f64, f64) {
    let furthest = written.abs().max(value.abs());
    match name {
        "mu_l" | "mu_a" | "friction" => (0.0, if furthest > 1.0 { rounded_up(1.5 * furthest) } else { 1.0 }),
        "restitution" => (0.0, 1.0),
        "epsilon" => (0.0, rounded_up((10.0 * furthest).max(0.01))),
        _ if furthest == 0.0 => (-1.0, 1.0),
        _ if written.min(value) < 0.0 && written.max(value) > 0.0 => {
            (-rounded_up(2.0 * furthest), rounded_up(2.0 * furthest))
        }
        _ if written + value < 0.0 => (-rounded_up(2.0 * furthest), 0.0),
        _ => (0.0, rounded_up(2.0 * furthest)),
    }
}

/// The next number up that is 1, 2 or 5 times a power of ten.
fn rounded_up(number: f64) -> f64 {
    let number = number.min(f64::MAX);
    let decade = exponent(number);
    let edges = [(1, decade), (2, decade), (5, decade), (1, decade + 1)].map(|(digit, decade)| scaled(digit, decade));
    edges.into_iter().find(|edge| *edge >= number && edge.is_finite()).unwrap_or(number)
}

/// A power of ten of which a range has a hundred to a thousand.
fn fine_step(span: f64) -> f64 {
    if span > 0.0 { scaled(1, exponent(span.min(f64::MAX) / 100.0)) } else { 1.0 }
}

/// Of the greatest power of ten that is not above a number greater than 0.
fn exponent(number: f64) -> i32 {
    format!("{number:e}").rsplit('e').next().and_then(|digits| digits.parse().ok()).unwrap_or(0)
}

/// Read rather than computed, so that it is the very number that is written so.
fn scaled(digit: u8, exponent: i32) -> f64 {
    format!("{digit}e{exponent}").parse().unwrap_or(f64::MAX)
}

/// The document's numbers belong to its exchange, the others to the impulses.
fn idle(name: &str, exchange: ExchangeRule) -> &'static str {
    let is_documents = matches!(name, "mu_l" | "mu_a" | "epsilon");
    match exchange {
        ExchangeRule::Impulse if is_documents => "exchange(\"impulse\") does not use it",
        ExchangeRule::Document if !is_documents => "the document's exchange does not use it",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn control(name: &str, written: f64, range: Option<(f64, f64)>, is_whole: bool) -> Control {
        let is_param = !matches!(name, "mu_l" | "mu_a" | "epsilon" | "restitution" | "friction");
        Control { name: name.to_owned(), is_param, value: written, written, range, is_whole }
    }

    #[test]
    fn a_slider_reaches_what_is_worth_trying_and_holds_its_value() {
        let scene = Scene::default();
        let ends = |name, written| {
            let slider = slider(&control(name, written, None, false), &scene);
            assert!(slider.min <= written && written <= slider.max, "{slider:?}");
            (slider.min, slider.max)
        };
        assert_eq!(ends("mu_l", 0.9), (0.0, 1.0));
        assert_eq!(ends("mu_a", 1.2), (0.0, 2.0));
        assert_eq!(ends("epsilon", 0.001), (0.0, 0.01));
        assert_eq!(ends("epsilon", 0.02), (0.0, 0.2));
        assert_eq!(ends("push", 8.0), (0.0, 20.0));
        assert_eq!(ends("push", -30.0), (-100.0, 0.0));
        assert_eq!(ends("push", 0.0), (-1.0, 1.0));
        assert_eq!(ends("tiny", 3e-7), (0.0, 1e-6));
        let (least, most) = ends("huge", f64::MAX);
        assert!(least == 0.0 && most.is_finite(), "{most}");
    }

    #[test]
    fn what_is_written_whole_moves_in_whole_steps() {
        let scene = Scene::default();
        let step = |range, is_whole| slider(&control("push", 8.0, range, is_whole), &scene).step;
        assert_eq!(step(Some((0.0, 30.0)), true), 1.0);
        assert_eq!(step(Some((0.0, 30.0)), false), 0.1);
        assert_eq!(step(Some((0.0, 1.0)), false), 0.01);
        assert_eq!(step(None, false), 0.1);
    }

    #[test]
    fn sliders_that_do_nothing_say_so() {
        let mut scene = Scene::default();
        assert!(slider(&control("mu_l", 1.0, None, false), &scene).idle.is_empty());
        assert!(!slider(&control("friction", 0.0, None, false), &scene).idle.is_empty());
        scene.settings.exchange = ExchangeRule::Impulse;
        assert!(!slider(&control("mu_l", 1.0, None, false), &scene).idle.is_empty());
        assert!(slider(&control("friction", 0.0, None, false), &scene).idle.is_empty());
    }
}

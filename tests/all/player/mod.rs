//! The player's page: it holds what was recorded, needs nothing from elsewhere, and no text in it becomes markup.

mod decoded;

use std::f64::consts::{PI, TAU};

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use choque::player;
use choque::recording::{About, Body, Frame, Recording, Settings, State, record};
use choque_engine::area::Rect;
use choque_engine::scene::Kind;
use choque_scripting::{Options, Scenario};
use sha2::{Digest, Sha256};

use crate::support::{choque, folder, stderr};
use decoded::Decoded;

const LIVELY: &str = r#"
title("Lively");
time_step(1.0 / 64); steps(200); drag(0.1, 0.2); mu_l(0.9);
let speed = param("speed", 3, 0, 10);
fixed("door").rect(1, 4).at(4, 0).patrol([[4, 3]], 1);
fixed("wall").rect(1, 9).at(-4, 0).angle(-3);
mobile("a").rect(1, 1).at(-2, 0).velocity(speed, 0.3).spin(400);
mobile("b").rect(1, 2).rect(2, 0.5).at(0.5, 0.4).mass(3);
expect("a is somewhere", |world| world["a"].x > -100);
"#;

fn recorded(script: &str) -> Recording {
    let folder = folder(&[("lively.rhai", script)]);
    let scenario = Scenario::load(&folder.path().join("lively.rhai"), &Options::default()).expect("a scenario");
    let command = ["choque", "render", "lively.rhai", "--set", "speed=3"].map(str::to_owned).to_vec();
    record(&scenario, &Settings { every: 1, ledger: true, command }).expect("a run")
}

/// A run made of nothing but places and motions.
fn played(bodies: usize, frames: usize, state: impl Fn(usize, usize) -> State) -> Recording {
    let body = |i: usize| Body {
        name: format!("b{i}"),
        kind: Kind::Mobile,
        mass: 1.0,
        inertia: 1.0,
        tags: Vec::new(),
        rects: vec![Rect::centred(1.0, 0.6)],
        restitution: None,
        friction: None,
    };
    let frame = |f: usize| Frame {
        iteration: f as u64,
        time: f as f64 / 120.0,
        states: (0..bodies).map(|i| state(f, i)).collect(),
        ..Frame::default()
    };
    Recording {
        about: About { time_step: 1.0 / 120.0, every: 1, ..About::default() },
        bodies: (0..bodies).map(body).collect(),
        frames: (0..frames).map(frame).collect(),
        ending: Default::default(),
    }
}

/// Numbers in [0, 1) that follow no rule, the same in every run.
fn noise(seed: u64) -> f64 {
    let mut bits = seed.wrapping_add(0x9e37_79b9_7f4a_7c15).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 29)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((bits ^ (bits >> 32)) >> 11) as f64 / (1_u64 << 53) as f64
}

#[test]
fn what_a_page_shows_is_what_was_recorded_to_the_steps_it_states() {
    let recording = recorded(LIVELY);
    let film = Decoded::of(&player::film(&recording, 0).expect("a film"));
    assert!(film.quantum("place") <= 1e-4 * 0.5 && film.quantum("velocity") <= 0.01, "{}", film.head);
    let [place, velocity, angle, spin] = ["place", "velocity", "angle", "spin"].map(|name| 0.501 * film.quantum(name));
    let allowed = [place, place, angle, velocity, velocity, spin];
    assert_eq!(film.states.len(), recording.frames.len());
    for ((frame, states), time) in recording.frames.iter().zip(&film.states).zip(&film.times) {
        assert_eq!(frame.time, *time);
        for (state, told) in frame.states.iter().zip(states) {
            for (k, (number, told)) in state.to_array().into_iter().zip(told).enumerate() {
                let mut off = number - told;
                if k == 2 {
                    off -= (off / TAU).round() * TAU;
                    assert!(-PI - angle < *told && *told <= PI + angle);
                }
                assert!(off.abs() <= allowed[k], "{k}: {number} is told as {told}");
            }
        }
    }
    let kinds: Vec<&str> = (0..4).map(|i| film.head["bodies"][i]["kind"].as_str().expect("a kind")).collect();
    assert_eq!(kinds, ["driven", "fixed", "mobile", "mobile"]);
}

#[test]
fn exchanges_and_the_ledger_are_those_recorded() {
    let recording = recorded(LIVELY);
    let film = Decoded::of(&player::film(&recording, 0).expect("a film"));
    let mut hits: Vec<_> =
        recording.frames.iter().enumerate().flat_map(|(f, frame)| frame.hits.iter().map(move |hit| (f, hit))).collect();
    hits.sort_by_key(|(_, hit)| (hit.a, hit.b));
    assert!(hits.len() > 3, "{}", hits.len());
    assert_eq!(hits.len(), film.hits.len());
    let near = 0.51 * (film.quantum("point") + film.quantum("place"));
    for ((frame, hit), (whole, [x, z, normal, depth])) in hits.into_iter().zip(film.hits) {
        assert_eq!(whole, [frame as i64, hit.iteration as i64, i64::from(hit.a), i64::from(hit.b)]);
        assert!((hit.point[0] - x).abs() <= near && (hit.point[1] - z).abs() <= near);
        assert!((hit.normal[0] * libm::cos(normal) + hit.normal[1] * libm::sin(normal)) > 0.999_999);
        assert!((hit.depth - depth).abs() <= 0.01 * hit.depth);
    }
    let last = recording.frames.last().expect("an end");
    let told = |name: &str| {
        film.series.iter().find(|(known, _)| known == name).map(|(_, column)| *column.last().expect("an end"))
    };
    assert_eq!(told("kinetic_energy"), Some(last.totals.kinetic_energy));
    let drag = recording.about.causes.iter().position(|cause| cause == "drag").expect("a cause");
    assert_eq!(told("drag.kinetic_energy"), Some(last.books.as_ref().expect("books").booked[drag][0]));
    assert_eq!(told("gravity.kinetic_energy"), None, "what was never booked is not written");
}

#[test]
fn a_page_of_a_thousand_bodies_and_a_thousand_frames_is_below_10_mb() {
    // Free flight; every half second or so a body is thrown another way.
    let thrown = |i: usize, f: usize| (f + 61 * i) / 60;
    let velocity = |i: usize, f: usize, k: u64| 20.0 * noise((i as u64 * 1000 + thrown(i, f) as u64) * 3 + k) - 10.0;
    let recording = played(1000, 1000, |f, i| {
        let since = ((f + 61 * i) % 60) as f64 / 120.0;
        let start = |k: u64| 80.0 * noise((i as u64 * 1000 + thrown(i, f) as u64) * 7 + k);
        let [vx, vz, spin] = [0, 1, 2].map(|k| velocity(i, f, k));
        let angle = libm::remainder(spin * since, TAU);
        State { x: start(0) + vx * since, z: start(1) + vz * since, angle, vx, vz, spin }
    });
    let page = player::page(&recording).expect("a page");
    assert!(page.len() < 10_000_000, "{} bytes", page.len());
    let film = &Decoded::of_page(&page)[0];
    assert_eq!(film.states.len(), 1000, "every frame is there");
    assert!(film.quantum("place") <= 1e-6 * 90.0);
}

#[test]
fn a_run_that_is_all_surprises_loses_digits_then_frames_and_says_so() {
    let recording = played(500, 1500, |f, i| {
        let number = |k: u64| noise((f as u64 * 500 + i as u64) * 6 + k);
        let [x, z, angle, vx, vz, spin] = [0, 1, 2, 3, 4, 5].map(number);
        State { x: 80.0 * x, z: 80.0 * z, angle: 6.0 * angle - 3.0, vx: 100.0 * vx, vz: 100.0 * vz, spin }
    });
    let page = player::page(&recording).expect("a page");
    assert!(page.len() < 10_000_000, "{} bytes", page.len());
    let film = &Decoded::of_page(&page)[0];
    assert!(film.quantum("place") <= 1e-4 * 80.0);
    assert!(film.states.len() < 1500 && film.states.len() > 300, "{}", film.states.len());
    assert_eq!(film.iterations.last(), Some(&1499), "the end is there");
    let note = film.head["notes"][0].as_str().expect("a note");
    assert!(note.starts_with(&format!("{} of 1500 recorded frames are here", film.states.len())), "{note}");
}

#[test]
fn a_page_fetches_nothing_and_allows_its_own_texts_alone() {
    let page = player::page(&recorded(LIVELY)).expect("a page");
    let rules =
        page.split_once("Content-Security-Policy\" content=\"").expect("rules").1.split_once('"').expect("an end").0;
    let digest = |text: &str| format!("'sha256-{}'", BASE64.encode(Sha256::digest(text)));
    let between =
        |open: &str, close: &str| page.split_once(open).expect("a tag").1.split_once(close).expect("its end").0;
    let [script, style] = [between("<script>", "</script>"), between("<style>", "</style>")];
    assert_eq!(
        rules,
        format!(
            "default-src 'none'; script-src {}; style-src {}; base-uri 'none'; form-action 'none'",
            digest(script),
            digest(style)
        )
    );
    for word in
        ["src=", "href=", "@import", "url(", "fetch(", "XMLHttpRequest", "WebSocket", "import(", "innerHTML", "eval("]
    {
        assert!(!page.contains(word), "{word}");
    }
    let addresses: Vec<&str> = page.split("http").skip(1).map(|rest| rest.get(..25).unwrap_or(rest)).collect();
    let known = |rest: &&str| rest.starts_with("://www.w3.org/2000/svg") || rest.starts_with("-equiv=");
    assert!(addresses.iter().all(known), "{addresses:?}");
}

#[test]
fn hostile_names_and_texts_stay_texts() {
    let evil = r#"</script></pre></title><script>alert(1)</script><img src=x onerror='alert("{films}")'><!--"#;
    let mut recording = recorded(LIVELY);
    recording.about.title = evil.to_owned();
    recording.about.command = vec![evil.to_owned()];
    recording.about.plan = vec![evil.to_owned()];
    recording.about.choque = evil.to_owned();
    recording.about.sources[0].name = evil.to_owned();
    recording.about.sources[0].text = format!("\n{evil}\u{0}\u{1b}");
    recording.about.params[0].name = evil.to_owned();
    recording.bodies[0].name = evil.to_owned();
    recording.ending.expectations[0].text = evil.to_owned();
    let plain = player::page(&recorded(LIVELY)).expect("a page");
    for page in [
        player::page(&recording).expect("a page"),
        player::page_of_two(&recording, &recording, [evil, evil], 3).expect("a page"),
    ] {
        assert!(!page.contains("<img") && !page.contains("<!--") && !page.contains("alert(1)</script>"));
        assert!(!page.contains('\0') && !page.contains('\u{1b}'));
        let scripts = if page.matches("class=\"film\"").count() == 2 { 3 } else { 2 };
        assert_eq!((page.matches("<script").count(), page.matches("</script").count()), (scripts, scripts));
        let part = |page: &str| page.rsplit_once("<script>").expect("the player").1.to_owned();
        assert_eq!(part(&page), part(&plain), "the player is the same whatever it plays");
        assert_eq!(Decoded::of_page(&page)[0].head["bodies"][0]["name"], evil);
    }
}

#[test]
fn two_runs_are_laid_over_each_other_from_an_iteration_on() {
    let [a, b] = [recorded(LIVELY), recorded(&LIVELY.replace("mu_l(0.9)", "mu_l(0.5)"))];
    let page = player::page_of_two(&a, &b, ["mu_l=0.9", "mu_l=0.5"], 50).expect("a page");
    let films = Decoded::of_page(&page);
    assert_eq!(films.len(), 2);
    for film in &films {
        assert_eq!((film.iterations[0], film.iterations.len()), (50, 151));
    }
    assert!(
        page.contains("<b>A: mu_l=0.9</b>, drawn full; <b>B: mu_l=0.5</b>, as outlines")
            && page.contains("mu_l(0.5)")
            && page.contains("mu_l(0.9)")
    );
}

#[test]
fn scenes_with_next_to_nothing_in_them_have_a_page_too() {
    let still = "mobile(\"a\").rect(1, 1); steps(1);";
    for (bodies, frames) in [(0, 0), (0, 1), (0, 5), (1, 0), (1, 1), (3, 1)] {
        let page =
            player::page(&played(bodies, frames, |_, i| State { x: i as f64, ..State::default() })).expect("a page");
        let film = &Decoded::of_page(&page)[0];
        assert_eq!(
            film.states,
            vec![(0..bodies).map(|i| [i as f64, 0.0, 0.0, 0.0, 0.0, 0.0]).collect::<Vec<_>>(); frames]
        );
    }
    assert_eq!(Decoded::of(&player::film(&recorded(still), 1).expect("a film")).states.len(), 1);
    let far = played(2, 50, |f, i| State { x: 1e15 * i as f64, z: 1e-3 * f as f64, vx: 1e200, ..State::default() });
    let film = Decoded::of(&player::film(&far, 0).expect("a film"));
    assert!((film.states[49][1][0] - 1e15).abs() <= film.quantum("place"));
}

#[test]
fn a_body_at_no_place_is_refused_by_name() {
    let run = played(2, 3, |f, i| State { x: if (f, i) == (2, 1) { f64::NAN } else { 0.0 }, ..State::default() });
    let refused = player::page(&run).expect_err("no page").to_string();
    assert!(refused.contains("b1") && refused.contains("iteration 2"), "{refused}");
}

#[test]
fn render_writes_the_page_with_its_script_and_command_line() {
    let folder = folder(&[("lively.rhai", LIVELY)]);
    let page = folder.path().join("page.html");
    let output = choque()
        .current_dir(&folder)
        .args(["render", "lively.rhai", "--set", "speed=4", "-o", "page.html"])
        .output()
        .expect("it runs");
    assert!(output.status.success(), "{}", stderr(&output));
    let html = std::fs::read_to_string(page).expect("a page");
    assert!(html.starts_with("<!doctype html>") && html.contains("<title>Lively</title>"));
    assert!(
        html.contains("render lively.rhai --set speed=4 -o page.html")
            && html.contains("let speed = param(&quot;speed&quot;, 3, 0, 10);")
    );
    assert!(html.contains("<li class=\"held\">a is somewhere: held</li>"));
}

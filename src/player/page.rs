//! A page that needs nothing else: the player, what it plays, the script and the command line that made it.

use std::fmt::Write;

use super::Error;
use super::assets::{page_style, script, source_digest, style};
use super::film::film_in_text;
use super::text::{command_line, escaped, filled};
use crate::outcome::hexadecimal;
use crate::output::numbers::{counted, duration};
use crate::recording::{Recording, Source};

/// A recording as one HTML page.
///
/// # Errors
/// A body that is at no finite place.
pub fn page(recording: &Recording) -> Result<String, Error> {
    let films = carrier(&film_in_text(recording, 0)?, "");
    let subtitle = escaped(&subtitle(recording));
    Ok(assembled(&recording.about.title, &subtitle, &told(recording, None, &[]), &films))
}

/// Two recordings laid over each other, from the frame of that iteration on: the first drawn full, the second as outlines and
/// dotted curves. `names` say what each of them is; on the page they are A and B.
///
/// # Errors
/// A body that is at no finite place.
pub fn page_of_two(a: &Recording, b: &Recording, names: [&str; 2], from: u64) -> Result<String, Error> {
    let labels = [format!("A: {}", names[0]), format!("B: {}", names[1])];
    let films = [carrier(&film_in_text(a, from)?, &labels[0]), carrier(&film_in_text(b, from)?, &labels[1])].concat();
    let (title, other) = (&a.about.title, &b.about.title);
    let title = if title == other { title.clone() } else { format!("{title} and {other}") };
    let subtitle = format!(
        "from iteration {from}: <b>{}</b>, drawn full; <b>{}</b>, as outlines and dotted curves",
        escaped(&labels[0]),
        escaped(&labels[1])
    );
    let told = [told(a, Some('A'), &[]), told(b, Some('B'), &a.about.sources)].concat();
    Ok(assembled(&title, &subtitle, &told, &films))
}

fn assembled(title: &str, subtitle: &str, told: &str, films: &str) -> String {
    let style = format!("{}{}", style(), page_style());
    let script = format!("{}choque.startPage();\n", script());
    filled(include_str!("page.html"), |name| {
        Some(match name {
            "title" => escaped(title),
            "subtitle" => subtitle.to_owned(),
            "told" => told.to_owned(),
            "films" => films.to_owned(),
            "version" => env!("CARGO_PKG_VERSION").to_owned(),
            "style" => style.clone(),
            "script" => script.clone(),
            "style-digest" => source_digest(&style),
            "script-digest" => source_digest(&script),
            _ => return None,
        })
    })
}

/// A film where no browser takes it for a program.
fn carrier(film: &str, label: &str) -> String {
    format!("<script type=\"text/plain\" class=\"film\" data-label=\"{}\">{film}</script>\n", escaped(label))
}

fn subtitle(recording: &Recording) -> String {
    let bodies = counted(recording.bodies.len(), "body", "bodies");
    let iterations = counted(recording.ending.steps as usize, "iteration", "iterations");
    let collisions = counted(recording.ending.collisions as usize, "exchange", "exchanges");
    format!("{bodies}, {iterations} of {}, {collisions}", duration(recording.about.time_step))
}

/// The sources but for those that are on the page already, and how the run was made, as panels; of one of two runs each
/// begins with its letter.
fn told(recording: &Recording, letter: Option<char>, shown: &[Source]) -> String {
    let about = &recording.about;
    let of = letter.map(|letter| format!("{letter}: ")).unwrap_or_default();
    let mut html = String::from("<div class=\"side\">\n");
    for (index, source) in about.sources.iter().enumerate().filter(|(_, source)| !shown.contains(source)) {
        let open = if index == 0 { " open" } else { "" };
        let (name, text) = (escaped(&source.name), escaped(&source.text));
        // A line break right after the tag is not part of the text; without it a first empty line would be lost.
        let _ = writeln!(
            html,
            "<details class=\"panel\"{open}><summary><h2>{of}{name}</h2></summary><pre class=\"script\" tabindex=\"0\">\n{text}</pre></details>"
        );
    }
    html.push_str("</div>\n<div class=\"side\">\n");
    let _ = writeln!(html, "<details class=\"panel\" open><summary><h2>{of}how it was made</h2></summary>");
    if !about.command.is_empty() {
        let _ = writeln!(html, "<pre class=\"wrapped command\">\n{}</pre>", escaped(&command_line(&about.command)));
    }
    html.push_str("<dl class=\"facts\">\n");
    for (term, text) in facts(recording) {
        let _ = writeln!(html, "<dt>{}</dt><dd>{}</dd>", escaped(&term), escaped(&text));
    }
    html.push_str("</dl></details>\n");
    html.push_str(&expectations(recording, &of));
    let plan = escaped(&about.plan.join("\n"));
    let _ = writeln!(
        html,
        "<details class=\"panel\"><summary><h2>{of}the plan</h2></summary><pre class=\"wrapped\">\n{plan}</pre></details>\n</div>"
    );
    html
}

fn facts(recording: &Recording) -> Vec<(String, String)> {
    let about = &recording.about;
    let settings = &about.settings;
    let mut facts = vec![
        ("time step".to_owned(), format!("{} s", about.time_step)),
        ("μ_L, μ_A, ε".to_owned(), format!("{}, {}, {} m", settings.mu_l, settings.mu_a, settings.epsilon)),
    ];
    facts.extend(about.params.iter().map(|param| (param.name.clone(), param.value.to_string())));
    if let Some(last) = recording.frames.last() {
        facts.push(("digest at the end".to_owned(), hexadecimal(last.digest)));
    }
    let build = &about.build;
    facts.push(("choque".to_owned(), about.choque.clone()));
    facts.push(("built".to_owned(), format!("{}, {}, {}", build.rustc, build.target, build.cpu)));
    facts
}

fn expectations(recording: &Recording, of: &str) -> String {
    let judged = &recording.ending.expectations;
    if judged.is_empty() {
        return String::new();
    }
    let mut html = format!(
        "<details class=\"panel\" open><summary><h2>{of}expectations</h2></summary><ul class=\"expectations\">\n"
    );
    for expectation in judged {
        let (class, word) = if expectation.held { ("held", "held") } else { ("failed", "failed") };
        let _ = writeln!(html, "<li class=\"{class}\">{}: {word}</li>", escaped(&expectation.text));
    }
    html.push_str("</ul></details>\n");
    html
}

//! A scene as plain data: a `.ron` file, which `choque export` writes.

use std::path::Path;

use choque_engine::{Scene, SceneError};

use crate::control::{self, Control};
use crate::error::{Complaint, Diagnostic};
use crate::options::Options;
use crate::params::Params;
use crate::syntax::lower;

/// Reads a scene, with everything said from outside applied, and what may be tuned of it.
///
/// # Errors
/// What is no scene, with its line; a `--set` that nothing answers to.
pub(crate) fn read(file: &Path, text: &str, options: &Options) -> Result<(Scene, Vec<Control>), Diagnostic> {
    let mut scene: Scene = ron::from_str(text).map_err(|error| {
        let at = error.span.start;
        Diagnostic::new(format!("not a scene: {}", lower(&error.code.to_string()))).at(file, text, at.line, at.col)
    })?;
    let complain = |complaint: Complaint| Diagnostic::of(complaint).in_file(file);
    let params = Params::new(&options.set).map_err(complain)?;
    if let Some(complaint) = params.unanswered() {
        let used = options.set.iter().any(|(name, _)| scene.params.iter().any(|param| param.name == *name));
        let hint =
            used.then(|| "a .ron scene is plain data: its params have been used; set them for its script".to_owned());
        return Err(complain(complaint.maybe_hint(hint)));
    }
    let written = scene.settings.clone();
    params.apply_to(&mut scene.settings);
    let controls = control::of_settings(&written, &scene.settings).collect();
    options.overrides.apply_to(&mut scene.settings);
    Ok((scene, controls))
}

/// A scene that cannot run, shown at the line that names the body.
pub(crate) fn complain(file: &Path, text: &str, error: &SceneError) -> Diagnostic {
    complain_of_body(file, text, error.body(), error.to_string())
}

pub(crate) fn complain_of_body(file: &Path, text: &str, body: Option<&str>, message: String) -> Diagnostic {
    let quoted = body.map(|body| format!("{body:?}"));
    let place = quoted.and_then(|quoted| {
        let named = |line: &str| line.find(&quoted).filter(|at| line[..*at].trim_end().ends_with("name:"));
        text.lines()
            .enumerate()
            .find_map(|(line, text)| named(text).map(|at| (line + 1, text[..at].chars().count() + 1)))
    });
    match place {
        Some((line, column)) => Diagnostic::new(message).at(file, text, line, column),
        None => Diagnostic::new(message).in_file(file),
    }
}

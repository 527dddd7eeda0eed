//! A scene as plain data: a `.ron` file, which `choque export` writes.

use std::path::Path;

use choque_engine::{Scene, SceneError};

use crate::control::{self, Control};
use crate::error::{Complaint, Diagnostic};
use crate::options::Overrides;
use crate::params::Params;
use crate::syntax::lower;

/// Reads a scene as it is written.
///
/// # Errors
/// What is no scene, with its line.
pub(crate) fn read(file: &Path, text: &str) -> Result<Scene, Diagnostic> {
    ron::from_str(text).map_err(|error| {
        let at = error.span.start;
        Diagnostic::new(format!("not a scene: {}", lower(&error.code.to_string()))).at(file, text, at.line, at.col)
    })
}

/// Applies everything said from outside; gives what may be tuned.
///
/// # Errors
/// A `--set` that nothing answers to.
pub(crate) fn apply(
    scene: &mut Scene,
    file: &Path,
    set: &[(String, f64)],
    overrides: &Overrides,
) -> Result<Vec<Control>, Diagnostic> {
    let complain = |complaint: Complaint| Diagnostic::of(complaint).in_file(file);
    let params = Params::new(set).map_err(complain)?;
    if let Some(complaint) = params.unanswered() {
        let used = set.iter().any(|(name, _)| scene.params.iter().any(|param| param.name == *name));
        let hint =
            used.then(|| "a .ron scene is plain data: its params have been used; set them for its script".to_owned());
        return Err(complain(complaint.maybe_hint(hint)));
    }
    let written = scene.settings.clone();
    params.apply_to(&mut scene.settings);
    let controls = control::of_settings(&written, &scene.settings).collect();
    overrides.apply_to(&mut scene.settings);
    Ok(controls)
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

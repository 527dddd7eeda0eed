//! A scenario: a script or a plain scene, ready to run as often as one likes.

use std::cell::RefCell;
use std::fmt;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use choque_engine::{Scene, SceneError, World, check};

use crate::callbacks::Callbacks;
use crate::control::Control;
use crate::error::{Complaint, Diagnostic};
use crate::fit::{Variable, Varied, Wanted};
use crate::library::read_text;
use crate::options::{Options, Overrides, Stop};
use crate::plain;
use crate::run::Run;
use crate::script::{Program, Script};
use crate::session::Site;

/// A scenario that was read: the scene it describes, and the callbacks it has.
pub struct Scenario {
    file: PathBuf,
    options: Options,
    name: String,
    scene: Scene,
    callbacks: Callbacks,
    controls: Vec<Control>,
    wanted: Wanted,
    source: Source,
}

enum Source {
    /// A `.ron` scene: its text, and what that says before anything is said from outside.
    Plain { text: Rc<str>, as_written: Rc<Scene> },
    /// A `.rhai` script, ready for the first run; later runs make it ready again, so that none sees what
    /// another has done to the variables of a closure or to the generator.
    Script { program: Rc<Program>, ready: Box<RefCell<Option<Script>>> },
}

/// What a scenario's file name ends in: of a script, and of a plain scene.
const SCRIPT: &str = "rhai";
const PLAIN: &str = "ron";

impl Scenario {
    /// Whether a file's name is a script's.
    #[must_use]
    pub fn is_script(file: &Path) -> bool {
        file.extension().is_some_and(|extension| extension == SCRIPT)
    }

    /// Whether a file's name is a scenario's: a script's or a plain scene's.
    #[must_use]
    pub fn is_named(file: &Path) -> bool {
        Scenario::is_script(file) || file.extension().is_some_and(|extension| extension == PLAIN)
    }

    /// Reads a `.rhai` script and runs its main part, or reads a `.ron` scene.
    ///
    /// # Errors
    /// What is wrong with the file, the script, the scene, or with a `--set` or an override.
    pub fn load(file: &Path, options: &Options) -> Result<Scenario, Diagnostic> {
        check_overrides(&options.overrides)?;
        check_library(options)?;
        if !Scenario::is_named(file) {
            return Err(unknown_kind(file));
        }
        options.reads.tell(file);
        let text = read_text(file, file)?;
        if Scenario::is_script(file) {
            Scenario::of_program(file, Rc::new(Program::compile(file, &text, options)?), options.clone())
        } else {
            let as_written = Rc::new(plain::read(file, &text)?);
            Scenario::of_scene(file, text.into(), as_written, options.clone())
        }
    }

    /// The same scenario with other numbers. A script is not read and compiled again: only its main part runs. What else
    /// the options of [`Scenario::load`] said still holds.
    ///
    /// # Errors
    /// What is wrong with a `--set` or an override, or with the script given these numbers.
    pub fn with(&self, set: &[(String, f64)], overrides: Overrides) -> Result<Scenario, Diagnostic> {
        check_overrides(&overrides)?;
        let options = Options { set: set.to_owned(), overrides, ..self.options.clone() };
        match &self.source {
            Source::Plain { text, as_written } => {
                Scenario::of_scene(&self.file, text.clone(), as_written.clone(), options)
            }
            Source::Script { program, .. } => Scenario::of_program(&self.file, program.clone(), options),
        }
    }

    /// From now on it is this one that stops the scenario, and all that [`Scenario::with`] makes of it: a stop that was asked for
    /// once stays so, and whoever runs the scenario again needs another.
    pub fn heed(&self, stop: &Stop) {
        if let Source::Script { program, .. } = &self.source {
            program.heed(stop);
        }
    }

    fn of_program(file: &Path, program: Rc<Program>, options: Options) -> Result<Scenario, Diagnostic> {
        let (mut script, scene) = program.prepare(&options.set, &options.overrides)?;
        let (callbacks, controls) = (script.callbacks, std::mem::take(&mut script.controls));
        let wanted = Wanted { varied: std::mem::take(&mut script.varied), targets: script.aims.len() };
        let source = Source::Script { program, ready: Box::new(RefCell::new(Some(script))) };
        Ok(Scenario { file: file.to_owned(), options, name: name_of(file), scene, callbacks, controls, wanted, source })
    }

    fn of_scene(file: &Path, text: Rc<str>, as_written: Rc<Scene>, options: Options) -> Result<Scenario, Diagnostic> {
        let mut scene = Scene::clone(&as_written);
        let controls = plain::apply(&mut scene, file, &options.set, &options.overrides)?;
        let (callbacks, wanted) = (Callbacks::default(), Wanted::default());
        let source = Source::Plain { text, as_written };
        Ok(Scenario { file: file.to_owned(), options, name: name_of(file), scene, callbacks, controls, wanted, source })
    }

    /// The scene, with every `--set` and override applied.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The scene, to be changed before a run starts: bodies keep their number and names. Callbacks stay as they are.
    pub fn scene_mut(&mut self) -> &mut Scene {
        &mut self.scene
    }

    /// The file's name without its extension.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The title the script gives, or else the name.
    #[must_use]
    pub fn title(&self) -> String {
        if self.scene.title.is_empty() { self.name.clone() } else { self.scene.title.clone() }
    }

    /// How it was loaded.
    #[must_use]
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The texts it was made from: the script or scene first, then what it imported and the models it read, each with its
    /// name as errors show it.
    #[must_use]
    pub fn sources(&self) -> Vec<(String, String)> {
        let name = self.file.display().to_string();
        let others = match &self.source {
            Source::Plain { .. } => Vec::new(),
            Source::Script { program, .. } => program.texts_read(),
        };
        let others = others.into_iter().filter(|(other, _)| *other != name);
        std::iter::once((name.clone(), self.text().to_owned())).chain(others).collect()
    }

    /// Which callbacks and expectations it has.
    #[must_use]
    pub fn callbacks(&self) -> Callbacks {
        self.callbacks
    }

    /// What may be tuned of it: the settings that `--set` reaches, then the script's params in their order.
    #[must_use]
    pub fn controls(&self) -> &[Control] {
        &self.controls
    }

    /// The text of the file it was read from, without a byte order mark.
    #[must_use]
    pub fn text(&self) -> &str {
        match &self.source {
            Source::Plain { text, .. } => text,
            Source::Script { program, .. } => program.text(),
        }
    }

    /// What the script says may vary, in its order.
    #[must_use]
    pub fn varied(&self) -> &[Varied] {
        &self.wanted.varied
    }

    /// A number of this scenario that may vary although the script does not say so, or within other bounds.
    ///
    /// # Errors
    /// A name that there is not; bounds that it cannot have.
    pub fn vary(&self, name: &str, range: (f64, f64)) -> Result<Varied, Diagnostic> {
        let variable = Variable::new(name, Some(range), Site::nowhere());
        let varied = variable.and_then(|variable| variable.resolve(&self.scene));
        varied.map_err(|complaint| Diagnostic::of(complaint).in_file(&self.file))
    }

    /// How many targets the script has.
    #[must_use]
    pub fn targets(&self) -> usize {
        self.wanted.targets
    }

    /// A run from the start; several runs of one scenario know nothing of each other.
    ///
    /// # Errors
    /// A scene that cannot run, shown at the line where the body in question was made.
    pub fn start(&self) -> Result<Run, Diagnostic> {
        match &self.source {
            Source::Plain { text, .. } => {
                let world = World::new(&self.scene).map_err(|error| plain::complain(&self.file, text, &error))?;
                Ok(Run::plain(world, self.scene.settings.steps, &self.file, text))
            }
            Source::Script { program, ready } => {
                let script = match ready.take() {
                    Some(script) => script,
                    None => program.prepare(&self.options.set, &self.options.overrides)?.0,
                };
                match World::new(&self.scene) {
                    Ok(world) => Ok(Run::scripted(script, world, &self.scene)),
                    Err(error) => Err(self.refused(&script, &error)),
                }
            }
        }
    }

    fn refused(&self, script: &Script, error: &SceneError) -> Diagnostic {
        script.complain_of_body(&self.scene, error.body(), Complaint::new(error.to_string()))
    }
}

impl fmt::Debug for Scenario {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Scenario").field("file", &self.file).field("scene", &self.scene).finish_non_exhaustive()
    }
}

/// The file's name without its extension.
fn name_of(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn unknown_kind(file: &Path) -> Diagnostic {
    Diagnostic::new(format!("{} is neither a .rhai script nor a .ron scene", file.display()))
        .in_file(file)
        .with_hint(Some("a scenario's file name ends in .rhai or .ron".to_owned()))
}

/// What is wrong whatever the file says.
fn check_overrides(overrides: &Overrides) -> Result<(), Diagnostic> {
    if let Some(time_step) = overrides.time_step {
        check::positive("--time-step", time_step).map_err(|bad| Diagnostic::new(bad.to_string()))?;
    }
    if let Some(substeps) = overrides.substeps {
        check::substeps("--substeps", substeps.into()).map_err(|bad| Diagnostic::new(bad.to_string()))?;
    }
    Ok(())
}

fn check_library(options: &Options) -> Result<(), Diagnostic> {
    match &options.library {
        Some(folder) if !folder.is_dir() => {
            Err(Diagnostic::new(format!("--library {}: there is no such folder", folder.display())))
        }
        _ => Ok(()),
    }
}

//! A script made ready: compiled once, its main part run, so that a scene and callbacks are there.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use choque_engine::{Scene, World};
use rhai::{AST, Dynamic, Engine, GlobalRuntimeState, Module, NativeCallContext, Position, Scope};

use crate::blame::Blame;
use crate::callbacks::Callbacks;
use crate::calls;
use crate::clock::Clock;
use crate::control::{self, Control};
use crate::draft::Draft;
use crate::error::{Complaint, Diagnostic};
use crate::expectation::Pending;
use crate::fit::{Aim, Variable, Varied};
use crate::library::{Found, Library};
use crate::modules::Resolver;
use crate::options::{Options, Overrides, Stop};
use crate::params::Params;
use crate::sandbox;
use crate::session::{Phase, RhaiResultOf, Running, Session, SessionTag, Site};

/// A script that was read and compiled: its main part can run as often as one likes, each time with other numbers.
pub(crate) struct Program {
    engine: Engine,
    ast: AST,
    text: String,
    clock: Clock,
    library: Rc<Library>,
    /// The script's name, as errors show it.
    name: String,
    file: PathBuf,
    /// The callbacks it defines; expectations are known once the main part has run.
    callbacks: Callbacks,
}

impl Program {
    /// Compiles a script.
    ///
    /// # Errors
    /// What the language does not allow; a callback that could never be called; a function that hides a word.
    pub(crate) fn compile(file: &Path, text: &str, options: &Options) -> Result<Program, Diagnostic> {
        let library = Rc::new(Library::new(file, options.library.as_deref(), options.reads.clone()));
        let name = file.display().to_string();
        library.keep(&name, text);
        let clock = Clock::new(options.script_timeout, options.stop.clone());
        let resolver = Resolver::new(library.clone(), Found::itself(file));
        let engine = sandbox::engine(resolver, &clock, &options.output);
        let blame = Blame { engine: &engine, library: &library, script: &name };
        let mut ast = sandbox::compile(&engine, text).map_err(|error| blame.syntax_error(error))?;
        ast.set_source(&name);
        if let Some((function, complaint)) = calls::hidden_word(text) {
            return Err(blame.complaint_at(complaint, &blame.definition(function.text)));
        }
        let callbacks = Callbacks::of(&ast)
            .map_err(|(function, complaint)| blame.complaint_at(complaint, &blame.definition(&function)))?;
        Ok(Program { engine, ast, text: text.to_owned(), clock, library, name, file: file.to_owned(), callbacks })
    }

    /// Runs the main part with these numbers; gives the scene it makes.
    ///
    /// # Errors
    /// What is wrong with the script as it runs, or with a `--set`.
    pub(crate) fn prepare(
        self: &Rc<Self>,
        set: &[(String, f64)],
        overrides: &Overrides,
    ) -> Result<(Script, Scene), Diagnostic> {
        let blame = self.blame();
        let params = Params::new(set).map_err(|complaint| Diagnostic::of(complaint).in_file(&self.file))?;
        let session = Rc::new(RefCell::new(Session::new(params, overrides.seed, self.library.clone())));
        self.clock.restart();
        let outcome = self.run_main_part(&session);
        // Taken out even when the script failed: expectations hold on to the session, and would keep it for ever.
        let pending = std::mem::take(&mut session.borrow_mut().pending);
        let aims = std::mem::take(&mut session.borrow_mut().aims);
        let surroundings = outcome.map_err(|error| blame.error(&error, None))?;
        let finished = finish(&mut session.borrow_mut(), overrides);
        let Finished { scene, sites, controls } = finished.map_err(|complaint| blame.complaint_of_script(complaint))?;
        let varied =
            varied(&session.borrow(), &scene).map_err(|(complaint, site)| blame.complaint_at(complaint, &site))?;
        let callbacks = self.callbacks.counting(&pending);
        let program = self.clone();
        Ok((Script { program, session, callbacks, pending, aims, varied, surroundings, sites, controls }, scene))
    }

    /// Runs the main part for a session, and keeps what callbacks will see: not its variables, but its functions, imports
    /// and constants.
    fn run_main_part(&self, session: &Rc<RefCell<Session>>) -> RhaiResultOf<GlobalRuntimeState> {
        let begin = || {
            let mut global = self.engine.new_global_runtime_state();
            global.tag = Dynamic::from(SessionTag(session.clone()));
            global
        };
        let module = Module::eval_ast_as_new_raw(&self.engine, &mut Scope::new(), &mut begin(), &self.ast)?;
        let mut surroundings = begin();
        surroundings.source = self.ast.source().map(Into::into);
        surroundings.lib.push(module.into());
        Ok(surroundings)
    }

    /// From now on it is this one that stops the script.
    pub(crate) fn heed(&self, stop: &Stop) {
        self.clock.heed(stop);
    }

    /// The text of the script.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// Every script and model read so far, with its name.
    pub(crate) fn texts_read(&self) -> Vec<(String, String)> {
        self.library.texts_read()
    }

    fn blame(&self) -> Blame<'_> {
        Blame { engine: &self.engine, library: &self.library, script: &self.name }
    }
}

/// A script whose main part has run.
pub(crate) struct Script {
    program: Rc<Program>,
    pub(crate) session: Rc<RefCell<Session>>,
    pub(crate) callbacks: Callbacks,
    pub(crate) pending: Vec<Pending>,
    pub(crate) aims: Vec<Aim>,
    pub(crate) varied: Vec<Varied>,
    /// Where callbacks run: the script's functions, with its imports and constants around them.
    surroundings: GlobalRuntimeState,
    /// Where each body was made.
    sites: Vec<Site>,
    /// What may be tuned.
    pub(crate) controls: Vec<Control>,
}

/// What the main part of a script left behind.
struct Finished {
    scene: Scene,
    sites: Vec<Site>,
    controls: Vec<Control>,
}

impl Script {
    /// Compiles a script and runs its main part, once; gives the scene it makes.
    pub(crate) fn prepare(file: &Path, text: &str, options: &Options) -> Result<(Script, Scene), Diagnostic> {
        Rc::new(Program::compile(file, text, options)?).prepare(&options.set, &options.overrides)
    }

    /// Lets the world begin: from now on words see it instead of the scene.
    pub(crate) fn enter(&self, world: Rc<RefCell<World>>) {
        self.session.borrow_mut().phase = Phase::Running(Running::new(world));
    }

    /// Whether a word stands anywhere in it, or in what it imports at its top.
    pub(crate) fn speaks_of(&self, word: &str) -> bool {
        self.program.library.speaks_of(word)
    }

    /// Every script and model read so far, with its name.
    pub(crate) fn texts_read(&self) -> Vec<(String, String)> {
        self.program.texts_read()
    }

    /// Calls a callback of the script.
    pub(crate) fn call(&self, callback: &str, arguments: &mut [Dynamic]) -> Result<Dynamic, Diagnostic> {
        self.program.clock.restart();
        let context = self.context(callback, &self.surroundings);
        let mut arguments: Vec<&mut Dynamic> = arguments.iter_mut().collect();
        context
            .call_fn_raw(callback, false, false, &mut arguments)
            .map_err(|error| self.blame().error(&error, Some(&self.blame().definition(callback))))
    }

    /// Asks an expectation about the world.
    pub(crate) fn ask(&self, pending: &Pending, world: Dynamic) -> Result<Dynamic, Diagnostic> {
        self.program.clock.restart();
        let context = self.context(pending.judge.fn_name(), &pending.surroundings);
        pending.judge.call_raw(&context, None, [world]).map_err(|error| {
            self.blame().error(&error, Some(&pending.site)).and_note(format!("in {}", pending.title()))
        })
    }

    /// A complaint about an expectation.
    pub(crate) fn complain_of(&self, pending: &Pending, complaint: Complaint) -> Diagnostic {
        self.blame().complaint_at(complaint, &pending.site)
    }

    /// A complaint about a callback.
    pub(crate) fn complain_of_callback(&self, callback: &str, complaint: Complaint) -> Diagnostic {
        self.blame().complaint_at(complaint, &self.blame().definition(callback))
    }

    /// A complaint about a param, shown where it is declared.
    pub(crate) fn complain_of_param(&self, name: &str, complaint: Complaint) -> Diagnostic {
        match self.session.borrow().params.site_of(name) {
            Some(site) => self.blame().complaint_at(complaint, site),
            None => self.blame().complaint_of_script(complaint),
        }
    }

    /// A complaint about a body, shown where it was made; without one, about the script.
    pub(crate) fn complain_of_body(&self, scene: &Scene, body: Option<&str>, complaint: Complaint) -> Diagnostic {
        let index = body.and_then(|name| scene.bodies.iter().position(|body| body.name == name));
        match index.and_then(|index| self.sites.get(index)) {
            Some(site) => self.blame().complaint_at(complaint, site),
            None => self.blame().complaint_of_script(complaint),
        }
    }

    fn blame(&self) -> Blame<'_> {
        self.program.blame()
    }

    fn context<'a>(&'a self, function: &'a str, surroundings: &'a GlobalRuntimeState) -> NativeCallContext<'a> {
        NativeCallContext::new_with_all_fields(&self.program.engine, function, None, surroundings, Position::NONE)
    }
}

/// The scene, with everything said from outside applied; where its bodies were made; what may be tuned.
fn finish(session: &mut Session, overrides: &Overrides) -> Result<Finished, Complaint> {
    if let Some(complaint) = session.params.unanswered() {
        return Err(complaint);
    }
    let Draft { mut scene, sites, .. } = std::mem::take(session.draft("")?);
    scene.params = session.params.record();
    let written = scene.settings.clone();
    session.params.apply_to(&mut scene.settings);
    let controls = control::of_settings(&written, &scene.settings).chain(session.params.controls()).collect();
    overrides.apply_to(&mut scene.settings);
    Ok(Finished { scene, sites, controls })
}

/// What may vary, looked up in the scene; with where the script says so when it cannot be.
fn varied(session: &Session, scene: &Scene) -> Result<Vec<Varied>, (Complaint, Site)> {
    let resolved = |variable: &Variable| variable.resolve(scene).map_err(|wrong| (wrong, variable.site.clone()));
    session.variables.iter().map(resolved).collect()
}
